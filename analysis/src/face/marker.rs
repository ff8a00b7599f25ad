//! Markers on the face, their virtual counterparts on the mesh, and one captured instant of them.

use nalgebra::Point3;

use super::{mesh::FaceMesh, region::FaceRegion};
use crate::space::{ModelPoint, PerformancePoint};

/// One marker by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Marker {
    /// Spelled in full: `brow_outer_left`.
    pub name: String,
    /// The region it observes.
    pub region: FaceRegion,
    /// Rides on the skull (headband, nose bridge): used for head motion, not for muscles.
    pub head_fixed: bool,
}

/// A marker's place on the mesh as triangle and barycentric weights, so that it survives deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualMarker {
    /// Index into [`FaceMesh::triangles`].
    pub triangle: usize,
    /// Weights of the triangle's corners: not negative, sum 1.
    pub barycentric: [f64; 3],
}

impl VirtualMarker {
    /// Where the virtual marker lies on `mesh`.
    pub fn position(&self, mesh: &FaceMesh) -> ModelPoint {
        let corners = mesh.corners(self.triangle);
        let mixed = corners
            .iter()
            .zip(self.barycentric)
            .fold(Point3::origin(), |sum, (corner, weight)| {
                sum + corner.0.coords * weight
            });
        ModelPoint(mixed)
    }
}

/// Number of a frame inside a session's run; strictly increasing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FrameIndex(pub u64);

/// One captured instant: every marker of the actor, in the actor's order.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkerFrame {
    /// The publisher's frame number.
    pub index: FrameIndex,
    /// When the shutter opened, on the publisher's monotonic capture clock.
    pub capture_time_nanos: i64,
    /// One entry a marker of the actor; `None` is occluded.
    pub positions: Vec<Option<PerformancePoint>>,
}
