//! `frontalis simulate --session ID`: a simulated five-camera capture in real time.

use std::{
    fs::File,
    io::{BufWriter, Write as _},
    path::{Path, PathBuf},
    process::ExitCode,
    sync::Arc,
};

use anyhow::Context as _;
use clap::Args;
use frontalis_analysis::{
    face::actor::{Actor, RankPolicy},
    format::{
        curve_csv::field,
        trc::{self, TrcFrame, TrcTake},
    },
    space::LengthUnit,
    synthesis::reference_face,
};
use frontalis_client::{
    capture_client::{CaptureClient, CaptureSettings},
    connection::Channel,
    simulated_stage::{SimulatedStage, StageFrame, StageSettings},
};

use super::{
    Context, actor,
    interrupt::Interrupt,
    names::{default_publisher, session_name},
    numbers, publish_summary,
    stage_run::{self, StageClock},
};
use crate::terminal::{progress, say};

/// Frames of `--markers` kept in memory: an hour at 240 Hz.
const MAX_KEPT_FRAMES: usize = 864_000;

/// Publish a simulated five-camera capture in real time
#[derive(Debug, Args)]
#[command(
    after_help = "One second of neutral face, then random, smooth, overlapping muscle events with head motion.

Example:
  frontalis simulate --session take-1 --rate 60 --seconds 30 --truth truth.csv"
)]
pub struct SimulateArgs {
    /// The actor on stage: an actor of the server, or `reference`, which is built in
    #[arg(long, value_name = "ID", default_value = "reference")]
    actor: String,
    /// The session to publish into
    #[arg(long, value_name = "ID")]
    session: String,
    /// Frames a second: 30, 60, 120 or 240
    #[arg(long, value_name = "HZ", default_value_t = 60.0, value_parser = numbers::rate_hz)]
    rate: f64,
    /// Length of the performance in seconds, its neutral second included
    #[arg(long, value_name = "N", default_value_t = 10.0, value_parser = numbers::positive)]
    seconds: f64,
    /// Cameras around the face, 2 to 32
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u8).range(2..=32))]
    cameras: u8,
    /// Noise of a marker in an image, one sigma in pixels an axis
    #[arg(long, value_name = "PIXELS", default_value_t = 0.3, value_parser = numbers::not_negative)]
    pixel_noise: f64,
    /// Share of the markers that a camera misses, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.03, value_parser = numbers::fraction)]
    misses: f64,
    /// The same seed gives the same performance and the same noise
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Write the true activations of every frame: frame, then one column a muscle
    #[arg(long, value_name = "FILE.csv")]
    truth: Option<PathBuf>,
    /// Write the markers as they were published, centimeters
    #[arg(long, value_name = "OUT.trc")]
    markers: Option<PathBuf>,
    /// Stable id of this capture client [default: frontalis-HOST-PID]
    #[arg(long, value_name = "NAME")]
    publisher: Option<String>,
    /// Take the session from another publisher
    #[arg(long)]
    takeover: bool,
}

impl SimulateArgs {
    fn stage_settings(&self) -> StageSettings {
        StageSettings {
            rate_hz: self.rate,
            seconds: self.seconds,
            cameras: self.cameras.into(),
            pixel_noise: self.pixel_noise,
            misses: self.misses,
            seed: self.seed,
        }
    }
}

pub async fn run(context: &Context, args: SimulateArgs) -> anyhow::Result<ExitCode> {
    let channel = context.connect().await?;
    let actor = Arc::new(stage_actor(channel.clone(), &args.actor).await?);
    let stage = SimulatedStage::new(Arc::clone(&actor), args.stage_settings())?;
    let mut recording = Recording::open(&args, &actor)?;
    let mut interrupt = Interrupt::listen()?;
    let settings = stage_run::capture_settings(
        session_name(&args.session),
        args.publisher.clone().unwrap_or_else(default_publisher),
        &actor,
        args.rate,
    );
    let settings = CaptureSettings {
        takeover: args.takeover,
        ..settings
    };
    let clock = StageClock::default();
    let client = CaptureClient::start_on_clock(channel, settings, Some(clock.capture_clock()))
        .await
        .with_context(|| format!("the session {} was not opened for publishing", args.session))?;
    let bar = progress::frames(stage.remaining_frames(), "simulating");
    let run = stage_run::run(
        &client,
        &clock,
        stage,
        args.rate,
        interrupt.wait(),
        |frame| {
            bar.inc(1);
            recording.take(frame);
        },
    )
    .await;
    bar.finish_and_clear();
    let published = client.finish().await;
    recording.close(&args, &actor)?;
    if !context.json {
        say(format_args!(
            "achieved {:.2} of {} frames/s, the latest frame {:.2} ms late",
            run.achieved_rate_hz(),
            args.rate,
            run.worst_delay.as_secs_f64() * 1e3
        ))?;
    }
    publish_summary::print(
        context,
        &args.session,
        &published,
        run.elapsed,
        "simulated stage",
    )
}

/// The built-in actor, or one of the server's.
async fn stage_actor(channel: Channel, id: &str) -> anyhow::Result<Actor> {
    if id == "reference" {
        return Ok(reference_face::actor());
    }
    let package = actor::fetch(channel, id, 0)
        .await
        .with_context(|| format!("cannot fetch the actor {id}"))?;
    actor::read_package(&package, RankPolicy::Regularize)
}

/// The files beside a simulation.
struct Recording {
    truth: Option<BufWriter<File>>,
    truth_failure: Option<std::io::Error>,
    keeps_markers: bool,
    frames: Vec<TrcFrame>,
}

impl Recording {
    /// Opened before anything is published: a wrong path should not cost a performance.
    fn open(args: &SimulateArgs, actor: &Actor) -> anyhow::Result<Self> {
        let mut truth = args.truth.as_deref().map(create).transpose()?;
        if let Some(out) = &mut truth {
            write!(out, "frame")?;
            for muscle in actor.muscle_set().muscles() {
                write!(out, ",{}", field(&muscle.name))?;
            }
            writeln!(out)?;
        }
        Ok(Self {
            truth,
            truth_failure: None,
            keeps_markers: args.markers.is_some(),
            frames: Vec::new(),
        })
    }

    fn take(&mut self, frame: &StageFrame) {
        if let Some(out) = &mut self.truth
            && let Err(failure) = write_truth(out, frame)
        {
            self.truth_failure.get_or_insert(failure);
        }
        if self.keeps_markers && self.frames.len() < MAX_KEPT_FRAMES {
            self.frames.push(TrcFrame {
                number: frame.number,
                time_s: frame.capture_time_nanos as f64 * 1e-9,
                positions: stage_run::wire_positions(frame).collect(),
            });
        }
    }

    fn close(self, args: &SimulateArgs, actor: &Actor) -> anyhow::Result<()> {
        if let (Some(path), Some(mut out)) = (&args.truth, self.truth) {
            self.truth_failure
                .map_or_else(|| out.flush(), Err)
                .with_context(|| format!("cannot write {}", path.display()))?;
        }
        if let Some(path) = &args.markers {
            let take = TrcTake {
                rate_hz: args.rate,
                unit: LengthUnit::Centimeter,
                marker_names: actor.markers().iter().map(|it| it.name.clone()).collect(),
                frames: self.frames,
                start_timecode: None,
            };
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            std::fs::write(path, trc::write(&take, &name))
                .with_context(|| format!("cannot write {}", path.display()))?;
        }
        Ok(())
    }
}

fn write_truth(out: &mut impl std::io::Write, frame: &StageFrame) -> std::io::Result<()> {
    write!(out, "{}", frame.number)?;
    for value in &frame.truth {
        write!(out, ",{value}")?;
    }
    writeln!(out)
}

fn create(path: &Path) -> anyhow::Result<BufWriter<File>> {
    let file = File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
    Ok(BufWriter::new(file))
}
