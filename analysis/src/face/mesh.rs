//! The facial surface: vertices, triangles, and the closest point of it.
//!
//! A hand-marked marker lies near the surface, not on it; it is bound to the closest point, kept as triangle and
//! barycentric weights (Choe & Ko 2001, section 4.1.1).

mod closest;
mod neighborhood;
mod soundness;
mod tree;

pub use closest::SurfacePoint;
pub use soundness::MeshFlaws;
pub use tree::SurfaceTree;

use crate::space::ModelPoint;

/// A triangle mesh in model space.
///
/// Every triangle names existing vertices and every coordinate is finite: [`super::actor::Actor::new`] checks both.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceMesh {
    /// The neutral vertices E₀, centimeters.
    pub vertices: Vec<ModelPoint>,
    /// Three vertex indices each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl FaceMesh {
    /// The three corners of a triangle.
    ///
    /// # Panics
    ///
    /// When `triangle` is not a triangle of this mesh.
    pub fn corners(&self, triangle: usize) -> [ModelPoint; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    /// Whether a triangle has no area, so that barycentric weights on it mean nothing.
    ///
    /// # Panics
    ///
    /// When `triangle` is not a triangle of this mesh.
    pub fn is_degenerate(&self, triangle: usize) -> bool {
        // A height of a ten-millionth of the longest edge is below what any of our formats can store.
        const LEAST_HEIGHT_PER_EDGE: f64 = 1e-7;
        let [a, b, c] = self.corners(triangle).map(|corner| corner.0);
        let longest_squared = (b - a)
            .norm_squared()
            .max((c - b).norm_squared())
            .max((a - c).norm_squared());
        (b - a).cross(&(c - a)).norm() <= LEAST_HEIGHT_PER_EDGE * longest_squared
    }
}
