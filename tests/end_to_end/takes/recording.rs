//! A take holds the frames as they came and the samples as they went.

use frontalis_proto::v1::{SubscribeStart, TakeState, take_event::Event};
use harness::{
    Problem, Publisher, RecordedTake, Subscriber, TestPerformance, TestServer, every_frame,
};
use tonic::Code;

use super::{SESSION, export, get, record, start, stop};

const N_FRAMES: u64 = 90;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_holds_every_frame_and_every_sample() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let take = start(&server, SESSION, "12A").await.unwrap();
    assert_eq!((take.state(), take.number), (TakeState::Recording, 1));
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    let frames = performance.frames(1..=N_FRAMES);
    publisher.send(frames.clone()).await;
    publisher.durable(N_FRAMES).await.unwrap();
    let under_way = RecordedTake::read(&export(&server, &take.name).await);
    assert_eq!(
        under_way.frames, frames,
        "acknowledged as on stable storage"
    );

    let stopped = stop(&server, &take.name).await.unwrap();
    assert_eq!(stopped.state(), TakeState::Closed);
    assert_eq!((stopped.first_frame, stopped.last_frame), (1, N_FRAMES));
    assert_eq!(stopped.n_frames, N_FRAMES);
    assert_eq!(get(&server, &take.name).await.unwrap(), stopped);

    let recorded = RecordedTake::read(&export(&server, &take.name).await);
    assert_eq!(recorded.frames, frames);
    let wanted = SubscribeStart {
        with_uncertainty: true,
        from_oldest: true,
        ..every_frame(SESSION)
    };
    let mut subscriber = Subscriber::open(&server, wanted).await.unwrap();
    let samples = subscriber.samples_through(N_FRAMES).await.unwrap();
    assert_eq!(recorded.samples, samples);
    assert!(matches!(&recorded.events[0], Event::Header(it) if it.take == take.name));
    let has_source = |it: &Event| matches!(it, Event::Source(it) if it.publisher == "stage");
    assert!(recorded.events.iter().any(has_source));
    let has_alignment = |it: &Event| matches!(it, Event::Alignment(_));
    assert!(recorded.events.iter().any(has_alignment));
    assert!(matches!(recorded.events.last(), Some(Event::Stop(it)) if it.n_frames == N_FRAMES));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_begins_and_ends_between_frames_of_a_live_session() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=40)).await;
    let take = start(&server, SESSION, "").await.unwrap();
    let again = start(&server, SESSION, "").await.unwrap_err();
    assert_eq!(Problem::of(&again).reason, "TAKE_RECORDING");
    publisher.send(performance.frames(41..=70)).await;
    publisher.durable(70).await.unwrap();
    let stopped = stop(&server, &take.name).await.unwrap();
    publisher.publish(performance.frames(71..=80)).await;
    assert_eq!((stopped.first_frame, stopped.last_frame), (41, 70));
    let recorded = RecordedTake::read(&export(&server, &take.name).await);
    assert_eq!(recorded.frame_numbers(), (41..=70).collect::<Vec<_>>());
    let solved: Vec<u64> = recorded.samples.iter().map(|it| it.frame).collect();
    assert_eq!(solved, (41..=70).collect::<Vec<_>>());
    let second = start(&server, SESSION, "").await.unwrap();
    assert_ne!(second.name, take.name);
    assert_eq!(second.number, take.number + 1);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_session_that_ends_closes_its_take() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let (take, mut publisher) = record(&server, &performance).await;
    publisher.send(performance.frames(1..=50)).await;
    publisher.accepted(50).await.unwrap();
    server.end_session(SESSION).await;
    let stopped = stop(&server, &take.name).await.unwrap();
    assert_eq!((stopped.state(), stopped.n_frames), (TakeState::Closed, 50));
    let nobody = stop(&server, "takes/nobody").await.unwrap_err();
    assert_eq!(Problem::of(&nobody).code, Code::NotFound);
}
