//! What was published and what came back: counts, latency, error against the truth.

use std::{
    collections::VecDeque,
    sync::{Mutex, MutexGuard, PoisonError},
};

use frontalis_client::{
    capture_client::report::PublishReport, curve_client::CurveEvent, simulated_stage::StageFrame,
};
use serde_json::json;
use tokio::time::Instant;

use crate::{
    commands::{Context, stage_run::StageRun},
    measure::{Latencies, RootMeanSquare},
    terminal::say,
};

/// Frames waiting for their sample; older ones became gaps.
const MAX_WAITING: usize = 4_096;

/// Shared by the stage and the subscriber; the lock is never held across a wait.
#[derive(Debug, Default)]
pub struct Scoreboard {
    board: Mutex<Board>,
}

#[derive(Debug, Default)]
struct Board {
    waiting: VecDeque<Waiting>,
    received: u64,
    first_received: Option<Instant>,
    /// Samples of neutral frames, which wait until the alignment is known.
    neutral: Phase,
    /// Samples of the frames after them.
    live: Phase,
    error: RootMeanSquare,
}

#[derive(Debug, Default)]
struct Phase {
    samples: u64,
    first: Option<Instant>,
    last: Option<Instant>,
    latencies: Latencies,
}

impl Phase {
    fn add(&mut self, published: Instant, received: Instant) {
        self.samples += 1;
        self.first.get_or_insert(received);
        self.last = Some(received);
        self.latencies.add(received - published);
    }

    fn samples_per_second(&self) -> f64 {
        match (self.first, self.last) {
            (Some(first), Some(last)) if last > first => {
                (self.samples - 1) as f64 / (last - first).as_secs_f64()
            }
            _ => 0.0,
        }
    }
}

#[derive(Debug)]
struct Waiting {
    number: u64,
    published: Instant,
    truth: Vec<f64>,
}

impl Scoreboard {
    fn lock(&self) -> MutexGuard<'_, Board> {
        self.board.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A frame goes out now.
    pub fn published(&self, frame: &StageFrame) {
        let mut board = self.lock();
        if board.waiting.len() == MAX_WAITING {
            board.waiting.pop_front();
        }
        board.waiting.push_back(Waiting {
            number: frame.number,
            published: Instant::now(),
            truth: frame.truth.clone(),
        });
    }

    /// An event arrived now; samples are matched to their frames by number.
    pub fn take(&self, event: &CurveEvent) {
        let CurveEvent::Sample(sample) = event else {
            return;
        };
        let now = Instant::now();
        let mut board = self.lock();
        board.received += 1;
        let first_received = *board.first_received.get_or_insert(now);
        while board
            .waiting
            .front()
            .is_some_and(|it| it.number < sample.frame)
        {
            board.waiting.pop_front();
        }
        if board
            .waiting
            .front()
            .is_some_and(|it| it.number == sample.frame)
            && let Some(frame) = board.waiting.pop_front()
        {
            let phase = if frame.published < first_received {
                &mut board.neutral
            } else {
                &mut board.live
            };
            phase.add(frame.published, now);
            board.error.add(&sample.activations, &frame.truth);
        }
    }

    /// Samples so far.
    pub fn received(&self) -> u64 {
        self.lock().received
    }

    /// The figures of the whole run.
    pub fn summary(&self, run: &StageRun, report: &PublishReport) -> Summary {
        let board = self.lock();
        Summary {
            published_frames: run.frames,
            accepted_frames: report.accepted_frames,
            received_samples: board.received,
            published_rate_hz: run.achieved_rate_hz(),
            received_rate_hz: board.live.samples_per_second(),
            rms_error: board.error.value(),
            latency_p50_micros: board.live.latencies.quantile_micros(0.5),
            latency_p99_micros: board.live.latencies.quantile_micros(0.99),
            neutral_frames: board.neutral.samples,
            alignment_wait_micros: board.neutral.latencies.quantile_micros(1.0),
        }
    }
}

/// The figures of a demo.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    published_frames: u64,
    accepted_frames: u64,
    received_samples: u64,
    published_rate_hz: f64,
    received_rate_hz: f64,
    rms_error: Option<f64>,
    latency_p50_micros: Option<f64>,
    latency_p99_micros: Option<f64>,
    neutral_frames: u64,
    alignment_wait_micros: Option<f64>,
}

impl Summary {
    pub fn print(&self, context: &Context) -> anyhow::Result<()> {
        if context.json {
            say(json!({
                "publishedFrames": self.published_frames.to_string(),
                "acceptedFrames": self.accepted_frames.to_string(),
                "receivedSamples": self.received_samples.to_string(),
                "publishedRateHz": self.published_rate_hz,
                "receivedRateHz": self.received_rate_hz,
                "rmsError": self.rms_error,
                "latencyP50Micros": self.latency_p50_micros,
                "latencyP99Micros": self.latency_p99_micros,
                "neutralFrames": self.neutral_frames.to_string(),
                "alignmentWaitMicros": self.alignment_wait_micros,
            }))?;
            return Ok(());
        }
        let millis = |it: Option<f64>| {
            it.map_or_else(|| "-".to_owned(), |it| format!("{:.2} ms", it * 1e-3))
        };
        let rms_error = self
            .rms_error
            .map_or_else(|| "-".to_owned(), |it| format!("{it:.4}"));
        say(format_args!(
            "frames published      {}",
            self.published_frames
        ))?;
        say(format_args!(
            "samples received      {}",
            self.received_samples
        ))?;
        say(format_args!(
            "measured rate         {:.2} frames/s out, {:.2} samples/s in",
            self.published_rate_hz, self.received_rate_hz
        ))?;
        say(format_args!("RMS error of curves   {rms_error}"))?;
        say(format_args!(
            "publish to receipt    p50 {}, p99 {}",
            millis(self.latency_p50_micros),
            millis(self.latency_p99_micros)
        ))?;
        say(format_args!(
            "neutral frames        {}, solved together when the alignment was known ({} after the first)",
            self.neutral_frames,
            millis(self.alignment_wait_micros)
        ))?;
        Ok(())
    }
}
