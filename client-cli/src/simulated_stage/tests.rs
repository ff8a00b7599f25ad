//! The stage as a whole: how precisely it observes, that it repeats itself, and what it refuses.

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, RegionMode},
    face::marker::{FrameIndex, MarkerFrame},
    space::LengthUnit,
    synthesis::reference_face,
};

use super::*;

fn stage(settings: StageSettings) -> SimulatedStage {
    SimulatedStage::new(Arc::new(reference_face::actor()), settings).unwrap()
}

/// Root mean square distance of the observed markers from the true ones, millimeters, and the share that is observed.
fn accuracy(settings: StageSettings) -> (f64, f64) {
    let (mut squared_cm2, mut n_observed, mut n_markers) = (0.0, 0, 0);
    for frame in stage(settings) {
        n_markers += frame.positions.len();
        for (observed, truth) in frame.positions.iter().zip(&frame.true_positions) {
            if let Some(observed) = observed {
                squared_cm2 += (observed.0 - truth.0).norm_squared();
                n_observed += 1;
            }
        }
    }
    let rms_mm = 10.0 * (squared_cm2 / f64::from(n_observed)).sqrt();
    (rms_mm, f64::from(n_observed) / n_markers as f64)
}

#[test]
fn five_cameras_at_a_third_of_a_pixel_find_markers_within_a_third_of_a_millimeter() {
    let minute = StageSettings {
        seconds: 60.0,
        ..StageSettings::default()
    };
    let (rms_mm, observed) = accuracy(minute);
    println!(
        "five cameras, 0.3 px, 3 % misses: 3D RMS {rms_mm:.3} mm, {:.2} % of markers observed",
        100.0 * observed
    );
    assert!(rms_mm <= 0.3, "{rms_mm} mm");
    assert!(observed > 0.98, "{observed}");
}

#[test]
fn without_noise_the_cameras_find_every_marker_where_it_is() {
    let exact = StageSettings {
        pixel_noise: 0.0,
        misses: 0.0,
        ..StageSettings::default()
    };
    let (rms_mm, observed) = accuracy(exact);
    assert!(rms_mm < 1e-9, "{rms_mm} mm");
    assert!(observed > 0.99, "{observed}");
}

#[test]
fn two_cameras_see_less_and_worse_and_blind_ones_nothing() {
    let with = |cameras, misses| {
        accuracy(StageSettings {
            cameras,
            misses,
            ..StageSettings::default()
        })
    };
    let ((five_mm, five_observed), (two_mm, two_observed)) = (with(5, 0.03), with(2, 0.03));
    println!(
        "two cameras, 0.3 px: 3D RMS {two_mm:.3} mm, {:.2} % observed",
        100.0 * two_observed
    );
    assert!(two_mm > five_mm && two_observed < five_observed);
    assert!(two_observed > 0.5, "{two_observed}");
    assert_eq!(with(5, 1.0).1.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn a_seed_is_a_performance_whatever_the_cameras() {
    let frames = |seed, cameras| -> Vec<StageFrame> {
        stage(StageSettings {
            seed,
            cameras,
            seconds: 3.0,
            ..StageSettings::default()
        })
        .collect()
    };
    assert_eq!(frames(5, 5), frames(5, 5));
    assert_ne!(frames(5, 5), frames(6, 5));
    let truths = |frames: Vec<StageFrame>| -> Vec<Vec<f64>> {
        frames.into_iter().map(|it| it.truth).collect()
    };
    assert_eq!(truths(frames(5, 5)), truths(frames(5, 3)));
}

#[test]
fn frames_count_from_one_at_the_rate_and_begin_neutral() {
    let settings = StageSettings {
        rate_hz: 120.0,
        seconds: 2.0,
        ..StageSettings::default()
    };
    assert_eq!(stage(settings).size_hint(), (240, Some(240)));
    for (at, frame) in stage(settings).enumerate() {
        assert_eq!(frame.number, at as u64 + 1);
        assert_eq!(frame.capture_time_nanos, nanos(at as f64 / 120.0));
        assert_eq!((frame.positions.len(), frame.truth.len()), (32, 16));
        assert!(at > 120 || frame.truth.iter().all(|it| *it == 0.0));
    }
}

#[test]
fn the_stage_is_elsewhere_and_turned_but_of_the_same_size() {
    let first = stage(StageSettings::default()).next().unwrap();
    let actor = reference_face::actor();
    let in_model: Vec<_> = actor
        .virtual_markers()
        .iter()
        .map(|it| it.position(actor.mesh()))
        .collect();
    assert!(
        first
            .true_positions
            .iter()
            .all(|it| it.0.coords.norm() > 100.0)
    );
    for (at, model) in in_model.iter().enumerate() {
        let on_stage = (first.true_positions[at].0 - first.true_positions[0].0).norm();
        assert!((on_stage - (model.0 - in_model[0].0).norm()).abs() < 1e-9);
        let offset = first.true_positions[at].0 - model.0;
        assert!(offset.norm() > 50.0);
    }
}

#[test]
fn settings_outside_their_range_are_refused_by_name() {
    let refused = |change: fn(&mut StageSettings)| {
        let mut settings = StageSettings::default();
        change(&mut settings);
        let actor = Arc::new(reference_face::actor());
        SimulatedStage::new(actor, settings)
            .err()
            .unwrap()
            .to_string()
    };
    assert_eq!(
        refused(|it| it.rate_hz = 0.0),
        "rate_hz is 0, and must be from 1 to 1000"
    );
    assert!(refused(|it| it.seconds = f64::INFINITY).starts_with("seconds is inf"));
    assert!(refused(|it| it.pixel_noise = f64::NAN).starts_with("pixel_noise is NaN"));
    assert!(refused(|it| it.misses = -0.1).starts_with("misses is -0.1"));
    assert_eq!(refused(|it| it.cameras = 1), "1 cameras, a rig has 2 to 32");
}

/// Root mean square error of the activations that the analysis finds, over all muscles and frames.
fn activation_error(stage: SimulatedStage, rate_hz: f64, region_mode: RegionMode) -> f64 {
    let settings = MarkerSettings {
        region_mode,
        ..MarkerSettings::default()
    };
    let actor = Arc::clone(stage.actor());
    let mut analyzer = MarkerAnalyzer::new(actor, settings, LengthUnit::Millimeter, rate_hz);
    let (mut truths, mut samples) = (Vec::new(), Vec::new());
    for frame in stage {
        truths.push(frame.truth);
        let frame = MarkerFrame {
            index: FrameIndex(frame.number),
            capture_time_nanos: frame.capture_time_nanos,
            positions: frame.positions,
        };
        analyzer.push(frame, &mut samples).unwrap();
    }
    assert_eq!(samples.len(), truths.len());
    let differences = (samples.iter().zip(&truths))
        .flat_map(|(sample, truth)| sample.activations.iter().zip(truth))
        .map(|(found, truth)| found - truth);
    let n = differences.clone().count();
    (differences.map(|it| it * it).sum::<f64>() / n as f64).sqrt()
}

#[test]
fn the_analysis_finds_the_performance_again() {
    let minute = StageSettings {
        seconds: 60.0,
        ..StageSettings::default()
    };
    let error = |mode| activation_error(stage(minute), minute.rate_hz, mode);
    let (joint, split) = (error(RegionMode::Joint), error(RegionMode::Split));
    println!(
        "activations, five cameras, 0.3 px, moving head: RMS error {joint:.4} joint, {split:.4} split"
    );
    assert!(joint <= 0.03, "{joint}");
}
