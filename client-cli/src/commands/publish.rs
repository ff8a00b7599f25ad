//! `frontalis publish TAKE --session ID`.

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
    time::Duration,
};

use anyhow::Context as _;
use clap::Args;
use frontalis_analysis::{format::trc::TrcTake, space::LengthUnit};
use frontalis_client::{
    capture_client::{CaptureClient, CaptureSettings},
    proto::Ingest,
    take_file::{self, wire_frame, wire_unit},
};
use tokio::time::{Instant, sleep_until};

use super::{
    Context,
    interrupt::Interrupt,
    marker_check::MarkerCheck,
    names::{default_publisher, session_name},
    publish_summary,
    unit::Unit,
};
use crate::terminal::progress;

/// Publish a TRC or C3D file into a session
#[derive(Debug, Args)]
#[command(
    after_help = "Frames keep the file's numbers, times, unit and timecode; what was not seen is sent as not seen. The publisher reconnects and resumes by itself.

Examples:
  frontalis publish take.trc --session take-1          in real time, by the file's rate
  frontalis publish take.trc --session take-1 --fast   every frame, as fast as the server takes them
  frontalis publish walk.c3d --session take-1 --unit mm"
)]
pub struct PublishArgs {
    /// The file, TRC or C3D
    take: PathBuf,
    /// The session
    #[arg(long, value_name = "ID")]
    session: String,
    /// Lossless, as fast as the server takes the frames, instead of in real time
    #[arg(long)]
    fast: bool,
    /// Stable id of this capture client, 1 to 64 of A-Z, a-z, 0-9, . _ - [default: frontalis-HOST-PID]
    #[arg(long, value_name = "NAME")]
    publisher: Option<String>,
    /// Take the session from another publisher
    #[arg(long)]
    takeover: bool,
    /// Number the frames on from the session's last one; the file's numbers travel as source frames
    #[arg(long)]
    renumber: bool,
    /// Unit of a C3D that states none
    #[arg(long, value_enum, value_name = "UNIT")]
    unit: Option<Unit>,
}

pub async fn run(context: &Context, args: PublishArgs) -> anyhow::Result<ExitCode> {
    let unit = args.unit.map(LengthUnit::from);
    let take = if args.renumber {
        take_file::read_any_numbers(&args.take, unit)?
    } else {
        take_file::read(&args.take, unit)?
    };
    let settings = CaptureSettings {
        session: session_name(&args.session),
        publisher: args.publisher.clone().unwrap_or_else(default_publisher),
        marker_names: take.marker_names.clone(),
        unit: wire_unit(take.unit),
        rate_hz: take.rate_hz,
        ingest: if args.fast {
            Ingest::Lossless
        } else {
            Ingest::Live
        },
        takeover: args.takeover,
    };
    let channel = context.connect().await?;
    let client = CaptureClient::start(channel.clone(), settings)
        .await
        .with_context(|| format!("the session {} was not opened for publishing", args.session))?;
    let begun = Instant::now();
    send(&client, &take, &args).await?;
    let published = client.finish().await;
    let session = session_name(&args.session);
    // The frames went out: not to know which markers fit is no failure of theirs.
    if let Ok(check) = MarkerCheck::of_session(channel, &session, &take.marker_names).await {
        check.warn();
    }
    publish_summary::print(
        context,
        &args.session,
        &published,
        begun.elapsed(),
        &told_name(&args.take),
    )
}

fn told_name(path: &Path) -> String {
    path.file_name().map_or_else(
        || path.display().to_string(),
        |it| it.to_string_lossy().into_owned(),
    )
}

/// Hands every frame over, at its time or at once; stops early on Ctrl-C or when the publication failed.
async fn send(client: &CaptureClient, take: &TrcTake, args: &PublishArgs) -> anyhow::Result<()> {
    let mut interrupt = Interrupt::listen()?;
    let first_number = args.renumber.then(|| client.started().next_expected.max(1));
    let bar = progress::frames(take.frames.len() as u64, "publishing");
    let begun = Instant::now();
    for (index, frame) in take.frames.iter().enumerate() {
        let mut message = wire_frame(take, frame);
        if let Some(first) = first_number {
            message.source_frame = message.number;
            message.number = first + index as u64;
        }
        let due = begun + Duration::from_secs_f64(index as f64 / take.rate_hz);
        let sending = async {
            if !args.fast {
                sleep_until(due).await;
            }
            client.send(message).await
        };
        tokio::select! {
            sent = sending => if sent.is_err() {
                // `finish` repeats the reason, with the counts.
                break;
            },
            () = interrupt.wait() => break,
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}
