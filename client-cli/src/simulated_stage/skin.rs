//! The patches of skin under the markers: where they are and where they face at given contractions.
//!
//! E = E₀ + Σ xᵢeᵢ at the three corners of each marker's triangle, which is all of the face that the cameras need.

use frontalis_analysis::{
    face::{actor::Actor, marker::VirtualMarker},
    space::ModelPoint,
};
use nalgebra::{Point3, Vector3};

/// The skin under one marker.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Where the marker is.
    pub(super) position: ModelPoint,
    /// The triangle's unit normal, outwards; zero if the contractions leave it no area.
    pub(super) normal: Vector3<f64>,
}

/// What moves one marker.
struct Mount {
    barycentric: [f64; 3],
    neutral: [Point3<f64>; 3],
    /// How each muscle displaces the corners; empty for a marker that rides on the skull.
    displacements_cm: Vec<[Vector3<f64>; 3]>,
}

/// The skin under all markers of an actor.
pub(super) struct MarkerSkin {
    mounts: Vec<Mount>,
}

impl MarkerSkin {
    pub(super) fn new(actor: &Actor) -> Self {
        let markers = actor.markers().iter().zip(actor.virtual_markers());
        let mounts = markers.map(|(marker, place)| Mount {
            barycentric: place.barycentric,
            neutral: actor.mesh().corners(place.triangle).map(|corner| corner.0),
            displacements_cm: if marker.head_fixed {
                Vec::new()
            } else {
                corner_displacements(actor, place)
            },
        });
        Self {
            mounts: mounts.collect(),
        }
    }

    pub(super) fn n_markers(&self) -> usize {
        self.mounts.len()
    }

    /// The middle of the markers on the neutral face.
    pub(super) fn center(&self) -> ModelPoint {
        let sum: Vector3<f64> = self.patches(&[]).map(|patch| patch.position.0.coords).sum();
        ModelPoint(Point3::from(sum / self.mounts.len().max(1) as f64))
    }

    /// Every marker's patch at `contractions`, one a muscle; none at all is the neutral face.
    pub(super) fn patches(&self, contractions: &[f64]) -> impl Iterator<Item = Patch> {
        self.mounts.iter().map(|mount| mount.patch(contractions))
    }
}

impl Mount {
    fn patch(&self, contractions: &[f64]) -> Patch {
        let mut corners = self.neutral;
        for (displacements, &contraction) in self.displacements_cm.iter().zip(contractions) {
            for (corner, displacement) in corners.iter_mut().zip(displacements) {
                *corner += displacement * contraction;
            }
        }
        let [a, b, c] = corners;
        let weighted = corners.iter().zip(self.barycentric);
        let position: Vector3<f64> = weighted.map(|(it, weight)| it.coords * weight).sum();
        Patch {
            position: ModelPoint(Point3::from(position)),
            normal: (b - a)
                .cross(&(c - a))
                .try_normalize(0.0)
                .unwrap_or_default(),
        }
    }
}

fn corner_displacements(actor: &Actor, place: &VirtualMarker) -> Vec<[Vector3<f64>; 3]> {
    let corners = actor.mesh().triangles[place.triangle];
    let elements = &actor.basis().displacements_cm;
    let of_muscle = |element: &Vec<Vector3<f64>>| corners.map(|vertex| element[vertex as usize]);
    elements.iter().map(of_muscle).collect()
}
