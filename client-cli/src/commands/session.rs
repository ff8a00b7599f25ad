//! `frontalis session …`: prepare, change and end captures.

use std::process::ExitCode;

use anyhow::Context as _;
use clap::{Args, Subcommand};
use frontalis_client::{connection::Channel, error::ClientError, proto};
use frontalis_proto::FieldMask;
use proto::{session_service_client::SessionServiceClient, take_service_client::TakeServiceClient};

use super::{Context, actor_name, names::new_session_id, session_name, settings::SettingsArgs};
use crate::terminal::{say, tables};

/// Sessions listed by one call.
const PAGE_SIZE: u32 = 200;

#[derive(Debug, Subcommand)]
pub enum SessionCommand {
    /// Prepare a capture of an actor
    Create(CreateArgs),
    /// List the sessions of the server
    List,
    /// Show one session: settings, state, counts, latencies, subscribers, and what its curves say of the shapes
    Show(IdArgs),
    /// Change settings, or move to another revision of the actor, between two frames
    Update(UpdateArgs),
    /// Take another neutral face; a live session goes on with the old one until the new is known
    Recenter(RecenterArgs),
    /// End a session: what is queued is solved, subscribers are told
    End(IdArgs),
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  frontalis session create --actor anna --id take-1
  frontalis session create --actor anna --record --slate 12A
  frontalis session create --actor anna --neutral-frames 1 --regions split --plain   as in the paper")]
pub struct CreateArgs {
    /// Whose capture it is
    #[arg(long, value_name = "ID")]
    actor: String,
    /// Id of the session: 1 to 63 of a-z, 0-9, - and _ [default: the server makes one]
    #[arg(long, value_parser = new_session_id)]
    id: Option<String>,
    /// Name for people
    #[arg(long, value_name = "NAME")]
    display_name: Option<String>,
    /// Record it from its first frame on
    #[arg(long)]
    record: bool,
    /// Slate of the recording
    #[arg(long, requires = "record")]
    slate: Option<String>,
    /// Number of the recording on its slate [default: the next one]
    #[arg(long, value_name = "N", requires = "record", value_parser = clap::value_parser!(u32).range(1..))]
    take: Option<u32>,
    /// What the recording, a training take, shows
    #[arg(long, value_name = "LABEL", requires = "record")]
    gesture: Option<String>,
    #[command(flatten)]
    settings: SettingsArgs,
}

impl CreateArgs {
    /// The recording that is started at once, because something is said of it; else the server starts one with the first
    /// frame.
    fn labeled_take(&self) -> Option<proto::StartTakeRequest> {
        let is_labeled = self.slate.is_some() || self.take.is_some() || self.gesture.is_some();
        is_labeled.then(|| proto::StartTakeRequest {
            slate: self.slate.clone().unwrap_or_default(),
            number: self.take.unwrap_or_default(),
            gesture: self.gesture.clone().unwrap_or_default(),
            ..proto::StartTakeRequest::default()
        })
    }
}

#[derive(Debug, Args)]
pub struct IdArgs {
    /// The session
    id: String,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  frontalis session recenter take-1              the next frames: let the actor relax the face first
  frontalis session recenter take-1 --quietest   the quietest frames seen so far, at once")]
pub struct RecenterArgs {
    /// The session
    id: String,
    /// The quietest frames seen so far, instead of the next ones
    #[arg(long)]
    quietest: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Only the settings that are given change. Lists are replaced as a whole.
--plain=false brings back the terms that --plain switched off.
Defaults in brackets are those of a new session: what is not given stays as it is.

Examples:
  frontalis session update take-1 --exaggeration=false --actor-revision 2
  frontalis session update take-1 --smoothing 0.2 --bounds jaw_rotation=0..0.8 --exclusive none"
)]
pub struct UpdateArgs {
    /// The session
    id: String,
    /// Move to this revision of the actor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    actor_revision: Option<u32>,
    #[command(flatten)]
    settings: SettingsArgs,
}

pub async fn run(context: &Context, command: SessionCommand) -> anyhow::Result<ExitCode> {
    let mut client = SessionServiceClient::new(context.connect().await?);
    let what = command.what();
    let session = match command {
        SessionCommand::List => {
            list(context, &mut client).await?;
            return Ok(ExitCode::SUCCESS);
        }
        SessionCommand::Create(args) => {
            let take = args.labeled_take();
            let session = create(&mut client, args).await.context(what)?;
            let session = session.unwrap_or_default();
            if let Some(take) = take {
                start_take(context, &session, take).await?;
            }
            print(context, &session)?;
            return Ok(ExitCode::SUCCESS);
        }
        SessionCommand::Show(args) => show(&mut client, args).await,
        SessionCommand::Update(args) => {
            let update_mask = args.settings.update_mask()?;
            update(&mut client, args, update_mask).await
        }
        SessionCommand::Recenter(args) => recenter(&mut client, args).await,
        SessionCommand::End(args) => end(&mut client, args).await,
    };
    print(context, &session.context(what)?.unwrap_or_default())?;
    Ok(ExitCode::SUCCESS)
}

impl SessionCommand {
    /// What failed, when it failed.
    fn what(&self) -> String {
        match self {
            Self::Create(args) => format!("cannot create a session of actor {}", args.actor),
            Self::List => "cannot list the sessions".to_owned(),
            Self::Show(args) => format!("cannot show session {}", args.id),
            Self::Update(args) => format!("cannot change session {}", args.id),
            Self::Recenter(args) => format!("cannot recenter session {}", args.id),
            Self::End(args) => format!("cannot end session {}", args.id),
        }
    }
}

type Client = SessionServiceClient<Channel>;

/// A session is recorded as a take of this slate, number and gesture.
async fn start_take(
    context: &Context,
    session: &proto::Session,
    take: proto::StartTakeRequest,
) -> anyhow::Result<()> {
    let mut client = TakeServiceClient::new(context.connect().await?);
    let request = proto::StartTakeRequest {
        session: session.name.clone(),
        ..take
    };
    let started = client.start_take(request).await;
    started.map_err(ClientError::from).with_context(|| {
        format!(
            "session {} is there, but it is not recorded",
            super::short_id(&session.name)
        )
    })?;
    Ok(())
}

async fn create(
    client: &mut Client,
    args: CreateArgs,
) -> Result<Option<proto::Session>, ClientError> {
    let mut request = proto::CreateSessionRequest {
        session_id: args.id.unwrap_or_default(),
        actor: actor_name(&args.actor),
        settings: Some(proto::SessionSettings {
            record: args.record.then_some(true),
            ..args.settings.to_proto()
        }),
        display_name: args.display_name.unwrap_or_default(),
        ..proto::CreateSessionRequest::default()
    };
    request.set_kind(proto::CaptureKind::Markers);
    Ok(client.create_session(request).await?.into_inner().session)
}

async fn show(client: &mut Client, args: IdArgs) -> Result<Option<proto::Session>, ClientError> {
    let name = session_name(&args.id);
    let request = proto::GetSessionRequest { name };
    Ok(client.get_session(request).await?.into_inner().session)
}

async fn recenter(
    client: &mut Client,
    args: RecenterArgs,
) -> Result<Option<proto::Session>, ClientError> {
    let mut request = proto::RecenterSessionRequest {
        name: session_name(&args.id),
        ..proto::RecenterSessionRequest::default()
    };
    request.set_source(if args.quietest {
        proto::NeutralSource::QuietestFrames
    } else {
        proto::NeutralSource::NextFrames
    });
    Ok(client.recenter_session(request).await?.into_inner().session)
}

async fn end(client: &mut Client, args: IdArgs) -> Result<Option<proto::Session>, ClientError> {
    let name = session_name(&args.id);
    let request = proto::EndSessionRequest { name };
    Ok(client.end_session(request).await?.into_inner().session)
}

async fn update(
    client: &mut Client,
    args: UpdateArgs,
    update_mask: Option<FieldMask>,
) -> Result<Option<proto::Session>, ClientError> {
    let request = proto::UpdateSessionRequest {
        name: session_name(&args.id),
        settings: Some(args.settings.to_proto()),
        actor_revision: args.actor_revision.unwrap_or_default(),
        update_mask,
    };
    Ok(client.update_session(request).await?.into_inner().session)
}

async fn list(context: &Context, client: &mut Client) -> anyhow::Result<()> {
    let mut sessions = Vec::new();
    let mut page_token = String::new();
    loop {
        let request = proto::ListSessionsRequest {
            page_size: PAGE_SIZE,
            page_token,
        };
        let page = client
            .list_sessions(request)
            .await
            .map_err(ClientError::from)?
            .into_inner();
        sessions.extend(page.sessions);
        page_token = page.next_page_token;
        if page_token.is_empty() {
            break;
        }
    }
    if context.json {
        let all = proto::ListSessionsResponse {
            sessions,
            next_page_token: String::new(),
        };
        say(serde_json::to_value(all)?)?;
    } else {
        say(tables::sessions(&sessions))?;
    }
    Ok(())
}

fn print(context: &Context, session: &proto::Session) -> anyhow::Result<()> {
    if context.json {
        say(serde_json::to_value(session)?)?;
    } else {
        say(tables::session(session))?;
    }
    Ok(())
}
