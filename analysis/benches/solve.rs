//! CPU time of a whole frame of 27 markers and 16 muscles, one thread: alignment, displacement, contraction, marker error.

use std::{hint::black_box, sync::Arc};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, RegionMode},
    face::marker::MarkerFrame,
    marker_analysis::{alignment::Alignment, contraction::ContractionSolver, neutral},
    space::LengthUnit,
    synthesis::reference_face,
};

mod cpu_clock;
#[path = "../tests/support/performance.rs"]
mod performance;

use performance::{NEUTRAL_FRAMES, Performance, Stage};

fn main() {
    let product = cpu_clock::matrix_vector_nanos();
    cpu_clock::print_row("bare matrix-vector product, 81 x 16", product, product);
    for (mode, stabilize_head, name) in [
        (
            RegionMode::Split,
            false,
            "plain QP, regions split, fixed head",
        ),
        (
            RegionMode::Joint,
            false,
            "plain QP, regions joint, fixed head",
        ),
        (RegionMode::Joint, true, "joint with head pose (default)"),
        (
            RegionMode::Split,
            true,
            "regions split, pose from the joint problem",
        ),
    ] {
        let settings = MarkerSettings {
            region_mode: mode,
            stabilize_head,
            ..MarkerSettings::default()
        };
        cpu_clock::print_row(name, solver_nanos(&settings), product);
    }
    let whole = analyzer_nanos();
    cpu_clock::print_row("default, with its sample", whole, product);
    let alignment = alignment_nanos();
    cpu_clock::print_row("alignment of 15 neutral frames, once", alignment, product);
}

/// A performance with noise, so that every frame has work to do.
fn performance(
    moving_head: bool,
) -> (
    Arc<frontalis_analysis::face::actor::Actor>,
    Vec<MarkerFrame>,
) {
    let mut parts = reference_face::actor_parts();
    parts.markers.retain(|(marker, _)| !marker.head_fixed);
    let (actor, _) = frontalis_analysis::face::actor::Actor::new(
        parts,
        frontalis_analysis::face::actor::RankPolicy::Refuse,
    )
    .expect("the reference face is an actor");
    let stage = Stage {
        moving_head,
        noise_cm: 0.02,
        ..Stage::STILL
    };
    let frames = Performance::of(&actor, stage).frames;
    (Arc::new(actor), frames)
}

fn solver_nanos(settings: &MarkerSettings) -> f64 {
    let (actor, frames) = performance(settings.stabilize_head);
    let neutral_frames: Vec<_> = frames[..NEUTRAL_FRAMES]
        .iter()
        .map(|it| it.positions.as_slice())
        .collect();
    let neutral = neutral::average(&neutral_frames);
    let alignment = Alignment::find(&actor, &neutral, LengthUnit::Centimeter)
        .expect("the performance starts neutral");
    let mut solver = ContractionSolver::new(&actor, &alignment, settings, 60.0);
    let pass = cpu_clock::median_nanos(|| {
        for frame in &frames {
            solver.solve(black_box(&frame.positions));
        }
        black_box(&solver);
    });
    pass / frames.len() as f64
}

fn analyzer_nanos() -> f64 {
    let (actor, frames) = performance(true);
    let mut samples = Vec::with_capacity(2 * NEUTRAL_FRAMES);
    let unit = LengthUnit::Centimeter;
    let mut analyzer = MarkerAnalyzer::new(actor, MarkerSettings::default(), unit, 60.0);
    let pass = cpu_clock::median_nanos(|| {
        for frame in &frames {
            samples.clear();
            analyzer
                .push(frame.clone(), &mut samples)
                .expect("the performance starts neutral");
            black_box(&samples);
        }
    });
    pass / frames.len() as f64
}

/// Aligning the reference face once: registration of the neutral frames, projection, similarity.
fn alignment_nanos() -> f64 {
    let (actor, frames) = performance(true);
    let positions: Vec<_> = frames[..15]
        .iter()
        .map(|it| it.positions.as_slice())
        .collect();
    cpu_clock::median_nanos(|| {
        let neutral = neutral::average(&positions);
        let found = Alignment::find(&actor, &neutral, LengthUnit::Centimeter);
        black_box(found).expect("the performance starts neutral");
    })
}
