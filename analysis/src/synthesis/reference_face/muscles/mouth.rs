//! The muscles around the mouth that act as one over both sides.

use nalgebra::Vector3;

use super::{Displacement, Side, both, mask, pull};
use crate::synthesis::{
    pseudo_muscle::{LinearMuscle, SphincterMuscle, smoothstep},
    reference_face::grid::SkinVertex,
};

/// y of the closed lips.
const MOUTH_Y_CM: f64 = -7.0;

const DEPRESSOR: LinearMuscle = pull([2.6, -7.1, 8.6], [2.85, -8.15, 8.45], 2.6);
const RING: SphincterMuscle = SphincterMuscle {
    center_cm: Vector3::new(0.0, MOUTH_Y_CM, 9.6),
    radius_cm: 3.9,
    contraction: Vector3::new(0.52, -0.16, 0.0),
    axis_weights: Vector3::new(1.0, 1.0, 0.3),
};
const PROTRUSION: LinearMuscle = pull([0.0, MOUTH_Y_CM, 9.9], [0.0, MOUTH_Y_CM, 10.75], 2.5);
const LOWER_LIP: LinearMuscle = pull([0.0, -7.45, 9.9], [0.0, -6.95, 10.45], 2.6);
const UPPER_LIP: LinearMuscle = pull([0.0, -6.6, 9.9], [0.0, -6.72, 10.22], 2.2);
const PRESSED_CORNER: LinearMuscle = pull([2.5, -7.05, 8.6], [2.35, -7.45, 8.6], 1.9);
const RAISED_CHIN: LinearMuscle = pull([0.0, -9.6, 9.8], [0.0, -9.2, 9.95], 2.0);

/// Pulls both mouth corners down.
pub(super) fn depressor_anguli_oris(vertex: &SkinVertex) -> Displacement {
    let below_eye = mask(vertex.below_eye());
    both(|side: Side| {
        let weight = below_eye * smoothstep(-0.6, 0.9, side.x(vertex));
        side.of(&DEPRESSOR).displacement(&vertex.place) * weight
    })
}

/// Rounds and protrudes the lips, as in the vowel /u/.
pub(super) fn orbicularis_oris(vertex: &SkinVertex) -> Displacement {
    let place = &vertex.place;
    let below_nose = mask(vertex.below_eye()) * smoothstep(-4.9, -5.9, place.y);
    let above_chin = smoothstep(-9.6, -8.4, place.y);
    RING.displacement(place) * (below_nose * above_chin)
        + PROTRUSION.displacement(place) * below_nose
        + Vector3::y() * rounding_cm(vertex)
}

/// How far the lips part in the middle while they round; up on the upper lip, down on the lower.
fn rounding_cm(vertex: &SkinVertex) -> f64 {
    let (across, along) = (vertex.place.x.abs(), vertex.place.y - MOUTH_Y_CM);
    if across >= 2.4 || along.abs() >= 1.3 {
        return 0.0;
    }
    let away = if vertex.below_mouth() { -0.22 } else { 0.22 };
    let relative = along / 0.8;
    away * (1.0 - across / 1.9).max(0.0) * (-relative * relative).exp()
}

/// Presses the lips together and raises the chin.
pub(super) fn lips_pressor(vertex: &SkinVertex) -> Displacement {
    let place = &vertex.place;
    let lower = mask(vertex.below_mouth());
    let upper = mask(!vertex.below_mouth()) * smoothstep(-5.2, -6.2, place.y);
    let below_eye = mask(vertex.below_eye());
    let corners = both(|side| side.of(&PRESSED_CORNER).displacement(place) * below_eye);
    LOWER_LIP.displacement(place) * lower
        + UPPER_LIP.displacement(place) * upper
        + corners
        + RAISED_CHIN.displacement(place) * lower
}
