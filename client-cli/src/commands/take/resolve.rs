//! `frontalis take resolve …`: solve a recorded performance again, into a new take.

use clap::Args;
use frontalis_client::{error::ClientError, proto};

use super::Client;
use crate::{
    commands::{names::take_name, settings::SettingsArgs},
    terminal::progress,
};

#[derive(Debug, Args)]
#[command(
    after_help = "What is not given stays as it was recorded; then the new take has the curves of the old one, bit for bit.
Defaults in brackets are those of a new session. Ctrl-C gives up, and leaves nothing behind.

Examples:
  frontalis take resolve stage-1-19f3 --revision 2
  frontalis take resolve stage-1-19f3 --regions split --plain"
)]
pub struct ResolveArgs {
    /// The take
    pub id: String,
    /// With this revision of the actor, throughout
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    revision: Option<u32>,
    #[command(flatten)]
    settings: SettingsArgs,
}

/// The new take.
pub async fn run(
    client: &mut Client,
    args: &ResolveArgs,
) -> Result<Option<proto::Take>, ClientError> {
    let settings = args.settings.to_proto();
    let is_given = settings != proto::SessionSettings::default();
    let request = proto::ResolveTakeRequest {
        name: take_name(&args.id),
        actor_revision: args.revision.unwrap_or_default(),
        settings: is_given.then_some(settings),
    };
    let mut answers = client.resolve_take(request).await?.into_inner();
    let bar = progress::frames(0, "solving");
    let mut take = None;
    while let Some(answer) = answers.message().await? {
        bar.set_length(answer.n_frames);
        bar.set_position(answer.frames_done);
        take = answer.take.or(take);
    }
    bar.finish_and_clear();
    Ok(take)
}
