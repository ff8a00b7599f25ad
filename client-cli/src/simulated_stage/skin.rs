//! The patches of skin under the markers: where they are and where they face at given contractions.
//!
//! E = E₀ + Σ xᵢeᵢ at the corners of a few triangles, which is all of the face that the cameras need.
//! A marker is a dot of some millimeters, so that it faces where the skin around it faces, not one small triangle.

use frontalis_analysis::{
    face::{actor::Actor, marker::VirtualMarker},
    space::ModelPoint,
};
use nalgebra::{Point3, Vector3};

/// The skin within this distance of a marker decides where it faces, centimeters.
const DOT_RADIUS_CM: f64 = 0.3;

/// The skin under one marker.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Where the marker is.
    pub(super) position: ModelPoint,
    /// The skin's mean unit normal, outwards; zero if the contractions leave it no area.
    pub(super) normal: Vector3<f64>,
}

/// What moves one marker.
struct Mount {
    barycentric: [f64; 3],
    /// The marker's own triangle first, then those around it.
    triangles: Vec<Triangle>,
}

/// A triangle of skin.
struct Triangle {
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
            triangles: (dot(actor, place).into_iter())
                .map(|triangle| Triangle::new(actor, triangle, marker.head_fixed))
                .collect(),
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
        let mut position = Vector3::zeros();
        let mut normal = Vector3::zeros();
        for (at, triangle) in self.triangles.iter().enumerate() {
            let corners = triangle.corners(contractions);
            let [a, b, c] = corners;
            normal += (b - a).cross(&(c - a));
            if at == 0 {
                let weighted = corners.iter().zip(self.barycentric);
                position = weighted.map(|(it, weight)| it.coords * weight).sum();
            }
        }
        Patch {
            position: ModelPoint(Point3::from(position)),
            normal: normal.try_normalize(0.0).unwrap_or_default(),
        }
    }
}

impl Triangle {
    fn new(actor: &Actor, triangle: usize, head_fixed: bool) -> Self {
        let corners = actor.mesh().triangles[triangle];
        let of_muscle = |element: &Vec<Vector3<f64>>| corners.map(|it| element[it as usize]);
        let elements = actor.basis().displacements_cm.iter();
        Self {
            neutral: actor.mesh().corners(triangle).map(|corner| corner.0),
            displacements_cm: if head_fixed {
                Vec::new()
            } else {
                elements.map(of_muscle).collect()
            },
        }
    }

    fn corners(&self, contractions: &[f64]) -> [Point3<f64>; 3] {
        let mut corners = self.neutral;
        for (displacements, &contraction) in self.displacements_cm.iter().zip(contractions) {
            if contraction == 0.0 {
                continue;
            }
            for (corner, displacement) in corners.iter_mut().zip(displacements) {
                *corner += displacement * contraction;
            }
        }
        corners
    }
}

/// The triangle that carries the marker, then those whose middle lies under the marker's dot.
fn dot(actor: &Actor, place: &VirtualMarker) -> Vec<usize> {
    let mesh = actor.mesh();
    let center = place.position(mesh).0;
    let under = |&triangle: &usize| {
        let [a, b, c] = mesh.corners(triangle).map(|corner| corner.0.coords);
        triangle != place.triangle && ((a + b + c) / 3.0 - center.coords).norm() < DOT_RADIUS_CM
    };
    let around = (0..mesh.triangles.len()).filter(under);
    std::iter::once(place.triangle).chain(around).collect()
}
