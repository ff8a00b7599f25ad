//! The actor: one person's neutral face, actuation basis and marker layout, checked once and then immutable.
//!
//! [`Actor::new`] is the only way in: whatever it accepts, the analysis can use without another check.

mod binding;
mod check;
mod error;

pub use error::{ActorError, ActorWarning, BarycentricProblem, NameProblem};

use super::{
    basis::{ActuationBasis, BasisReport, MarkerBasis, rank_deficiency},
    marker::{Marker, VirtualMarker},
    mesh::FaceMesh,
    muscle::{Muscle, MuscleSet},
};
use crate::space::ModelPoint;

/// Most markers of an actor; the wire admits as many a frame.
pub const MAX_MARKERS: usize = 1_024;
/// Most muscles of an actor.
pub const MAX_MUSCLES: usize = 256;
/// Most vertices of a neutral face.
pub const MAX_VERTICES: usize = 200_000;
/// Most triangles of a neutral face.
pub const MAX_TRIANGLES: usize = 400_000;
/// Most muscles × vertices: one displacement takes 24 bytes, so a basis stays below 200 MB.
pub const MAX_DISPLACEMENTS: usize = 8_000_000;

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

/// What to do with a basis whose columns the markers cannot tell apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RankPolicy {
    /// Refuse the actor.
    #[default]
    Refuse,
    /// Accept it with a warning: the solver's regularization shares the motion among the columns.
    Regularize,
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
    /// Checks the parts, binds every marker to the surface, and judges the basis at the markers.
    ///
    /// What is odd but usable comes back as warnings, in the order of the checks.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong, by name: a limit, a name, a coordinate, an index, a marker's weights, or the
    /// rank of the basis (with [`RankPolicy::Refuse`]).
    pub fn new(
        parts: ActorParts,
        rank: RankPolicy,
    ) -> Result<(Self, Vec<ActorWarning>), ActorError> {
        check::sizes(&parts)?;
        check::names(&parts)?;
        check::mesh(&parts.mesh)?;
        check::basis(&parts)?;
        let mut warnings = check::oddities(&parts.mesh);
        let virtual_markers = binding::bind(&parts, &mut warnings)?;
        let actor = Self {
            display_name: parts.display_name,
            mesh: parts.mesh,
            basis: parts.basis,
            muscle_set: MuscleSet::new(parts.muscle_set, parts.muscles),
            markers: parts.markers.into_iter().map(|(it, _)| it).collect(),
            virtual_markers,
        };
        warnings.extend(actor.rank_warning(rank)?);
        Ok((actor, warnings))
    }

    fn rank_warning(&self, rank: RankPolicy) -> Result<Option<ActorWarning>, ActorError> {
        let Some(deficiency) = rank_deficiency(&self.marker_basis()) else {
            return Ok(None);
        };
        let muscles = self.muscle_set.muscles();
        let columns = deficiency
            .columns
            .iter()
            .map(|&muscle| muscles[muscle].name.clone())
            .collect();
        let condition = deficiency.condition;
        match rank {
            RankPolicy::Refuse => Err(ActorError::BasisRank { columns, condition }),
            RankPolicy::Regularize => Ok(Some(ActorWarning::BasisRank { columns, condition })),
        }
    }

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

    /// The marker's place in the order.
    pub fn marker_index(&self, name: &str) -> Option<usize> {
        self.markers.iter().position(|it| it.name == name)
    }

    /// The basis at the hand-marked places of the markers.
    pub fn marker_basis(&self) -> MarkerBasis {
        MarkerBasis::at(self, &self.virtual_markers)
    }

    /// How well the markers tell the muscles apart. Computed anew each time: a fraction of a
    /// millisecond for 30 muscles and 60 markers, about a second at the limits.
    pub fn basis_report(&self) -> BasisReport {
        BasisReport::of(&self.marker_basis(), &self.markers, &self.muscle_set)
    }

    /// The parts again, markers bound: what [`Actor::new`] makes the same actor of.
    pub fn to_parts(&self) -> ActorParts {
        let places = self.virtual_markers.iter().copied();
        ActorParts {
            display_name: self.display_name.clone(),
            muscle_set: self.muscle_set.id().to_owned(),
            mesh: self.mesh.clone(),
            muscles: self.muscle_set.muscles().to_vec(),
            basis: self.basis.clone(),
            markers: self
                .markers
                .iter()
                .cloned()
                .zip(places.map(MarkerPlace::OnTriangle))
                .collect(),
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
