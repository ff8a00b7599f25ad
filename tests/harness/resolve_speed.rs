//! How fast a take is solved again: processor time of one thread, from opening the file to the new one on the disk
//! (CONTRACTS U-13).

use std::{fmt, path::Path, sync::Arc, time::Duration};

use frontalis_analysis::{face::actor::Actor, synthesis::reference_face};
use frontalis_proto::v1::{RegionMode, SessionSettings, StartTakeRequest, StopTakeRequest, Take};
use frontalis_server::{
    fs::StdFs,
    name::TakeId,
    take::{Advance, ResolveTarget, TakeToResolve},
};
use rustix::time::{ClockId, clock_gettime};

use crate::{Publisher, TestPerformance, TestServer, take_calls::export_mcap};

const RATE_HZ: u64 = 120;
const FRAMES_A_MESSAGE: u64 = 128;

/// A take of 27 markers at 120 Hz.
#[derive(Clone, Copy, Debug)]
pub struct ResolveProfile {
    /// How long it is.
    pub minutes: u64,
    /// With the paper's least squares, each region by itself, and a head that is held still; else with the default settings.
    pub plain: bool,
}

/// What solving it again cost.
#[derive(Clone, Copy, Debug)]
pub struct ResolveReport {
    profile: ResolveProfile,
    n_frames: u64,
    n_bytes: u64,
    took: Duration,
}

impl ResolveReport {
    /// So many times faster than it was captured.
    pub fn times_real_time(&self) -> f64 {
        (self.profile.minutes * 60) as f64 / self.took.as_secs_f64()
    }
}

impl fmt::Display for ResolveReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let settings = if self.profile.plain {
            "plain, split, fixed head"
        } else {
            "default settings"
        };
        write!(
            f,
            "{settings}: {} frames, {:.1} MB, in {:.3} s of processor time of one core, {:.0} times faster than they were captured",
            self.n_frames,
            self.n_bytes as f64 / 1e6,
            self.took.as_secs_f64(),
            self.times_real_time(),
        )
    }
}

impl ResolveProfile {
    /// Records the take on a server of its own, and solves it again without one.
    ///
    /// # Panics
    ///
    /// When it cannot be recorded, or not be solved.
    pub async fn run(self) -> ResolveReport {
        let server = TestServer::start().await;
        server.import_reference().await;
        let n_frames = self.minutes * 60 * RATE_HZ;
        let take = record(&server, self.settings(), n_frames).await;
        let dir = tempfile::tempdir().unwrap();
        let id = TakeId::from_resource(&take.name).unwrap();
        let file = export_mcap(&server, &take.name).await;
        std::fs::write(dir.path().join(format!("{id}.mcap")), file).unwrap();
        server.stop().await;
        ResolveReport {
            profile: self,
            n_frames,
            n_bytes: take.n_bytes,
            took: resolve(dir.path(), &id),
        }
    }

    fn settings(self) -> SessionSettings {
        if !self.plain {
            return SessionSettings::default();
        }
        SessionSettings {
            plain: Some(true),
            stabilize_head: Some(false),
            region_mode: RegionMode::Split.into(),
            ..SessionSettings::default()
        }
    }
}

async fn record(server: &TestServer, settings: SessionSettings, n_frames: u64) -> Take {
    let made = server.create_session_with("stage", "actors/reference", settings);
    let session = made.await.unwrap().name;
    let performance = TestPerformance::reference();
    let mut takes = server.takes().await;
    let request = StartTakeRequest {
        session: session.clone(),
        ..StartTakeRequest::default()
    };
    let take = takes.start_take(request).await.unwrap().into_inner().take;
    let start = performance.start(&session, "stage");
    let mut publisher = Publisher::open(server, start).await.unwrap();
    for first in (1..=n_frames).step_by(usize::try_from(FRAMES_A_MESSAGE).unwrap()) {
        let last = n_frames.min(first + FRAMES_A_MESSAGE - 1);
        publisher.publish(performance.frames(first..=last)).await;
    }
    let request = StopTakeRequest {
        name: take.unwrap().name,
    };
    let stopped = takes.stop_take(request).await.unwrap().into_inner().take;
    stopped.unwrap()
}

/// Processor time of this thread, on which all of it runs.
fn resolve(dir: &Path, id: &TakeId) -> Duration {
    let actor: Arc<Actor> = Arc::new(reference_face::actor());
    let start = thread_cpu();
    let take = TakeToResolve::open(&StdFs, dir, id, u64::MAX).unwrap();
    let target = ResolveTarget {
        take: TakeId::parse("again").unwrap(),
        from: id.clone(),
        recorded_actor: actor,
        other_revision: None,
        package_sha256: String::new(),
        asked: SessionSettings::default(),
    };
    let fs = Arc::new(StdFs);
    let mut resolve = take.begin(fs, dir.to_owned(), target).unwrap();
    loop {
        let (next, advance) = resolve.advance(0).unwrap();
        match (next, advance) {
            (Some(next), Advance::More { .. }) => resolve = next,
            (_, Advance::Over(resolved)) => {
                assert!(resolved.figures.n_samples > 0);
                return thread_cpu().checked_sub(start).unwrap();
            }
            (_, other) => panic!("{other:?}"),
        }
    }
}

fn thread_cpu() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(
        u64::try_from(time.tv_sec).unwrap(),
        u32::try_from(time.tv_nsec).unwrap(),
    )
}
