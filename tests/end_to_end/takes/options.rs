//! Sessions that record themselves, what came before a take, where it starts on the stage's clock, and the publisher's clock.

use frontalis_proto::v1::{
    ClockEcho, CurveSample, MarkerFrame, PublishMarkersRequest, SessionSettings, StartTakeRequest,
    Take, TakeState, Timecode, take_event::Event,
};
use harness::{Problem, Publisher, RecordedTake, TestPerformance, TestServer};

use super::{SESSION, export, get, resolve::resolved, stop};

async fn recorded(server: &TestServer, name: &str) -> RecordedTake {
    RecordedTake::read(&export(server, name).await)
}

async fn start(
    server: &TestServer,
    change: impl FnOnce(&mut StartTakeRequest),
) -> Result<Take, tonic::Status> {
    let mut request = StartTakeRequest {
        session: SESSION.to_owned(),
        ..StartTakeRequest::default()
    };
    change(&mut request);
    let answer = server.takes().await.start_take(request).await?;
    Ok(answer.into_inner().take.unwrap())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_session_that_records_itself_loses_no_frame() {
    let server = TestServer::start().await;
    server.import_reference().await;
    let settings = SessionSettings {
        record: Some(true),
        record_images: Some(true),
        ..SessionSettings::default()
    };
    let made = server.create_session_with("stage", "actors/reference", settings);
    let session = made.await.unwrap();
    assert!(session.settings.as_ref().unwrap().record());
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.send(performance.frames(1..=50)).await;
    publisher.durable(50).await.unwrap();
    drop(publisher);
    // Another publication of the same run begins no other take.
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.send(performance.frames(51..=60)).await;
    publisher.durable(60).await.unwrap();
    server.end_session(SESSION).await;
    let takes = super::resolve::listed(&server).await;
    assert_eq!(takes.len(), 1, "{takes:?}");
    assert!(takes[0].with_images);
    let take = stop(&server, &takes[0].name).await.unwrap();
    assert_eq!(take.state(), TakeState::Closed);
    let recorded = recorded(&server, &take.name).await;
    assert_eq!(recorded.frames, performance.frames(1..=60));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_pre_roll_holds_what_came_before_and_says_so() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=60)).await;
    let pre_roll = |secs| pbjson_types::Duration {
        seconds: secs,
        nanos: 0,
    };
    let too_long = start(&server, |it| it.pre_roll = Some(pre_roll(11))).await;
    let too_long = Problem::of(&too_long.unwrap_err());
    assert_eq!(too_long.code, tonic::Code::InvalidArgument);
    let take = start(&server, |it| it.pre_roll = Some(pre_roll(10)))
        .await
        .unwrap();
    publisher.send(performance.frames(61..=90)).await;
    publisher.durable(90).await.unwrap();
    let take = stop(&server, &take.name).await.unwrap();
    assert_eq!(
        (take.first_frame, take.last_frame, take.n_frames),
        (1, 90, 90)
    );
    let live = recorded(&server, &take.name).await;
    assert_eq!(live.frames, performance.frames(1..=90));
    let numbers: Vec<u64> = live.samples.iter().map(|it| it.frame).collect();
    assert_eq!(numbers, (1..=90).collect::<Vec<_>>());
    let Event::Header(header) = &live.events[0] else {
        panic!("{:?}", live.events[0]);
    };
    assert_eq!((header.pre_roll_from, header.next_frame), (1, 61));

    // Solved again, the frames of the take itself have the same bits; those before have samples all the same.
    let again = resolved(&server, &take, None).await;
    let again = recorded(&server, &again.name).await;
    assert_eq!(again.frames, live.frames);
    assert_eq!(again.samples.len(), 90);
    let bare = |it: &CurveSample| CurveSample {
        sequence: 0,
        solved_time_nanos: 0,
        ..it.clone()
    };
    for (found, expected) in again.samples.iter().zip(&live.samples).skip(60) {
        assert_eq!(bare(found), bare(expected));
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_starts_at_the_timecode_of_its_first_frame_that_has_one() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let take = start(&server, |it| it.with_images = true).await.unwrap();
    assert!(take.with_images);
    let timecode = Timecode {
        hours: 1,
        minutes: 10,
        seconds: 0,
        frames: 1,
        rate_numerator: 30_000,
        rate_denominator: 1_001,
        drop_frame: true,
        sub_frame: 0.5,
        user_bits: 3,
    };
    let mut frames = performance.frames(1..=30);
    // The second one does not occur.
    frames[1].timecode = Some(Timecode {
        minutes: 11,
        ..timecode
    });
    frames[2].timecode = Some(timecode);
    frames[3].timecode = Some(Timecode {
        frames: 2,
        ..timecode
    });
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publisher.send(frames).await;
    publisher.durable(30).await.unwrap();
    assert_eq!(
        get(&server, &take.name).await.unwrap().start_timecode,
        Some(timecode)
    );
    let take = stop(&server, &take.name).await.unwrap();
    assert_eq!(take.start_timecode, Some(timecode));
    let server = server.restart().await;
    assert_eq!(get(&server, &take.name).await.unwrap(), take);
    server.stop().await;
}

/// Answers the newest response: this capture clock is 250 ms behind the server's.
fn echo(server_send_nanos: i64) -> ClockEcho {
    const BEHIND_NANOS: i64 = 250_000_000;
    ClockEcho {
        server_send_nanos,
        client_receive_nanos: server_send_nanos - BEHIND_NANOS,
        client_send_nanos: server_send_nanos - BEHIND_NANOS,
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_publishers_clock_is_estimated_shown_and_recorded() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let take = start(&server, |_| {}).await.unwrap();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    let mut number = 0;
    let status = async || server.session(SESSION).await.status.unwrap();
    let mut newest = 0;
    while status().await.clock.is_none() {
        assert!(number < 2_000, "no estimate after {number} exchanges");
        number += 1;
        publisher
            .send_message(PublishMarkersRequest {
                frames: vec![performance.frame(number)],
                clock: (newest != 0).then(|| echo(newest)),
                ..PublishMarkersRequest::default()
            })
            .await;
        newest = publisher.next().await.unwrap().unwrap().server_send_nanos;
    }
    let clock = status().await.clock.unwrap();
    assert!(clock.uncertainty_nanos <= clock.round_trip_nanos);
    let off = clock.offset_nanos - 250_000_000;
    assert!(off.unsigned_abs() <= clock.uncertainty_nanos, "{clock:?}");

    publisher
        .publish(performance.frames(number + 1..=number + 40))
        .await;
    let take = stop(&server, &take.name).await.unwrap();
    let live = recorded(&server, &take.name).await;
    let told = live.events.iter().find_map(|it| match it {
        Event::Clock(it) => it.clock,
        _ => None,
    });
    assert_eq!(told, Some(clock));
    // Capture times stay as they were sent; the corrected ones stand beside them.
    let last = live.samples.last().unwrap();
    let sent = |it: &MarkerFrame| it.capture_time_nanos;
    assert_eq!(
        last.capture_time_nanos,
        sent(&performance.frame(last.frame))
    );
    let moved = last.capture_time_server_nanos - last.capture_time_nanos;
    assert!((moved - clock.offset_nanos).abs() < 50_000_000, "{moved}");
    assert_eq!(live.samples[0].capture_time_server_nanos, 0);
    let again = resolved(&server, &take, None).await;
    let again = recorded(&server, &again.name).await;
    let times = |it: &RecordedTake| -> Vec<i64> {
        let samples = it.samples.iter();
        samples.map(|it| it.capture_time_server_nanos).collect()
    };
    assert_eq!(times(&again), times(&live));
    server.stop().await;
}
