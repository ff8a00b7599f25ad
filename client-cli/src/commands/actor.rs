//! `frontalis actor …`: bring actors in and out.

mod package;

use std::{fs, path::PathBuf, process::ExitCode};

use anyhow::{Context as _, bail};
use clap::{Args, Subcommand};
use frontalis_analysis::synthesis::reference_face;
use frontalis_client::{connection::Channel, error::ClientError, proto};
use proto::actor_service_client::ActorServiceClient;

pub use self::package::{PackageForm, fetch, import, read as read_package};
use super::{Context, actor_name, names::new_actor_id, short_id};
use crate::terminal::{self, say, tables};

/// Actors listed by one call.
const PAGE_SIZE: u32 = 200;

#[derive(Debug, Subcommand)]
pub enum ActorCommand {
    /// Bring in an actor package: a ZIP of actor.json and OBJ files, or a GLB
    Import(ImportArgs),
    /// List the actors of the server
    List,
    /// Show one actor: muscles, markers, what can be said of the basis
    Show(ShowArgs),
    /// Write an actor to a .zip or .glb file, whichever form it came in
    Export(ExportArgs),
    /// Erase an actor and its revisions
    Delete(DeleteArgs),
    /// Write the built-in reference actor to a .zip or .glb file; needs no server
    Reference(ReferenceArgs),
}

#[derive(Debug, Args)]
#[command(
    after_help = "Importing under an id that exists adds a revision when muscles and markers are the same.

Example:
  frontalis actor import anna.zip --id anna --display-name \"Anna K.\""
)]
pub struct ImportArgs {
    /// The package, .zip or .glb
    package: PathBuf,
    /// Id of the actor: 1 to 63 of a-z, 0-9, - and _
    #[arg(long, value_parser = new_actor_id)]
    id: String,
    /// Name for people [default: the package's own]
    #[arg(long, value_name = "NAME")]
    display_name: Option<String>,
    /// Accept a basis whose muscles the markers cannot tell apart, and report it
    #[arg(long)]
    regularize: bool,
}

#[derive(Debug, Args)]
pub struct ShowArgs {
    /// The actor
    id: String,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  frontalis actor export anna anna.glb --revision 2")]
pub struct ExportArgs {
    /// The actor
    id: String,
    /// File to write; its extension, .zip or .glb, chooses the form
    out: PathBuf,
    /// Revision to export [default: the newest]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    revision: u32,
}

#[derive(Debug, Args)]
pub struct DeleteArgs {
    /// The actor
    id: String,
    /// Do not ask; needed without a terminal
    #[arg(long, short)]
    yes: bool,
    /// Erase everything of this person: its ended sessions and its takes too, and print a receipt
    #[arg(long)]
    with_takes: bool,
}

#[derive(Debug, Args)]
pub struct ReferenceArgs {
    /// File to write, .zip or .glb
    out: PathBuf,
}

pub async fn run(context: &Context, command: ActorCommand) -> anyhow::Result<ExitCode> {
    match command {
        ActorCommand::Import(args) => import_file(context, args).await?,
        ActorCommand::List => list(context).await?,
        ActorCommand::Show(args) => show(context, &args).await?,
        ActorCommand::Export(args) => export(context, &args).await?,
        ActorCommand::Delete(args) => return delete(context, &args).await,
        ActorCommand::Reference(args) => reference(context, &args)?,
    }
    Ok(ExitCode::SUCCESS)
}

async fn import_file(context: &Context, args: ImportArgs) -> anyhow::Result<()> {
    let bytes = fs::read(&args.package)
        .with_context(|| format!("cannot read the package {}", args.package.display()))?;
    let start = proto::ImportActorStart {
        actor_id: args.id,
        display_name: args.display_name.unwrap_or_default(),
        unit: proto::LengthUnit::Unspecified.into(),
        regularize: args.regularize,
    };
    let imported = import(context.connect().await?, start, bytes)
        .await
        .with_context(|| format!("the package {} was not imported", args.package.display()))?;
    if context.json {
        say(serde_json::to_value(&imported)?)?;
        return Ok(());
    }
    let actor = imported.actor.unwrap_or_default();
    for warning in &imported.warnings {
        eprintln!("warning: {warning}");
    }
    say(format_args!(
        "imported {} revision {}: {} muscles, {} markers, {} vertices",
        short_id(&actor.name),
        actor.revision,
        actor.muscles.len(),
        actor.markers.len(),
        actor.n_vertices
    ))?;
    Ok(())
}

async fn list(context: &Context) -> anyhow::Result<()> {
    let mut client = ActorServiceClient::new(context.connect().await?);
    let mut actors = Vec::new();
    let mut page_token = String::new();
    loop {
        let request = proto::ListActorsRequest {
            page_size: PAGE_SIZE,
            page_token,
        };
        let page = client
            .list_actors(request)
            .await
            .map_err(ClientError::from)?
            .into_inner();
        actors.extend(page.actors);
        page_token = page.next_page_token;
        if page_token.is_empty() {
            break;
        }
    }
    if context.json {
        let all = proto::ListActorsResponse {
            actors,
            next_page_token: String::new(),
        };
        say(serde_json::to_value(all)?)?;
    } else {
        say(tables::actors(&actors))?;
    }
    Ok(())
}

/// One actor, as the server knows it.
pub async fn get(channel: Channel, id: &str) -> Result<proto::Actor, ClientError> {
    let request = proto::GetActorRequest {
        name: actor_name(id),
    };
    let response = ActorServiceClient::new(channel).get_actor(request).await?;
    Ok(response.into_inner().actor.unwrap_or_default())
}

async fn show(context: &Context, args: &ShowArgs) -> anyhow::Result<()> {
    let actor = get(context.connect().await?, &args.id)
        .await
        .with_context(|| format!("cannot show actor {}", args.id))?;
    if context.json {
        say(serde_json::to_value(&actor)?)?;
    } else {
        say(tables::actor(&actor))?;
    }
    Ok(())
}

async fn export(context: &Context, args: &ExportArgs) -> anyhow::Result<()> {
    let form = PackageForm::of_file(&args.out)?;
    let bytes = fetch(context.connect().await?, &args.id, args.revision)
        .await
        .with_context(|| format!("cannot export actor {}", args.id))?;
    let bytes = form.convert(bytes)?;
    fs::write(&args.out, &bytes).with_context(|| format!("cannot write {}", args.out.display()))?;
    written(context, &args.out, bytes.len())
}

fn reference(context: &Context, args: &ReferenceArgs) -> anyhow::Result<()> {
    let bytes = PackageForm::of_file(&args.out)?.write(&reference_face::actor());
    fs::write(&args.out, &bytes).with_context(|| format!("cannot write {}", args.out.display()))?;
    written(context, &args.out, bytes.len())
}

fn written(context: &Context, out: &std::path::Path, n_bytes: usize) -> anyhow::Result<()> {
    if context.json {
        say(serde_json::json!({ "file": out.display().to_string(), "bytes": n_bytes }))?;
    } else {
        say(format_args!("wrote {} ({n_bytes} bytes)", out.display()))?;
    }
    Ok(())
}

async fn delete(context: &Context, args: &DeleteArgs) -> anyhow::Result<ExitCode> {
    let what = if args.with_takes {
        "all its revisions, sessions and takes"
    } else {
        "all its revisions"
    };
    let question = format!("Erase the actor {} with {what}?", args.id);
    if !args.yes && !terminal::is_interactive() {
        bail!("nobody can be asked without a terminal, nothing was erased: give --yes");
    }
    if !args.yes && !terminal::confirm(&question)? {
        eprintln!("nothing was erased");
        return Ok(ExitCode::FAILURE);
    }
    let request = proto::DeleteActorRequest {
        name: actor_name(&args.id),
        with_takes: args.with_takes,
    };
    let answer = ActorServiceClient::new(context.connect().await?)
        .delete_actor(request)
        .await
        .map_err(ClientError::from)
        .with_context(|| format!("cannot erase actor {}", args.id))?;
    match answer.into_inner().receipt {
        Some(receipt) => say_receipt(context, &receipt)?,
        None if context.json => say(serde_json::json!({ "deleted": actor_name(&args.id) }))?,
        None => say(format_args!("erased {}", args.id))?,
    }
    Ok(ExitCode::SUCCESS)
}

fn say_receipt(context: &Context, receipt: &proto::ErasureReceipt) -> anyhow::Result<()> {
    if context.json {
        let name = &receipt.actor;
        say(serde_json::json!({ "deleted": name, "receipt": receipt }))?;
        return Ok(());
    }
    let time = receipt
        .erase_time
        .map(frontalis_proto::Timestamp::to_rfc3339);
    say(format_args!(
        "erased {} at {}: {} revisions, {} sessions, {} takes, {} bytes; nothing of them is left in the server's data directory but these ids in its audit log",
        short_id(&receipt.actor),
        time.unwrap_or_default(),
        receipt.n_revisions,
        receipt.n_sessions,
        receipt.n_takes,
        receipt.n_bytes,
    ))?;
    Ok(())
}
