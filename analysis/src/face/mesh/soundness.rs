//! What is odd about a mesh without making it useless: scans have such places.

use super::{FaceMesh, neighborhood::edges};

/// Oddities of a mesh that is accepted all the same, as counts with the first of each kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshFlaws {
    /// Triangles without area; they never carry a marker.
    pub degenerate_triangles: usize,
    /// The first of them.
    pub first_degenerate: Option<usize>,
    /// Vertices that no triangle uses.
    pub isolated_vertices: usize,
    /// The first of them.
    pub first_isolated: Option<usize>,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// The vertices of the first of them.
    pub first_non_manifold: Option<[u32; 2]>,
}

impl FaceMesh {
    /// Counts the places where this is not a plain surface.
    ///
    /// # Panics
    ///
    /// When a triangle names a vertex that the mesh does not have.
    pub fn flaws(&self) -> MeshFlaws {
        let mut degenerate = (0..self.triangles.len()).filter(|&it| self.is_degenerate(it));
        let mut used = vec![false; self.vertices.len()];
        for &vertex in self.triangles.iter().flatten() {
            used[vertex as usize] = true;
        }
        let mut isolated = (0..used.len()).filter(|&vertex| !used[vertex]);
        let crowded = self.non_manifold_edges();
        let first_degenerate = degenerate.next();
        let first_isolated = isolated.next();
        MeshFlaws {
            degenerate_triangles: usize::from(first_degenerate.is_some()) + degenerate.count(),
            first_degenerate,
            isolated_vertices: usize::from(first_isolated.is_some()) + isolated.count(),
            first_isolated,
            non_manifold_edges: crowded.len(),
            first_non_manifold: crowded.first().copied(),
        }
    }

    fn non_manifold_edges(&self) -> Vec<[u32; 2]> {
        let mut all: Vec<_> = self.triangles.iter().flat_map(|it| edges(*it)).collect();
        all.sort_unstable();
        all.chunk_by(|first, second| first == second)
            .filter(|same| same.len() > 2)
            .map(|same| same[0])
            .collect()
    }
}
