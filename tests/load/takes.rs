//! How fast a take is solved again: `takes [MINUTES]`, by default 10 min of 27 markers at 120 Hz, processor time of one thread
//! from opening the file to the new one on the disk.
#![expect(
    clippy::unwrap_used,
    reason = "a run that cannot start has nothing to report"
)]

use std::{path::Path, sync::Arc, time::Duration};

use frontalis_analysis::{face::actor::Actor, synthesis::reference_face};
use frontalis_proto::v1::{
    ExportTakeRequest, RegionMode, SessionSettings, StartTakeRequest, StopTakeRequest, Take,
};
use frontalis_server::{
    fs::StdFs,
    name::TakeId,
    take::{Advance, ResolveTarget, TakeToResolve},
};
use harness::{Publisher, TestPerformance, TestServer};
use rustix::time::{ClockId, clock_gettime};

const MINUTES: u64 = 10;
const RATE_HZ: u64 = 120;
const FRAMES_A_MESSAGE: u64 = 128;

/// What the take is solved with.
const RUNS: [&str; 2] = ["plain, split, fixed head", "default settings"];

#[tokio::main(flavor = "multi_thread", worker_threads = 2)]
async fn main() {
    let minutes = std::env::args()
        .nth(1)
        .map_or(MINUTES, |it| it.parse().unwrap());
    let n_frames = minutes * 60 * RATE_HZ;
    for name in RUNS {
        let server = TestServer::start().await;
        server.import_reference().await;
        let take = record(&server, settings(name), n_frames).await;
        let dir = tempfile::tempdir().unwrap();
        let id = save(&server, &take, dir.path()).await;
        server.stop().await;
        let (took, n_bytes) = (resolve(dir.path(), &id), take.n_bytes);
        let real = Duration::from_secs(minutes * 60);
        println!(
            "{name}: {n_frames} frames, {:.1} MB, solved again in {:.3} s of processor time: {:.0} times faster than they were captured",
            n_bytes as f64 / 1e6,
            took.as_secs_f64(),
            real.as_secs_f64() / took.as_secs_f64(),
        );
    }
}

fn settings(name: &str) -> SessionSettings {
    if name == RUNS[1] {
        return SessionSettings::default();
    }
    SessionSettings {
        plain: Some(true),
        stabilize_head: Some(false),
        region_mode: RegionMode::Split.into(),
        ..SessionSettings::default()
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

/// The take's file under its own name.
async fn save(server: &TestServer, take: &Take, dir: &Path) -> TakeId {
    let id = TakeId::from_resource(&take.name).unwrap();
    let request = ExportTakeRequest {
        name: take.name.clone(),
        ..ExportTakeRequest::default()
    };
    let mut takes = server.takes().await;
    let mut pieces = takes.export_take(request).await.unwrap().into_inner();
    let mut file = Vec::new();
    while let Some(piece) = pieces.message().await.unwrap() {
        file.extend(piece.chunk);
    }
    std::fs::write(dir.join(format!("{id}.mcap")), file).unwrap();
    id
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
