//! The facial surface: vertices and triangles.

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
}
