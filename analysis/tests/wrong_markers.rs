//! The curves stay right when markers are wrong (rows A12 to A19 of the bad-input table, at the analysis itself).
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::sync::{Arc, LazyLock};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Progress},
    curve::{CurveSample, HeldReason, Quality},
    face::{actor::Actor, marker::MarkerFrame},
    space::{LengthUnit, PerformancePoint},
    synthesis::reference_face,
};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use rand::SeedableRng as _;
use rand_pcg::Pcg64;

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

/// The frame that each test spoils: in the middle of the performance, with muscles active.
const SPOILED: usize = 200;

/// What a spoiled frame may add to a contraction, beyond what its neighbors have.
const SPIKE: f64 = 0.05;

const CALM: Stage = Stage {
    n_frames: 300,
    moving_head: true,
    noise_cm: 0.02,
    seed: 31,
    ..Stage::STILL
};

/// The reference face, made once.
fn actor() -> Arc<Actor> {
    static ACTOR: LazyLock<Arc<Actor>> = LazyLock::new(|| Arc::new(reference_face::actor()));
    Arc::clone(&ACTOR)
}

fn marker(name: &str) -> usize {
    let actor = actor();
    actor
        .markers()
        .iter()
        .position(|it| it.name == name)
        .unwrap()
}

fn solve(frames: &[MarkerFrame]) -> Vec<CurveSample> {
    let (unit, settings) = (LengthUnit::Centimeter, MarkerSettings::default());
    let mut analyzer = MarkerAnalyzer::new(actor(), settings, unit, 60.0);
    let mut samples = Vec::new();
    for frame in frames {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    assert_eq!(samples.len(), frames.len());
    for sample in &samples {
        assert!(sample.activations.iter().all(|it| (0.0..=1.0).contains(it)));
        assert!(sample.standard_errors.iter().all(|it| it.is_finite()));
        if let Some(head) = sample.head {
            let matrix = head.rotation.to_rotation_matrix();
            assert!((matrix.matrix().determinant() - 1.0).abs() < 1e-9);
        }
    }
    samples
}

/// The samples of the performance, clean and with one frame spoiled.
fn spoiled(spoil: impl Fn(&mut [Option<PerformancePoint>])) -> [Vec<CurveSample>; 2] {
    let clean = Performance::of(&actor(), CALM).frames;
    let mut frames = clean.clone();
    spoil(&mut frames[SPOILED].positions);
    [solve(&clean), solve(&frames)]
}

/// The most that a contraction of the spoiled performance is beyond all of its neighbors, in the frames around.
fn largest_spike(samples: &[CurveSample]) -> f64 {
    let mut largest = 0.0_f64;
    for k in SPOILED..SPOILED + 3 {
        for (i, value) in samples[k].activations.iter().enumerate() {
            let around = (SPOILED - 3..SPOILED + 8).filter(|it| *it != k);
            let (low, high) = around.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
                let value = samples[it].activations[i];
                (low.min(value), high.max(value))
            });
            largest = largest.max(value - high).max(low - value);
        }
    }
    largest
}

#[test]
fn a_marker_that_jumps_is_masked_and_named() {
    for jumping in ["chin", "brow_inner_right", "mouth_corner_left"].map(marker) {
        let [_, samples] = spoiled(|it| {
            let position = it[jumping].as_mut().unwrap();
            position.0 += Vector3::new(3.0, 4.0, 0.0);
        });
        assert_eq!(samples[SPOILED].outliers, [jumping]);
        assert!(samples[SPOILED].relabeled.is_empty());
        let spike = largest_spike(&samples);
        assert!(spike < SPIKE, "marker {jumping}: {spike}");
        assert!(samples[SPOILED + 1].outliers.is_empty());
    }
}

#[test]
fn two_swapped_markers_are_put_right_and_named() {
    let pairs = [
        ["forehead_left", "lid_right"],
        ["mouth_corner_left", "mouth_corner_right"],
        ["upper_lip_left", "lower_lip_left"],
    ];
    for pair in pairs.map(|it| it.map(marker)) {
        let [clean, samples] = spoiled(|it| it.swap(pair[0], pair[1]));
        assert_eq!(samples[SPOILED].relabeled, [pair]);
        let apart = samples[SPOILED]
            .activations
            .iter()
            .zip(&clean[SPOILED].activations)
            .fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()));
        assert!(apart < 1e-12, "{pair:?}: {apart:e}");
    }
}

#[test]
fn a_swap_that_lasts_is_put_right_in_every_frame() {
    let mut frames = Performance::of(&actor(), CALM).frames;
    for frame in &mut frames[SPOILED..] {
        frame.positions.swap(marker("cheek_left"), marker("chin"));
    }
    let samples = solve(&frames);
    let relabeled = |it: &&CurveSample| it.relabeled == [["cheek_left", "chin"].map(marker)];
    assert_eq!(samples[SPOILED..].iter().filter(relabeled).count(), 100);
}

#[test]
fn a_head_that_jumps_a_meter_leaves_no_spike() {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.2, -0.5, 0.1));
    for turn in [UnitQuaternion::identity(), turn] {
        let mut frames = Performance::of(&actor(), CALM).frames;
        for frame in &mut frames[SPOILED..] {
            for position in frame.positions.iter_mut().flatten() {
                let moved = turn * position.0.coords + Vector3::new(70.0, -20.0, 65.0);
                *position = PerformancePoint(Point3::from(moved));
            }
        }
        let samples = solve(&frames);
        let spike = largest_spike(&samples);
        assert!(spike < SPIKE, "{spike}");
        assert_eq!(samples[SPOILED].quality, Quality::Solved);
        let moved = samples[SPOILED].head.unwrap().translation_cm
            - samples[SPOILED - 1].head.unwrap().translation_cm;
        assert!(moved.norm() > 50.0, "{moved}");
    }
}

#[test]
fn markers_on_a_point_a_line_or_a_plane_are_held() {
    let on_a_point = |_: Vector3<f64>| Vector3::new(1.0, 2.0, 3.0);
    let on_a_line = |it: Vector3<f64>| Vector3::new(it.x, 0.0, 0.0);
    let on_a_plane = |it: Vector3<f64>| Vector3::new(it.x, it.y, 0.0);
    let flatten: [fn(Vector3<f64>) -> Vector3<f64>; 3] = [on_a_point, on_a_line, on_a_plane];
    for flatten in flatten {
        let [_, samples] = spoiled(|it| {
            for position in it.iter_mut().flatten() {
                position.0 = Point3::from(flatten(position.0.coords));
            }
        });
        assert_held(&samples, HeldReason::DegeneratePose);
    }
}

#[test]
fn a_mirrored_frame_is_held_and_never_gives_a_reflection() {
    let [_, samples] = spoiled(|it| {
        for position in it.iter_mut().flatten() {
            position.0.x = -position.0.x;
        }
    });
    assert_held(&samples, HeldReason::DegeneratePose);
}

#[test]
fn one_two_or_three_markers_are_held() {
    for n_visible in 1..=3 {
        let [_, samples] = spoiled(|it| it[n_visible..].fill(None));
        assert_held(&samples, HeldReason::TooFewMarkers);
    }
}

fn assert_held(samples: &[CurveSample], reason: HeldReason) {
    let (before, held) = (&samples[SPOILED - 1], &samples[SPOILED]);
    assert_eq!(held.quality, Quality::Held);
    assert_eq!(held.activations, before.activations);
    assert!(held.regions.iter().all(|it| it.held_reason == Some(reason)));
    assert_eq!(samples[SPOILED + 1].quality, Quality::Solved);
    let spike = largest_spike(samples);
    assert!(spike < SPIKE, "{spike}");
}

#[test]
fn another_axis_upwards_changes_nothing() {
    let frames = Performance::of(&actor(), CALM).frames;
    let z_up = UnitQuaternion::from_scaled_axis(Vector3::x() * std::f64::consts::FRAC_PI_2);
    let mut turned = frames.clone();
    for position in turned.iter_mut().flat_map(|it| &mut it.positions).flatten() {
        *position = PerformancePoint(z_up * position.0);
    }
    for (a, b) in solve(&frames).iter().zip(&solve(&turned)) {
        for (a, b) in a.activations.iter().zip(&b.activations) {
            assert!((a - b).abs() < 1e-6, "{a} {b}");
        }
    }
}

/// Lids that are closed once a second for a fifth of it, both together; all else as in [`CALM`].
fn blinking() -> Performance {
    let actor = actor();
    let mut truth = Performance::of(&actor, CALM).truth;
    for (k, row) in truth.iter_mut().enumerate().skip(60) {
        let phase = ((k % 60) as f64 / 12.0).min(1.0);
        let closed = 0.5 - 0.5 * (std::f64::consts::TAU * phase).cos();
        for lid in LIDS {
            row[actor.muscle_set().index_of(lid).unwrap()] = closed;
        }
    }
    Performance::of_truth(&actor, CALM, truth, &mut Pcg64::seed_from_u64(7))
}

const LIDS: [&str; 2] = ["orbicularis_oculi_left", "orbicularis_oculi_right"];

/// The marker on which a lid rests alone.
fn marker_of(lid: usize) -> usize {
    let actor = actor();
    let basis = actor.marker_basis();
    let of_marker = |j: usize| basis.of_marker_cm(j)[lid].norm_squared();
    let all: f64 = (0..actor.markers().len()).map(of_marker).sum();
    (0..actor.markers().len())
        .find(|&j| of_marker(j) > 0.85 * all)
        .unwrap()
}

#[test]
fn a_lid_whose_marker_is_hidden_is_said_and_blinks_with_the_other() {
    let mut performance = blinking();
    let lid = actor().muscle_set().index_of(LIDS[0]).unwrap();
    for frame in &mut performance.frames[SPOILED..] {
        frame.positions[marker_of(lid)] = None;
    }
    let samples = solve(&performance.frames);
    let hidden = samples.iter().zip(&performance.truth).skip(SPOILED);
    for (sample, truth) in hidden {
        assert_eq!(sample.unobserved, [lid]);
        let error = (sample.activations[lid] - truth[lid]).abs();
        assert!(error < 0.1, "{error} at {:?}", sample.frame);
        assert!(sample.standard_errors[lid] > samples[SPOILED - 1].standard_errors[lid]);
    }
}

#[test]
fn lids_that_are_both_hidden_are_let_go() {
    let mut performance = blinking();
    let lids = LIDS.map(|it| actor().muscle_set().index_of(it).unwrap());
    // In the middle of a blink.
    let closed = 186;
    for frame in &mut performance.frames[closed..] {
        for lid in lids {
            frame.positions[marker_of(lid)] = None;
        }
    }
    let samples = solve(&performance.frames);
    for lid in lids {
        assert!(samples[closed - 1].activations[lid] > 0.8);
        assert!(samples[closed..].iter().all(|it| it.unobserved == lids));
        let fallen = samples[closed..]
            .windows(2)
            .all(|it| it[1].activations[lid] <= it[0].activations[lid]);
        assert!(fallen, "it does not come back");
        assert!(samples.last().unwrap().activations[lid] < 0.05);
    }
}

#[test]
fn frames_that_did_not_come_do_not_delay_what_comes_after_them() {
    let mut frames = Performance::of(&actor(), CALM).frames;
    let whole = solve(&frames);
    frames.drain(SPOILED..SPOILED + 40);
    let with_gap = solve(&frames);
    let after = &with_gap[SPOILED];
    assert_eq!(after.frame, whole[SPOILED + 40].frame);
    for (a, b) in after
        .activations
        .iter()
        .zip(&whole[SPOILED + 40].activations)
    {
        assert!((a - b).abs() < 0.1, "{a} {b}");
    }
}

#[test]
fn a_frame_in_another_unit_gives_no_sample_and_says_by_how_much() {
    for factor in [0.001, 0.01, 0.1, 10.0] {
        let mut frames = Performance::of(&actor(), CALM).frames;
        for position in frames[SPOILED].positions.iter_mut().flatten() {
            position.0 *= factor;
        }
        let (unit, settings) = (LengthUnit::Centimeter, MarkerSettings::default());
        let mut analyzer = MarkerAnalyzer::new(actor(), settings, unit, 60.0);
        let mut samples = Vec::new();
        for (k, frame) in frames.iter().enumerate() {
            let progress = analyzer.push(frame.clone(), &mut samples).unwrap();
            if k == SPOILED {
                assert_eq!(progress, Progress::ScaleJump);
                let found = analyzer.scale_jump().unwrap();
                assert!((found / factor - 1.0).abs() < 0.2, "{found} {factor}");
            }
        }
        assert_eq!(samples.len(), frames.len() - 1);
    }
}
