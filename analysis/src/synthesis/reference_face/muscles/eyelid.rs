//! Orbicularis oculi, palpebral part: the upper lid glides down the eyeball to meet the lower lid, which rises a little.

use nalgebra::Vector3;

use super::{Displacement, Side};
use crate::synthesis::{
    pseudo_muscle::smoothstep,
    reference_face::{
        grid::SkinVertex,
        lids::{CANTHI_CM, eyeball_depth_cm, lower_margin_y_cm, upper_margin_y_cm},
        tables::EYE_RADIUS_CM,
    },
};

/// The part of the way to the lower lid that the upper margin travels; the rest is the lashes' thickness.
const TRAVEL: f64 = 0.93;
/// The travel fades to nothing this far above the margin.
const FADE_CM: f64 = 1.75;
/// How far the lower lid rises.
const LOWER_LID_RISE_CM: f64 = 0.12;
/// A moving lid keeps this distance from the eyeball's resting surface.
const MOVING_LID_THICKNESS_CM: f64 = 0.09;

pub(super) fn orbicularis_oculi(vertex: &SkinVertex, side: Side) -> Displacement {
    let x = side.x(vertex);
    // A little outside the canthi, whose own vertices round to either side.
    if x <= CANTHI_CM.0 - 0.02 || x >= CANTHI_CM.1 + 0.02 {
        return Vector3::zeros();
    }
    if vertex.above_eye() {
        upper_lid(vertex)
    } else if vertex.lower_lid() {
        lower_lid(vertex)
    } else {
        Vector3::zeros()
    }
}

fn upper_lid(vertex: &SkinVertex) -> Displacement {
    let place = vertex.place;
    let margin = upper_margin_y_cm(place.x);
    let way_cm = margin - (lower_margin_y_cm(place.x) + 0.02);
    let above_margin = place.y - margin;
    let y = place.y - way_cm * smoothstep(FADE_CM, 0.0, above_margin) * TRAVEL;
    // The rim stays behind the lid; only the visible skin is lifted onto the eyeball.
    let lifted = if vertex.rim {
        0.0
    } else {
        smoothstep(0.9, 0.2, above_margin)
    };
    let eyeball = eyeball_depth_cm(EYE_RADIUS_CM + MOVING_LID_THICKNESS_CM, place.x, y);
    Vector3::new(0.0, y - place.y, lifted * (eyeball - place.z).max(0.0))
}

fn lower_lid(vertex: &SkinVertex) -> Displacement {
    let (inner, outer) = CANTHI_CM;
    let x = vertex.place.x.abs().clamp(inner, outer);
    let below_margin = lower_margin_y_cm(x) + 0.02 - vertex.place.y;
    let across = ((x - inner) * (outer - x) / 2.25).clamp(0.0, 1.0);
    Vector3::y() * (LOWER_LID_RISE_CM * smoothstep(1.0, 0.0, below_margin) * across)
}
