//! Every row of the bad-input table: the answer it gets, and a control session on the same server that loses nothing.
//!
//! Tests are named after their row: `a3_…`.

mod access;
mod actor_packages;
mod cancel;
mod connections;
mod documented;
mod downloads;
mod http1;
mod http2;
mod http_bodies;
mod json_forms;
mod leases;
mod marker_frames;
mod memory;
mod messages;
mod names;
mod neutral_faces;
mod origin;
mod packages_glb;
mod positions;
mod protocol_order;
mod protocols;
mod resources;
mod solver_options;
mod storage;
mod tls;
mod websocket;
mod wrong_markers;

use frontalis_proto::v1::{CurveSample, MarkerFrame};
use frontalis_server::config::Config;
use harness::{ControlSession, Publisher, Subscriber, TestPerformance, TestServer, every_frame};

/// The session that the bad input goes to.
const SUBJECT: &str = "sessions/subject";

/// Frames that a well-behaved publisher has sent before the bad ones: the neutral face is known.
const GOOD_FRAMES: u64 = 30;

/// A server with the reference face, a session to mistreat, and a session that must not notice.
struct Stage {
    server: TestServer,
    performance: TestPerformance,
}

impl Stage {
    /// A publisher of the subject whose first [`GOOD_FRAMES`] frames were taken.
    async fn publisher(&self) -> Publisher {
        let start = self.performance.start(SUBJECT, "camera-1");
        let mut publisher = Publisher::open(&self.server, start).await.unwrap();
        publisher
            .send(self.performance.frames(1..=GOOD_FRAMES))
            .await;
        publisher.accepted(GOOD_FRAMES).await.unwrap();
        publisher
    }

    /// A subscriber of every frame of the subject that has heard the samples of the good frames.
    async fn subscriber(&self) -> Subscriber {
        let mut subscriber = Subscriber::open(&self.server, every_frame(SUBJECT))
            .await
            .unwrap();
        let samples = subscriber.samples_through(GOOD_FRAMES).await.unwrap();
        assert_eq!(samples.len() as u64, GOOD_FRAMES);
        subscriber
    }

    /// The samples that these frames, numbered from 1, give in a new session: all are accepted, each gives one.
    async fn samples_of(&self, id: &str, frames: Vec<MarkerFrame>) -> Vec<CurveSample> {
        let n_frames = frames.len() as u64;
        let created = self.server.create_session(id, "actors/reference").await;
        let session = created.unwrap().name;
        let start = self.performance.start(&session, "camera-1");
        let mut publisher = Publisher::open(&self.server, start).await.unwrap();
        publisher.publish(frames).await;
        assert_eq!(publisher.report().rejections(), []);
        let every = every_frame(&session);
        let mut subscriber = Subscriber::open(&self.server, every).await.unwrap();
        let samples = subscriber.samples_through(n_frames).await.unwrap();
        assert_eq!(samples.len() as u64, n_frames);
        samples
    }

    /// The place of a marker in the stream.
    fn marker(&self, name: &str) -> usize {
        let mut names = self.performance.marker_names().iter();
        names.position(|it| it == name).unwrap()
    }
}

/// Runs one row beside the control session, and fails when that loses a frame.
async fn beside_a_control_session(row: &str, test: impl AsyncFnOnce(&Stage)) {
    beside_a_control_session_with(row, |_| {}, test).await;
}

/// The same with other limits than the defaults.
async fn beside_a_control_session_with(
    row: &str,
    change: impl FnOnce(&mut Config),
    test: impl AsyncFnOnce(&Stage),
) {
    beside_a_control_session_of(row, TestServer::start_with(change).await, test).await;
}

/// The same on a server that runs already.
async fn beside_a_control_session_of(
    row: &str,
    server: TestServer,
    test: impl AsyncFnOnce(&Stage),
) {
    server.import_reference().await;
    server
        .create_session("subject", "actors/reference")
        .await
        .unwrap();
    let control = ControlSession::start(&server).await;
    let stage = Stage {
        server,
        performance: TestPerformance::reference(),
    };
    test(&stage).await;
    let report = control.finish(&stage.server).await;
    println!(
        "{row}: control session {} frames, none lost, p99 {:.0} us",
        report.n_frames, report.p99_micros
    );
    stage.server.stop().await;
}
