//! Rows A16 to A19 and C5: faces that are mirrored, in another unit, on other axes, or incomplete.

use std::ops::RangeInclusive;

use frontalis_proto::v1::{
    CurveSample, GapCause, LengthUnit, MarkerFrame, Quality, SessionState, SessionStatus,
};
use harness::{Heard, Publisher, Subscriber, assert_eventually, assert_refused, every_frame};
use tonic::{Code, Status};

use super::{GOOD_FRAMES, SUBJECT, Stage, beside_a_control_session};

/// Frames refused in a row before the stream is closed (CONTRACTS D-10).
const MOST_REFUSED: u64 = 100;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a16_a_mirrored_face_ends_the_stream_and_the_session_waits() {
    beside_a_control_session("A16", async |stage| {
        let frames = neutral(stage, 1).map(|it| changed(it, |[x, y, z]| [-x, y, z]));
        let broken = broken_off_by(stage, LengthUnit::Millimeter, frames).await;
        assert_refused(&broken, Code::FailedPrecondition, "MIRRORED");
        assert_waits(stage, "MIRRORED").await;
        assert_a_right_face_aligns(stage).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a16_a_mirrored_frame_is_held_and_never_a_reflection() {
    beside_a_control_session("A16 frame", async |stage| {
        let mut publisher = stage.publisher().await;
        let (mirrored, last) = (GOOD_FRAMES + 1, GOOD_FRAMES + 2);
        let mut frames = stage.performance.frames(mirrored..=last);
        // About the face itself, so that only its handedness is wrong.
        let [middle, ..] = center(&frames[0]);
        frames[0] = changed(frames[0].clone(), |[x, y, z]| [2.0 * middle - x, y, z]);
        publisher.publish(frames).await;
        assert_eq!(publisher.report().rejections(), []);
        let mut subscriber = Subscriber::open(&stage.server, every_frame(SUBJECT))
            .await
            .unwrap();
        let samples = subscriber.samples_through(last).await.unwrap();
        let [.., before, held, after] = samples.as_slice() else {
            panic!("three samples");
        };
        assert_eq!((held.quality(), held.held_frames), (Quality::Held, 1));
        let reason = |it: &CurveSample| it.region_errors[0].held_reason.clone();
        assert_eq!(reason(held), "DEGENERATE_POSE");
        assert_eq!(held.activations, before.activations);
        assert_eq!(after.quality(), Quality::Solved);
        let turned = |it: &CurveSample| it.head.map_or(1.0, |it| it.qw.abs());
        assert!(turned(held) > 0.99 && turned(after) > 0.99);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a17_a_wrong_unit_ends_the_stream_and_says_the_likely_one() {
    use LengthUnit::{Centimeter, Meter, Millimeter};
    beside_a_control_session("A17", async |stage| {
        let wrong = [
            (Centimeter, Millimeter, "mm"),
            (Millimeter, Centimeter, "cm"),
            (Meter, Centimeter, "cm"),
            (Millimeter, Meter, "m"),
            (Centimeter, Meter, "m"),
        ];
        for (run, (declared, sent, symbol)) in (0_u64..).zip(wrong) {
            let first = run * GOOD_FRAMES + 1;
            let frames = neutral(stage, first).map(|it| near_the_origin(it, sent));
            let broken = broken_off_by(stage, declared, frames).await;
            assert_refused(&broken, Code::FailedPrecondition, "UNITS_SUSPECT");
            let said = broken.message();
            let scale = f64::from(meters(declared) / meters(sent));
            let extent_m = scale * extent_m(&stage.performance.frame(1));
            assert!(
                said.contains(&format!("span {extent_m:.4} m")),
                "{extent_m}: {said}"
            );
            assert!(said.ends_with(&format!("probably in {symbol}")), "{said}");
            assert_waits(stage, "UNITS_SUSPECT").await;
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a17_millimeters_sent_as_meters_are_out_of_the_volume() {
    beside_a_control_session("A17 far out", async |stage| {
        let frames: Vec<_> = (1..=MOST_REFUSED)
            .map(|number| near_the_origin(at_rest(stage, number), LengthUnit::Millimeter))
            .collect();
        let mut start = stage.performance.start(SUBJECT, "camera-1");
        start.unit = LengthUnit::Meter.into();
        let mut publisher = Publisher::open(&stage.server, start).await.unwrap();
        publisher.send(frames).await;
        let broken = publisher.broken_off().await;
        assert_refused(&broken, Code::InvalidArgument, "TOO_MANY_REJECTS");
        let rejected = &publisher.report().rejected;
        assert_eq!(rejected.len() as u64, MOST_REFUSED);
        for it in rejected {
            assert_eq!(it.reason, "OUT_OF_VOLUME");
            assert!(it.detail.contains("read in m"), "{}", it.detail);
        }
        assert_a_right_face_aligns(stage).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a18_a_unit_that_changes_gives_no_samples_and_after_100_frames_ends_the_stream() {
    beside_a_control_session("A18", async |stage| {
        let in_another_unit = |factor: f32, numbers: RangeInclusive<u64>| -> Vec<_> {
            let frames = stage.performance.frames(numbers).into_iter();
            let scaled = |it| changed(it, |position| position.map(|it| it * factor));
            frames.map(scaled).collect()
        };
        let (mut next, mut solved) = (GOOD_FRAMES + 1, (1..=GOOD_FRAMES).collect::<Vec<_>>());
        for (factor, reason) in [(0.001, "SCALE_JUMP"), (1_000.0, "OUT_OF_VOLUME")] {
            let mut publisher = resumed(stage, next).await;
            // One less than too many, a right one, and as many as are too many.
            let right = next + MOST_REFUSED - 1;
            let last = right + MOST_REFUSED;
            publisher
                .send(in_another_unit(factor, next..=right - 1))
                .await;
            publisher.send(vec![stage.performance.frame(right)]).await;
            publisher.accepted(right).await.unwrap();
            publisher
                .send(in_another_unit(factor, right + 1..=last))
                .await;
            let broken = publisher.broken_off().await;
            assert_refused(&broken, Code::InvalidArgument, "TOO_MANY_REJECTS");
            let refused = (next..=last).filter(|it| *it != right);
            let refused: Vec<_> = refused.map(|it| (it, reason)).collect();
            assert_eq!(publisher.report().rejections(), refused);
            solved.push(right);
            next = last + 1;
        }
        // The session and its neutral face are as they were.
        let last = next + GOOD_FRAMES;
        let mut publisher = resumed(stage, next).await;
        publisher
            .publish(stage.performance.frames(next..=last))
            .await;
        solved.extend(next..=last);
        assert_solved_and_the_others_rejected(stage, &solved).await;
        let status = status(stage).await;
        let is_on = matches!(status.state(), SessionState::Live | SessionState::Stale);
        assert!(is_on && status.alignment.is_some(), "{status:?}");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a19_another_axis_upwards_changes_nothing() {
    beside_a_control_session("A19", async |stage| {
        const LAST: u64 = 200;
        let frames = stage.performance.frames(1..=LAST);
        let turned = frames.clone().into_iter();
        let turned = turned.map(|it| changed(it, |[x, y, z]| [x, -z, y]));
        let curves = [
            stage.samples_of("y-up", frames).await,
            stage.samples_of("z-up", turned.collect()).await,
        ];
        let mut furthest = 0.0_f32;
        for (a, b) in curves[0].iter().zip(&curves[1]) {
            assert_eq!((a.frame, b.quality()), (b.frame, Quality::Solved));
            for (a, b) in a.activations.iter().zip(&b.activations) {
                furthest = furthest.max((a - b).abs());
            }
        }
        let moves = curves[0].iter().flat_map(|it| &it.activations);
        assert!(moves.fold(0.0_f32, |largest, it| largest.max(*it)) > 0.4);
        println!("A19: at most {furthest:e} apart");
        assert!(furthest < 1e-3, "{furthest}");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a19_axes_of_the_other_hand_are_a_mirrored_face() {
    beside_a_control_session("A19 hand", async |stage| {
        let frames = neutral(stage, 1).map(|it| changed(it, |[x, y, z]| [x, z, y]));
        let broken = broken_off_by(stage, LengthUnit::Millimeter, frames).await;
        assert_refused(&broken, Code::FailedPrecondition, "MIRRORED");
        assert_waits(stage, "MIRRORED").await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn c5_a_marker_that_the_neutral_frames_never_show_is_left_out() {
    beside_a_control_session("C5 one", async |stage| {
        let unseen = stage.marker("cheek_left");
        let frames = stage.performance.frames(1..=GOOD_FRAMES).into_iter();
        let frames = frames.map(|it| without(it, |marker| marker == unseen));
        let samples = stage.samples_of("one-unseen", frames.collect()).await;
        assert!(samples.iter().all(|it| it.quality() != Quality::Held));
        let session = stage.server.session("sessions/one-unseen").await;
        let aligned = session.status.unwrap().alignment.unwrap();
        assert_eq!(
            aligned.n_markers as usize,
            stage.performance.n_markers() - 1
        );
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn c5_too_few_markers_of_a_region_end_the_stream_and_are_listed() {
    beside_a_control_session("C5", async |stage| {
        let shown = ["brow_inner_left", "lid_left", "nose_bridge"];
        let upper = ["forehead", "brow", "lid", "nose_bridge", "head", "temple"];
        let names = stage.performance.marker_names();
        let is_unseen = |marker: usize| {
            let name = names[marker].as_str();
            upper.iter().any(|it| name.starts_with(it)) && !shown.contains(&name)
        };
        let frames = neutral(stage, 1).map(|it| without(it, is_unseen));
        let broken = broken_off_by(stage, LengthUnit::Millimeter, frames).await;
        assert_refused(&broken, Code::FailedPrecondition, "NEUTRAL_INCOMPLETE");
        let said = broken.message();
        assert!(
            said.contains("show 3 markers of the upper region"),
            "{said}"
        );
        for (marker, name) in names.iter().enumerate() {
            assert_eq!(said.contains(name), is_unseen(marker), "{name}: {said}");
        }
        assert_waits(stage, "NEUTRAL_INCOMPLETE").await;
        assert_a_right_face_aligns(stage).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn c5_a_head_that_moves_while_the_neutral_face_is_taken_is_no_error() {
    beside_a_control_session("C5 moving", async |stage| {
        // A turn of 2 degrees and a step of 3 mm a frame.
        let frames = neutral(stage, 1).map(|it| {
            let (angle, step) = (0.035 * it.number as f32, 3.0 * it.number as f32);
            let (sin, cos) = angle.sin_cos();
            changed(it, |[x, y, z]| {
                [cos * x + sin * z + step, y, cos * z - sin * x]
            })
        });
        let samples = stage.samples_of("moving", frames.collect()).await;
        let largest = samples.iter().flat_map(|it| &it.activations);
        let largest = largest.fold(0.0_f32, |largest, it| largest.max(*it));
        assert!(largest < 0.02, "a face at rest: {largest}");
        let session = stage.server.session("sessions/moving").await;
        let aligned = session.status.unwrap().alignment.unwrap();
        assert!(aligned.rms_residual_cm < 0.01, "{aligned:?}");
    })
    .await;
}

/// The neutral face in as many frames as a session has seen when it is live, from `first` on.
fn neutral(stage: &Stage, first: u64) -> impl Iterator<Item = MarkerFrame> {
    (first..first + GOOD_FRAMES).map(|number| at_rest(stage, number))
}

fn at_rest(stage: &Stage, number: u64) -> MarkerFrame {
    MarkerFrame {
        number,
        ..stage.performance.frame(1)
    }
}

fn changed(mut frame: MarkerFrame, change: impl Fn([f32; 3]) -> [f32; 3]) -> MarkerFrame {
    for position in frame.positions.chunks_exact_mut(3) {
        position.copy_from_slice(&change([position[0], position[1], position[2]]));
    }
    frame
}

fn without(mut frame: MarkerFrame, is_hidden: impl Fn(usize) -> bool) -> MarkerFrame {
    for (marker, position) in frame.positions.chunks_exact_mut(3).enumerate() {
        if is_hidden(marker) {
            position.fill(f32::NAN);
        }
    }
    frame
}

/// About the origin, in another unit than millimeters.
fn near_the_origin(frame: MarkerFrame, unit: LengthUnit) -> MarkerFrame {
    let per_mm = meters(LengthUnit::Millimeter) / meters(unit);
    let [a, b, c] = center(&frame);
    changed(frame, |[x, y, z]| {
        [x - a, y - b, z - c].map(|it| it * per_mm)
    })
}

/// The mean of all markers.
fn center(frame: &MarkerFrame) -> [f32; 3] {
    let n = (frame.positions.len() / 3) as f32;
    let of_axis = |axis: usize| frame.positions.iter().skip(axis).step_by(3);
    [0, 1, 2].map(|axis| of_axis(axis).sum::<f32>() / n)
}

fn meters(unit: LengthUnit) -> f32 {
    match unit {
        LengthUnit::Millimeter => 0.001,
        LengthUnit::Centimeter => 0.01,
        LengthUnit::Meter | LengthUnit::Unspecified => 1.0,
    }
}

/// How the server breaks off a stream of these frames.
async fn broken_off_by(
    stage: &Stage,
    unit: LengthUnit,
    frames: impl Iterator<Item = MarkerFrame>,
) -> Status {
    let mut start = stage.performance.start(SUBJECT, "camera-1");
    start.unit = unit.into();
    let mut publisher = Publisher::open(&stage.server, start).await.unwrap();
    publisher.send(frames.collect()).await;
    publisher.broken_off().await
}

/// A stream of the subject, aligned before.
async fn resumed(stage: &Stage, next: u64) -> Publisher {
    if next == GOOD_FRAMES + 1 {
        return stage.publisher().await;
    }
    let start = stage.performance.start(SUBJECT, "camera-1");
    Publisher::open(&stage.server, start).await.unwrap()
}

async fn status(stage: &Stage) -> SessionStatus {
    stage.server.session(SUBJECT).await.status.unwrap()
}

async fn assert_waits(stage: &Stage, problem: &str) {
    assert_eventually!(status(stage).await.alignment_problem == problem);
    let status = status(stage).await;
    assert_eq!(status.state(), SessionState::Waiting);
    assert_eq!(status.alignment, None);
}

/// What was wrong is over: the same session takes the next right frames.
async fn assert_a_right_face_aligns(stage: &Stage) {
    let start = stage.performance.start(SUBJECT, "camera-1");
    let mut publisher = Publisher::open(&stage.server, start).await.unwrap();
    let next = publisher.started.next_expected.max(1);
    publisher.publish(neutral(stage, next).collect()).await;
    let mut subscriber = Subscriber::open(&stage.server, every_frame(SUBJECT))
        .await
        .unwrap();
    let last = next + GOOD_FRAMES - 1;
    let samples = subscriber.samples_through(last).await.unwrap();
    assert_eq!(samples.len() as u64, GOOD_FRAMES);
    assert!(samples.iter().all(|it| it.quality() == Quality::Solved));
    let status = status(stage).await;
    assert_eq!(status.alignment_problem, "");
    assert!(status.alignment.is_some());
}

/// These frames give samples, and all others before the last of them a gap that says why not.
async fn assert_solved_and_the_others_rejected(stage: &Stage, solved: &[u64]) {
    let every = every_frame(SUBJECT);
    let mut subscriber = Subscriber::open(&stage.server, every).await.unwrap();
    let (mut samples, mut next) = (Vec::new(), 1);
    while samples.len() < solved.len() {
        match subscriber.next().await.unwrap().unwrap() {
            Heard::Sample(sample) => {
                assert_eq!((sample.frame, sample.quality()), (next, Quality::Solved));
                samples.push(sample.frame);
                next += 1;
            }
            Heard::Gap(gap) => {
                assert_eq!((gap.first, gap.cause()), (next, GapCause::Rejected));
                next = gap.last + 1;
            }
            Heard::State(_) => {}
            Heard::End(end) => panic!("{end:?}"),
        }
    }
    assert_eq!(samples, solved);
}

/// The longest way through the face, meters.
fn extent_m(frame: &MarkerFrame) -> f64 {
    let points: Vec<_> = frame.positions.chunks_exact(3).collect();
    let squared = |a: &[f32], b: &[f32]| -> f64 {
        let axes = a.iter().zip(b);
        axes.map(|(a, b)| f64::from(a - b).powi(2)).sum()
    };
    let pairs = points.iter();
    let pairs = pairs.flat_map(|a| points.iter().map(move |b| squared(a, b)));
    pairs.fold(0.0, f64::max).sqrt() / 1_000.0
}
