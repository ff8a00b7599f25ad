//! Whatever frames come, the analysis goes on: nothing panics, loops or leaves the boxes.

use std::sync::{Arc, LazyLock};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Objective, RegionMode},
    curve::CurveSample,
    face::{
        actor::Actor,
        marker::{FrameIndex, MarkerFrame},
    },
    space::{LengthUnit, PerformancePoint},
    synthesis::reference_face,
};
use proptest::prelude::*;

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

fn actor() -> Arc<Actor> {
    static ACTOR: LazyLock<Arc<Actor>> = LazyLock::new(|| Arc::new(reference_face::actor()));
    Arc::clone(&ACTOR)
}

/// What is done to one marker of one frame.
#[derive(Clone, Debug)]
enum Harm {
    Hidden,
    /// To any place of the volume, and of numbers: the wire admits ±10 m.
    Moved([f64; 3]),
    /// To where another marker is.
    On(usize),
    Swapped(usize),
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1000.0..1000.0,
        Just(0.0),
        Just(-0.0),
        Just(f64::MIN_POSITIVE / 4.0),
        Just(1000.0),
    ]
}

fn harm() -> impl Strategy<Value = Harm> {
    prop_oneof![
        3 => Just(Harm::Hidden),
        3 => prop::array::uniform3(coordinate()).prop_map(Harm::Moved),
        1 => (0..32_usize).prop_map(Harm::On),
        2 => (0..32_usize).prop_map(Harm::Swapped),
    ]
}

fn settings() -> impl Strategy<Value = MarkerSettings> {
    let strength = || prop_oneof![Just(0.0), Just(0.5), Just(1.0), 0.0..1.0];
    let objective = (any::<bool>(), strength(), strength(), strength());
    (any::<bool>(), any::<bool>(), any::<bool>(), objective).prop_map(
        |(split, stabilize_head, allow_exaggeration, (robust, smoothing, sparsity, symmetry))| {
            MarkerSettings {
                region_mode: if split {
                    RegionMode::Split
                } else {
                    RegionMode::Joint
                },
                stabilize_head,
                allow_exaggeration,
                objective: Objective {
                    robust,
                    smoothing,
                    sparsity,
                    symmetry,
                    exclusive_pairs: vec![
                        ["jaw_rotation", "lips_pressor"].map(str::to_owned),
                        ["jaw_rotation", "risorius_left"].map(str::to_owned),
                    ],
                    ..Objective::plain()
                },
                ..MarkerSettings::default()
            }
        },
    )
}

fn spoil(frame: &mut MarkerFrame, harms: &[(usize, Harm)]) {
    for (j, harm) in harms {
        match harm {
            Harm::Hidden => frame.positions[*j] = None,
            Harm::Moved([x, y, z]) => {
                frame.positions[*j] = Some(PerformancePoint::new(*x, *y, *z));
            }
            Harm::On(other) => frame.positions[*j] = frame.positions[*other],
            Harm::Swapped(other) => frame.positions.swap(*j, *other),
        }
    }
}

fn check(sample: &CurveSample, upper: f64) {
    let in_box = |it: &f64| (-1e-9..=upper + 1e-9).contains(it);
    assert!(sample.activations.iter().all(in_box), "{sample:?}");
    assert!(
        sample
            .standard_errors
            .iter()
            .all(|it| it.is_finite() && *it >= 0.0)
    );
    assert!(sample.kkt_residual <= 1e-9, "{:e}", sample.kkt_residual);
    for region in &sample.regions {
        assert!(region.marker_error_cm.is_finite());
    }
    if let Some(head) = sample.head {
        assert!(head.translation_cm.iter().all(|it| it.is_finite()));
        let matrix = head.rotation.to_rotation_matrix();
        assert!((matrix.matrix().determinant() - 1.0).abs() < 1e-6);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn nothing_that_frames_hold_breaks_the_analysis(
        settings in settings(),
        seed in 0..1_000_u64,
        spoiled in prop::collection::vec(
            (20..60_usize, prop::collection::vec((0..32_usize, harm()), 0..40)),
            0..30,
        ),
        jumps in prop::collection::vec((0..60_usize, any::<u64>()), 0..3),
    ) {
        let stage = Stage { n_frames: 60, moving_head: true, noise_cm: 0.05, seed, ..Stage::STILL };
        let mut frames = Performance::of(&actor(), stage).frames;
        for (k, harms) in &spoiled {
            spoil(&mut frames[*k], harms);
        }
        for (k, number) in jumps {
            frames[k].index = FrameIndex(number);
        }
        let upper = settings.upper_bound();
        let mut analyzer = MarkerAnalyzer::new(actor(), settings, LengthUnit::Centimeter, 60.0);
        let mut samples = Vec::new();
        for frame in frames {
            analyzer.push(frame, &mut samples).unwrap();
        }
        prop_assert!(samples.len() <= 60);
        for sample in &samples {
            check(sample, upper);
        }
        prop_assert_eq!(analyzer.ranges().len(), actor().muscle_set().len());
        let _doubt = analyzer.neutral_doubt();
        let _recentered = analyzer.recenter_on_quietest();
    }
}
