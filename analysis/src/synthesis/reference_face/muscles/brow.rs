//! The muscles of the brow: frontalis raises it, corrugator draws it inwards and down.
//!
//! Both fade out above the lid's margin, which belongs to the orbicularis oculi.

use super::{Displacement, Side, mask, pull, stretched};
use crate::synthesis::{
    pseudo_muscle::{LinearMuscle, smoothstep},
    reference_face::grid::SkinVertex,
};

const FRONTALIS: LinearMuscle = stretched([3.3, 2.3, 8.3], [3.3, 3.35, 8.15], 4.0, 0.95);
const CORRUGATOR: LinearMuscle = pull([1.6, 1.9, 9.0], [1.05, 1.25, 9.25], 2.7);

pub(super) fn frontalis(vertex: &SkinVertex, side: Side) -> Displacement {
    let weight = mask(!vertex.below_eye())
        * smoothstep(0.25, 1.5, vertex.place.y)
        * smoothstep(-1.4, 1.2, side.x(vertex));
    side.of(&FRONTALIS).displacement(&vertex.place) * weight
}

pub(super) fn corrugator(vertex: &SkinVertex, side: Side) -> Displacement {
    let weight = mask(!vertex.below_eye())
        * smoothstep(0.1, 1.2, vertex.place.y)
        * smoothstep(-0.9, 0.5, side.x(vertex));
    side.of(&CORRUGATOR).displacement(&vertex.place) * weight
}
