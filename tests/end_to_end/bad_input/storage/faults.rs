//! A disk that fails at any call: nothing is acknowledged past the failure, live curves go on, and new takes are recorded when
//! the disk works again (CONTRACTS U-8, U-9).

use std::{io::ErrorKind, sync::Arc};

use frontalis_proto::v1::TakeState;
use frontalis_server::fs::{Fs, MemFs};
use harness::{
    Problem, Publisher, RecordedTake, Subscriber, TestPerformance, TestServer, every_frame,
    http_get,
};
use tonic::Code;
use tonic_health::pb::{
    HealthCheckRequest, health_check_response::ServingStatus, health_client::HealthClient,
};

use crate::takes::{SESSION, export, get, start, stop};

/// Frames of one take.
const FRAMES: u64 = 12;

/// A disk to break, and a session that goes on whatever happens to it.
struct Stage {
    disk: MemFs,
    server: TestServer,
    performance: TestPerformance,
    publisher: Publisher,
    subscriber: Subscriber,
    n_frames: u64,
}

impl Stage {
    async fn start() -> Self {
        let disk = MemFs::default();
        let files: Arc<dyn Fs> = Arc::new(disk.clone());
        let server = TestServer::start_on(files).await;
        server.import_reference().await;
        let created = server.create_session("stage", "actors/reference").await;
        created.unwrap();
        let performance = TestPerformance::reference();
        let start = performance.start(SESSION, "stage");
        let mut publisher = Publisher::open(&server, start).await.unwrap();
        let subscriber = Subscriber::open(&server, every_frame(SESSION)).await;
        publisher.publish(performance.frames(1..=30)).await;
        Self {
            disk,
            server,
            performance,
            publisher,
            subscriber: subscriber.unwrap(),
            n_frames: 30,
        }
    }

    /// Publishes a few frames, whose samples come whatever the disk does. Half of them at a time, so that several commits
    /// are made.
    async fn perform(&mut self) {
        for _ in 0..2 {
            let first = self.n_frames + 1;
            self.n_frames += FRAMES / 2;
            self.publisher
                .publish(self.performance.frames(first..=self.n_frames))
                .await;
            self.subscriber
                .samples_through(self.n_frames)
                .await
                .unwrap();
        }
    }

    /// A take of a few frames. Those that are acknowledged as durable are in its file, even when the power goes now.
    async fn record(&mut self) -> Option<frontalis_proto::v1::Take> {
        let take = match start(&self.server, SESSION, "").await {
            Ok(take) => take,
            Err(refused) => {
                let refused = Problem::of(&refused);
                assert!(
                    ["STORAGE", "DISK_LOW"].contains(&refused.reason.as_str()),
                    "{refused:?}"
                );
                return None;
            }
        };
        let first = self.n_frames + 1;
        self.perform().await;
        let stopped = stop(&self.server, &take.name).await.unwrap();
        let durable_through = self.publisher.report().durable_through;
        let name = stopped.name.trim_start_matches("takes/");
        let file = std::path::PathBuf::from(format!("/takes/{name}.mcap"));
        let after = self.disk.after_power_cut(|_, _| Vec::new());
        let numbers = RecordedTake::beginning(&after.read(&file).unwrap()).frame_numbers();
        let expected: Vec<u64> = (first..).take(numbers.len()).collect();
        assert_eq!(numbers, expected, "{stopped:?}");
        let n_durable = (durable_through + 1).saturating_sub(first);
        assert!(
            numbers.len() as u64 >= n_durable,
            "{n_durable} of {numbers:?}"
        );
        Some(stopped)
    }
}

/// Lets one call after another fail from the start of a take on, for good or once, until none is left that a take makes.
async fn every_call_fails(stage: &mut Stage, kind: ErrorKind, lasts: bool, broken: TakeState) {
    for n_calls in 0.. {
        stage.disk.fail_call(n_calls, kind, lasts);
        let take = stage.record().await;
        let has_failed = stage.disk.repair();
        if let Some(take) = &take {
            let states = [TakeState::Closed, broken];
            assert!(states.contains(&take.state()), "call {n_calls}: {take:?}");
            let file = export(&stage.server, &take.name).await;
            let n_found = RecordedTake::read(&file).frame_numbers().len() as u64;
            assert_eq!(n_found, take.n_frames, "call {n_calls}: {take:?}");
            if take.state() == TakeState::Closed {
                assert_eq!(take.n_frames, FRAMES, "call {n_calls}");
            }
            assert_eq!(get(&stage.server, &take.name).await.unwrap(), *take);
        }
        if !has_failed {
            println!("{kind}: {n_calls} calls, each failed");
            assert!(n_calls > 10, "a take makes more calls");
            return;
        }
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h8_a_disk_that_is_full_at_any_call_costs_nothing_acknowledged_and_works_again_when_it_is_free()
 {
    let mut stage = Stage::start().await;
    let full = TakeState::TruncatedDiskFull;
    every_call_fails(&mut stage, ErrorKind::StorageFull, true, full).await;
    let after = stage.record().await.unwrap();
    assert_eq!((after.state(), after.n_frames), (TakeState::Closed, FRAMES));
    let is_temporary = |it: &std::ffi::OsString| it.to_string_lossy().ends_with(".tmp");
    let names = stage.disk.list(std::path::Path::new("/takes")).unwrap();
    assert!(!names.iter().any(is_temporary), "{names:?}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h9_a_call_that_fails_once_ends_its_take_and_nothing_is_acknowledged_past_it() {
    let mut stage = Stage::start().await;
    every_call_fails(&mut stage, ErrorKind::Other, false, TakeState::Degraded).await;
    let after = stage.record().await.unwrap();
    assert_eq!((after.state(), after.n_frames), (TakeState::Closed, FRAMES));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_disk_that_is_almost_full_takes_no_new_take_and_says_so() {
    let mut stage = Stage::start().await;
    stage.disk.set_free_bytes(Some((1 << 30) - 1));
    let refused = start(&stage.server, SESSION, "").await.unwrap_err();
    let refused = Problem::of(&refused);
    assert_eq!(
        (refused.code, refused.reason.as_str()),
        (Code::ResourceExhausted, "DISK_LOW")
    );
    stage.perform().await;
    let ready = async |service: &str| {
        let path = format!("/readyz?service={service}");
        http_get(&stage.server, &path).await.status.as_u16()
    };
    assert_eq!(
        (ready("").await, ready("frontalis.v1.TakeService").await),
        (200, 503)
    );
    let health = async || {
        let service = "frontalis.v1.TakeService".to_owned();
        let mut client = HealthClient::new(stage.server.channel().await);
        let answer = client.check(HealthCheckRequest { service }).await.unwrap();
        answer.into_inner().status()
    };
    harness::assert_eventually!(health().await == ServingStatus::NotServing);
    stage.disk.set_free_bytes(None);
    let take = start(&stage.server, SESSION, "").await.unwrap();
    assert_eq!(ready("frontalis.v1.TakeService").await, 200);
    harness::assert_eventually!(health().await == ServingStatus::Serving);
    stop(&stage.server, &take.name).await.unwrap();
}
