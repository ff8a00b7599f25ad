//! A take that is solved again gives the bits of the live run, or what other settings would have given (CONTRACTS U-13).

use frontalis_proto::v1::{
    CurveSample, Gap, Ingest, ListTakesRequest, MarkerFrame, NeutralSource, PublishStart,
    RecenterSessionRequest, RegionMode, ResolveTakeRequest, ResolveTakeResponse, SessionSettings,
    Take, UpdateSessionRequest, take_event::Event,
};
use harness::{Problem, Publisher, RecordedTake, TestPerformance, TestServer};
use tonic::Status;

use super::{SESSION, export, get, start, stop};

async fn staged(settings: SessionSettings) -> TestServer {
    let server = TestServer::start().await;
    server.import_reference().await;
    server
        .create_session_with("stage", "actors/reference", settings)
        .await
        .unwrap();
    server
}

fn plain(region_mode: RegionMode, stabilize_head: bool) -> SessionSettings {
    SessionSettings {
        plain: Some(true),
        stabilize_head: Some(stabilize_head),
        region_mode: region_mode.into(),
        ..SessionSettings::default()
    }
}

/// Every answer of a re-solve; the last one has the new take.
async fn resolve(
    server: &TestServer,
    request: ResolveTakeRequest,
) -> Result<Vec<ResolveTakeResponse>, Status> {
    let mut client = server.takes().await;
    let mut answers = client.resolve_take(request).await?.into_inner();
    let mut all = Vec::new();
    while let Some(answer) = answers.message().await? {
        all.push(answer);
    }
    Ok(all)
}

pub(super) async fn resolved(
    server: &TestServer,
    take: &Take,
    settings: Option<SessionSettings>,
) -> Take {
    let request = ResolveTakeRequest {
        name: take.name.clone(),
        settings,
        ..ResolveTakeRequest::default()
    };
    let answers = resolve(server, request).await.unwrap();
    let last = answers.last().unwrap();
    assert_eq!(last.frames_done, last.n_frames);
    last.take.clone().unwrap()
}

async fn recorded(server: &TestServer, take: &Take) -> RecordedTake {
    RecordedTake::read(&export(server, &take.name).await)
}

/// All of a sample but its place in the stream and the server's times.
fn solved(take: &RecordedTake) -> Vec<CurveSample> {
    let bare = |it: &CurveSample| CurveSample {
        sequence: 0,
        solved_time_nanos: 0,
        ..it.clone()
    };
    take.samples.iter().map(bare).collect()
}

/// The frames as they were sent: hidden markers are no numbers, and equal to nothing.
fn sent(take: &RecordedTake) -> Vec<Vec<u8>> {
    take.frames
        .iter()
        .map(prost::Message::encode_to_vec)
        .collect()
}

/// The gaps, those that go on joined.
fn gaps(take: &RecordedTake) -> Vec<Gap> {
    let mut gaps: Vec<Gap> = Vec::new();
    for event in &take.events {
        let Event::Gap(gap) = event else { continue };
        match gaps.last_mut() {
            Some(last) if last.cause == gap.cause && last.last + 1 == gap.first => {
                last.last = gap.last;
            }
            _ => gaps.push(*gap),
        }
    }
    gaps
}

/// The take solved again is the take, bit for bit.
async fn check_same(server: &TestServer, take: &Take) -> RecordedTake {
    let again = resolved(server, take, None).await;
    assert_eq!(again.resolved_from, take.name);
    assert_eq!((again.n_frames, &again.slate), (take.n_frames, &take.slate));
    assert_eq!(get(server, &again.name).await.unwrap(), again);
    let (live, solved_again) = (recorded(server, take).await, recorded(server, &again).await);
    assert_eq!(sent(&solved_again), sent(&live));
    assert_eq!(gaps(&solved_again), gaps(&live));
    assert_eq!(solved(&solved_again), solved(&live));
    live
}

/// At rest, or hidden in part, or moving: frames that go through everything a session does.
fn frame(performance: &TestPerformance, number: u64) -> MarkerFrame {
    let mut frame = match number {
        81..=110 | 171..=180 => MarkerFrame {
            number,
            ..performance.frame(1)
        },
        _ => performance.frame(number),
    };
    frame.capture_time_nanos = performance.frame(number).capture_time_nanos;
    let hidden = match number {
        50..=56 => 3..9,
        60..=64 => 0..performance.n_markers(),
        140..=150 => 12..14,
        _ => 0..0,
    };
    for marker in hidden {
        frame.positions[3 * marker..3 * marker + 3].fill(f32::NAN);
    }
    frame
}

fn frames(
    performance: &TestPerformance,
    numbers: std::ops::RangeInclusive<u64>,
) -> Vec<MarkerFrame> {
    numbers.map(|it| frame(performance, it)).collect()
}

async fn recenter(server: &TestServer, source: NeutralSource) {
    let request = RecenterSessionRequest {
        name: SESSION.to_owned(),
        source: source.into(),
    };
    let mut sessions = server.sessions().await;
    sessions.recenter_session(request).await.unwrap();
}

async fn update(server: &TestServer, settings: SessionSettings) {
    let request = UpdateSessionRequest {
        name: SESSION.to_owned(),
        settings: Some(settings),
        ..UpdateSessionRequest::default()
    };
    let mut sessions = server.sessions().await;
    sessions.update_session(request).await.unwrap();
}

/// A take that starts in a running session and goes through recentering, other settings, hidden and late and unusable frames,
/// skipped numbers and another publisher.
async fn eventful_take(server: &TestServer) -> Take {
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.publish(frames(&performance, 1..=40)).await;
    let take = start(server, SESSION, "12A").await.unwrap();
    publisher.publish(frames(&performance, 41..=80)).await;
    recenter(server, NeutralSource::NextFrames).await;
    publisher.publish(frames(&performance, 81..=115)).await;
    update(
        server,
        SessionSettings {
            neutral_frames: Some(4),
            allow_exaggeration: Some(true),
            ..SessionSettings::default()
        },
    )
    .await;
    publisher.publish(frames(&performance, 120..=150)).await;
    // Late, unusable, and out of the order of time.
    publisher.send(frames(&performance, 117..=118)).await;
    let mut unusable = frame(&performance, 151);
    unusable.positions[4] = f32::INFINITY;
    publisher.send(vec![unusable]).await;
    let mut early = frame(&performance, 152);
    early.capture_time_nanos = 1;
    publisher.publish(vec![early]).await;
    publisher.publish(frames(&performance, 153..=160)).await;
    drop(publisher);
    let takeover = PublishStart {
        takeover: true,
        ..performance.start(SESSION, "other")
    };
    let mut publisher = Publisher::open(server, takeover).await.unwrap();
    publisher.publish(frames(&performance, 165..=190)).await;
    recenter(server, NeutralSource::QuietestFrames).await;
    publisher.publish(frames(&performance, 191..=220)).await;
    stop(server, &take.name).await.unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_eventful_take_gives_the_same_bits_again() {
    for settings in [
        SessionSettings::default(),
        plain(RegionMode::Split, false),
        plain(RegionMode::Joint, true),
    ] {
        let server = staged(settings).await;
        let take = eventful_take(&server).await;
        let live = check_same(&server, &take).await;
        assert!(live.samples.len() > 150, "{}", live.samples.len());
        let of = |kind: fn(&Event) -> bool| live.events.iter().filter(|it| kind(it)).count();
        assert_eq!(of(|it| matches!(it, Event::AnalysisState(_))), 1);
        assert_eq!(of(|it| matches!(it, Event::Recenter(_))), 2);
        assert!(of(|it| matches!(it, Event::Alignment(_))) >= 2);
        assert!(
            live.frame_numbers().windows(2).any(|it| it[1] < it[0]),
            "late frames are there"
        );
        // What was made so can be solved again itself.
        let again = resolved(&server, &take, None).await;
        check_same(&server, &again).await;
        server.stop().await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_that_starts_among_the_neutral_frames_gives_the_same_bits_again() {
    let server = staged(SessionSettings::default()).await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=9)).await;
    let take = start(&server, SESSION, "").await.unwrap();
    publisher.publish(performance.frames(10..=60)).await;
    let take = stop(&server, &take.name).await.unwrap();
    let live = check_same(&server, &take).await;
    assert_eq!(live.samples.first().map(|it| it.frame), Some(10));
    server.stop().await;
}

/// One thread: the frames of a message are all offered before the first of them is solved.
#[tokio::test]
async fn shed_frames_stay_shed() {
    let server = TestServer::start_with(|config| config.limits.waiting_frames = 4).await;
    server.import_reference().await;
    server
        .create_session("stage", "actors/reference")
        .await
        .unwrap();
    let performance = TestPerformance::reference();
    let live = PublishStart {
        ingest: Ingest::Live.into(),
        ..performance.start(SESSION, "stage")
    };
    let mut publisher = Publisher::open(&server, live).await.unwrap();
    for first in (1..=28).step_by(4) {
        publisher
            .publish(performance.frames(first..=first + 3))
            .await;
    }
    let take = start(&server, SESSION, "").await.unwrap();
    for first in (29..=172).step_by(12) {
        publisher
            .publish(performance.frames(first..=first + 11))
            .await;
    }
    let take = stop(&server, &take.name).await.unwrap();
    let live = check_same(&server, &take).await;
    assert_eq!(live.frames.len(), 144);
    assert!(live.samples.len() < 144, "nothing was shed");
    assert!(publisher.report().shed_frames > 0);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn other_settings_hold_throughout() {
    let server = staged(SessionSettings::default()).await;
    let performance = TestPerformance::reference();
    let asked = plain(RegionMode::Split, true);
    let mut takes = Vec::new();
    for (session, settings) in [("stage", None), ("other", Some(asked.clone()))] {
        if let Some(settings) = settings {
            let made = server.create_session_with(session, "actors/reference", settings);
            made.await.unwrap();
        }
        let name = format!("sessions/{session}");
        let take = start(&server, &name, "").await.unwrap();
        let mut publisher = Publisher::open(&server, performance.start(&name, "stage"))
            .await
            .unwrap();
        publisher.publish(frames(&performance, 1..=110)).await;
        takes.push(stop(&server, &take.name).await.unwrap());
    }
    let again = resolved(&server, &takes[0], Some(asked)).await;
    let (found, expected) = (
        recorded(&server, &again).await,
        recorded(&server, &takes[1]).await,
    );
    assert_eq!(solved(&found), solved(&expected));
    let Event::Header(header) = &found.events[0] else {
        panic!("{:?}", found.events[0]);
    };
    assert_eq!(header.settings.as_ref().unwrap().plain, Some(true));
    assert_eq!(header.resolved_from, takes[0].name);

    let refused = |settings, actor_revision| ResolveTakeRequest {
        name: takes[0].name.clone(),
        actor_revision,
        settings,
    };
    let wrong = SessionSettings {
        smoothing: Some(7.0),
        ..SessionSettings::default()
    };
    let error = resolve(&server, refused(Some(wrong), 0)).await.unwrap_err();
    assert_eq!(Problem::of(&error).reason, "SOLVER_OPTIONS");
    let error = resolve(&server, refused(None, 9)).await.unwrap_err();
    assert_eq!(Problem::of(&error).reason, "ACTOR");
    check_files(&server, 3).await;
    server.stop().await;
}

pub(super) async fn listed(server: &TestServer) -> Vec<Take> {
    let mut client = server.takes().await;
    let answer = client.list_takes(ListTakesRequest::default()).await;
    answer.unwrap().into_inner().takes
}

/// As many files as takes, and none that is not whole.
async fn check_files(server: &TestServer, n_takes: usize) {
    let listed = listed(server).await;
    assert_eq!(listed.len(), n_takes);
    let n_bytes: u64 = listed.iter().map(|it| it.n_bytes).sum();
    assert_eq!(server.disk_bytes(|name| name.contains(".mcap")), n_bytes);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_resolve_that_is_given_up_leaves_nothing() {
    let server = staged(SessionSettings::default()).await;
    let performance = TestPerformance::reference();
    let take = start(&server, SESSION, "").await.unwrap();
    let request = ResolveTakeRequest {
        name: take.name.clone(),
        ..ResolveTakeRequest::default()
    };
    let under_way = resolve(&server, request.clone()).await.unwrap_err();
    assert_eq!(Problem::of(&under_way).reason, "TAKE_RECORDING");
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=250)).await;
    stop(&server, &take.name).await.unwrap();
    let mut client = server.takes().await;
    let answers = client.resolve_take(request).await.unwrap();
    drop(answers);
    // The take was solved in time, or nothing is left of it; both are seen by whoever starts the server again.
    let server = server.restart().await;
    let n_takes = listed(&server).await.len();
    check_files(&server, n_takes).await;
    server.stop().await;
}
