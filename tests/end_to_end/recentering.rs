//! A live session takes another neutral face without a hole: it stays live, every frame gives its sample.

use frontalis_proto::v1::{
    NeutralSource, RecenterSessionRequest, Session, SessionSettings, SessionState,
};
use harness::{
    Heard, Publisher, Subscriber, TestPerformance, TestServer, assert_refused, every_frame,
    http_send,
};
use hyper::Method;
use serde_json::json;
use tonic::{Code, Status};

const SESSION: &str = "sessions/stage";
const PATH: &str = "/api/v1/sessions/stage/recenter";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_live_session_recenters_without_a_hole_and_stays_live() {
    let server = staged().await;
    let performance = TestPerformance::reference();
    let mut subscriber = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    let mut publisher = publisher(&server, &performance).await;
    publisher.publish(performance.frames(1..=40)).await;
    let before = status(&server.session(SESSION).await);
    assert!(before.alignment.is_some());

    let source = NeutralSource::NextFrames;
    let recentered = recenter(&server, source).await.unwrap();
    assert_eq!(status(&recentered).state(), SessionState::Live);
    assert_eq!(status(&recentered).alignment, before.alignment);
    // The face is at rest again, as in the first frames, and the capture goes on.
    let at_rest = (41..=80).map(|number| frontalis_proto::v1::MarkerFrame {
        number,
        ..performance.frame(1)
    });
    publisher.publish(at_rest.collect()).await;
    let after = status(&server.session(SESSION).await);
    assert_eq!(after.alignment_problem, "");
    assert_ne!(after.alignment, None);
    server.end_session(SESSION).await;

    let (mut frames, mut states) = (Vec::new(), Vec::new());
    while let Some(heard) = subscriber.next().await.unwrap() {
        match heard {
            Heard::Sample(sample) => {
                assert_eq!(sample.sequence, sample.frame);
                frames.push(sample.frame);
            }
            Heard::Gap(gap) => panic!("{gap:?}"),
            Heard::State(state) => states.push(state.session_state()),
            Heard::End(_) => {}
        }
    }
    assert_eq!(frames, (1..=80).collect::<Vec<_>>());
    states.dedup();
    let was_live = states.iter().position(|it| *it == SessionState::Live);
    let from_live = &states[was_live.unwrap_or_default()..];
    assert!(
        from_live
            .iter()
            .all(|it| matches!(it, SessionState::Live | SessionState::Ended)),
        "{states:?}"
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_face_that_cannot_be_aligned_leaves_the_old_one_and_the_stream() {
    let server = staged().await;
    let performance = TestPerformance::reference();
    let mut publisher = publisher(&server, &performance).await;
    publisher.publish(performance.frames(1..=40)).await;
    recenter(&server, NeutralSource::NextFrames).await.unwrap();
    let mirrored = |number| {
        let mut frame = performance.frame(1);
        frame.number = number;
        frame.positions.iter_mut().step_by(3).for_each(|x| *x = -*x);
        frame
    };
    publisher.publish((41..=60).map(mirrored).collect()).await;
    let mut subscriber = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    subscriber.samples_through(60).await.unwrap();
    let failed = status(&server.session(SESSION).await);
    assert_eq!(failed.alignment_problem, "MIRRORED");
    assert_eq!(failed.state(), SessionState::Live);
    assert!(failed.alignment.is_some());
    publisher.publish(performance.frames(61..=90)).await;
    let samples = subscriber.samples_through(90).await.unwrap();
    assert_eq!(samples.len(), 30);
    assert_eq!(publisher.report().rejections(), []);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn quietest_frames_that_are_not_there_are_refused_at_every_door() {
    let server = staged().await;
    let quietest = NeutralSource::QuietestFrames;
    let refused = recenter(&server, quietest).await.unwrap_err();
    assert_refused(&refused, Code::FailedPrecondition, "NOT_ALIGNED");
    let performance = TestPerformance::reference();
    publisher(&server, &performance)
        .await
        .publish(performance.frames(1..=40))
        .await;

    // After a restart the alignment is there, and no frame has been looked at.
    let server = server.restart().await;
    let _publisher = publisher(&server, &performance).await;
    let refused = recenter(&server, quietest).await.unwrap_err();
    assert_refused(&refused, Code::FailedPrecondition, "QUIETEST_FRAMES");
    assert!(
        refused.message().contains("15 are needed"),
        "{}",
        refused.message()
    );
    let body = json!({ "source": "NEUTRAL_SOURCE_QUIETEST_FRAMES" }).to_string();
    let kind = [("content-type", "application/json")];
    let answer = http_send(&server, &Method::POST, PATH, &kind, body.as_bytes()).await;
    assert_eq!(answer.status, 409, "{}", answer.text());
    let problem = answer.json();
    assert_eq!(problem["type"], "urn:frontalis:problem:QUIETEST_FRAMES");
    let status = status(&server.session(SESSION).await);
    assert!(status.alignment.is_some());
    assert_eq!(status.alignment_problem, "");
    server.stop().await;
}

/// A server with a session that a slow machine does not make stale.
async fn staged() -> TestServer {
    let server = TestServer::start().await;
    server.import_reference().await;
    let patient = SessionSettings {
        stale_after: Some(pbjson_types::Duration {
            seconds: 3_600,
            nanos: 0,
        }),
        ..SessionSettings::default()
    };
    let created = server.create_session_with("stage", "actors/reference", patient);
    created.await.unwrap();
    server
}

async fn publisher(server: &TestServer, performance: &TestPerformance) -> Publisher {
    let start = performance.start(SESSION, "camera-1");
    Publisher::open(server, start).await.unwrap()
}

async fn recenter(server: &TestServer, source: NeutralSource) -> Result<Session, Status> {
    let request = RecenterSessionRequest {
        name: SESSION.to_owned(),
        source: source.into(),
    };
    let answer = server.sessions().await.recenter_session(request).await?;
    Ok(answer.into_inner().session.unwrap())
}

fn status(session: &Session) -> frontalis_proto::v1::SessionStatus {
    session.status.clone().unwrap()
}
