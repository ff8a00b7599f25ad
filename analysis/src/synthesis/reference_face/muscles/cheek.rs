//! The muscles of the cheek: levator lifts the upper lip and nose wing, zygomatic and risorius draw the mouth corner.
//!
//! None of them reaches above the eye slit.

use super::{Displacement, Side, mask, pull, stretched};
use crate::synthesis::{
    pseudo_muscle::{LinearMuscle, smoothstep},
    reference_face::grid::SkinVertex,
};

const LEVATOR_AT_LIP: LinearMuscle = pull([1.35, -5.6, 9.3], [1.55, -4.75, 9.25], 2.5);
const LEVATOR_AT_NOSE_WING: LinearMuscle = pull([1.5, -4.3, 9.3], [1.65, -3.85, 9.2], 1.5);
const LEVATOR_AT_CHEEK: LinearMuscle = pull([2.4, -3.0, 8.7], [2.4, -2.75, 8.95], 1.9);
const ZYGOMATIC_AT_CORNER: LinearMuscle = pull([2.6, -7.0, 8.6], [3.45, -5.95, 8.0], 3.1);
const ZYGOMATIC_AT_APPLE: LinearMuscle = pull([3.7, -3.6, 8.4], [3.75, -3.15, 8.9], 2.2);
const RISORIUS: LinearMuscle = stretched([2.6, -7.05, 8.6], [3.75, -7.2, 7.75], 3.2, 1.1);

pub(super) fn levator_labii_superioris(vertex: &SkinVertex, side: Side) -> Displacement {
    let here = mask(vertex.below_eye()) * smoothstep(-1.2, 0.6, side.x(vertex));
    let at = |part: &LinearMuscle| side.of(part).displacement(&vertex.place);
    at(&LEVATOR_AT_LIP) * (here * mask(!vertex.below_mouth()))
        + at(&LEVATOR_AT_NOSE_WING) * here
        + at(&LEVATOR_AT_CHEEK) * here
}

pub(super) fn zygomatic_major(vertex: &SkinVertex, side: Side) -> Displacement {
    let below_eye = mask(vertex.below_eye());
    let towards_side = smoothstep(-0.9, 0.9, side.x(vertex));
    // The lower lip follows the corner a little less than the upper one.
    let lip = 1.0 - 0.10 * mask(vertex.below_mouth());
    let at = |part: &LinearMuscle| side.of(part).displacement(&vertex.place);
    at(&ZYGOMATIC_AT_CORNER) * (below_eye * towards_side * lip)
        + at(&ZYGOMATIC_AT_APPLE) * below_eye
}

pub(super) fn risorius(vertex: &SkinVertex, side: Side) -> Displacement {
    let weight = mask(vertex.below_eye()) * smoothstep(-0.9, 0.9, side.x(vertex));
    side.of(&RISORIUS).displacement(&vertex.place) * weight
}
