//! CPU time of a whole frame, one thread: alignment, displacement, contraction, marker error.

use std::{hint::black_box, sync::Arc};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, RegionMode},
    face::{
        actor::{Actor, RankPolicy},
        marker::MarkerFrame,
    },
    marker_analysis::{alignment::Alignment, contraction::ContractionSolver, neutral},
    space::LengthUnit,
    synthesis::reference_face,
};

mod cpu_clock;
#[path = "../tests/support/performance.rs"]
mod performance;
#[path = "../tests/support/production_face.rs"]
mod production_face;

use performance::{NEUTRAL_FRAMES, Performance, Stage};

fn main() {
    let product = cpu_clock::matrix_vector_nanos();
    cpu_clock::print_row("bare matrix-vector product, 81 x 16", product, product);
    let floor = cpu_clock::projection_and_product_nanos();
    cpu_clock::print_row(
        "projection by region and one 16 x 16 product",
        floor,
        product,
    );
    let split = solver_nanos(&reference_face(), &plain(RegionMode::Split, false));
    cpu_clock::print_row("27 x 16 plain, regions split, fixed head", split, product);
    println!("{:>74.2} x projection and product", split / floor);
    for (mode, stabilize_head, name) in [
        (
            RegionMode::Joint,
            false,
            "27 x 16 plain, regions joint, fixed head",
        ),
        (
            RegionMode::Joint,
            true,
            "27 x 16 plain, joint with head pose",
        ),
        (
            RegionMode::Split,
            true,
            "27 x 16 plain, split, pose from the joint problem",
        ),
    ] {
        let nanos = solver_nanos(&reference_face(), &plain(mode, stabilize_head));
        cpu_clock::print_row(name, nanos, product);
    }
    for (n, m) in [(60, 52), (300, 150)] {
        let actor = production_face::actor(n, m, 3);
        for (stabilize_head, head) in [(false, "fixed head"), (true, "head pose")] {
            let nanos = solver_nanos(&actor, &plain(RegionMode::Joint, stabilize_head));
            let name = format!("{n} x {m} plain, joint, {head}");
            cpu_clock::print_row(&name, nanos, product);
        }
    }
    let nanos = solver_nanos(&reference_face(), &MarkerSettings::default());
    cpu_clock::print_row("27 x 16 default", nanos, product);
    let nanos = solver_nanos(
        &production_face::actor(60, 52, 3),
        &MarkerSettings::default(),
    );
    cpu_clock::print_row("60 x 52 default", nanos, product);
    let whole = analyzer_nanos();
    cpu_clock::print_row("default, with its sample", whole, product);
    let alignment = alignment_nanos();
    cpu_clock::print_row("alignment of 15 neutral frames, once", alignment, product);
}

/// The reference face without its head-fixed markers.
fn reference_face() -> Actor {
    let mut parts = reference_face::actor_parts();
    parts.markers.retain(|(marker, _)| !marker.head_fixed);
    let (actor, _) = Actor::new(parts, RankPolicy::Refuse).expect("the reference face is an actor");
    actor
}

fn plain(region_mode: RegionMode, stabilize_head: bool) -> MarkerSettings {
    MarkerSettings {
        region_mode,
        stabilize_head,
        ..MarkerSettings::plain()
    }
}

/// A performance with noise, so that every frame has work to do.
fn performance(actor: &Actor, moving_head: bool) -> Vec<MarkerFrame> {
    let stage = Stage {
        moving_head,
        noise_cm: 0.02,
        ..Stage::STILL
    };
    Performance::of(actor, stage).frames
}

fn solver_nanos(actor: &Actor, settings: &MarkerSettings) -> f64 {
    let frames = performance(actor, settings.stabilize_head);
    let neutral_frames: Vec<_> = frames[..NEUTRAL_FRAMES]
        .iter()
        .map(|it| it.positions.as_slice())
        .collect();
    let neutral = neutral::average(&neutral_frames);
    let alignment = Alignment::find(actor, &neutral, LengthUnit::Centimeter)
        .expect("the performance starts neutral");
    let mut solver = ContractionSolver::new(actor, &alignment, settings, 60.0);
    let pass = cpu_clock::median_nanos(|| {
        for frame in &frames {
            solver.solve(black_box(&frame.positions));
        }
        black_box(&solver);
    });
    pass / frames.len() as f64
}

fn analyzer_nanos() -> f64 {
    let actor = Arc::new(reference_face());
    let frames = performance(&actor, true);
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
    let actor = reference_face();
    let frames = performance(&actor, true);
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
