//! Rows A1 to A11 and A20 to A24: marker frames that are odd, wrong, or wrongly numbered.

use frontalis_proto::v1::{
    CurveSample, GapCause, MarkerFrame, Quality, SampleFlag, SessionState, StartTakeRequest,
    StopTakeRequest, Take,
};
use harness::{Publisher, Subscriber, TestServer, assert_refused, every_frame};
use tonic::Code;

use super::{GOOD_FRAMES, SUBJECT, Stage, beside_a_control_session};

const NEXT: u64 = GOOD_FRAMES + 1;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a1_a_marker_that_is_nan_is_occluded() {
    beside_a_control_session("A1", async |stage| {
        let mut frame = stage.performance.frame(NEXT);
        frame.positions[36..39].fill(f32::NAN);
        let (good, sample) = samples_around(stage, frame).await;
        assert_eq!(n_markers(&sample), n_markers(&good) - 1);
        assert_finite(&sample);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a2_a_marker_that_is_partly_nan_is_occluded() {
    beside_a_control_session("A2", async |stage| {
        let mut frame = stage.performance.frame(NEXT);
        frame.positions[36] = f32::NAN;
        frame.positions[61..63].fill(f32::NAN);
        let (good, sample) = samples_around(stage, frame).await;
        assert_eq!(n_markers(&sample), n_markers(&good) - 2);
        assert_finite(&sample);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a3_an_infinite_coordinate_rejects_its_frame() {
    beside_a_control_session("A3", async |stage| {
        let mut publisher = stage.publisher().await;
        let mut frames = stage.performance.frames(NEXT..=NEXT + 2);
        frames[0].positions[37] = f32::INFINITY;
        frames[1].positions[0] = f32::NEG_INFINITY;
        publisher.send(frames).await;
        let rejected = publisher.rejected(2).await.unwrap().to_vec();
        assert!(
            rejected.iter().all(|it| it.reason == "NON_FINITE"),
            "{rejected:?}"
        );
        let name = &stage.performance.marker_names()[12];
        assert!(rejected[0].detail.contains(name) && rejected[0].detail.contains('y'));
        let mut subscriber = stage.subscriber().await;
        let gap = subscriber.gap().await.unwrap();
        assert_eq!(
            (gap.first, gap.last, gap.cause()),
            (NEXT, NEXT + 1, GapCause::Rejected)
        );
        let sample = subscriber.sample().await.unwrap();
        assert_eq!((sample.frame, sample.sequence), (NEXT + 2, NEXT));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a4_a_frame_without_a_visible_marker_is_held() {
    beside_a_control_session("A4", async |stage| {
        let mut frame = stage.performance.frame(NEXT);
        frame.positions.fill(f32::NAN);
        assert_held(stage, frame).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a5_a_frame_without_markers_is_held() {
    beside_a_control_session("A5", async |stage| {
        let mut frame = stage.performance.frame(NEXT);
        frame.positions.clear();
        assert_held(stage, frame).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a6_a_wrong_number_of_coordinates_rejects_its_frame() {
    beside_a_control_session("A6", async |stage| {
        let mut publisher = stage.publisher().await;
        let right = 3 * stage.performance.n_markers();
        let mut frames = stage.performance.frames(NEXT..=NEXT + 2);
        frames[0].positions.truncate(right - 3);
        frames[1].positions.push(0.0);
        frames[2].positions.extend([0.0; 3]);
        let found: Vec<_> = frames.iter().map(|it| it.positions.len()).collect();
        publisher.send(frames).await;
        for (rejected, found) in publisher.rejected(3).await.unwrap().iter().zip(found) {
            assert_eq!(rejected.reason, "MARKER_COUNT");
            for count in [found, right] {
                let named = rejected.detail.contains(&count.to_string());
                assert!(named, "{count} is not in: {}", rejected.detail);
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a7_unknown_marker_names_are_listed_and_not_solved() {
    beside_a_control_session("A7", async |stage| {
        let mut start = stage.performance.start(SUBJECT, "camera-1");
        start.marker_names = stage.performance.marker_names().to_vec();
        start.marker_names.insert(0, "prop_left".to_owned());
        let mut publisher = Publisher::open(&stage.server, start).await.unwrap();
        let with_prop = |mut frame: MarkerFrame| {
            frame.positions.splice(0..0, [1.0, 2.0, 3.0]);
            frame
        };
        let frames = stage.performance.frames(1..=GOOD_FRAMES);
        publisher
            .send(frames.into_iter().map(with_prop).collect())
            .await;
        publisher.accepted(GOOD_FRAMES).await.unwrap();
        stage.subscriber().await;
        let status = stage.server.session(SUBJECT).await.status.unwrap();
        assert_eq!(status.unknown_markers, ["prop_left"]);
        publisher.finish().await.unwrap();

        let mut start = stage.performance.start(SUBJECT, "camera-1");
        start.marker_names = vec!["prop_left".to_owned(), "prop_right".to_owned()];
        let refused = Publisher::open(&stage.server, start).await.err().unwrap();
        assert_refused(&refused, Code::FailedPrecondition, "UNKNOWN_MARKERS");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a8_a_marker_named_twice_is_refused() {
    beside_a_control_session("A8", async |stage| {
        let mut start = stage.performance.start(SUBJECT, "camera-1");
        start.marker_names = stage.performance.marker_names().to_vec();
        start.marker_names[5] = start.marker_names[4].clone();
        let refused = Publisher::open(&stage.server, start).await.err().unwrap();
        assert_refused(&refused, Code::InvalidArgument, "DUPLICATE_MARKER");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a10_eighty_thousand_markers_reject_their_frame() {
    beside_a_control_session("A10", async |stage| {
        let mut publisher = stage.publisher().await;
        let mut frames = stage.performance.frames(NEXT..=NEXT + 1);
        frames[0].positions = vec![1.0; 3 * 80_000];
        for frame in frames {
            publisher.send(vec![frame]).await;
        }
        publisher.accepted(NEXT + 1).await.unwrap();
        assert_eq!(publisher.report().rejections(), [(NEXT, "MARKER_COUNT")]);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a11_coordinates_out_of_the_volume_reject_their_frame() {
    beside_a_control_session("A11", async |stage| {
        let mut publisher = stage.publisher().await;
        let mut frames = stage.performance.frames(NEXT..=NEXT + 2);
        frames[0].positions[3] = 1e30;
        frames[1].positions[3] = 10_001.0;
        frames[2].positions[36..39].copy_from_slice(&[f32::MIN_POSITIVE / 4.0, -0.0, 1_200.0]);
        publisher.send(frames).await;
        publisher.accepted(NEXT + 2).await.unwrap();
        let out = "OUT_OF_VOLUME";
        assert_eq!(
            publisher.report().rejections(),
            [(NEXT, out), (NEXT + 1, out)]
        );
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a20_a_repeated_frame_has_no_second_effect() {
    beside_a_control_session("A20", async |stage| {
        let mut publisher = stage.publisher().await;
        publisher
            .send(stage.performance.frames(NEXT - 5..=NEXT))
            .await;
        publisher.accepted(NEXT).await.unwrap();
        assert_eq!(publisher.report().rejections(), []);
        let mut other = stage.performance.frame(NEXT);
        other.positions[0] += 1.0;
        publisher
            .send(vec![other, stage.performance.frame(NEXT + 1)])
            .await;
        publisher.accepted(NEXT + 1).await.unwrap();
        assert_eq!(publisher.report().rejections(), [(NEXT, "FRAME_CONFLICT")]);
        let samples = stage
            .subscriber()
            .await
            .samples_through(NEXT + 1)
            .await
            .unwrap();
        let frames: Vec<_> = samples.iter().map(|it| (it.frame, it.sequence)).collect();
        assert_eq!(frames, [(NEXT, NEXT), (NEXT + 1, NEXT + 1)]);
    })
    .await;
}

/// More frames than are remembered beside the take.
const MANY_FRAMES: u64 = 70_000;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a20_a_whole_take_sent_again_has_no_second_effect() {
    beside_a_control_session("A20, a whole take", async |stage| {
        let take = start_take(&stage.server, SUBJECT).await;
        let mut publisher = stage.publisher().await;
        // Without markers, so that the test is short.
        let empty = |number| MarkerFrame {
            number,
            ..MarkerFrame::default()
        };
        let mut frames = stage.performance.frames(1..=GOOD_FRAMES);
        frames.extend((NEXT..=MANY_FRAMES).map(empty));
        let n_good = usize::try_from(GOOD_FRAMES).unwrap();
        send_all(&mut publisher, &frames[n_good..]).await;
        publisher.durable(MANY_FRAMES).await.unwrap();

        // The first of them are long forgotten, and then the last are not.
        send_all(&mut publisher, &frames[..2_000]).await;
        send_all(&mut publisher, &frames[65_000..]).await;
        let mut other = stage.performance.frame(7);
        other.positions[0] += 1.0;
        let next = empty(MANY_FRAMES + 1);
        publisher.send(vec![other, frames[8].clone(), next]).await;
        publisher.durable(MANY_FRAMES + 1).await.unwrap();
        assert_eq!(publisher.report().rejections(), [(7, "FRAME_CONFLICT")]);
        let after = stage.server.session(SUBJECT).await.status.unwrap();
        assert_eq!(after.frames_received, MANY_FRAMES + 1);
        assert_eq!(after.frames_rejected, 1);
        let stopped = stop_take(&stage.server, &take.name).await;
        assert_eq!(stopped.n_frames, MANY_FRAMES + 1);
    })
    .await;
}

async fn send_all(publisher: &mut Publisher, frames: &[MarkerFrame]) {
    for message in frames.chunks(250) {
        publisher.send(message.to_vec()).await;
    }
}

async fn start_take(server: &TestServer, session: &str) -> Take {
    let request = StartTakeRequest {
        session: session.to_owned(),
        ..StartTakeRequest::default()
    };
    let answer = server.takes().await.start_take(request).await.unwrap();
    answer.into_inner().take.unwrap()
}

async fn stop_take(server: &TestServer, name: &str) -> Take {
    let request = StopTakeRequest {
        name: name.to_owned(),
    };
    let answer = server.takes().await.stop_take(request).await.unwrap();
    answer.into_inner().take.unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a21_a_frame_number_that_goes_back_is_late() {
    beside_a_control_session("A21", async |stage| {
        const BASE: u64 = 2_000_000;
        let start = stage.performance.start(SUBJECT, "camera-1");
        let mut publisher = Publisher::open(&stage.server, start).await.unwrap();
        let renumbered = |number: u64, as_number: u64| MarkerFrame {
            number: as_number,
            ..stage.performance.frame(number)
        };
        let mut frames: Vec<_> = (1..=30).map(|it| renumbered(it, BASE + it)).collect();
        frames.push(renumbered(32, BASE + 32));
        frames.push(renumbered(31, BASE + 31));
        frames.push(renumbered(33, 1_000_000));
        frames.push(renumbered(33, 0));
        frames.push(renumbered(33, BASE + 33));
        publisher.send(frames).await;
        publisher.accepted(BASE + 33).await.unwrap();
        let late = "LATE";
        assert_eq!(
            publisher.report().rejections(),
            [(BASE + 31, late), (1_000_000, late), (0, "FRAME_NUMBER")]
        );
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a22_a_jump_of_frame_numbers_is_one_gap() {
    beside_a_control_session("A22", async |stage| {
        let mut publisher = stage.publisher().await;
        let far = NEXT + 1 + 1_000_000_000;
        let at = |number: u64| MarkerFrame {
            number,
            ..stage.performance.frame(NEXT)
        };
        publisher
            .send(vec![at(NEXT + 1), at(far), at(u64::MAX), at(far + 1)])
            .await;
        publisher.accepted(far + 1).await.unwrap();
        assert_eq!(publisher.report().rejections(), [(u64::MAX, "FRAME_JUMP")]);
        let mut subscriber = stage.subscriber().await;
        for (first, last, next) in [(NEXT, NEXT, NEXT + 1), (NEXT + 2, far - 1, far)] {
            let gap = subscriber.gap().await.unwrap();
            assert_eq!(
                (gap.first, gap.last, gap.cause()),
                (first, last, GapCause::CaptureSkip)
            );
            assert_eq!(subscriber.sample().await.unwrap().frame, next);
        }
        assert_eq!(subscriber.sample().await.unwrap().frame, far + 1);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a23_capture_times_may_be_nonsense() {
    beside_a_control_session("A23", async |stage| {
        let mut publisher = stage.publisher().await;
        let last = stage.performance.frame(GOOD_FRAMES).capture_time_nanos;
        let times = [last, last - 1, 0, i64::MAX, i64::MIN, -1, i64::MAX];
        let frames = times
            .into_iter()
            .zip(NEXT..)
            .map(|(time, number)| MarkerFrame {
                capture_time_nanos: time,
                ..stage.performance.frame(number)
            });
        publisher.send(frames.collect()).await;
        let newest = GOOD_FRAMES + times.len() as u64;
        publisher.accepted(newest).await.unwrap();
        assert_eq!(publisher.report().rejections(), []);
        let samples = stage
            .subscriber()
            .await
            .samples_through(newest)
            .await
            .unwrap();
        for ((sample, time), rises) in samples
            .iter()
            .zip(times)
            .zip([false, false, false, true, false, true, true])
        {
            let flagged = sample.flags().any(|it| it == SampleFlag::TimeNonMonotonic);
            assert_eq!(sample.capture_time_nanos, time);
            assert_eq!(flagged, !rises, "frame {}", sample.frame);
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a24_a_capture_time_in_the_future_is_accepted() {
    beside_a_control_session("A24", async |stage| {
        let mut frame = stage.performance.frame(NEXT);
        frame.capture_time_nanos += 3_600_000_000_000;
        let (_, sample) = samples_around(stage, frame).await;
        assert_finite(&sample);
        let status = stage.server.session(SUBJECT).await.status.unwrap();
        assert!(matches!(
            status.state(),
            SessionState::Live | SessionState::Stale
        ));
        for stage in &status.latencies {
            let latency = stage.latency.unwrap_or_default();
            assert!(latency.max_micros < 60e6, "{}: {latency:?}", stage.stage);
        }
    })
    .await;
}

/// The sample of the last good frame, and the one that one more frame gives.
async fn samples_around(stage: &Stage, frame: MarkerFrame) -> (CurveSample, CurveSample) {
    let number = frame.number;
    let mut publisher = stage.publisher().await;
    publisher.send(vec![frame]).await;
    publisher.accepted(number).await.unwrap();
    assert_eq!(publisher.report().rejections(), []);
    let mut subscriber = Subscriber::open(&stage.server, every_frame(SUBJECT))
        .await
        .unwrap();
    let mut samples = subscriber.samples_through(number).await.unwrap();
    let after = samples.pop().unwrap();
    assert_eq!(after.frame, number);
    (samples.pop().unwrap(), after)
}

async fn assert_held(stage: &Stage, frame: MarkerFrame) {
    let mut publisher = stage.publisher().await;
    publisher.send(vec![frame]).await;
    publisher.accepted(NEXT).await.unwrap();
    let mut subscriber = stage.subscriber().await;
    let sample = subscriber.sample().await.unwrap();
    assert_eq!((sample.quality(), sample.held_frames), (Quality::Held, 1));
    assert!(
        sample
            .region_errors
            .iter()
            .all(|it| it.quality_fraction == 0.0)
    );
    assert_finite(&sample);
    // The frame counts as one: a next one follows at once, and the session is live.
    publisher
        .send(vec![stage.performance.frame(NEXT + 1)])
        .await;
    publisher.accepted(NEXT + 1).await.unwrap();
    assert_eq!(
        subscriber.sample().await.unwrap().quality(),
        Quality::Solved
    );
    let state = stage.server.session(SUBJECT).await.status.unwrap().state();
    assert!(
        matches!(state, SessionState::Live | SessionState::Stale),
        "{state:?}"
    );
}

fn n_markers(sample: &CurveSample) -> u32 {
    sample.region_errors.iter().map(|it| it.n_markers).sum()
}

fn assert_finite(sample: &CurveSample) {
    let scalars = sample.activations.iter().chain(&sample.standard_errors);
    assert!(scalars.copied().all(f32::is_finite));
    assert!(
        sample
            .region_errors
            .iter()
            .all(|it| it.marker_error_cm.is_finite())
    );
    let head = sample.head.unwrap_or_default();
    assert!(
        [
            head.qx, head.qy, head.qz, head.qw, head.tx_cm, head.ty_cm, head.tz_cm
        ]
        .into_iter()
        .all(f32::is_finite)
    );
}
