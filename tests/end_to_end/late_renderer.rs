//! A renderer that stalls shows the present when it wakes, and nobody else notices that it stalled.

use harness::{Publisher, Subscriber, TestPerformance, TestServer, every_frame, latest};

const SESSION: &str = "sessions/late";
const CREDITS: u32 = 3;
/// 20 s at 120 Hz: what a renderer that sleeps so long does not read.
const STALL_FRAMES: u64 = 2_400;
/// Frames before the stall.
const BEFORE: u64 = 40;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_renderer_that_stalls_gets_its_credits_of_stale_samples_then_the_newest() {
    let server = TestServer::start().await;
    server.import_reference().await;
    server
        .create_session("late", "actors/reference")
        .await
        .unwrap();
    let mut renderer = Subscriber::open(&server, latest(SESSION, CREDITS))
        .await
        .unwrap();
    let mut recorder = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publish(&mut publisher, &performance, 1, BEFORE).await;
    let before = read_through(&mut renderer, BEFORE).await;

    // The renderer sleeps while 20 s of samples pass it by; the recorder reads on.
    let last = BEFORE + STALL_FRAMES;
    let recording = tokio::spawn(async move { recorder.samples_through(last).await.unwrap() });
    publish(&mut publisher, &performance, BEFORE + 1, last).await;
    let recorded = recording.await.unwrap();

    let after = read_through(&mut renderer, last).await;
    let stale = after.len() - 1;
    println!("after 20 s at 120 Hz: {stale} stale samples, then the newest of {last}");
    assert!(stale <= CREDITS as usize, "{after:?}");
    assert_eq!(
        renderer.skipped_samples + (before.len() + after.len()) as u64,
        last,
        "what was not sent was counted"
    );
    let sequences: Vec<_> = recorded.iter().map(|it| it.sequence).collect();
    assert_eq!(
        sequences,
        (1..=last).collect::<Vec<_>>(),
        "the recorder missed something"
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_late_renderer_sees_the_current_face_at_once() {
    let server = TestServer::start().await;
    server.import_reference().await;
    server
        .create_session("late", "actors/reference")
        .await
        .unwrap();
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publish(&mut publisher, &performance, 1, BEFORE).await;
    let mut recorder = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    recorder.samples_through(BEFORE).await.unwrap();
    let mut renderer = Subscriber::open(&server, latest(SESSION, 1)).await.unwrap();
    assert_eq!(renderer.sample().await.unwrap().frame, BEFORE);
    server.stop().await;
}

async fn publish(publisher: &mut Publisher, performance: &TestPerformance, first: u64, last: u64) {
    for number in (first..=last).step_by(8) {
        let until = (number + 7).min(last);
        publisher.send(performance.frames(number..=until)).await;
    }
    publisher.accepted(last).await.unwrap();
}

/// Reads and returns credits until the sample of `frame` is there; the frames that were read.
async fn read_through(renderer: &mut Subscriber, frame: u64) -> Vec<u64> {
    let mut frames = Vec::new();
    loop {
        let sample = renderer.sample().await.unwrap();
        renderer.grant(1).await;
        frames.push(sample.frame);
        if sample.frame == frame {
            return frames;
        }
    }
}
