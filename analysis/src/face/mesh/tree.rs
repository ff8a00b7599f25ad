//! Boxes around ever smaller groups of triangles, so that many closest points of one mesh cost little each.
//!
//! Groups are halved at the median of their centers along their longest side. An import with 1,024 hand-marked markers
//! on 400,000 triangles would otherwise take half a minute.

use nalgebra::Vector3;

use super::{
    FaceMesh, SurfacePoint,
    closest::{Best, Bounds},
};
use crate::space::ModelPoint;

/// Groups of this size are searched one by one.
const LEAF_TRIANGLES: usize = 16;

/// A mesh prepared for many searches.
pub struct SurfaceTree<'a> {
    mesh: &'a FaceMesh,
    root: Option<Group>,
}

struct Group {
    bounds: Bounds,
    content: Content,
}

enum Content {
    Triangles(Vec<usize>),
    Halves(Box<[Group; 2]>),
}

impl<'a> SurfaceTree<'a> {
    /// Sorts the mesh's triangles into groups.
    pub fn of(mesh: &'a FaceMesh) -> Self {
        let mut all: Vec<_> = (0..mesh.triangles.len())
            .map(|it| (it, Bounds::of(&mesh.corners(it).map(|corner| corner.0))))
            .collect();
        let root = group(&mut all);
        Self { mesh, root }
    }

    /// The closest point of the whole mesh, as [`FaceMesh::closest_point`] finds it.
    pub fn closest_point(&self, point: ModelPoint) -> Option<SurfacePoint> {
        let mut best = Best::default();
        let mut waiting: Vec<&Group> = self.root.iter().collect();
        while let Some(group) = waiting.pop() {
            if best.beats(group.bounds.distance_squared(point.0)) {
                continue;
            }
            match &group.content {
                Content::Triangles(triangles) => {
                    for &triangle in triangles {
                        best.offer(self.mesh, point, triangle);
                    }
                }
                Content::Halves(halves) => {
                    let [first, second] = halves.as_ref();
                    let distance = |it: &Group| it.bounds.distance_squared(point.0);
                    // The closer half is searched first: it rules out most of the other.
                    if distance(first) < distance(second) {
                        waiting.extend([second, first]);
                    } else {
                        waiting.extend([first, second]);
                    }
                }
            }
        }
        best.found
    }
}

/// Halves until groups are small; the halves are equal, so the depth is the logarithm of the number.
fn group(triangles: &mut [(usize, Bounds)]) -> Option<Group> {
    let bounds = triangles
        .iter()
        .map(|(_, bounds)| *bounds)
        .reduce(|all, it| all.joined(&it))?;
    if triangles.len() <= LEAF_TRIANGLES {
        let content = Content::Triangles(triangles.iter().map(|(it, _)| *it).collect());
        return Some(Group { bounds, content });
    }
    let axis = (bounds.high - bounds.low).imax();
    let center = |bounds: &Bounds| -> Vector3<f64> { bounds.low + bounds.high };
    let middle = triangles.len() / 2;
    triangles.select_nth_unstable_by(middle, |(_, a), (_, b)| {
        center(a)[axis].total_cmp(&center(b)[axis])
    });
    let (first, second) = triangles.split_at_mut(middle);
    let content = Content::Halves(Box::new([group(first)?, group(second)?]));
    Some(Group { bounds, content })
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = ModelPoint> {
        [-5.0..5.0, -5.0..5.0, -5.0..5.0].prop_map(|[x, y, z]| ModelPoint(Point3::new(x, y, z)))
    }

    proptest! {
        #[test]
        fn the_tree_finds_what_a_search_of_all_triangles_finds(
            vertices in prop::collection::vec(point(), 8..40),
            corners in prop::collection::vec([0..8u32, 0..8u32, 0..8u32], 0..200),
            asked in prop::collection::vec(point(), 1..20),
        ) {
            let spread = u32::try_from(vertices.len()).unwrap() / 8;
            let triangles = corners.iter().enumerate();
            let triangles = triangles.map(|(at, it)| it.map(|corner| corner * spread + u32::try_from(at).unwrap() % spread));
            let mesh = FaceMesh { triangles: triangles.collect(), vertices };
            let tree = SurfaceTree::of(&mesh);
            for point in asked.into_iter().chain(mesh.vertices.iter().copied()) {
                let (found, expected) = (tree.closest_point(point), mesh.closest_point(point, |_| true));
                prop_assert_eq!(found.is_some(), expected.is_some());
                if let (Some(found), Some(expected)) = (found, expected) {
                    prop_assert!((found.distance_cm - expected.distance_cm).abs() < 1e-12);
                }
            }
        }
    }
}
