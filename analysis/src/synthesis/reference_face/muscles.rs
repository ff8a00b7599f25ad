//! The sixteen muscles of `choe-ko-16` on the reference face, in the order of every activation vector.
//!
//! Each is a few pseudo-muscles times a mask: without the mask the lips of a closed mouth, or both brows, move together.
//! A muscle is a function of one vertex, so that left and right are exact mirror images.

mod brow;
mod cheek;
mod eyelid;
mod jaw;
mod mouth;

use nalgebra::Vector3;

use super::grid::SkinVertex;
use crate::{
    face::{
        muscle::Muscle,
        region::FaceRegion::{self, Lower, Upper},
    },
    synthesis::pseudo_muscle::LinearMuscle,
};

/// How full contraction displaces one vertex, centimeters.
type Displacement = Vector3<f64>;

/// A half of the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

impl Side {
    const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// x seen from this side: positive on it, negative on the other.
    fn x(self, vertex: &SkinVertex) -> f64 {
        match self {
            Self::Left => vertex.place.x,
            Self::Right => -vertex.place.x,
        }
    }

    /// A muscle that is written down for the left.
    fn of(self, left: &LinearMuscle) -> LinearMuscle {
        match self {
            Self::Left => *left,
            Self::Right => left.mirrored(),
        }
    }
}

/// One basis element's maker.
enum Action {
    /// Contracts on its own on each side; given for the side, and named `_left` and `_right`.
    Paired(fn(&SkinVertex, Side) -> Displacement),
    /// One unit over both sides.
    Single(fn(&SkinVertex) -> Displacement),
}

/// The muscle set, left before right.
const MUSCLES: [(&str, FaceRegion, Action); 10] = [
    ("frontalis", Upper, Action::Paired(brow::frontalis)),
    ("corrugator", Upper, Action::Paired(brow::corrugator)),
    (
        "orbicularis_oculi",
        Upper,
        Action::Paired(eyelid::orbicularis_oculi),
    ),
    (
        "levator_labii_superioris",
        Lower,
        Action::Paired(cheek::levator_labii_superioris),
    ),
    (
        "zygomatic_major",
        Lower,
        Action::Paired(cheek::zygomatic_major),
    ),
    ("risorius", Lower, Action::Paired(cheek::risorius)),
    (
        "depressor_anguli_oris",
        Lower,
        Action::Single(mouth::depressor_anguli_oris),
    ),
    (
        "orbicularis_oris",
        Lower,
        Action::Single(mouth::orbicularis_oris),
    ),
    ("lips_pressor", Lower, Action::Single(mouth::lips_pressor)),
    ("jaw_rotation", Lower, Action::Single(jaw::jaw_rotation)),
];

/// Every muscle with the displacement of every vertex.
pub(super) fn muscles(skin: &[SkinVertex]) -> Vec<(Muscle, Vec<Displacement>)> {
    let mut elements = Vec::new();
    for (name, region, action) in MUSCLES {
        let mut add = |name: String, element| elements.push((Muscle { name, region }, element));
        match action {
            Action::Paired(pull) => {
                for (side, suffix) in Side::BOTH.into_iter().zip(["left", "right"]) {
                    let element = skin.iter().map(|vertex| pull(vertex, side)).collect();
                    add(format!("{name}_{suffix}"), element);
                }
            }
            Action::Single(pull) => add(name.to_owned(), skin.iter().map(pull).collect()),
        }
    }
    elements
}

/// A pull from `origin` to `target`, written for the left side; depth counts less than width and height.
const fn pull(origin: [f64; 3], target: [f64; 3], radius_cm: f64) -> LinearMuscle {
    stretched(origin, target, radius_cm, 1.0)
}

/// A pull whose distance counts height by `height_weight`.
const fn stretched(
    origin: [f64; 3],
    target: [f64; 3],
    radius_cm: f64,
    height_weight: f64,
) -> LinearMuscle {
    LinearMuscle {
        origin_cm: Vector3::new(origin[0], origin[1], origin[2]),
        target_cm: Vector3::new(target[0], target[1], target[2]),
        radius_cm,
        axis_weights: Vector3::new(1.0, height_weight, 0.6),
    }
}

/// The sum of both sides; adding two numbers is commutative, so the sum is symmetric to the last bit.
fn both(one_side: impl Fn(Side) -> Displacement) -> Displacement {
    one_side(Side::Left) + one_side(Side::Right)
}

/// 1 where it holds, else 0.
fn mask(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}
