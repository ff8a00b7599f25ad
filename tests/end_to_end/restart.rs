//! Actors, sessions and alignments survive a restart, and a publisher that comes back goes on.

use frontalis_client::{
    capture_client::CaptureClient,
    connection::lazy_channel,
    curve_client::{CurveClient, CurveEvent, CurveSettings, StartAt, Wanted},
};
use frontalis_proto::v1::{
    CurveSample, GetActorRequest, ListActorsRequest, ListSessionsRequest, SessionSettings,
    SessionState, SubscribeStart,
};
use harness::{
    Problem, Publisher, Subscriber, TestPerformance, TestServer, assert_eventually, every_frame,
};
use tonic::Code;

const SESSION: &str = "sessions/stage";
const BEFORE: u64 = 60;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_publisher_goes_on_after_a_restart_without_a_new_alignment() {
    let server = staged().await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=BEFORE)).await;
    let mut subscriber = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    subscriber.samples_through(BEFORE).await.unwrap();
    let (epoch, run) = (publisher.started.epoch, publisher.started.run);
    let before = server.session(SESSION).await.status.unwrap();

    let server = server.restart().await;
    let restored = server.session(SESSION).await.status.unwrap();
    assert_eq!(
        restored.alignment, before.alignment,
        "the alignment is the one that was found"
    );
    assert_eq!(restored.state(), SessionState::Waiting);
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    assert!(publisher.started.epoch > epoch, "epochs never repeat");
    assert!(
        publisher.started.run > run,
        "unrecorded samples are lost with the process"
    );
    // The next frame of a moving face: it would make a poor neutral face.
    publisher
        .send(performance.frames(BEFORE + 1..=BEFORE + 20))
        .await;
    publisher.accepted(BEFORE + 20).await.unwrap();
    let mut subscriber = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    let samples = subscriber.samples_through(BEFORE + 20).await.unwrap();
    assert_eq!((samples[0].frame, samples[0].sequence), (BEFORE + 1, 1));
    assert_eq!(samples.len(), 20);
    for sample in &samples {
        assert_close(sample, &performance.activations(sample.frame));
    }
    let after = server.session(SESSION).await.status.unwrap();
    assert_eq!(after.alignment, before.alignment);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn actors_and_sessions_survive_a_restart() {
    let server = staged().await;
    let settings = SessionSettings {
        neutral_frames: Some(3),
        allow_exaggeration: Some(true),
        ..SessionSettings::default()
    };
    let other = server
        .create_session_with("other", "actors/reference", settings)
        .await
        .unwrap();
    let actor = actor(&server).await;

    let server = server.restart().await;
    assert_eq!(self::actor(&server).await, actor);
    let actors = server
        .actors()
        .await
        .list_actors(ListActorsRequest::default())
        .await
        .unwrap();
    assert_eq!(actors.into_inner().actors, [actor]);
    let listed = server
        .sessions()
        .await
        .list_sessions(ListSessionsRequest::default())
        .await
        .unwrap();
    let names: Vec<_> = listed
        .into_inner()
        .sessions
        .into_iter()
        .map(|it| it.name)
        .collect();
    assert_eq!(names, ["sessions/other", SESSION]);
    let again = server.session("sessions/other").await;
    assert_eq!(
        (again.settings, again.create_time),
        (other.settings, other.create_time)
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_position_in_the_run_before_the_restart_is_answered_new_run() {
    let server = staged().await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=BEFORE)).await;
    let run = publisher.started.run;

    let server = server.restart().await;
    let start = SubscribeStart {
        run,
        from_sequence: 10,
        from_oldest: false,
        ..every_frame(SESSION)
    };
    let refused = match Subscriber::open(&server, start).await {
        Err(status) => status,
        Ok(mut subscriber) => subscriber.next().await.unwrap_err(),
    };
    harness::assert_refused(&refused, Code::OutOfRange, "NEW_RUN");
    println!("{}", Problem::of(&refused).message);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_client_library_goes_on_over_a_restart_by_itself() {
    let server = staged().await;
    let performance = TestPerformance::reference();
    let channel = lazy_channel(&server.url()).unwrap();
    let publisher = CaptureClient::start(
        channel.clone(),
        performance.capture_settings(SESSION, "camera-1"),
    )
    .await
    .unwrap();
    let from = StartAt::Oldest;
    let wanted = CurveSettings::new(SESSION, Wanted::EveryFrame { from });
    let mut curves = CurveClient::subscribe(channel, wanted).await.unwrap();
    for number in 1..=BEFORE {
        publisher.send(performance.frame(number)).await.unwrap();
    }
    let (before, _) = frames_through(&mut curves, BEFORE).await;
    assert_eq!(before, (1..=BEFORE).collect::<Vec<_>>());
    assert_eventually!(publisher.report().accepted_through == BEFORE);

    let server = server.restart().await;
    for number in BEFORE + 1..=2 * BEFORE {
        publisher.send(performance.frame(number)).await.unwrap();
    }
    let (after, runs) = frames_through(&mut curves, 2 * BEFORE).await;
    assert_eq!(after, (BEFORE + 1..=2 * BEFORE).collect::<Vec<_>>());
    assert_eq!(
        runs, 1,
        "a restart without a recording is a new run, and is said"
    );
    let published = publisher.finish().await;
    assert!(published.failure.is_none(), "{:?}", published.failure);
    assert!(published.report.reconnections >= 1);
    assert_eq!(
        (
            published.report.unacknowledged_frames,
            published.report.lost.n_frames()
        ),
        (0, 0)
    );
    drop(curves);
    server.stop().await;
}

/// Frames of the samples up to that of `frame`, and how many new runs were told of.
async fn frames_through(curves: &mut CurveClient, frame: u64) -> (Vec<u64>, usize) {
    let (mut frames, mut runs) = (Vec::new(), 0);
    while frames.last() != Some(&frame) {
        match curves.next().await.unwrap().unwrap() {
            CurveEvent::Sample(sample) => frames.push(sample.frame),
            CurveEvent::NewRun { .. } => runs += 1,
            CurveEvent::Gap(gap) => panic!("{gap:?}"),
            _ => {}
        }
    }
    (frames, runs)
}

/// A server with a session that adds nothing to what a frame says, so that its curves are those that made the frame.
async fn staged() -> TestServer {
    let server = TestServer::start().await;
    server.import_reference().await;
    let plain = SessionSettings {
        plain: Some(true),
        ..SessionSettings::default()
    };
    let created = server.create_session_with("stage", "actors/reference", plain);
    created.await.unwrap();
    server
}

async fn actor(server: &TestServer) -> frontalis_proto::v1::Actor {
    let name = "actors/reference".to_owned();
    let answer = server
        .actors()
        .await
        .get_actor(GetActorRequest { name })
        .await;
    answer.unwrap().into_inner().actor.unwrap()
}

/// The performance is free of noise and its actor is known: what is left is the wire's single precision.
fn assert_close(sample: &CurveSample, truth: &[f64]) {
    for (muscle, (found, truth)) in sample.activations.iter().zip(truth).enumerate() {
        let error = (f64::from(*found) - truth).abs();
        assert!(
            error < 0.02,
            "frame {}, muscle {muscle}: {found} for {truth}",
            sample.frame
        );
    }
}
