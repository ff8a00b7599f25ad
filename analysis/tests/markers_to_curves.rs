//! Markers in, contractions out by the plain objective, where the contractions that made the markers are known.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::sync::Arc;

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Progress, RegionMode},
    curve::{CurveSample, HeldReason, Quality},
    face::{actor::Actor, marker::FrameIndex},
    space::{LengthUnit, PerformancePoint},
    synthesis::reference_face,
};
use nalgebra::Point3;

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

/// Largest KKT residual that any frame may have, relative to the largest diagonal entry of Q.
const KKT_LIMIT: f64 = 1e-10;

fn actor() -> Arc<Actor> {
    Arc::new(reference_face::actor())
}

fn analyzer(actor: &Arc<Actor>, settings: MarkerSettings) -> MarkerAnalyzer {
    MarkerAnalyzer::new(Arc::clone(actor), settings, LengthUnit::Centimeter, 60.0)
}

fn solve(performance: &Performance, settings: MarkerSettings) -> Vec<CurveSample> {
    let mut analyzer = analyzer(&actor(), settings);
    let mut samples = Vec::new();
    for frame in &performance.frames {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    assert_eq!(samples.len(), performance.frames.len());
    for sample in &samples {
        assert!(
            sample.kkt_residual <= KKT_LIMIT,
            "{:e}",
            sample.kkt_residual
        );
        assert!(sample.activations.iter().all(|it| (0.0..=2.0).contains(it)));
    }
    samples
}

fn errors(samples: &[CurveSample], truth: &[Vec<f64>]) -> (f64, f64) {
    let differences = || {
        samples
            .iter()
            .zip(truth)
            .flat_map(|(sample, truth)| sample.activations.iter().zip(truth).map(|(a, b)| a - b))
    };
    let count = differences().count() as f64;
    let rms = (differences().map(|it| it * it).sum::<f64>() / count).sqrt();
    (
        rms,
        differences().fold(0.0, |largest, it| it.abs().max(largest)),
    )
}

fn settings(region_mode: RegionMode, stabilize_head: bool) -> MarkerSettings {
    MarkerSettings {
        region_mode,
        stabilize_head,
        ..MarkerSettings::plain()
    }
}

#[test]
fn recovers_the_contractions_of_a_noise_free_take_to_a_millionth() {
    let performance = Performance::of(&actor(), Stage::STILL);
    for (mode, stabilize_head) in [
        (RegionMode::Joint, true),
        (RegionMode::Joint, false),
        (RegionMode::Split, true),
        (RegionMode::Split, false),
    ] {
        let samples = solve(&performance, settings(mode, stabilize_head));
        let (rms, largest) = errors(&samples, &performance.truth);
        println!(
            "noise-free, {mode:?}, head solved {stabilize_head}: RMS {rms:.1e}, largest {largest:.1e}"
        );
        assert!(largest <= 1e-6, "{mode:?}, {stabilize_head}: {largest:e}");
        assert!(samples.iter().all(|it| it.quality == Quality::Solved));
    }
}

#[test]
fn recovers_the_contractions_under_a_moving_head() {
    let stage = Stage {
        moving_head: true,
        ..Stage::STILL
    };
    let performance = Performance::of(&actor(), stage);
    let samples = solve(&performance, MarkerSettings::plain());
    let (rms, largest) = errors(&samples, &performance.truth);
    println!("noise-free, moving head: RMS {rms:.1e}, largest {largest:.1e}");
    assert!(largest <= 1e-6, "{largest:e}");
}

#[test]
fn noise_gives_the_errors_that_the_method_promises() {
    for (noise_cm, still_limit, moving_limit) in [(0.02, 0.015, 0.016), (0.05, 0.035, 0.04)] {
        let stage = Stage {
            noise_cm,
            seed: 5,
            ..Stage::STILL
        };
        let still = Performance::of(&actor(), stage);
        let fixed = settings(RegionMode::Joint, false);
        let (fixed_rms, _) = errors(&solve(&still, fixed), &still.truth);
        let moving = Performance::of(
            &actor(),
            Stage {
                moving_head: true,
                ..stage
            },
        );
        let (joint_rms, _) = errors(&solve(&moving, MarkerSettings::plain()), &moving.truth);
        println!(
            "noise {:.1} mm: RMS {fixed_rms:.4} (still head, fixed), {joint_rms:.4} (moving head, joint)",
            noise_cm * 10.0
        );
        assert!(fixed_rms <= still_limit && joint_rms <= moving_limit);
    }
}

#[test]
fn the_head_pose_is_the_motion_that_was_made() {
    let stage = Stage {
        moving_head: true,
        ..Stage::STILL
    };
    let performance = Performance::of(&actor(), stage);
    let samples = solve(&performance, MarkerSettings::plain());
    let time = 200.0 / stage.rate_hz;
    let axis = nalgebra::Vector3::new((0.9 * time).sin(), (0.7 * time).sin(), (1.1 * time).sin());
    let made = nalgebra::UnitQuaternion::from_scaled_axis(0.15 * axis);
    // The neutral mean lies in the pose of the first frame, where the head does not move yet.
    let found = samples[200].head.unwrap().rotation;
    assert!(found.angle_to(&made) < 1e-6, "{}", found.angle_to(&made));
}

#[test]
fn hidden_markers_leave_the_sums_and_the_rest_still_tells() {
    let mut performance = Performance::of(&actor(), Stage::STILL);
    let cheek = actor()
        .markers()
        .iter()
        .position(|it| it.name == "cheek_left")
        .unwrap();
    for frame in performance.frames.iter_mut().skip(60) {
        frame.positions[cheek] = None;
    }
    let samples = solve(&performance, MarkerSettings::plain());
    let (_, largest) = errors(&samples, &performance.truth);
    assert!(largest <= 1e-6, "{largest:e}");
    assert_eq!(samples[100].quality, Quality::Partial);
    assert_eq!(samples[100].regions[0].quality, Quality::Solved);
    assert_eq!(samples[100].regions[1].n_markers, 15);
}

#[test]
fn a_muscle_whose_markers_are_hidden_is_named_and_decays() {
    let actor = actor();
    let stage = Stage {
        n_frames: 900,
        ..Stage::STILL
    };
    let mut performance = Performance::of(&actor, stage);
    let lid = actor
        .markers()
        .iter()
        .position(|it| it.name == "lid_left")
        .unwrap();
    let muscle = actor
        .muscle_set()
        .index_of("orbicularis_oculi_left")
        .unwrap();
    let closed = performance
        .truth
        .iter()
        .position(|it| it[muscle] > 0.5)
        .unwrap();
    for frame in &mut performance.frames[closed..] {
        frame.positions[lid] = None;
    }
    let samples = solve(&performance, MarkerSettings::plain());
    assert_eq!(samples[closed].unobserved, [muscle]);
    let height = |k: usize| samples[k].activations[muscle];
    let after_a_fifth_of_a_second = height(closed + 11) / height(closed - 1);
    assert!((after_a_fifth_of_a_second - (-1.0_f64).exp()).abs() < 1e-6);
}

#[test]
fn a_region_that_shows_too_little_stands_still_and_the_other_goes_on() {
    let actor = actor();
    let mut performance = Performance::of(&actor, Stage::STILL);
    for frame in &mut performance.frames[200..300] {
        for (marker, position) in actor.markers().iter().zip(&mut frame.positions).take(5) {
            assert_eq!(marker.region.name(), "upper");
            *position = None;
        }
    }
    let samples = solve(&performance, MarkerSettings::plain());
    let held = &samples[250];
    assert_eq!(held.quality, Quality::Partial);
    assert_eq!(held.regions[0].held_reason, Some(HeldReason::TooFewMarkers));
    assert_eq!(held.activations[..6], samples[199].activations[..6]);
    for (found, truth) in held.activations[6..]
        .iter()
        .zip(&performance.truth[250][6..])
    {
        assert!((found - truth).abs() < 1e-2, "{found} {truth}");
    }
}

#[test]
fn a_frame_without_markers_is_held_and_counted() {
    let mut performance = Performance::of(&actor(), Stage::STILL);
    for frame in &mut performance.frames[100..110] {
        frame.positions.fill(None);
    }
    let samples = solve(&performance, MarkerSettings::plain());
    assert_eq!(samples[105].quality, Quality::Held);
    assert_eq!(samples[105].held_frames, 6);
    assert_eq!(samples[105].activations, samples[99].activations);
    assert_eq!(samples[105].head, None);
    assert_eq!(samples[110].quality, Quality::Solved);
}

/// Spoils one marker's position.
type Spoil = fn(PerformancePoint) -> PerformancePoint;

#[test]
fn a14_markers_on_a_point_a_line_or_a_plane_or_mirrored_are_held() {
    let mut performance = Performance::of(&actor(), Stage::STILL);
    let shapes: [Spoil; 4] = [
        |_| PerformancePoint::new(1.0, 2.0, 3.0),
        |it| PerformancePoint::new(it.0.x, it.0.x, it.0.x),
        |it| PerformancePoint::new(it.0.x, it.0.y, 0.0),
        |it| PerformancePoint(Point3::new(-it.0.x, it.0.y, it.0.z)),
    ];
    for (k, shape) in shapes.iter().enumerate() {
        for position in performance.frames[100 + k].positions.iter_mut().flatten() {
            *position = shape(*position);
        }
    }
    let samples = solve(&performance, MarkerSettings::plain());
    for sample in &samples[100..104] {
        assert_eq!(sample.quality, Quality::Held);
        assert_eq!(
            sample.regions[1].held_reason,
            Some(HeldReason::DegeneratePose)
        );
        assert_eq!(sample.activations, samples[99].activations);
    }
    assert_eq!(samples[104].quality, Quality::Solved);
}

#[test]
fn exaggeration_is_found_up_to_two_when_it_is_allowed() {
    let actor = actor();
    let mut performance = Performance::of(&actor, Stage::STILL);
    let basis = frontalis_analysis::face::basis::MarkerBasis::at(&actor, actor.virtual_markers());
    let smile = actor.muscle_set().index_of("zygomatic_major_left").unwrap();
    let mut strong = performance.frames[20].clone();
    strong.index = FrameIndex(10_000);
    // The reference frame is neutral; its similarity is undone to add the displacement in model space.
    let mut plain = analyzer(&actor, MarkerSettings::plain());
    let mut exaggerated = analyzer(
        &actor,
        MarkerSettings {
            allow_exaggeration: true,
            ..MarkerSettings::plain()
        },
    );
    let mut samples = Vec::new();
    performance.frames.truncate(15);
    for frame in &performance.frames {
        plain.push(frame.clone(), &mut samples).unwrap();
        exaggerated.push(frame.clone(), &mut samples).unwrap();
    }
    let similarity = plain.alignment().unwrap().model_from_performance;
    for (j, position) in strong.positions.iter_mut().enumerate() {
        let mut model = similarity.to_model(position.unwrap());
        model.0 += 1.5 * basis.of_marker_cm(j)[smile];
        *position = Some(similarity.to_performance(model));
    }
    samples.clear();
    plain.push(strong.clone(), &mut samples).unwrap();
    exaggerated.push(strong, &mut samples).unwrap();
    assert!((samples[0].activations[smile] - 1.0).abs() < 1e-12);
    assert!((samples[1].activations[smile] - 1.5).abs() < 1e-6);
}

#[test]
fn alignment_waits_for_a_request_where_it_was_asked_to() {
    let performance = Performance::of(&actor(), Stage::STILL);
    let mut analyzer = analyzer(
        &actor(),
        MarkerSettings {
            align_on_request: true,
            ..MarkerSettings::plain()
        },
    );
    let mut samples = Vec::new();
    let first = analyzer.push(performance.frames[0].clone(), &mut samples);
    assert_eq!(first, Ok(Progress::Waiting));
    analyzer.recenter();
    for frame in &performance.frames[1..15] {
        let progress = analyzer.push(frame.clone(), &mut samples).unwrap();
        assert!(matches!(progress, Progress::Collecting { wanted: 15, .. }));
    }
    let last = analyzer.push(performance.frames[15].clone(), &mut samples);
    assert_eq!(last, Ok(Progress::Aligned));
    assert_eq!(samples.len(), 15);
    assert_eq!(samples[0].frame, FrameIndex(2));
}

#[test]
fn the_same_frames_give_the_same_bits() {
    let stage = Stage {
        moving_head: true,
        noise_cm: 0.03,
        occluded: 0.1,
        ..Stage::STILL
    };
    let performance = Performance::of(&actor(), stage);
    let [first, second] = [(); 2].map(|()| solve(&performance, MarkerSettings::plain()));
    assert_eq!(first, second);
}

#[test]
fn an_analyzer_that_need_not_wait_any_more_aligns_on_the_next_frames() {
    let performance = Performance::of(&actor(), Stage::STILL);
    let waiting = MarkerSettings {
        align_on_request: true,
        ..MarkerSettings::plain()
    };
    let mut analyzer = analyzer(&actor(), waiting);
    let mut samples = Vec::new();
    let first = analyzer.push(performance.frames[0].clone(), &mut samples);
    assert_eq!(first, Ok(Progress::Waiting));
    analyzer.update(actor(), MarkerSettings::plain());
    for frame in &performance.frames[1..16] {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    assert!(analyzer.alignment().is_some());
    assert_eq!(samples.len(), 15);
}
