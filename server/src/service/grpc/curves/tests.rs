//! Renderers and recorders of every kind, on a paused clock.

use std::time::Duration;

use frontalis_proto::v1::SessionState;
use tokio::time::{Instant, sleep, sleep_until, timeout};
use tonic::Code;

use super::*;
use crate::service::grpc::stage::{Stage, asked, assert_refused, every_frame, latest, start};

const FRAME: Duration = Duration::from_micros(16_667);

#[tokio::test(start_paused = true)]
async fn the_header_names_the_controls_in_order() {
    let stage = Stage::new().await;
    let renderer = stage.renderer(latest(2)).await;
    let header = renderer.header.unwrap();
    assert_eq!(header.session, "sessions/one");
    assert_eq!(header.actor, "actors/reference");
    assert_eq!(header.muscle_set, "choe-ko-16");
    assert_eq!((header.actor_revision, header.run), (1, 1));
    let names: Vec<_> = header.controls.iter().map(|it| it.name.as_str()).collect();
    let muscles = stage.actor.muscle_set().muscles().iter();
    assert_eq!(
        names,
        muscles.map(|it| it.name.as_str()).collect::<Vec<_>>()
    );
    let bounds = |it: &v1::Control| it.driven && (it.lower..=it.upper) == (0.0..=1.0);
    assert!(header.controls.iter().all(bounds));
}

#[tokio::test(start_paused = true)]
async fn a_sample_carries_its_frame_and_markers_only_on_request() {
    let stage = Stage::new().await;
    let mut plain = stage.renderer(every_frame()).await;
    let asked = v1::SubscribeStart {
        with_markers: true,
        ..every_frame()
    };
    let mut with_markers = stage.renderer(asked).await;
    let mut publisher = stage.publisher("stage").await;
    let timecode = v1::Timecode {
        hours: 1,
        rate_numerator: 60,
        rate_denominator: 1,
        ..v1::Timecode::default()
    };
    let mut frames = stage.frames(1..=8);
    frames[6].timecode = Some(timecode);
    frames[7].timecode = Some(v1::Timecode {
        hours: 25,
        ..timecode
    });
    publisher.publish(frames).await;
    let samples = plain.samples_through(8).await;
    let sample = &samples[6];
    assert_eq!((sample.frame, sample.source_frame), (7, 1_007));
    assert_eq!(sample.timecode, Some(timecode));
    assert_eq!(sample.activations.len(), 16);
    assert!(
        (sample.activations[7] - 0.5).abs() < 0.05,
        "{:?}",
        sample.activations
    );
    assert_eq!(sample.region_errors.len(), 2);
    assert_eq!(sample.quality(), v1::Quality::Solved);
    let head = sample.head.unwrap();
    assert!((head.qw - 1.0).abs() < 1e-2);
    assert!(sample.observed_cm.is_empty() && sample.observed_markers.is_empty());
    assert_eq!(samples[7].timecode, None);
    assert_eq!(samples[7].flags, [v1::SampleFlag::TimecodeInvalid as i32]);
    let markers = &with_markers.samples_through(8).await[6];
    let n_markers = stage.actor.markers().len();
    assert_eq!(markers.observed_markers.len(), n_markers);
    assert_eq!(markers.observed_cm.len(), 3 * n_markers);
    assert_eq!(markers.reproduced_cm.len(), 3 * n_markers);
}

#[tokio::test(start_paused = true)]
async fn a_renderer_that_pauses_gets_its_credits_of_stale_samples_and_then_a_fresh_one() {
    let stage = Stage::new().await;
    let mut wall = stage.renderer(latest(3)).await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    // The wall does not read for twenty seconds of sixty frames a second.
    let mut recorded = recorder.samples_through(10).await.len();
    for number in 11..=1_210 {
        publisher.send(stage.frames([number])).await;
        publisher.response().await.unwrap();
        recorded += recorder.samples_through(number).await.len();
    }
    assert_eq!(recorded, 1_210);
    let mut n_stale = 0;
    loop {
        let response = wall.response().await.unwrap();
        wall.grant(u32::try_from(response.samples.len()).unwrap())
            .await;
        match response.samples.last() {
            Some(sample) if sample.frame == 1_210 => {
                assert_eq!(response.skipped_samples, sample.sequence - 1 - n_stale);
                break;
            }
            Some(_) => n_stale += 1,
            None => {}
        }
    }
    assert!(n_stale <= 3, "{n_stale}");
}

#[tokio::test(start_paused = true)]
async fn i11_positions_outside_what_is_kept_are_refused_with_what_is() {
    let stage = Stage::new().await;
    stage
        .publisher("stage")
        .await
        .publish(stage.frames(1..=10))
        .await;
    let mut recorder = stage.renderer(every_frame()).await;
    recorder.samples_through(10).await;
    let from = async |from_sequence, run| {
        let asked = v1::SubscribeStart {
            from_sequence,
            run,
            from_oldest: false,
            ..every_frame()
        };
        stage.subscribe(asked).await.end().await.1
    };
    let refused = from(12, 0).await;
    assert_refused(&refused, Code::OutOfRange, "SEQUENCE");
    assert!(
        refused
            .message()
            .contains("the first available is 1, the last 10")
    );
    assert_refused(&from(1, 2).await, Code::OutOfRange, "NEW_RUN");
    let asked = v1::SubscribeStart {
        from_sequence: 8,
        run: 1,
        from_oldest: false,
        ..every_frame()
    };
    let mut resumed = stage.renderer(asked).await;
    let sequences: Vec<u64> = resumed
        .samples_through(10)
        .await
        .iter()
        .map(|it| it.sequence)
        .collect();
    assert_eq!(sequences, [8, 9, 10]);
}

#[tokio::test(start_paused = true)]
async fn i12_more_than_thirty_two_credits_clamp() {
    let stage = Stage::new().await;
    let mut wall = stage.renderer(latest(u32::MAX)).await;
    for _ in 0..10 {
        wall.grant(u32::MAX).await;
    }
    let mut publisher = stage.publisher("stage").await;
    let mut n_samples = 0;
    for number in 1..=60 {
        publisher.publish(stage.frames([number])).await;
        // The session's task has its turn before the wall reads.
        sleep(FRAME).await;
        if number >= 4 {
            let response = wall.response().await.unwrap();
            n_samples += response.samples.len();
        }
    }
    assert_eq!(n_samples, 32);
}

#[tokio::test(start_paused = true)]
async fn a_stale_session_says_so_in_time_and_again_when_it_is_live() {
    let stage = Stage::new().await;
    let mut wall = stage.renderer(latest(32)).await;
    wall.hear(SessionState::Waiting).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    wall.hear(SessionState::Live).await;
    let last_frame = Instant::now();
    wall.hear(SessionState::Stale).await;
    let silence = last_frame.elapsed();
    assert!(silence >= Duration::from_millis(60), "{silence:?}");
    assert!(silence <= Duration::from_millis(101), "{silence:?}");
    publisher.publish(stage.frames(11..=11)).await;
    wall.hear(SessionState::Live).await;
    let heard: Vec<_> = wall.states.iter().map(|it| it.0).collect();
    let expected = [
        SessionState::Waiting,
        SessionState::Aligning,
        SessionState::Live,
        SessionState::Stale,
        SessionState::Live,
    ];
    assert_eq!(heard, expected);
}

#[tokio::test(start_paused = true)]
async fn follow_needs_no_requests_and_keeps_to_thirty_hertz() {
    let stage = Stage::new().await;
    stage
        .publisher("stage")
        .await
        .publish(stage.frames(1..=10))
        .await;
    let request = asked(v1::SubscribeStart {
        credits: 2,
        ..latest(0)
    });
    let mut followed = stage.curves.follow(request).await.unwrap().into_inner();
    let mut publisher = stage.publisher("stage").await;
    let header = followed.next().await.unwrap().unwrap();
    assert!(header.header.is_some());
    let mut n_samples = 0;
    for number in 11..=130 {
        publisher.send(stage.frames([number])).await;
        let soon = timeout(FRAME, followed.next());
        let (_, answer) = tokio::join!(timeout(FRAME, publisher.response()), soon);
        if let Ok(Some(response)) = answer {
            n_samples += response.unwrap().samples.len();
        }
    }
    assert!((55..=62).contains(&n_samples), "{n_samples}");
}

#[tokio::test(start_paused = true)]
async fn what_cannot_be_subscribed_is_refused_with_its_reason() {
    let stage = Stage::new().await;
    let check = async |change: fn(&mut v1::SubscribeStart), code: Code, reason: &str| {
        let mut sent = latest(2);
        change(&mut sent);
        assert_refused(&stage.subscribe(sent).await.end().await.1, code, reason);
    };
    check(
        |it| it.session = "sessions/two".to_owned(),
        Code::NotFound,
        "SESSION",
    )
    .await;
    check(|it| it.session.clear(), Code::InvalidArgument, "NAME").await;
    check(
        |it| it.control_space = 2,
        Code::Unimplemented,
        "NOT_IMPLEMENTED",
    )
    .await;
    check(
        |it| it.control_space = 3,
        Code::Unimplemented,
        "NOT_IMPLEMENTED",
    )
    .await;
    check(|it| it.control_space = 9, Code::InvalidArgument, "ENUM").await;
    let mut hasty = stage.silent_renderer();
    hasty.grant(1).await;
    assert_refused(
        &hasty.end().await.1,
        Code::FailedPrecondition,
        "PROTOCOL_ORDER",
    );
    let mut twice = stage.renderer(latest(2)).await;
    let start = v1::SubscribeRequest {
        start: Some(latest(2)),
        credits: 0,
    };
    twice.request(start).await;
    assert_refused(
        &twice.end().await.1,
        Code::FailedPrecondition,
        "PROTOCOL_ORDER",
    );
}

#[tokio::test(start_paused = true)]
async fn a_dropped_stream_leaves_no_subscriber() {
    let stage = Stage::new().await;
    let wall = stage.renderer(latest(2)).await;
    let recorder = stage.renderer(every_frame()).await;
    let named: Vec<_> = stage.session.status().subscribers;
    assert_eq!(named.len(), 2);
    assert_eq!(
        (named[0].subscriber.as_str(), named[0].protocol),
        ("127.0.0.1:9", "grpc")
    );
    drop((wall, recorder));
    assert!(stage.session.status().subscribers.is_empty());
    assert_eq!(stage.registry.n_subscribers(), 0);
}

#[tokio::test(start_paused = true)]
async fn more_subscribers_than_the_session_may_have_are_refused() {
    let limits = crate::session::SessionLimits {
        subscribers_per_session: 1,
        ..crate::session::SessionLimits::default()
    };
    let stage = Stage::with(limits, crate::service::grpc::stage::settings(), None).await;
    let first = stage.renderer(latest(2)).await;
    let refused = stage.subscribe(latest(2)).await.end().await.1;
    assert_refused(&refused, Code::ResourceExhausted, "SUBSCRIBERS");
    drop(first);
    stage.renderer(latest(2)).await;
    assert!(stage.start(start("stage")).await.response().await.is_ok());
}

#[tokio::test(start_paused = true)]
async fn f4_a_recorder_that_takes_nothing_for_thirty_seconds_is_given_up_with_what_it_lost() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut wall = stage.renderer(latest(1)).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    recorder.samples_through(10).await;
    let end = Instant::now() + MAX_PAUSE;
    publisher.publish(stage.frames(11..=20)).await;
    sleep_until(end.checked_sub(FRAME).unwrap()).await;
    assert_eq!(stage.session.status().subscribers.len(), 2);
    sleep_until(end + FRAME).await;
    // One of the newest sample may pause for any time.
    assert_eq!(stage.session.status().subscribers.len(), 1);
    publisher.publish(stage.frames(21..=25)).await;
    assert_eq!(wall.samples_through(10).await.len(), 1);

    let lagged = recorder.end().await.1;
    assert_refused(&lagged, Code::DataLoss, "SUBSCRIBER_LAGGED");
    let lost = "samples 11 to 20 (frames 11 to 20) were not taken within 30 s";
    assert_eq!(lagged.message(), lost);
    // What is still kept can still be had.
    let asked = v1::SubscribeStart {
        from_sequence: 11,
        run: 1,
        from_oldest: false,
        ..every_frame()
    };
    let mut resumed = stage.renderer(asked).await;
    assert_eq!(resumed.samples_through(25).await.len(), 15);
}

#[tokio::test(start_paused = true)]
async fn a_recorder_that_is_slow_or_has_all_there_is_is_not_given_up() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    recorder.samples_through(10).await;
    sleep(MAX_PAUSE * 4).await;
    publisher.publish(stage.frames(11..=200)).await;
    let mut n_samples = 0;
    while n_samples < 190 {
        n_samples += recorder.response().await.unwrap().samples.len();
        sleep(MAX_PAUSE.saturating_sub(FRAME)).await;
    }
    assert_eq!(n_samples, 190);
}
