//! `frontalis take diff`: where the curves of two takes differ, muscle by muscle.

mod chart;
mod report;

use std::{fs, path::PathBuf, process::ExitCode};

use anyhow::Context as _;
use clap::Args;
use frontalis_client::{
    connection::Channel, proto::TakeHeader, recorded_take::RecordedTake,
    take_difference::TakeDifference,
};

use super::source;
use crate::{
    commands::{Context, numbers},
    terminal::{progress, say},
};

/// Frames between two movements of the bar.
const FRAMES_A_STEP: u64 = 256;

#[derive(Debug, Args)]
#[command(
    after_help = "Samples are matched by frame number, which `take resolve` and `take play` keep, and muscles by name.
The same means the same bits: activations, qualities, head pose and all else but the sequence and the server's times.

Exit status: 0; with --tolerance 1 when a muscle differs by more, or when a frame or a muscle is in one take only.

Examples:
  frontalis take diff stage-1-19f3 stage-1-19f3-2b                      after `take resolve --revision 2`
  frontalis take diff stage-1-19f3 stage-1-19f3-2b --picture diff.svg   every muscle's two curves over time
  frontalis take diff old.mcap new.mcap --tolerance 0.01                files, without a server"
)]
pub struct DiffArgs {
    /// A take, or a take's MCAP file
    pub first: String,
    /// The other one
    pub second: String,
    /// Draw the curves of both, and where they are apart, as SVG
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Fail when activations, from 0 to 1, are further apart than this
    #[arg(long, value_name = "X", value_parser = numbers::not_negative)]
    tolerance: Option<f64>,
}

/// One of the two.
struct Side {
    name: String,
    take: RecordedTake,
    header: TakeHeader,
}

impl Side {
    async fn open(name: &str, channel: Option<&Channel>) -> anyhow::Result<Self> {
        let read = async {
            let mut take = source::open(name, channel).await?;
            let header = source::header(&mut take).await?;
            anyhow::Ok((take, header))
        };
        let (take, header) = read.await.with_context(|| format!("take {name}"))?;
        Ok(Self {
            name: name.to_owned(),
            take,
            header,
        })
    }
}

pub async fn run(context: &Context, args: &DiffArgs) -> anyhow::Result<ExitCode> {
    let is_local = source::is_file(&args.first) && source::is_file(&args.second);
    let channel = if is_local {
        None
    } else {
        Some(context.connect().await?)
    };
    let mut first = Side::open(&args.first, channel.as_ref()).await?;
    let mut second = Side::open(&args.second, channel.as_ref()).await?;
    let difference = compare(&mut first, &mut second).await?;
    if let Some(file) = &args.picture {
        let svg = chart::svg(&difference, [&first.name, &second.name]);
        fs::write(file, svg).with_context(|| format!("cannot write {}", file.display()))?;
    }
    if context.json {
        say(report::json(&difference))?;
    } else {
        say(report::words(&difference, [&first.name, &second.name]))?;
    }
    Ok(verdict(&difference, args.tolerance))
}

async fn compare(first: &mut Side, second: &mut Side) -> anyhow::Result<TakeDifference> {
    let bar = progress::spinner("comparing");
    let controls = [
        first.header.controls.as_slice(),
        second.header.controls.as_slice(),
    ];
    let told = |n_frames| {
        if n_frames % FRAMES_A_STEP == 0 {
            bar.set_message(format!("comparing: {n_frames} frames"));
        }
    };
    let takes = [&mut first.take, &mut second.take];
    let found = TakeDifference::of(takes, controls, told).await;
    bar.finish_and_clear();
    Ok(found?)
}

fn verdict(difference: &TakeDifference, tolerance: Option<f64>) -> ExitCode {
    let Some(tolerance) = tolerance else {
        return ExitCode::SUCCESS;
    };
    let is_whole = difference.n_only_first == 0
        && difference.n_only_second == 0
        && difference.only_first.is_empty()
        && difference.only_second.is_empty();
    if is_whole && difference.max() <= tolerance {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
