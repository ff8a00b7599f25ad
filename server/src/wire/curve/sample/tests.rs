//! Samples with everything, and with nothing that was not asked for.

use frontalis_analysis::{
    curve::MarkerTrace,
    face::{marker::FrameIndex, region::FaceRegion},
};

use super::*;

fn published(change: impl FnOnce(&mut CurveSample)) -> PublishedSample {
    let report = |region| RegionReport {
        region,
        marker_error_cm: 0.02,
        n_markers: 11,
        quality: Quality::Solved,
        held_reason: None,
        quality_fraction: 1.0,
    };
    let mut sample = CurveSample {
        frame: FrameIndex(7),
        capture_time_nanos: 116_666_667,
        activations: vec![0.25, 1.0],
        standard_errors: vec![0.01, 0.5],
        quality: Quality::Solved,
        held_frames: 0,
        regions: FaceRegion::ALL.map(report),
        head: None,
        unobserved: Vec::new(),
        outliers: Vec::new(),
        relabeled: Vec::new(),
        markers: MarkerTrace::default(),
        kkt_residual: 0.0,
    };
    change(&mut sample);
    PublishedSample {
        sequence: 3,
        sample,
        tag: SampleTag::default(),
        solved_time_nanos: 1,
        actor_revision: 1,
    }
}

fn flags_of(change: impl FnOnce(&mut CurveSample)) -> Vec<v1::SampleFlag> {
    let wire = sample_to_wire(&published(change), SampleDetail::default());
    wire.flags().collect()
}

#[test]
fn standard_errors_are_sent_to_those_who_asked() {
    let published = published(|_| {});
    let bare = sample_to_wire(&published, SampleDetail::default());
    assert!(bare.standard_errors.is_empty());
    let detail = SampleDetail {
        with_uncertainty: true,
        ..SampleDetail::default()
    };
    let full = sample_to_wire(&published, detail);
    assert_eq!(full.standard_errors, [0.01, 0.5]);
    assert_eq!(full.activations, bare.activations);
}

#[test]
fn outliers_are_flagged_and_named_and_swapped_labels_flagged() {
    assert_eq!(flags_of(|_| {}), []);
    assert_eq!(
        flags_of(|it| it.relabeled = vec![[3, 4]]),
        [v1::SampleFlag::Relabeled]
    );
    let outlying = published(|it| {
        it.outliers = vec![5, 26];
        it.relabeled = vec![[3, 4]];
    });
    let wire = sample_to_wire(&outlying, SampleDetail::default());
    assert_eq!(wire.outlier_markers, [5, 26]);
    let flags: Vec<_> = wire.flags().collect();
    assert_eq!(flags, [v1::SampleFlag::Outlier, v1::SampleFlag::Relabeled]);
}

#[test]
fn nothing_that_is_not_finite_leaves() {
    let broken = published(|it| {
        it.activations = vec![f64::NAN, f64::INFINITY];
        it.standard_errors = vec![f64::NEG_INFINITY, f64::NAN];
        it.regions[0].marker_error_cm = f64::NAN;
    });
    let detail = SampleDetail {
        with_uncertainty: true,
        with_markers: true,
    };
    let wire = sample_to_wire(&broken, detail);
    let numbers = wire.activations.iter().chain(&wire.standard_errors);
    assert!(numbers.copied().all(f32::is_finite), "{wire:?}");
    let json = serde_json::to_string(&wire).unwrap();
    assert!(!json.contains("null") && !json.contains("NaN"), "{json}");
}

#[test]
fn a_response_is_as_short_as_it_must_be_for_a_slow_reader() {
    let plain = SampleDetail::default();
    let full = SampleDetail {
        with_uncertainty: true,
        with_markers: true,
    };
    assert_eq!(samples_in_a_response(16, 27, plain), 47);
    assert_eq!(samples_in_a_response(16, 27, full), 16);
    assert_eq!(samples_in_a_response(64, 1_024, full), 1);
}
