//! The actor: one person's neutral face, actuation basis and marker layout, checked once and then immutable.

use super::{
    basis::ActuationBasis,
    marker::{Marker, VirtualMarker},
    mesh::FaceMesh,
    muscle::{Muscle, MuscleSet},
};
use crate::space::ModelPoint;

/// Where an artist put a marker.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkerPlace {
    /// Hand-marked near the neutral surface; bound to the closest point of it.
    Position(ModelPoint),
    /// On a vertex.
    Vertex(usize),
    /// On a triangle.
    OnTriangle(VirtualMarker),
}

/// What an actor is made of, before it is checked.
#[derive(Clone, Debug)]
pub struct ActorParts {
    /// A person's name for the actor.
    pub display_name: String,
    /// The muscle vocabulary's id: `choe-ko-16`, or the package's own.
    pub muscle_set: String,
    /// The neutral face.
    pub mesh: FaceMesh,
    /// Muscles in order, each with the full-contraction displacement of every vertex.
    pub muscles: Vec<Muscle>,
    /// The basis, one element a muscle.
    pub basis: ActuationBasis,
    /// Markers in order, each with its place.
    pub markers: Vec<(Marker, MarkerPlace)>,
}

/// One person's face, as the analysis needs it. Immutable; shared by `Arc`.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    display_name: String,
    mesh: FaceMesh,
    basis: ActuationBasis,
    muscle_set: MuscleSet,
    markers: Vec<Marker>,
    virtual_markers: Vec<VirtualMarker>,
}

impl Actor {
    /// A person's name for the actor.
    pub fn display_name(&self) -> &str {
        &self.display_name
    }

    /// The neutral face.
    pub fn mesh(&self) -> &FaceMesh {
        &self.mesh
    }

    /// How every vertex moves with every muscle.
    pub fn basis(&self) -> &ActuationBasis {
        &self.basis
    }

    /// Muscles in activation order.
    pub fn muscle_set(&self) -> &MuscleSet {
        &self.muscle_set
    }

    /// Markers in the default order of a stream.
    pub fn markers(&self) -> &[Marker] {
        &self.markers
    }

    /// Each marker's hand-marked place on the mesh.
    pub fn virtual_markers(&self) -> &[VirtualMarker] {
        &self.virtual_markers
    }
}
