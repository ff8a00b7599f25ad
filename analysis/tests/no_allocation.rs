//! After its first frames a session solves without allocating memory.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use frontalis_analysis::{
    face::actor::Actor,
    marker_analysis::{
        alignment::Alignment,
        contraction::ContractionSolver,
        neutral,
        objective::Objective,
        settings::{MarkerSettings, RegionMode},
    },
    space::{LengthUnit, PerformancePoint},
    synthesis::reference_face,
};

#[path = "support/performance.rs"]
mod performance;

use performance::{NEUTRAL_FRAMES, Performance, Stage};

fn solver(
    actor: &Actor,
    performance: &Performance,
    settings: &MarkerSettings,
) -> ContractionSolver {
    let neutral_frames: Vec<&[Option<PerformancePoint>]> = performance.frames[..NEUTRAL_FRAMES]
        .iter()
        .map(|it| it.positions.as_slice())
        .collect();
    let neutral = neutral::average(&neutral_frames);
    let alignment = Alignment::find(actor, &neutral, LengthUnit::Centimeter).unwrap();
    ContractionSolver::new(actor, &alignment, settings, 60.0)
}

/// Allocations of all frames but the first, with the lid's marker hidden or not.
fn allocations(actor: &Actor, settings: &MarkerSettings, hidden: bool) -> u64 {
    let stage = Stage {
        moving_head: settings.stabilize_head,
        noise_cm: 0.02,
        ..Stage::STILL
    };
    let mut performance = Performance::of(actor, stage);
    let mut solver = solver(actor, &performance, settings);
    let lid = actor.marker_index("lid_left").unwrap();
    for frame in &mut performance.frames {
        if hidden {
            frame.positions[lid] = None;
        }
    }
    let (first, others) = performance.frames.split_first().unwrap();
    solver.solve(&first.positions);
    let counted = allocation_counter::measure(|| {
        for frame in others {
            solver.solve(&frame.positions);
        }
    });
    counted.count_total
}

#[test]
fn no_frame_after_the_first_allocates() {
    let actor = reference_face::actor();
    for region_mode in [RegionMode::Joint, RegionMode::Split] {
        for stabilize_head in [false, true] {
            for objective in [Objective::plain(), Objective::default()] {
                let settings = MarkerSettings {
                    region_mode,
                    stabilize_head,
                    objective,
                    ..MarkerSettings::default()
                };
                for hidden in [false, true] {
                    let counted = allocations(&actor, &settings, hidden);
                    assert_eq!(counted, 0, "{settings:?}, a marker hidden: {hidden}");
                }
            }
        }
    }
}
