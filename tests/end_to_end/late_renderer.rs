//! A renderer that stalls shows the present when it wakes, and nobody else notices that it stalled.

use harness::{
    Publisher, StallProfile, Subscriber, TestPerformance, TestServer, every_frame, latest,
};

const SESSION: &str = "sessions/late";
/// Frames before anyone listens.
const BEFORE: u64 = 40;

/// 20 s at 120 Hz, published as fast as the server takes them; `make bench-late` sleeps for real.
const STALL: StallProfile = StallProfile {
    credits: 3,
    n_frames: 2_400,
    real_time: false,
};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_renderer_that_stalls_gets_its_credits_of_stale_samples_then_the_newest() {
    let server = TestServer::start().await;
    server.import_reference().await;
    let report = STALL.run(&server).await;
    println!("asleep for {} frames: {report}", STALL.n_frames);
    assert!(report.n_stale <= STALL.credits as usize, "{report:?}");
    assert_eq!(
        report.n_accounted, report.last_frame,
        "what was not sent was counted"
    );
    assert_eq!(report.n_missing, 0, "the recorder missed something");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_late_renderer_sees_the_current_face_at_once() {
    let server = TestServer::with_session("late").await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=BEFORE)).await;
    let mut recorder = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    recorder.samples_through(BEFORE).await.unwrap();
    let mut renderer = Subscriber::open(&server, latest(SESSION, 1)).await.unwrap();
    assert_eq!(renderer.sample().await.unwrap().frame, BEFORE);
    server.stop().await;
}
