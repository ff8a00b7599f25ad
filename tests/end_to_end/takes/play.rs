//! A take is played again: the same frames, as another session.

use frontalis_proto::v1::{SessionState, Timecode};
use harness::{RecordedTake, TestPerformance, TestServer};

use super::{export, record, start, stop};
use crate::person::Person;

const N_FRAMES: u64 = 90;

/// A server with a take whose frames have all that a frame can have, and one that came late.
async fn recorded() -> (TestServer, String) {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let (take, mut publisher) = record(&server, &performance).await;
    let mut frames = performance.frames(1..=N_FRAMES);
    for frame in &mut frames {
        frame.source_frame = 1_000 + frame.number;
        frame.timecode = Some(Timecode {
            hours: 10,
            frames: u32::try_from(frame.number % 30).unwrap(),
            rate_numerator: 30,
            rate_denominator: 1,
            ..Timecode::default()
        });
    }
    let late = frames.remove(39);
    publisher.send(frames).await;
    publisher.send(vec![late]).await;
    publisher.durable(N_FRAMES).await.unwrap();
    stop(&server, &take.name).await.unwrap();
    let id = take.name.strip_prefix("takes/").unwrap().to_owned();
    (server, id)
}

/// Frames of a session's take that is recorded while a person does this.
async fn recorded_while(
    server: &TestServer,
    person: &Person,
    session: &str,
    line: &str,
) -> RecordedTake {
    let name = format!("sessions/{session}");
    let take = start(server, &name, "").await.unwrap();
    person
        .does(&format!("--server {} {line}", server.url()))
        .await;
    stop(server, &take.name).await.unwrap();
    RecordedTake::read(&export(server, &take.name).await)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_that_is_played_is_the_same_frames_again() {
    let (server, id) = recorded().await;
    let anna = Person::new();
    let take = RecordedTake::read(&export(&server, &format!("takes/{id}")).await);
    let mut in_order = take.frames.clone();
    let late = in_order.pop().unwrap();
    assert_eq!(late.number, 40);
    server
        .create_session("again", "actors/reference")
        .await
        .unwrap();
    let play = format!("take play {id} --session again --speed 20");
    let played = recorded_while(&server, &anna, "again", &play).await;
    assert_eq!(played.frames, in_order);
    assert_eq!(played.samples.len(), take.samples.len());
    for (again, once) in played.samples.iter().zip(&take.samples) {
        assert_eq!(again.activations, once.activations, "frame {}", once.frame);
    }

    // From a file, into the same session: numbered on.
    let file = server.data_dir().join("one.mcap").display().to_string();
    let url = server.url();
    anna.does(&format!("--server {url} take export {id} --out {file}"))
        .await;
    let play = format!("take play {file} --session again --speed 20");
    let played = recorded_while(&server, &anna, "again", &play).await;
    for (again, once) in played.frames.iter().zip(&in_order) {
        assert_eq!(again.number, once.number + N_FRAMES);
        assert_eq!(again.positions, once.positions);
        assert_eq!(again.source_frame, once.source_frame);
    }
    assert_eq!(played.frames.len(), in_order.len());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_session_is_made_for_a_take_and_ended_with_it() {
    let (server, id) = recorded().await;
    let anna = Person::new();
    let url = server.url();
    let said = anna
        .does(&format!("--server {url} --json take play {id} --speed 50"))
        .await;
    let report: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(report["acceptedFrames"], (N_FRAMES - 1).to_string());
    let session = server.session(&format!("sessions/play-{id}")).await;
    assert_eq!(session.actor, "actors/reference");
    assert_eq!(session.status.unwrap().state(), SessionState::Ended);
    let complained = anna
        .fails(&format!("--server {url} take play nothing-like-it"))
        .await;
    assert!(complained.contains("nothing-like-it"), "{complained}");
    server.stop().await;
}
