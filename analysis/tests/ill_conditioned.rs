//! Shapes that the markers hardly tell apart are refused at import by name, or solved as exactly as any others.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::sync::Arc;

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings},
    face::actor::{Actor, ActorError, ActorParts, RankPolicy},
    space::LengthUnit,
    synthesis::reference_face,
};

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

/// The second of them is drawn like the first.
const ALIKE: [&str; 2] = ["zygomatic_major_left", "risorius_left"];

/// Largest KKT residual that any frame may have, relative to the largest diagonal entry of Q.
const KKT_LIMIT: f64 = 1e-10;

/// The reference face with two shapes that differ by about `difference` of their size.
fn drawn_alike(difference: f64) -> ActorParts {
    let mut parts = reference_face::actor_parts();
    let index = |name| parts.muscles.iter().position(|it| it.name == name);
    let [first, second] = ALIKE.map(|it| index(it).unwrap());
    let shapes = &mut parts.basis.displacements_cm;
    let first = shapes[first].clone();
    for (own, like) in shapes[second].iter_mut().zip(first) {
        *own = like + difference * *own;
    }
    parts
}

#[test]
fn two_shapes_that_cannot_be_told_apart_are_refused_by_name() {
    let error = Actor::new(drawn_alike(1e-3), RankPolicy::Refuse).unwrap_err();
    let ActorError::BasisRank { columns, condition } = &error else {
        panic!("{error}");
    };
    let mut named: Vec<_> = columns.iter().map(String::as_str).collect();
    named.sort_unstable();
    let mut alike = ALIKE;
    alike.sort_unstable();
    assert_eq!(named, alike);
    // Of Q it is the square.
    assert!(condition * condition > 4e6, "{condition:e}");
}

#[test]
fn an_ill_conditioned_basis_that_is_accepted_is_reported_and_solved_to_the_same_limit() {
    // Just told apart, and beyond it, where the artist insists.
    for (difference, policy, least_condition) in [
        (1e-2, RankPolicy::Refuse, 1e6),
        (1e-3, RankPolicy::Regularize, 4e6),
    ] {
        let (actor, _) = Actor::new(drawn_alike(difference), policy).unwrap();
        let report = actor.basis_report();
        let name = |it: usize| actor.muscle_set().muscles()[it].name.as_str();
        let worst = &report.ambiguous[0];
        let pair = [name(worst.first), name(worst.second)];
        assert!(ALIKE.iter().all(|it| pair.contains(it)), "{pair:?}");
        let condition = report.condition_lower;
        assert!(condition > least_condition, "{condition:e}");
        let actor = Arc::new(actor);
        for settings in [MarkerSettings::default(), MarkerSettings::plain()] {
            let worst = largest_kkt_residual(&actor, settings);
            println!("condition {condition:.1e}: largest KKT residual {worst:.1e}");
            assert!(worst <= KKT_LIMIT, "condition {condition:e}: {worst:e}");
        }
    }
}

/// Over a performance with noise and a moving head; every frame must be solved.
fn largest_kkt_residual(actor: &Arc<Actor>, settings: MarkerSettings) -> f64 {
    let stage = Stage {
        n_frames: 240,
        moving_head: true,
        noise_cm: 0.03,
        seed: 5,
        ..Stage::STILL
    };
    let mut samples = Vec::new();
    let unit = LengthUnit::Centimeter;
    let mut analyzer = MarkerAnalyzer::new(Arc::clone(actor), settings, unit, stage.rate_hz);
    for frame in Performance::of(actor, stage).frames {
        analyzer.push(frame, &mut samples).unwrap();
    }
    assert_eq!(samples.len(), stage.n_frames);
    for sample in &samples {
        let held = sample
            .regions
            .iter()
            .filter_map(|it| it.held_reason)
            .count();
        assert_eq!(held, 0, "frame {:?}", sample.frame);
        assert!(sample.activations.iter().all(|it| (0.0..=1.0).contains(it)));
        assert!(sample.standard_errors.iter().all(|it| it.is_finite()));
    }
    let residuals = samples.iter().map(|it| it.kkt_residual);
    residuals.fold(0.0, f64::max)
}
