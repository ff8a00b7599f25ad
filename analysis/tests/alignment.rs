//! Coordinate alignment: what projection mends, and what it refuses.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use frontalis_analysis::{
    face::{
        actor::{Actor, MarkerPlace, RankPolicy},
        marker::MarkerFrame,
    },
    marker_analysis::{
        alignment::{Alignment, AlignmentError},
        neutral,
    },
    space::{LengthUnit, ModelPoint, PerformancePoint},
    synthesis::reference_face,
};
use nalgebra::{Point3, Vector3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

#[path = "support/performance.rs"]
mod performance;

use performance::{NEUTRAL_FRAMES, Performance, Stage};

/// The reference face with every marker put down by a hand that errs by `error_cm` (RMS) along the surface.
fn hand_marked(error_cm: f64, rng: &mut Pcg64) -> Actor {
    let exact = reference_face::actor();
    let mut parts = reference_face::actor_parts();
    for ((_, place), truth) in parts.markers.iter_mut().zip(exact.virtual_markers()) {
        let at = truth.position(exact.mesh()).0;
        let wrong = at + Vector3::from_fn(|_, _| error_cm * rng.random_range(-1.0..1.0));
        // Only the neighborhood of the marker: the hand does not put an upper lip's marker on the lower lip.
        let near = exact.mesh().neighborhood(truth.triangle, 1.5);
        let foot = exact
            .mesh()
            .closest_point_among(ModelPoint(wrong), near)
            .unwrap();
        *place = MarkerPlace::OnTriangle(foot.place);
    }
    Actor::new(parts, RankPolicy::Refuse).unwrap().0
}

fn neutral_of(actor: &Actor, noise_cm: f64, seed: u64) -> neutral::Neutral {
    let stage = Stage {
        n_frames: NEUTRAL_FRAMES,
        noise_cm,
        moving_head: true,
        seed,
        ..Stage::STILL
    };
    let frames = Performance::of(actor, stage).frames;
    let positions: Vec<_> = frames[..15]
        .iter()
        .map(|it: &MarkerFrame| it.positions.as_slice())
        .collect();
    neutral::average(&positions)
}

/// RMS distance of the virtual markers of `alignment` from where they truly are, centimeters.
fn rms_error_cm(
    truth: &Actor,
    places: &[Option<frontalis_analysis::face::marker::VirtualMarker>],
) -> f64 {
    let squares: Vec<f64> = places
        .iter()
        .zip(truth.virtual_markers())
        .map(|(found, truth_place)| {
            let found = found.unwrap().position(truth.mesh()).0;
            (found - truth_place.position(truth.mesh()).0).norm_squared()
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// How many hands mark the face.
const HANDS: u64 = 5;

#[test]
fn projection_mends_three_millimeters_of_hand_marking() {
    let truth = reference_face::actor();
    let (mut before, mut after) = (0.0, 0.0);
    for seed in 0..HANDS {
        let mut rng = Pcg64::seed_from_u64(seed);
        // Uniform over ±a in each axis has an RMS length of a.
        let actor = hand_marked(0.3, &mut rng);
        let start: Vec<_> = actor.virtual_markers().iter().copied().map(Some).collect();
        before += rms_error_cm(&truth, &start) / HANDS as f64;
        let neutral = neutral_of(&truth, 0.0, seed);
        let alignment = Alignment::find(&actor, &neutral, LengthUnit::Centimeter).unwrap();
        after += rms_error_cm(&truth, &alignment.bindings) / HANDS as f64;
    }
    println!(
        "hand-marking error {:.2} mm RMS, after projection {:.2} mm",
        before * 10.0,
        after * 10.0
    );
    assert!(after <= 0.025, "{after}");
}

#[test]
fn projection_does_not_spoil_exact_hand_marking_under_noise() {
    let truth = reference_face::actor();
    let neutral = neutral_of(&truth, 0.05, 3);
    let alignment = Alignment::find(&truth, &neutral, LengthUnit::Centimeter).unwrap();
    let error_cm = rms_error_cm(&truth, &alignment.bindings);
    println!(
        "exact hand-marking, 0.5 mm noise: {:.3} mm after projection",
        error_cm * 10.0
    );
    assert!(error_cm <= 0.01, "{error_cm}");
}

fn aligned(
    change: impl Fn(PerformancePoint) -> PerformancePoint,
    unit: LengthUnit,
) -> Result<Alignment, AlignmentError> {
    let actor = reference_face::actor();
    let mut neutral = neutral_of(&actor, 0.0, 1);
    for it in neutral.positions.iter_mut().flatten() {
        *it = change(*it);
    }
    Alignment::find(&actor, &neutral, unit)
}

#[test]
fn a16_a_mirrored_face_is_refused() {
    let mirrored = aligned(
        |it| PerformancePoint(Point3::new(-it.0.x, it.0.y, it.0.z)),
        LengthUnit::Centimeter,
    );
    assert_eq!(mirrored, Err(AlignmentError::Mirrored));
}

#[test]
fn a_face_in_the_wrong_unit_is_refused_and_the_likely_unit_named() {
    // Meters declared as millimeters: a thousandth of the size.
    let error = aligned(|it| PerformancePoint(it.0 * 1e-3), LengthUnit::Millimeter).unwrap_err();
    assert!(
        matches!(
            error,
            AlignmentError::UnitsSuspect {
                likely: Some(LengthUnit::Meter),
                ..
            }
        ),
        "{error}"
    );
    assert!(error.to_string().contains("probably in m"), "{error}");
}

#[test]
fn identical_markers_are_refused() {
    let error = aligned(
        |_| PerformancePoint::new(1.0, 2.0, 3.0),
        LengthUnit::Centimeter,
    );
    assert_eq!(error, Err(AlignmentError::Degenerate));
}

#[test]
fn c5_a_region_with_fewer_than_four_markers_is_refused_with_the_missing_ones() {
    let actor = reference_face::actor();
    let mut neutral = neutral_of(&actor, 0.0, 1);
    for (marker, position) in actor.markers().iter().zip(&mut neutral.positions) {
        if marker.region.name() == "upper" && marker.name != "nose_bridge" {
            *position = None;
        }
    }
    let error = Alignment::find(&actor, &neutral, LengthUnit::Centimeter).unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("show 1 markers of the upper region") && text.contains("forehead_left"),
        "{text}"
    );
}

#[test]
fn c5_a_marker_never_seen_is_left_out_and_the_rest_aligns() {
    let actor = reference_face::actor();
    let mut neutral = neutral_of(&actor, 0.0, 1);
    neutral.positions[4] = None;
    let alignment = Alignment::find(&actor, &neutral, LengthUnit::Centimeter).unwrap();
    assert_eq!(alignment.bindings[4], None);
    assert_eq!(alignment.n_markers(), actor.markers().len() - 1);
}
