//! Rotation of the lower jaw about the axis through its joints; the skin follows it by a weight, 1 on the chin.

use nalgebra::Vector3;

use super::{Displacement, both, pull};
use crate::synthesis::{
    pseudo_muscle::{LinearMuscle, smoothstep},
    reference_face::grid::SkinVertex,
};

/// A point on the axis, which runs along x.
const JOINT_CM: Vector3<f64> = Vector3::new(0.0, -1.2, 0.8);
/// The jaw's angle when it is fully open.
const OPEN_RADIANS: f64 = 18.0 * std::f64::consts::PI / 180.0;
/// The opening mouth draws its corners inwards, since the lips keep their length.
const CORNER: LinearMuscle = pull([2.5, -7.0, 8.2], [2.28, -7.0, 8.2], 1.8);

pub(super) fn jaw_rotation(vertex: &SkinVertex) -> Displacement {
    let place = &vertex.place;
    rotation(place) * weight(vertex) + both(|side| side.of(&CORNER).displacement(place))
}

fn rotation(place: &Vector3<f64>) -> Displacement {
    let arm = place - JOINT_CM;
    let (sin, cos) = OPEN_RADIANS.sin_cos();
    Vector3::new(
        0.0,
        cos * arm.y - sin * arm.z - arm.y,
        sin * arm.y + cos * arm.z - arm.z,
    )
}

/// How much of the bone's rotation reaches the skin.
fn weight(vertex: &SkinVertex) -> f64 {
    let (across, y) = (vertex.place.x.abs(), vertex.place.y);
    // Outside the mouth corners the weight grows downwards, so that the cheek stretches.
    let cheek = smoothstep(-4.6, -9.4, y);
    let lip = if vertex.below_mouth() {
        0.55 + 0.45 * smoothstep(-7.1, -8.6, y)
    } else {
        0.0
    };
    let between_corners = smoothstep(2.75, 1.9, across);
    let front = smoothstep(6.9, 5.2, across);
    (between_corners * lip + (1.0 - between_corners) * cheek) * front
}
