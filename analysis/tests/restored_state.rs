//! An analyzer that is made from another one's state goes on bit for bit as that one does.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::sync::{Arc, LazyLock};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, MuscleBounds, Objective, RegionMode},
    curve::CurveSample,
    face::{
        actor::Actor,
        marker::{FrameIndex, MarkerFrame},
    },
    numeric::tape::TapeError,
    space::LengthUnit,
    synthesis::reference_face,
};

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

const RATE_HZ: f64 = 60.0;

/// The reference face, made once.
fn actor() -> Arc<Actor> {
    static ACTOR: LazyLock<Arc<Actor>> = LazyLock::new(|| Arc::new(reference_face::actor()));
    Arc::clone(&ACTOR)
}

fn analyzer(settings: &MarkerSettings) -> MarkerAnalyzer {
    let settings = settings.clone();
    MarkerAnalyzer::new(actor(), settings, LengthUnit::Centimeter, RATE_HZ)
}

/// An analyzer from the state of this one.
fn restored(from: &mut MarkerAnalyzer, settings: &MarkerSettings) -> MarkerAnalyzer {
    let (state, alignment) = (from.state(), from.alignment().cloned());
    let (unit, settings) = (LengthUnit::Centimeter, settings.clone());
    MarkerAnalyzer::restore(actor(), settings, unit, RATE_HZ, alignment, state).unwrap()
}

/// A noisy take with a moving head, hidden markers, a head that vanishes for longer than its pose lasts, skipped numbers,
/// wrong and swapped markers.
fn frames() -> Vec<MarkerFrame> {
    let stage = Stage {
        n_frames: 300,
        rate_hz: RATE_HZ,
        moving_head: true,
        noise_cm: 0.03,
        occluded: 0.02,
        seed: 5,
    };
    let mut frames = Performance::of(&actor(), stage).frames;
    for (k, frame) in frames.iter_mut().enumerate() {
        let skipped = if k >= 120 { 7 } else { 0 };
        frame.index = FrameIndex(k as u64 + 1 + skipped);
        match k {
            90..95 => frame.positions.iter_mut().skip(9).for_each(|it| *it = None),
            140..170 => frame.positions.fill(None),
            200 => frame.positions.swap(3, 8),
            60..62 | 230 => {
                if let Some(it) = &mut frame.positions[4] {
                    it.0.x += 3.0;
                }
            }
            _ => {}
        }
    }
    frames
}

fn push(analyzer: &mut MarkerAnalyzer, frame: &MarkerFrame, samples: &mut Vec<CurveSample>) {
    let _progress = analyzer.push(frame.clone(), samples);
}

/// The trace is for display: what it says of hidden regions is not compared.
fn without_traces(samples: &[CurveSample]) -> Vec<CurveSample> {
    let bare = |it: &CurveSample| CurveSample {
        markers: frontalis_analysis::curve::MarkerTrace::default(),
        ..it.clone()
    };
    samples.iter().map(bare).collect()
}

/// What happens to an analyzer before a frame.
fn requests(k: usize, analyzer: &mut MarkerAnalyzer) {
    match k {
        105 | 258 => analyzer.recenter(),
        215 => drop(analyzer.recenter_on_quietest()),
        _ => {}
    }
}

/// Restores before every `step`th frame, each time from the restored one and from the first alike.
fn check(settings: &MarkerSettings, step: usize) {
    let frames = frames();
    let (mut live, mut other) = (analyzer(settings), analyzer(settings));
    let (mut expected, mut found) = (Vec::new(), Vec::new());
    for (k, frame) in frames.iter().enumerate() {
        if k % step == 0 {
            other = restored(if k % 2 == 0 { &mut live } else { &mut other }, settings);
        }
        for (analyzer, samples) in [(&mut live, &mut expected), (&mut other, &mut found)] {
            requests(k, analyzer);
            push(analyzer, frame, samples);
        }
    }
    assert!(expected.len() > 200, "{}", expected.len());
    assert_eq!(without_traces(&found), without_traces(&expected));
    assert_eq!(other.state().len(), live.state().len());
}

#[test]
fn plain_curves_go_on_bit_for_bit() {
    for region_mode in [RegionMode::Joint, RegionMode::Split] {
        for stabilize_head in [true, false] {
            let settings = MarkerSettings {
                region_mode,
                stabilize_head,
                ..MarkerSettings::plain()
            };
            check(&settings, 13);
        }
    }
}

#[test]
fn curves_with_every_term_go_on_bit_for_bit() {
    for region_mode in [RegionMode::Joint, RegionMode::Split] {
        for stabilize_head in [true, false] {
            let settings = MarkerSettings {
                region_mode,
                stabilize_head,
                ..MarkerSettings::default()
            };
            check(&settings, 17);
        }
    }
    let objective = Objective {
        symmetry: 0.4,
        exclusive_pairs: vec![["frontalis_left".into(), "corrugator_left".into()]],
        bounds: vec![MuscleBounds {
            muscle: "zygomatic_major_left".into(),
            lower: 0.1,
            upper: 0.7,
        }],
        ..Objective::default()
    };
    let settings = MarkerSettings {
        objective,
        neutral_frames: 3,
        ..MarkerSettings::default()
    };
    check(&settings, 1);
}

#[test]
fn a_state_of_other_settings_or_of_another_stage_is_refused() {
    let plain = MarkerSettings::plain();
    let mut analyzer = analyzer(&plain);
    let mut samples = Vec::new();
    for frame in &frames()[..40] {
        push(&mut analyzer, frame, &mut samples);
    }
    let state = analyzer.state();
    let restore = |settings: &MarkerSettings, alignment| {
        let (unit, settings) = (LengthUnit::Centimeter, settings.clone());
        MarkerAnalyzer::restore(actor(), settings, unit, RATE_HZ, alignment, state.clone()).err()
    };
    let alignment = analyzer.alignment().cloned();
    assert_eq!(restore(&plain, alignment.clone()), None);
    let without = restore(&plain, None).unwrap();
    assert!(matches!(without, TapeError::Value { name } if name == "stage"));
    let other = restore(&MarkerSettings::default(), alignment).unwrap();
    assert!(matches!(other, TapeError::Name { .. }), "{other}");
}
