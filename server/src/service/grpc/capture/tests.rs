//! Publishers of every kind, from start to end, on a paused clock.

use std::time::Duration;

use frontalis_analysis::analyzer::NeutralSource;
use frontalis_proto::v1::{GapCause, SessionState};
use tokio::time::{Instant, advance};

use super::*;
use crate::{
    service::grpc::stage::{
        NEUTRAL_FRAMES, SESSION, Seen, Stage, assert_refused, every_frame, settings, start,
    },
    session::{RestoredAlignment, SessionEvent, SessionLimits, SessionUpdate},
};

fn sample(frame: u64, sequence: u64) -> Seen {
    Seen::Sample { frame, sequence }
}

fn gap(first: u64, last: u64, cause: GapCause) -> Seen {
    Seen::Gap { first, last, cause }
}

#[tokio::test(start_paused = true)]
async fn every_frame_becomes_one_sample_in_order() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=100)).await;
    let seen = recorder.see_through(100).await;
    let expected: Vec<_> = (1..=100).map(|it| sample(it, it)).collect();
    assert_eq!(seen, expected);
    assert_eq!(publisher.accepted_through, 100);
    assert!(publisher.rejected.is_empty());
    let status = stage.session.status();
    assert_eq!(
        (
            status.frames_received,
            status.last_frame,
            status.last_sequence
        ),
        (100, 100, 100)
    );
    assert_eq!(
        status.alignment.unwrap().n_markers,
        stage.actor.markers().len()
    );
    let stages: Vec<_> = status.latencies.iter().map(|it| it.stage).collect();
    assert_eq!(stages, ["queued", "solved", "published", "total", "sent"]);
    assert_eq!(status.ranges.len(), stage.actor.muscle_set().len());
    assert!(status.ranges[3].max > 0.4, "{:?}", status.ranges[3]);
}

#[tokio::test(start_paused = true)]
async fn latencies_leave_out_the_frames_that_waited_for_the_alignment() {
    let stage = Stage::new().await;
    let mut publisher = stage.publisher("stage").await;
    for number in 1..=NEUTRAL_FRAMES + 2 {
        publisher.publish(stage.frames([number])).await;
        advance(Duration::from_secs(1)).await;
    }
    let status = stage.session.status();
    assert_eq!(status.last_sequence, NEUTRAL_FRAMES + 2);
    for stage in status.latencies {
        assert!(stage.latency.max_micros < 1e6, "{stage:?}");
    }
}

#[tokio::test(start_paused = true)]
async fn started_says_where_to_go_on() {
    let stage = Stage::new().await;
    let mut first = stage.publisher("stage").await;
    let started = first.started.unwrap();
    assert_eq!(
        (started.epoch, started.next_expected, started.run),
        (1, 0, 1)
    );
    first.publish(stage.frames(7..=20)).await;
    let again = stage.publisher("stage").await;
    let started = again.started.unwrap();
    assert_eq!(
        (
            started.epoch,
            started.next_expected,
            started.durable_through
        ),
        (2, 21, 0)
    );
}

#[tokio::test(start_paused = true)]
async fn a_response_comes_within_fifty_milliseconds_or_thirty_two_frames() {
    let stage = Stage::new().await;
    let mut publisher = stage.publisher("stage").await;
    let sent = Instant::now();
    publisher.send(stage.frames(1..=1)).await;
    assert_eq!(publisher.response().await.unwrap().accepted_through, 1);
    assert!(sent.elapsed() <= Duration::from_millis(50));
    let sent = Instant::now();
    publisher.send(stage.frames(2..=65)).await;
    for through in [33, 65] {
        assert_eq!(
            publisher.response().await.unwrap().accepted_through,
            through
        );
    }
    assert!(sent.elapsed() < Duration::from_millis(1));
    publisher.keep_alive().await;
}

#[tokio::test(start_paused = true)]
async fn a20_a_frame_sent_again_is_acknowledged_and_other_content_is_a_conflict() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    let other = v1::MarkerFrame {
        source_frame: 7,
        ..stage.frame(4)
    };
    publisher
        .send(vec![stage.frame(3), stage.frame(10), other])
        .await;
    publisher.response().await.unwrap();
    publisher.publish(stage.frames(11..=11)).await;
    assert_eq!(publisher.rejected, [(4, "FRAME_CONFLICT".to_owned())]);
    let seen = recorder.see_through(11).await;
    assert_eq!(seen, (1..=11).map(|it| sample(it, it)).collect::<Vec<_>>());
    assert_eq!(stage.session.status().frames_duplicate, 2);
}

#[tokio::test(start_paused = true)]
async fn a21_a_passed_number_is_late_and_never_ends_the_stream() {
    let stage = Stage::new().await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames([1, 2, 3, 5, 8])).await;
    for _ in 0..40 {
        publisher.send(stage.frames([4, 6, 7])).await;
    }
    publisher.publish(stage.frames([9])).await;
    assert_eq!(publisher.rejected.len(), 120);
    assert!(publisher.rejected.iter().all(|it| it.1 == "LATE"));
    assert_eq!(stage.session.status().frames_late, 120);
}

#[tokio::test(start_paused = true)]
async fn a21_number_zero_is_no_late_frame_and_leaves_no_gap() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames([0, 1, 2, 3, 4])).await;
    assert_eq!(publisher.rejected, [(0, "FRAME_NUMBER".to_owned())]);
    let status = stage.session.status();
    assert_eq!((status.frames_rejected, status.frames_late), (1, 0));
    let expected: Vec<_> = (1..=4).map(|it| sample(it, it)).collect();
    assert_eq!(recorder.see_through(4).await, expected);
}

#[tokio::test(start_paused = true)]
async fn a22_a_jump_is_one_gap_and_a_huge_one_is_rejected() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=5)).await;
    let far = |number| v1::MarkerFrame {
        number,
        ..stage.frame(6)
    };
    publisher.send(vec![far(u64::MAX)]).await;
    publisher.publish(vec![far(1_000_000_005)]).await;
    assert_eq!(publisher.rejected, [(u64::MAX, "FRAME_JUMP".to_owned())]);
    let seen = recorder.see_through(1_000_000_005).await;
    let last = [
        gap(6, 1_000_000_004, GapCause::CaptureSkip),
        sample(1_000_000_005, 6),
    ];
    assert_eq!(seen[5..], last);
    assert_eq!(stage.session.status().frames_missing, 999_999_999);
}

#[tokio::test(start_paused = true)]
async fn a23_times_that_do_not_grow_are_flagged_and_solved() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    let times = [0, 0, -1, i64::MIN, i64::MAX, 5];
    let frames = (1..)
        .zip(times)
        .map(|(number, capture_time_nanos)| v1::MarkerFrame {
            capture_time_nanos,
            ..stage.frame(number)
        });
    publisher.publish(frames.collect()).await;
    let samples = recorder.samples_through(6).await;
    let flagged: Vec<bool> = samples.iter().map(|it| !it.flags.is_empty()).collect();
    assert_eq!(flagged, [false, true, true, true, false, true]);
    let seen_times: Vec<i64> = samples.iter().map(|it| it.capture_time_nanos).collect();
    assert_eq!(seen_times, times);
}

#[tokio::test(start_paused = true)]
async fn a4_a_frame_without_markers_is_held_and_the_session_stays_live() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    let empty = v1::MarkerFrame {
        positions: Vec::new(),
        ..stage.frame(11)
    };
    let mut blind = stage.frame(12);
    blind.positions.fill(f32::NAN);
    publisher.publish(vec![empty, blind]).await;
    let samples = recorder.samples_through(12).await;
    for sample in &samples[10..] {
        assert_eq!(sample.quality(), v1::Quality::Held);
        assert_eq!(sample.activations, samples[9].activations);
    }
    assert_eq!(samples[11].held_frames, 2);
    assert_eq!(stage.session.hub().state(), crate::hub::SessionState::Live);
}

#[tokio::test(start_paused = true)]
async fn rejected_frames_leave_a_gap_and_a_hundred_in_a_row_end_the_stream() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=5)).await;
    let broken = |number| {
        let mut frame = stage.frame(number);
        frame.positions[4] = f32::INFINITY;
        frame
    };
    publisher.send((6..=8).map(broken).collect()).await;
    publisher.publish(stage.frames(9..=9)).await;
    let seen = recorder.see_through(9).await;
    assert_eq!(seen[5..], [gap(6, 8, GapCause::Rejected), sample(9, 6)]);
    publisher.send((10..=109).map(broken).collect()).await;
    let status = publisher.end().await;
    assert_refused(&status, Code::InvalidArgument, "TOO_MANY_REJECTS");
    assert_eq!(publisher.rejected.len(), 103);
    assert!(publisher.rejected.iter().all(|it| it.1 == "NON_FINITE"));
    // The session is free at once.
    stage.publisher("other").await;
}

#[tokio::test(start_paused = true)]
async fn e8_start_comes_first_and_once() {
    let stage = Stage::new().await;
    let mut hasty = stage.silent_publisher();
    hasty.send(stage.frames(1..=1)).await;
    assert_refused(
        &hasty.end().await,
        Code::FailedPrecondition,
        "PROTOCOL_ORDER",
    );
    let mut empty = stage.silent_publisher();
    empty.half_close();
    assert_refused(
        &empty.end().await,
        Code::FailedPrecondition,
        "PROTOCOL_ORDER",
    );
    let mut twice = stage.publisher("stage").await;
    let request = v1::PublishMarkersRequest {
        start: Some(start("stage")),
        ..v1::PublishMarkersRequest::default()
    };
    twice.request(request).await;
    assert_refused(
        &twice.end().await,
        Code::FailedPrecondition,
        "PROTOCOL_ORDER",
    );
    let mut silent = stage.silent_publisher();
    assert_refused(&silent.end().await, Code::DeadlineExceeded, "START_TIMEOUT");
}

#[tokio::test(start_paused = true)]
async fn a_start_that_cannot_be_used_is_refused_with_its_reason() {
    let stage = Stage::new().await;
    let check = async |change: fn(&mut v1::PublishStart), code: Code, reason: &str| {
        let mut sent = start("stage");
        change(&mut sent);
        assert_refused(&stage.start(sent).await.end().await, code, reason);
    };
    check(
        |it| it.session = "one".to_owned(),
        Code::InvalidArgument,
        "NAME",
    )
    .await;
    check(
        |it| it.session = "sessions/two".to_owned(),
        Code::NotFound,
        "SESSION",
    )
    .await;
    check(|it| it.unit = 0, Code::InvalidArgument, "UNIT").await;
    check(|it| it.rate_hz = -1.0, Code::InvalidArgument, "RATE").await;
    let twice = |it: &mut v1::PublishStart| it.marker_names = vec!["a".into(), "a".into()];
    check(twice, Code::InvalidArgument, "DUPLICATE_MARKER").await;
    let unknown = |it: &mut v1::PublishStart| it.marker_names = vec!["nose_left".into()];
    check(unknown, Code::FailedPrecondition, "UNKNOWN_MARKERS").await;
    let image = |it: &mut v1::PublishStart| it.image = Some(v1::ImageFormat::default());
    check(image, Code::Unimplemented, "NOT_IMPLEMENTED").await;
    let mut crowded = stage.publisher("stage").await;
    crowded.send(stage.frames(1..=257)).await;
    assert_refused(&crowded.end().await, Code::InvalidArgument, "FRAME_COUNT");
}

#[tokio::test(start_paused = true)]
async fn a7_unknown_markers_are_listed_and_another_order_gives_the_same_curves() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut names: Vec<String> = stage
        .actor
        .markers()
        .iter()
        .map(|it| it.name.clone())
        .collect();
    names.reverse();
    names.insert(1, "watch".to_owned());
    let mut publisher = stage
        .start(v1::PublishStart {
            marker_names: names,
            ..start("stage")
        })
        .await;
    let reversed = |number| {
        let mut frame = stage.frame(number);
        let mut markers: Vec<[f32; 3]> = frame.positions.as_chunks().0.to_vec();
        markers.reverse();
        markers.insert(1, [1.0, 2.0, 3.0]);
        frame.positions = markers.concat();
        frame
    };
    publisher.publish((1..=20).map(reversed).collect()).await;
    let samples = recorder.samples_through(20).await;
    assert_eq!(stage.session.status().unknown_markers, ["watch"]);

    let straight = Stage::new().await;
    let mut other = straight.renderer(every_frame()).await;
    straight
        .publisher("stage")
        .await
        .publish(straight.frames(1..=20))
        .await;
    let expected = other.samples_through(20).await;
    for (found, expected) in samples.iter().zip(&expected) {
        assert_eq!(found.activations, expected.activations);
    }
}

#[tokio::test(start_paused = true)]
async fn i9_an_owned_session_is_refused_and_a_takeover_fences_the_owner() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut owner = stage.publisher("a").await;
    owner.publish(stage.frames(1..=6)).await;
    let refused = stage.start(start("b")).await.end().await;
    assert_refused(&refused, Code::FailedPrecondition, "SESSION_OWNED");
    let takeover = v1::PublishStart {
        takeover: true,
        ..start("b")
    };
    let mut other = stage.start(takeover).await;
    assert_eq!(
        other
            .response()
            .await
            .unwrap()
            .started
            .unwrap()
            .next_expected,
        7
    );
    owner.send(stage.frames(7..=8)).await;
    assert_refused(&owner.end().await, Code::Aborted, "PUBLISHER_FENCED");
    other.publish(stage.frames(10..=11)).await;
    let seen = recorder.see_through(11).await;
    let change = gap(7, 9, GapCause::PublisherChange);
    assert_eq!(seen[6..], [change, sample(10, 7), sample(11, 8)]);
}

#[tokio::test(start_paused = true)]
async fn the_same_publisher_replaces_its_older_stream_at_once() {
    let stage = Stage::new().await;
    let mut older = stage.publisher("a").await;
    let mut newer = stage.publisher("a").await;
    assert_refused(&older.end().await, Code::Aborted, "PUBLISHER_FENCED");
    newer.publish(stage.frames(1..=3)).await;
}

#[tokio::test(start_paused = true)]
async fn a_lease_lives_ten_seconds_past_the_last_sign_of_life() {
    let stage = Stage::new().await;
    let mut owner = stage.publisher("a").await;
    advance(Duration::from_secs(9)).await;
    owner.keep_alive().await;
    advance(Duration::from_millis(9_900)).await;
    let refused = stage.start(start("b")).await.end().await;
    assert_refused(&refused, Code::FailedPrecondition, "SESSION_OWNED");
    advance(Duration::from_millis(100)).await;
    let mut next = stage.publisher("b").await;
    assert_refused(&owner.end().await, Code::Aborted, "PUBLISHER_FENCED");
    drop(next);
    // A connection that is lost keeps the lease; only closing the request side gives it back.
    let refused = stage.start(start("a")).await.end().await;
    assert_refused(&refused, Code::FailedPrecondition, "SESSION_OWNED");
    next = stage.publisher("b").await;
    next.half_close();
    assert_eq!(next.end().await.code(), Code::Ok);
    stage.publisher("a").await;
}

#[tokio::test(start_paused = true)]
async fn closing_the_request_side_answers_the_last_watermark() {
    let stage = Stage::new().await;
    let mut publisher = stage.publisher("stage").await;
    publisher.send(stage.frames(1..=10)).await;
    publisher.half_close();
    assert_eq!(publisher.end().await.code(), Code::Ok);
    assert_eq!(publisher.accepted_through, 10);
    assert_eq!(stage.session.hub().newest_sequence(), 10);
}

#[tokio::test(start_paused = true)]
async fn a17_a_wrong_unit_ends_the_stream_and_the_session_waits() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    let in_centimeters = (1..=10).map(|it| stage.frame_in(it, 1.0)).collect();
    publisher.send(in_centimeters).await;
    publisher.half_close();
    let status = publisher.end().await;
    assert_refused(&status, Code::FailedPrecondition, "UNITS_SUSPECT");
    let seen = recorder.see_through(10).await;
    let causes: Vec<_> = seen
        .iter()
        .map(|it| {
            matches!(
                it,
                Seen::Gap {
                    cause: GapCause::NotAligned,
                    ..
                }
            )
        })
        .collect();
    assert!(causes.iter().all(|it| *it), "{seen:?}");
    let status = stage.session.status();
    assert_eq!(status.alignment_problem, Some("UNITS_SUSPECT"));
    assert_eq!(status.state, crate::hub::SessionState::Waiting);
    let mut better = stage.publisher("stage").await;
    better.publish(stage.frames(11..=20)).await;
    let seen = recorder.see_through(20).await;
    assert_eq!(
        seen,
        (11..=20).map(|it| sample(it, it - 10)).collect::<Vec<_>>()
    );
    assert_eq!(stage.session.status().alignment_problem, None);
}

#[tokio::test(start_paused = true)]
async fn frames_before_a_requested_alignment_are_gaps() {
    let mut on_request = settings();
    on_request.marker.align_on_request = true;
    let mut stage = Stage::with(SessionLimits::default(), on_request, None).await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=3)).await;
    let seen = recorder.see_through(3).await;
    assert!(seen.iter().all(|it| matches!(
        it,
        Seen::Gap {
            cause: GapCause::NotAligned,
            ..
        }
    )));
    stage
        .session
        .recenter(NeutralSource::NextFrames)
        .await
        .unwrap();
    let neutral = (4..=9).map(|number| v1::MarkerFrame {
        number,
        ..stage.frame(1)
    });
    publisher.publish(neutral.collect()).await;
    let seen = recorder.see_through(9).await;
    assert_eq!(
        seen,
        (4..=9).map(|it| sample(it, it - 3)).collect::<Vec<_>>()
    );
    assert!(matches!(
        stage.events.recv().await,
        Some(SessionEvent::Aligned { .. })
    ));
}

#[tokio::test(start_paused = true)]
async fn resuming_keeps_the_alignment_unless_the_stream_has_another_shape() {
    let mut stage = Stage::new().await;
    let mut first = stage.publisher("stage").await;
    first.publish(stage.frames(1..=10)).await;
    let Some(SessionEvent::Aligned {
        alignment, shape, ..
    }) = stage.events.recv().await
    else {
        panic!("aligned");
    };
    let mut again = stage.publisher("stage").await;
    again.publish(stage.frames(11..=20)).await;
    let restored = RestoredAlignment {
        alignment: *alignment,
        shape,
    };
    let mut after_restart = Stage::with(SessionLimits::default(), settings(), Some(restored)).await;
    let mut recorder = after_restart.renderer(every_frame()).await;
    let mut back = after_restart.publisher("stage").await;
    back.publish(after_restart.frames(21..=21)).await;
    assert_eq!(recorder.see_through(21).await, [sample(21, 1)]);
    assert!(after_restart.events.try_recv().is_err());

    let other_unit = v1::PublishStart {
        unit: v1::LengthUnit::Centimeter.into(),
        ..start("stage")
    };
    let mut other = after_restart.start(other_unit).await;
    let frames = (22..=30).map(|number| v1::MarkerFrame {
        number,
        ..after_restart.frame_in(1, 1.0)
    });
    other.publish(frames.collect()).await;
    recorder.see_through(30).await;
    let forgotten = after_restart.events.recv().await;
    assert!(matches!(
        forgotten,
        Some(SessionEvent::AlignmentForgotten { .. })
    ));
    assert!(matches!(
        after_restart.events.recv().await,
        Some(SessionEvent::Aligned { .. })
    ));
}

#[tokio::test(start_paused = true)]
async fn a_live_session_recenters_while_its_curves_go_on() {
    let mut stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    recorder.see_through(10).await;
    let n_states = recorder.states.len();
    stage
        .session
        .recenter(NeutralSource::NextFrames)
        .await
        .unwrap();
    let status = stage.session.status();
    assert_eq!(status.state, crate::hub::SessionState::Live);
    assert!(status.alignment.is_some());
    let neutral = (11..=16).map(|number| v1::MarkerFrame {
        number,
        ..stage.frame(1)
    });
    publisher.publish(neutral.collect()).await;
    let seen = recorder.see_through(16).await;
    assert_eq!(seen, (11..=16).map(|it| sample(it, it)).collect::<Vec<_>>());
    assert!(
        recorder.states[n_states..]
            .iter()
            .all(|it| it.0 == SessionState::Live)
    );
    let names: Vec<_> = std::iter::from_fn(|| stage.events.try_recv().ok()).collect();
    assert!(matches!(
        names[..],
        [SessionEvent::Aligned { .. }, SessionEvent::Aligned { .. }]
    ));
}

#[tokio::test(start_paused = true)]
async fn a_neutral_face_that_cannot_replace_the_old_one_is_said_and_the_stream_goes_on() {
    let mut stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    stage
        .session
        .recenter(NeutralSource::NextFrames)
        .await
        .unwrap();
    // A face of ten times its size is none in the declared unit.
    let too_large = (11..=14).map(|number| v1::MarkerFrame {
        number,
        ..stage.frame_in(1, 100.0)
    });
    publisher.publish(too_large.collect()).await;
    recorder.see_through(14).await;
    let status = stage.session.status();
    assert_eq!(status.alignment_problem, Some("UNITS_SUSPECT"));
    assert_eq!(status.state, crate::hub::SessionState::Live);
    assert!(status.alignment.is_some());
    publisher.publish(stage.frames(15..=20)).await;
    let seen = recorder.see_through(20).await;
    // Frames at another scale give no samples, but a new neutral face is looked for in them.
    let samples = (15..=20).map(|it| sample(it, it - 4));
    assert_eq!(seen, samples.collect::<Vec<_>>());
    let rejected = (11..=13).map(|it| (it, "SCALE_JUMP".to_owned()));
    assert_eq!(publisher.rejected, rejected.collect::<Vec<_>>());

    // Another request is another attempt.
    stage
        .session
        .recenter(NeutralSource::NextFrames)
        .await
        .unwrap();
    assert_eq!(stage.session.status().alignment_problem, None);
    assert!(matches!(
        stage.events.recv().await,
        Some(SessionEvent::Aligned { .. })
    ));
    assert!(stage.events.try_recv().is_err());
}

#[tokio::test(start_paused = true)]
async fn a_request_after_a_restart_waits_for_frames_while_the_old_alignment_holds_on() {
    let mut stage = Stage::new().await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    let Some(SessionEvent::Aligned {
        alignment, shape, ..
    }) = stage.events.recv().await
    else {
        panic!("aligned");
    };
    let restored = RestoredAlignment {
        alignment: *alignment,
        shape,
    };
    let mut again = Stage::with(SessionLimits::default(), settings(), Some(restored)).await;
    again
        .session
        .recenter(NeutralSource::NextFrames)
        .await
        .unwrap();
    let mut recorder = again.renderer(every_frame()).await;
    let mut publisher = again.publisher("stage").await;
    let neutral = (11..=16).map(|number| v1::MarkerFrame {
        number,
        ..again.frame(1)
    });
    publisher.publish(neutral.collect()).await;
    let seen = recorder.see_through(16).await;
    assert_eq!(
        seen,
        (11..=16).map(|it| sample(it, it - 10)).collect::<Vec<_>>()
    );
    assert!(matches!(
        again.events.recv().await,
        Some(SessionEvent::Aligned { .. })
    ));
}

#[tokio::test(start_paused = true)]
async fn the_quietest_frames_are_refused_before_there_are_any() {
    let stage = Stage::new().await;
    let id = stage.session.id().clone();
    let recenter = async || {
        let quietest = NeutralSource::QuietestFrames;
        stage.sessions.recenter(&id, quietest).await.unwrap_err()
    };
    assert_refused(&recenter().await, Code::FailedPrecondition, "NOT_ALIGNED");
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..NEUTRAL_FRAMES)).await;
    assert_refused(&recenter().await, Code::FailedPrecondition, "NOT_ALIGNED");
}

#[tokio::test(start_paused = true)]
async fn d15_another_revision_takes_over_between_two_frames() {
    let mut stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=10)).await;
    let update = SessionUpdate {
        settings: None,
        actor: Some((std::sync::Arc::clone(&stage.actor), 2)),
    };
    stage.session.update(update).await.unwrap();
    publisher.publish(stage.frames(11..=20)).await;
    for sample in recorder.samples_through(20).await {
        let expected = if sample.frame <= 10 { 1 } else { 2 };
        assert_eq!(sample.actor_revision, expected);
    }
    assert!(matches!(
        stage.events.recv().await,
        Some(SessionEvent::Aligned {
            actor_revision: 1,
            ..
        })
    ));
    assert!(matches!(
        stage.events.recv().await,
        Some(SessionEvent::Aligned {
            actor_revision: 2,
            ..
        })
    ));
}

#[tokio::test(start_paused = true)]
async fn live_ingest_sheds_the_oldest_and_says_so() {
    let limits = SessionLimits {
        waiting_frames: 8,
        ..SessionLimits::default()
    };
    let stage = Stage::with(limits, settings(), None).await;
    let mut recorder = stage.renderer(every_frame()).await;
    let live = v1::PublishStart {
        ingest: v1::Ingest::Live.into(),
        ..start("stage")
    };
    let mut publisher = stage.start(live).await;
    publisher.publish(stage.frames(1..=8)).await;
    recorder.see_through(8).await;
    // One message is offered in one go, so the session's task has no turn in between.
    publisher.publish(stage.frames(9..=40)).await;
    let seen = recorder.see_through(40).await;
    assert_eq!(seen[0], gap(9, 32, GapCause::Shed));
    assert_eq!(
        seen[1..],
        (33..=40).map(|it| sample(it, it - 24)).collect::<Vec<_>>()
    );
    assert_eq!(publisher.shed_frames, 24);
    assert_eq!(stage.session.status().frames_shed, 24);
}

#[tokio::test(start_paused = true)]
async fn lossless_ingest_waits_and_sheds_nothing() {
    let limits = SessionLimits {
        waiting_frames: 8,
        ..SessionLimits::default()
    };
    let stage = Stage::with(limits, settings(), None).await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=600)).await;
    let seen = recorder.see_through(600).await;
    assert_eq!(seen, (1..=600).map(|it| sample(it, it)).collect::<Vec<_>>());
    assert_eq!(publisher.shed_frames, 0);
}

#[tokio::test(start_paused = true)]
async fn a26_excess_frames_of_live_ingest_are_slowed_and_then_refused() {
    let stage = Stage::new().await;
    let live = v1::PublishStart {
        ingest: v1::Ingest::Live.into(),
        ..start("stage")
    };
    let mut publisher = stage.start(live).await;
    for first in (1..=2_000).step_by(200) {
        publisher.send(stage.frames(first..first + 200)).await;
    }
    let began = Instant::now();
    while publisher.rejected.last().is_none_or(|it| it.0 < 1_990) {
        publisher.response().await.unwrap();
    }
    assert!(began.elapsed() >= Duration::from_millis(900));
    assert!(publisher.rejected.iter().all(|it| it.1 == "RATE_LIMIT"));
    assert!(
        (480..=520).contains(&publisher.accepted_through),
        "{}",
        publisher.accepted_through
    );
}

#[tokio::test(start_paused = true)]
async fn ending_finishes_the_queue_and_closes_both_sides() {
    let mut stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..NEUTRAL_FRAMES)).await;
    let mut broken = stage.frame(NEUTRAL_FRAMES);
    broken.positions.pop();
    publisher.send(vec![broken]).await;
    publisher.response().await.unwrap();
    stage.session.end().await;
    stage.session.end().await;
    assert_refused(
        &publisher.end().await,
        Code::FailedPrecondition,
        "SESSION_ENDED",
    );
    let mut seen = Vec::new();
    let end = loop {
        let response = recorder.response().await.unwrap();
        seen.extend(crate::service::grpc::stage::in_order(&response));
        if let Some(end) = response.end {
            break end;
        }
    };
    let unused = [
        gap(1, NEUTRAL_FRAMES - 1, GapCause::NotAligned),
        gap(NEUTRAL_FRAMES, NEUTRAL_FRAMES, GapCause::Rejected),
    ];
    assert_eq!(seen, unused);
    assert_eq!(end.last_frame, NEUTRAL_FRAMES - 1);
    assert_eq!(recorder.end().await.1.code(), Code::Ok);
    assert!(recorder.states.iter().any(|it| it.0 == SessionState::Ended));
    let refused = stage.start(start("stage")).await.end().await;
    assert_refused(&refused, Code::FailedPrecondition, "SESSION_ENDED");
    let next = NeutralSource::NextFrames;
    assert!(stage.session.recenter(next).await.is_err());
    assert!(matches!(
        stage.events.recv().await,
        Some(SessionEvent::Ended { .. })
    ));
    assert!(stage.registry.get(stage.session.id()).is_ok());
    stage.registry.remove(stage.session.id());
    assert!(stage.registry.get(stage.session.id()).is_err());
    assert_eq!(stage.session.id().resource(), SESSION);
}

#[tokio::test(start_paused = true)]
async fn draining_finishes_the_queue_and_never_says_end() {
    let stage = Stage::new().await;
    let mut recorder = stage.renderer(every_frame()).await;
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=50)).await;
    stage.registry.drain().await;
    assert_refused(&publisher.end().await, Code::Unavailable, "DRAINING");
    assert_eq!(recorder.samples_through(50).await.len(), 50);
    let (last, status) = recorder.end().await;
    assert!(last.is_none_or(|it| it.end.is_none()));
    assert_refused(&status, Code::Unavailable, "DRAINING");
}
