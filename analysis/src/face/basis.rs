//! The actuation basis: how every vertex moves when one muscle contracts fully (Choe & Ko 2001, section 3).
//!
//! E = E₀ + Σ xᵢeᵢ for the surface; at the markers p = p₀ + Σ xᵢdᵢ, with dᵢⱼ the barycentric mix of eᵢ at marker j.

mod report;

pub(crate) use report::rank_deficiency;
pub use report::{AmbiguousPair, BasisReport};

use nalgebra::Vector3;

use super::{
    actor::Actor,
    marker::{Marker, VirtualMarker},
    mesh::FaceMesh,
};
use crate::space::ModelPoint;

/// Displacements eᵢ = Eᵢ − E₀ of all vertices, one list a muscle.
#[derive(Clone, Debug, PartialEq)]
pub struct ActuationBasis {
    /// `displacements_cm[muscle][vertex]`, centimeters; finite.
    pub displacements_cm: Vec<Vec<Vector3<f64>>>,
}

impl ActuationBasis {
    /// How a place of the surface moves when `muscle` contracts fully, centimeters.
    ///
    /// # Panics
    ///
    /// When the muscle or the triangle does not exist.
    pub fn displacement_cm(
        &self,
        muscle: usize,
        mesh: &FaceMesh,
        place: &VirtualMarker,
    ) -> Vector3<f64> {
        let of_vertex = &self.displacements_cm[muscle];
        mesh.triangles[place.triangle]
            .iter()
            .zip(place.barycentric)
            .map(|(&vertex, weight)| of_vertex[vertex as usize] * weight)
            .sum()
    }
}

/// The basis at the markers: p₀ (n points) and the n × m displacements D.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkerBasis {
    /// The virtual markers of the neutral face, one a marker.
    pub neutral: Vec<ModelPoint>,
    n_muscles: usize,
    displacements_cm: Vec<Vector3<f64>>,
}

impl MarkerBasis {
    /// The basis of `actor` at `places`, one a marker in the actor's order.
    ///
    /// Head-fixed markers ride on the skull, so D is 0 for them whatever the mesh does there.
    ///
    /// # Panics
    ///
    /// When there are not as many places as markers, or one is not on the actor's mesh.
    pub fn at(actor: &Actor, places: &[VirtualMarker]) -> Self {
        Self::of(actor.mesh(), actor.basis(), actor.markers(), places)
    }

    /// As [`MarkerBasis::at`], from the parts of an actor.
    pub(crate) fn of(
        mesh: &FaceMesh,
        basis: &ActuationBasis,
        markers: &[Marker],
        places: &[VirtualMarker],
    ) -> Self {
        assert_eq!(markers.len(), places.len(), "one place a marker");
        let n_muscles = basis.displacements_cm.len();
        let displacement = |(marker, place): (&Marker, &VirtualMarker), muscle| {
            if marker.head_fixed {
                Vector3::zeros()
            } else {
                basis.displacement_cm(muscle, mesh, place)
            }
        };
        let displacements_cm = markers
            .iter()
            .zip(places)
            .flat_map(|at| (0..n_muscles).map(move |muscle| displacement(at, muscle)))
            .collect();
        Self {
            neutral: places.iter().map(|place| place.position(mesh)).collect(),
            n_muscles,
            displacements_cm,
        }
    }

    /// Number of markers, n.
    pub fn n_markers(&self) -> usize {
        self.neutral.len()
    }

    /// Number of muscles, m.
    pub fn n_muscles(&self) -> usize {
        self.n_muscles
    }

    /// How a marker moves with each muscle, centimeters: m entries.
    ///
    /// # Panics
    ///
    /// When there is no such marker.
    pub fn of_marker_cm(&self, marker: usize) -> &[Vector3<f64>] {
        &self.displacements_cm[marker * self.n_muscles..][..self.n_muscles]
    }
}
