//! Any sequence of frames and requests, under any settings: the analysis goes on, inside its boxes.
#![no_main]

use std::sync::{Arc, LazyLock};

use arbitrary::Arbitrary;
use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Objective, RegionMode},
    face::{
        actor::Actor,
        basis::MarkerBasis,
        marker::{FrameIndex, MarkerFrame},
    },
    space::{LengthUnit, PerformancePoint},
    synthesis::reference_face,
};
use libfuzzer_sys::fuzz_target;

/// Beyond it the boundary rejects a coordinate, centimeters.
const VOLUME_CM: f64 = 1_000.0;

/// Steps of one run: enough to align, to be spoiled and to recover.
const MAX_STEPS: usize = 64;

#[derive(Arbitrary, Debug)]
struct Run {
    settings: Settings,
    rate_hz: u16,
    steps: Vec<Step>,
}

#[derive(Arbitrary, Debug)]
struct Settings {
    split: bool,
    fixed_head: bool,
    exaggeration: bool,
    robust: bool,
    strengths: [u8; 3],
    neutral_frames: u8,
}

#[derive(Arbitrary, Debug)]
enum Step {
    /// The neutral face, with noise from a few bytes.
    Frame { noise: [i8; 8], gap: u16 },
    /// A frame with one marker anywhere.
    Jump { marker: u8, to: [f32; 3] },
    /// A frame without the markers of a mask.
    Hidden { mask: u32 },
    Swapped { a: u8, b: u8 },
    Recenter,
    RecenterOnQuietest,
}

static ACTOR: LazyLock<(Arc<Actor>, MarkerBasis)> = LazyLock::new(|| {
    let actor = Arc::new(reference_face::actor());
    let basis = actor.marker_basis();
    (actor, basis)
});

fn settings(of: &Settings) -> MarkerSettings {
    let [smoothing, sparsity, symmetry] = of.strengths.map(|it| f64::from(it) / 255.0);
    MarkerSettings {
        neutral_frames: usize::from(of.neutral_frames % 16).max(1),
        allow_exaggeration: of.exaggeration,
        region_mode: if of.split {
            RegionMode::Split
        } else {
            RegionMode::Joint
        },
        stabilize_head: !of.fixed_head,
        align_on_request: false,
        objective: Objective {
            robust: of.robust,
            smoothing,
            sparsity,
            symmetry,
            ..Objective::plain()
        },
    }
}

fn neutral(noise: &[i8; 8]) -> Vec<Option<PerformancePoint>> {
    let places = ACTOR.1.neutral.iter().enumerate();
    let moved = places.map(|(j, place)| {
        let by = |axis: usize| f64::from(noise[(3 * j + axis) % noise.len()]) * 1e-2;
        let it = place.0;
        Some(PerformancePoint::new(it.x + by(0), it.y + by(1), it.z + by(2)))
    });
    moved.collect()
}

fuzz_target!(|run: Run| {
    let actor = Arc::clone(&ACTOR.0);
    let n = actor.markers().len();
    let settings = settings(&run.settings);
    let upper = settings.upper_bound();
    let rate_hz = f64::from(run.rate_hz.max(1));
    let mut analyzer = MarkerAnalyzer::new(actor, settings, LengthUnit::Centimeter, rate_hz);
    let mut samples = Vec::new();
    let mut index = 0_u64;
    for step in run.steps.iter().take(MAX_STEPS) {
        let mut positions = neutral(&[0; 8]);
        index += 1;
        match step {
            Step::Frame { noise, gap } => {
                positions = neutral(noise);
                index += u64::from(*gap);
            }
            Step::Jump { marker, to } => {
                let [x, y, z] = to.map(f64::from);
                let is_admitted = |it: &f64| it.is_finite() && it.abs() <= VOLUME_CM;
                if [x, y, z].iter().all(is_admitted) {
                    positions[usize::from(*marker) % n] = Some(PerformancePoint::new(x, y, z));
                }
            }
            Step::Hidden { mask } => {
                for (j, it) in positions.iter_mut().enumerate() {
                    if mask >> (j % 32) & 1 == 1 {
                        *it = None;
                    }
                }
            }
            Step::Swapped { a, b } => positions.swap(usize::from(*a) % n, usize::from(*b) % n),
            Step::Recenter => analyzer.recenter(),
            Step::RecenterOnQuietest => {
                let _refused = analyzer.recenter_on_quietest();
            }
        }
        let frame = MarkerFrame {
            index: FrameIndex(index),
            capture_time_nanos: 0,
            positions,
        };
        let _refused = analyzer.push(frame, &mut samples);
    }
    for sample in &samples {
        assert!(sample.activations.iter().all(|it| (-1e-9..=upper + 1e-9).contains(it)));
        assert!(sample.standard_errors.iter().all(|it| it.is_finite()));
        assert!(sample.kkt_residual <= 1e-9);
    }
});
