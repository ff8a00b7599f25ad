//! A simulated stage, paced in real time, into a publication.

use std::{
    future::Future,
    sync::{Arc, OnceLock},
    time::Duration,
};

use frontalis_analysis::{face::actor::Actor, space::PerformancePoint};
use frontalis_client::{
    capture_client::{CaptureClient, CaptureClock, CaptureSettings},
    proto::{Ingest, LengthUnit, MarkerFrame},
    simulated_stage::StageFrame,
};
use tokio::time::{Instant, sleep_until};

/// What a stage needs to publish.
pub fn capture_settings(
    session: String,
    publisher: String,
    actor: &Actor,
    rate_hz: f64,
) -> CaptureSettings {
    CaptureSettings {
        session,
        publisher,
        marker_names: actor.markers().iter().map(|it| it.name.clone()).collect(),
        unit: LengthUnit::Centimeter,
        rate_hz,
        ingest: Ingest::Live,
        takeover: false,
    }
}

/// The frame as it is published: centimeters, NaN for a marker that was not seen.
pub fn to_proto(frame: &StageFrame) -> MarkerFrame {
    MarkerFrame {
        number: frame.number,
        capture_time_nanos: frame.capture_time_nanos,
        positions: wire_positions(frame).flatten().collect(),
        ..MarkerFrame::default()
    }
}

/// x y z of every marker in centimeters, NaN for one that was not seen.
pub fn wire_positions(frame: &StageFrame) -> impl Iterator<Item = [f32; 3]> {
    #[expect(clippy::cast_possible_truncation, reason = "the wire carries f32")]
    let coordinates = |it: PerformancePoint| it.0.coords.map(|it| it as f32).into();
    frame
        .positions
        .iter()
        .map(move |it| it.map_or([f32::NAN; 3], coordinates))
}

/// The clock of a stage's capture times: it starts with the first frame.
#[derive(Clone, Debug, Default)]
pub struct StageClock(Arc<OnceLock<Instant>>);

impl StageClock {
    /// As a publication reads it.
    pub fn capture_clock(&self) -> CaptureClock {
        let begun = Arc::clone(&self.0);
        CaptureClock::new(move || {
            let nanos = begun.get()?.elapsed().as_nanos();
            Some(i64::try_from(nanos).unwrap_or(i64::MAX))
        })
    }
}

/// How a run went.
#[derive(Clone, Copy, Debug)]
pub struct StageRun {
    /// Frames handed over.
    pub frames: u64,
    /// From the first frame to the last, with the last one's own time.
    pub elapsed: Duration,
    /// The longest that a frame was late: this machine could not keep the rate.
    pub worst_delay: Duration,
}

impl StageRun {
    /// Frames a second, as measured.
    pub fn achieved_rate_hz(&self) -> f64 {
        self.frames as f64 / self.elapsed.as_secs_f64().max(1e-9)
    }
}

/// Hands every frame over at its time; ends early when `stop` is ready or the publication failed.
///
/// Frames are numbered on from what the session expects next. `on_frame` sees each just before it goes out.
pub async fn run(
    client: &CaptureClient,
    clock: &StageClock,
    stage: impl Iterator<Item = StageFrame>,
    rate_hz: f64,
    stop: impl Future<Output = ()>,
    mut on_frame: impl FnMut(&StageFrame),
) -> StageRun {
    let numbers_before = client.started().next_expected.saturating_sub(1);
    let begun = *clock.0.get_or_init(Instant::now);
    let mut frames = 0_u64;
    let mut worst_delay = Duration::ZERO;
    tokio::pin!(stop);
    for mut frame in stage {
        frame.number += numbers_before;
        let due = begun + Duration::from_secs_f64(frames as f64 / rate_hz);
        tokio::select! {
            () = sleep_until(due) => {}
            () = &mut stop => break,
        }
        worst_delay = worst_delay.max(Instant::now() - due);
        on_frame(&frame);
        if client.send(to_proto(&frame)).await.is_err() {
            // `finish` repeats the reason, with the counts.
            break;
        }
        frames += 1;
    }
    let last_frame_lasts = Duration::from_secs_f64(1.0 / rate_hz);
    let last_due = begun + Duration::from_secs_f64(frames as f64 / rate_hz);
    tokio::select! {
        () = sleep_until(last_due) => {}
        () = &mut stop => {}
    }
    StageRun {
        frames,
        elapsed: begun.elapsed().max(last_frame_lasts),
        worst_delay,
    }
}
