//! `frontalis take …`: record sessions, and what becomes of the recordings.

mod diff;
mod export;
mod play;
mod resolve;
mod source;

use std::process::ExitCode;

use anyhow::Context as _;
use clap::{Args, Subcommand};
use frontalis_client::{connection::Channel, error::ClientError, proto};
use frontalis_proto::FieldMask;
use proto::take_service_client::TakeServiceClient;

use self::play::PlayArgs;
use self::resolve::ResolveArgs;
use super::{
    Context, actor_name,
    names::{session_name, take_name},
};
use crate::terminal::{say, tables};

/// Takes listed by one call.
const PAGE_SIZE: u32 = 200;

#[derive(Debug, Subcommand)]
pub enum TakeCommand {
    /// Record a session: what it acknowledges from now on is on the server's disk
    Start(StartArgs),
    /// End a recording; returns when all of it is on the server's disk
    Stop(IdArgs),
    /// List the takes of the server
    List(ListArgs),
    /// Show one take, as far as it has been recorded
    Show(IdArgs),
    /// Correct what is said of a take: slate, number, gesture, notes, the director's choice
    Label(LabelArgs),
    /// Save a take: its MCAP, or curves as CSV, for Live Link or moving a face, or markers as TRC or C3D
    Export(export::ExportArgs),
    /// Publish a take again, in time, into a session
    Play(PlayArgs),
    /// Solve a take again into a new one, with another revision of the actor or other settings
    Resolve(ResolveArgs),
    /// Where the curves of two takes differ, muscle by muscle: largest, RMS, and a picture
    Diff(diff::DiffArgs),
    /// Erase a take; nothing of it stays on the server's disk, and it cannot be brought back
    Delete(DeleteArgs),
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  frontalis take start stage-1 --slate 12A                  the next take of slate 12A
  frontalis take start stage-1 --pre-roll 5 --gesture smile  with the five seconds before")]
pub struct StartArgs {
    /// The session to be recorded
    session: String,
    /// Slate
    #[arg(long, default_value = "")]
    slate: String,
    /// Number on the slate [default: the next one]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    number: Option<u32>,
    /// What a training take shows
    #[arg(long, value_name = "LABEL", default_value = "")]
    gesture: String,
    /// So many seconds of what came before, from 0 to 10: frames and curves that the session still holds
    #[arg(long, value_name = "SECS", default_value_t = 0.0)]
    pre_roll: f64,
    /// Keep raw images too, which a session of markers has none of
    #[arg(long)]
    with_images: bool,
}

#[derive(Debug, Args)]
pub struct IdArgs {
    /// The take
    id: String,
}

#[derive(Debug, Args)]
pub struct ListArgs {
    /// Those of this session
    #[arg(long, value_name = "ID")]
    session: Option<String>,
    /// Those of this actor
    #[arg(long, value_name = "ID")]
    actor: Option<String>,
    /// Those of this slate
    #[arg(long)]
    slate: Option<String>,
}

#[derive(Debug, Args)]
#[command(after_help = "Only what is given changes.

Example:
  frontalis take label stage-1-19f3 --circled --notes 'the one'")]
pub struct LabelArgs {
    /// The take
    id: String,
    /// Slate
    #[arg(long)]
    slate: Option<String>,
    /// Number on the slate
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    number: Option<u32>,
    /// What a training take shows; empty: nothing
    #[arg(long, value_name = "LABEL")]
    gesture: Option<String>,
    /// The director's choice
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    circled: Option<bool>,
    /// Anything else
    #[arg(long, value_name = "TEXT")]
    notes: Option<String>,
}

#[derive(Debug, Args)]
pub struct DeleteArgs {
    /// The take
    id: String,
    /// Do it: a take cannot be brought back
    #[arg(long)]
    yes: bool,
}

type Client = TakeServiceClient<Channel>;

pub async fn run(context: &Context, command: TakeCommand) -> anyhow::Result<ExitCode> {
    let what = command.what();
    if let TakeCommand::Delete(args) = &command
        && !args.yes
    {
        anyhow::bail!("{what} without --yes: nothing of it would be left");
    }
    // Those that tell more than what became of a take.
    let command = match command {
        TakeCommand::Play(args) => return play::run(context, args).await.context(what),
        TakeCommand::Diff(args) => return diff::run(context, &args).await.context(what),
        other => other,
    };
    let mut client = TakeServiceClient::new(context.connect().await?);
    let take = match command {
        TakeCommand::List(args) => {
            list(context, &mut client, args).await?;
            return Ok(ExitCode::SUCCESS);
        }
        TakeCommand::Export(args) => {
            export::run(context, &mut client, &args)
                .await
                .context(what)?;
            return Ok(ExitCode::SUCCESS);
        }
        TakeCommand::Delete(args) => {
            let request = proto::DeleteTakeRequest {
                name: take_name(&args.id),
            };
            let deleted = client.delete_take(request).await;
            deleted.map_err(ClientError::from).context(what)?;
            say(format!("take {} is erased", args.id))?;
            return Ok(ExitCode::SUCCESS);
        }
        TakeCommand::Play(_) | TakeCommand::Diff(_) => {
            unreachable!("invariant: they were run above")
        }
        TakeCommand::Start(args) => start(&mut client, args).await,
        TakeCommand::Stop(args) => stop(&mut client, &args).await,
        TakeCommand::Show(args) => show(&mut client, &args).await,
        TakeCommand::Resolve(args) => resolve::run(&mut client, &args).await,
        TakeCommand::Label(args) => label(&mut client, args).await,
    };
    let take = take.context(what)?.unwrap_or_default();
    if context.json {
        say(serde_json::to_value(take)?)?;
    } else {
        say(tables::takes(&[take]))?;
    }
    Ok(ExitCode::SUCCESS)
}

impl TakeCommand {
    /// What failed, when it failed.
    fn what(&self) -> String {
        match self {
            Self::Start(args) => format!("cannot record session {}", args.session),
            Self::Stop(args) => format!("cannot stop take {}", args.id),
            Self::List(_) => "cannot list the takes".to_owned(),
            Self::Show(args) => format!("cannot show take {}", args.id),
            Self::Label(args) => format!("cannot change take {}", args.id),
            Self::Export(args) => format!("cannot save take {}", args.id),
            Self::Play(args) => format!("cannot play {}", args.take()),
            Self::Diff(args) => format!("cannot compare {} and {}", args.first, args.second),
            Self::Resolve(args) => format!("cannot solve take {} again", args.id),
            Self::Delete(args) => format!("cannot erase take {}", args.id),
        }
    }
}

async fn start(client: &mut Client, args: StartArgs) -> Result<Option<proto::Take>, ClientError> {
    let request = proto::StartTakeRequest {
        session: session_name(&args.session),
        slate: args.slate,
        number: args.number.unwrap_or_default(),
        gesture: args.gesture,
        with_images: args.with_images,
        pre_roll: (args.pre_roll > 0.0).then(|| seconds(args.pre_roll)),
    };
    if args.with_images {
        eprintln!(
            "note: a session of markers has no images: --with-images is noted and has no effect"
        );
    }
    Ok(client.start_take(request).await?.into_inner().take)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the server takes 0 to 10 s and refuses what saturates"
)]
fn seconds(secs: f64) -> pbjson_types::Duration {
    pbjson_types::Duration {
        seconds: secs.trunc() as i64,
        nanos: (secs.fract() * 1e9).round() as i32,
    }
}

async fn stop(client: &mut Client, args: &IdArgs) -> Result<Option<proto::Take>, ClientError> {
    let name = take_name(&args.id);
    let request = proto::StopTakeRequest { name };
    Ok(client.stop_take(request).await?.into_inner().take)
}

async fn show(client: &mut Client, args: &IdArgs) -> Result<Option<proto::Take>, ClientError> {
    let name = take_name(&args.id);
    let request = proto::GetTakeRequest { name };
    Ok(client.get_take(request).await?.into_inner().take)
}

async fn label(client: &mut Client, args: LabelArgs) -> Result<Option<proto::Take>, ClientError> {
    let given = [
        ("slate", args.slate.is_some()),
        ("number", args.number.is_some()),
        ("gesture", args.gesture.is_some()),
        ("circled", args.circled.is_some()),
        ("notes", args.notes.is_some()),
    ];
    let paths = given.into_iter().filter(|it| it.1);
    let request = proto::UpdateTakeRequest {
        update_mask: Some(FieldMask {
            paths: paths.map(|it| it.0.to_owned()).collect(),
        }),
        take: Some(proto::Take {
            name: take_name(&args.id),
            slate: args.slate.unwrap_or_default(),
            number: args.number.unwrap_or_default(),
            gesture: args.gesture.unwrap_or_default(),
            circled: args.circled.unwrap_or_default(),
            notes: args.notes.unwrap_or_default(),
            ..proto::Take::default()
        }),
    };
    Ok(client.update_take(request).await?.into_inner().take)
}

async fn list(context: &Context, client: &mut Client, args: ListArgs) -> anyhow::Result<()> {
    let mut takes = Vec::new();
    let mut page_token = String::new();
    loop {
        let request = proto::ListTakesRequest {
            page_size: PAGE_SIZE,
            page_token,
            actor: args.actor.as_deref().map(actor_name).unwrap_or_default(),
            session: args
                .session
                .as_deref()
                .map(session_name)
                .unwrap_or_default(),
            slate: args.slate.clone().unwrap_or_default(),
        };
        let page = client.list_takes(request).await;
        let page = page.map_err(ClientError::from)?.into_inner();
        takes.extend(page.takes);
        page_token = page.next_page_token;
        if page_token.is_empty() {
            break;
        }
    }
    if context.json {
        let all = proto::ListTakesResponse {
            takes,
            next_page_token: String::new(),
        };
        say(serde_json::to_value(all)?)?;
    } else {
        say(tables::takes(&takes))?;
    }
    Ok(())
}
