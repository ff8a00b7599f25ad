//! The eyelids: where their margins run, and how they rest on the eyeball.

use std::sync::LazyLock;

use nalgebra::Vector3;

use super::{
    pchip::Pchip,
    tables::{EYE_CENTER_CM, EYE_RADIUS_CM, LOWER_LID_MARGIN, UPPER_LID_MARGIN},
};
use crate::synthesis::pseudo_muscle::smoothstep;

static UPPER_MARGIN: LazyLock<Pchip> =
    LazyLock::new(|| Pchip::new(&UPPER_LID_MARGIN.0, &UPPER_LID_MARGIN.1));
static LOWER_MARGIN: LazyLock<Pchip> =
    LazyLock::new(|| Pchip::new(&LOWER_LID_MARGIN.0, &LOWER_LID_MARGIN.1));

/// |x| of the canthi at the lid margins.
pub(super) const CANTHI_CM: (f64, f64) = (1.62, 4.62);

/// How thick the resting lid is.
const LID_THICKNESS_CM: f64 = 0.07;

/// y of the upper lid's margin at |x|.
pub(super) fn upper_margin_y_cm(x_cm: f64) -> f64 {
    UPPER_MARGIN.at(x_cm.abs().clamp(CANTHI_CM.0, CANTHI_CM.1))
}

/// y of the lower lid's margin at |x|.
pub(super) fn lower_margin_y_cm(x_cm: f64) -> f64 {
    LOWER_MARGIN.at(x_cm.abs().clamp(CANTHI_CM.0, CANTHI_CM.1))
}

/// z of a sphere of `radius_cm` about the eye's center at (`x_cm`, `y_cm`); the center's own z outside the sphere.
pub(super) fn eyeball_depth_cm(radius_cm: f64, x_cm: f64, y_cm: f64) -> f64 {
    let (across, along) = (x_cm.abs() - EYE_CENTER_CM.0, y_cm - EYE_CENTER_CM.1);
    let squared = radius_cm * radius_cm - across * across - along * along;
    EYE_CENTER_CM.2 + squared.max(0.0).sqrt()
}

/// z of the skin once the lids rest on the eyeball: a soft transition from `place` to the sphere.
pub(super) fn resting_depth_cm(place: &Vector3<f64>) -> f64 {
    let radius = EYE_RADIUS_CM + LID_THICKNESS_CM;
    let across = place.x.abs() - EYE_CENTER_CM.0;
    let along = place.y - EYE_CENTER_CM.1;
    let weight = smoothstep(0.0, 0.45, 1.30 - (across / 1.25).hypot(along));
    // The canthi lie beyond the sphere; there the lids keep at least this depth.
    let canthus_depth = EYE_CENTER_CM.2 + 0.42 * radius;
    let lid = eyeball_depth_cm(radius, place.x, place.y).max(canthus_depth);
    (1.0 - weight) * place.z + weight * lid
}
