//! A whole actor made by code: a symmetric face of 1,536 vertices with the sixteen muscles of `choe-ko-16`.
//!
//! The face is a table of feature rows under a depth function; its muscles are the pseudo-muscles of Hung & Huang,
//! arranged as the actuation basis of Choe & Ko 2001 (section 3); 27 markers and 5 head-fixed ones sit on it.
//! The symmetry is exact: every formula is even or odd in x.

mod depth;
#[cfg(test)]
mod golden;
mod grid;
mod lids;
mod markers;
mod muscles;
mod pchip;
mod tables;

use nalgebra::Point3;

use crate::{
    face::{
        actor::{Actor, ActorParts, MarkerPlace, RankPolicy},
        basis::ActuationBasis,
        mesh::FaceMesh,
    },
    space::ModelPoint,
};

/// The vocabulary of the reference face's muscles; its order is part of it.
pub const MUSCLE_SET: &str = "choe-ko-16";

/// The reference actor: 1,536 vertices, 2,860 triangles, 16 muscles, 27 markers and then 5 head-fixed ones.
///
/// It is computed anew at every call, in a few milliseconds; share it by `Arc`.
///
/// ```
/// let actor = frontalis_analysis::synthesis::reference_face::actor();
/// assert_eq!(actor.muscle_set().index_of("zygomatic_major_left"), Some(8));
/// ```
#[expect(
    clippy::missing_panics_doc,
    reason = "the parts are constants, which tests check"
)]
pub fn actor() -> Actor {
    let checked = Actor::new(actor_parts(), RankPolicy::Refuse);
    let (actor, _warnings) = checked.expect("invariant: the reference face is a sound actor");
    actor
}

/// What the reference actor is made of: the mesh, the basis, 27 markers and then 5 head-fixed ones.
pub fn actor_parts() -> ActorParts {
    let skin = grid::skin();
    let (muscles, displacements_cm) = muscles::muscles(&skin.vertices).into_iter().unzip();
    let places = skin
        .vertices
        .iter()
        .map(|vertex| ModelPoint(Point3::from(vertex.place)));
    let mesh = FaceMesh {
        vertices: places.collect(),
        triangles: skin.triangles,
    };
    let markers = (markers::markers(&mesh, &skin.vertices).into_iter())
        .map(|(marker, place)| (marker, MarkerPlace::OnTriangle(place)))
        .collect();
    ActorParts {
        display_name: "Reference face".to_owned(),
        muscle_set: MUSCLE_SET.to_owned(),
        mesh,
        muscles,
        basis: ActuationBasis { displacements_cm },
        markers,
    }
}
