//! A server that is told to stop says so to everyone, and is gone within its grace.

use harness::{
    DrainProfile, Heard, Publisher, Subscriber, TestPerformance, TestServer, assert_refused,
    every_frame, latest,
};
use tonic::Code;

const SESSION: &str = "sessions/stage";
const FRAMES: u64 = 50;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_drain_closes_every_stream_with_its_reason_and_never_with_an_end() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    let recorder = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    let renderer = Subscriber::open(&server, latest(SESSION, 2)).await.unwrap();
    publisher.publish(performance.frames(1..=FRAMES)).await;

    let recording = tokio::spawn(until_cut(recorder));
    let rendering = tokio::spawn(until_cut(renderer));
    server.begin_drain();
    assert_refused(&publisher.broken_off().await, Code::Unavailable, "DRAINING");
    let (recorded, status) = recording.await.unwrap();
    assert_refused(&status, Code::Unavailable, "DRAINING");
    assert_eq!(
        recorded,
        (1..=FRAMES).collect::<Vec<_>>(),
        "every frame that was taken was sent first"
    );
    let (_, status) = rendering.await.unwrap();
    assert_refused(&status, Code::Unavailable, "DRAINING");
    server.stop().await;
}

/// `make drain-test` has a hundred.
const CYCLES: usize = 5;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_recording_server_loses_nothing_durable_over_drains_and_restarts() {
    let report = DrainProfile { n_cycles: CYCLES }.run().await;
    println!("G10: {report}");
    assert!(report.is_clean(), "{report}");
    assert!(report.n_durable > 0);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_end_is_the_last_word_of_a_session() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    let mut recorder = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=FRAMES)).await;
    drop(publisher.finish().await);
    server.end_session(SESSION).await;
    server.end_session(SESSION).await;
    let heard = recorder.until_end().await.unwrap();
    let Some(Heard::End(end)) = heard.last() else {
        panic!("the last word was {:?}", heard.last());
    };
    assert_eq!(end.last_frame, FRAMES);
    assert_eq!(heard.len() as u64, FRAMES + 1);
    server.stop().await;
}

/// Reads until the server cuts the stream: the frames, and its reason.
async fn until_cut(mut subscriber: Subscriber) -> (Vec<u64>, tonic::Status) {
    let mut frames = Vec::new();
    loop {
        match subscriber.next().await {
            Ok(Some(Heard::Sample(sample))) => frames.push(sample.frame),
            Ok(Some(Heard::End(end))) => panic!("a drain is no end: {end:?}"),
            Ok(Some(_)) => {}
            Ok(None) => panic!("the stream ended in peace"),
            Err(status) => return (frames, status),
        }
    }
}
