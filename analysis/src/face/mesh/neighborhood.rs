//! The connected piece of surface around a triangle: where a marker may slide without jumping over the mouth slit.

use std::collections::BTreeMap;

use super::{
    FaceMesh,
    closest::{Bounds, closest_on_triangle},
};
use crate::face::marker::VirtualMarker;

impl FaceMesh {
    /// The triangles that can be reached from `triangle` over shared edges without going further than `radius_cm`
    /// from its center; itself included, in ascending order.
    ///
    /// Upper and lower lip do not share edges along the slit, so a marker that is searched only here stays on its lip.
    /// Cost: one bounding box test a triangle of the mesh, plus sorting those within the radius.
    ///
    /// # Panics
    ///
    /// When `triangle` is not a triangle of this mesh.
    pub fn neighborhood(&self, triangle: usize, radius_cm: f64) -> Vec<usize> {
        let center = VirtualMarker {
            triangle,
            barycentric: [1.0 / 3.0; 3],
        }
        .position(self);
        let within = |candidate: &usize| {
            let corners = self.corners(*candidate).map(|corner| corner.0);
            if Bounds::of(&corners).distance_squared(center.0) > radius_cm * radius_cm {
                return false;
            }
            let place = VirtualMarker {
                triangle: *candidate,
                barycentric: closest_on_triangle(center.0, corners),
            };
            (place.position(self).0 - center.0).norm() <= radius_cm
        };
        let near: Vec<usize> = (0..self.triangles.len())
            .filter(|candidate| *candidate == triangle || within(candidate))
            .collect();
        self.connected(triangle, &near)
    }

    /// Those of `candidates` that hang together with `start` by edges, ascending.
    fn connected(&self, start: usize, candidates: &[usize]) -> Vec<usize> {
        let mut triangles_at_edge: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for &candidate in candidates {
            for edge in edges(self.triangles[candidate]) {
                triangles_at_edge.entry(edge).or_default().push(candidate);
            }
        }
        let mut reached = vec![start];
        let mut waiting = vec![start];
        let mut seen: std::collections::BTreeSet<usize> = [start].into();
        while let Some(triangle) = waiting.pop() {
            for edge in edges(self.triangles[triangle]) {
                for &next in triangles_at_edge.get(&edge).into_iter().flatten() {
                    if seen.insert(next) {
                        reached.push(next);
                        waiting.push(next);
                    }
                }
            }
        }
        reached.sort_unstable();
        reached
    }
}

/// The three edges of a triangle, each with the smaller vertex first.
pub(super) fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::ModelPoint;

    /// Two strips of unit squares that touch along y = 0 but share no vertex there: a closed mouth.
    fn closed_mouth() -> FaceMesh {
        let row = |y: f64| (0..6).map(move |x| ModelPoint::new(f64::from(x), y, 0.0));
        let vertices = row(1.0).chain(row(0.0)).chain(row(0.0)).chain(row(-1.0));
        let quad = |left: u32| [[left + 6, left + 7, left + 1], [left + 6, left + 1, left]];
        FaceMesh {
            vertices: vertices.collect(),
            triangles: (0..5).chain(12..17).flat_map(quad).collect(),
        }
    }

    #[test]
    fn a_neighborhood_does_not_cross_the_slit() {
        let mesh = closed_mouth();
        assert_eq!(mesh.neighborhood(4, 50.0), (0..10).collect::<Vec<_>>());
        assert_eq!(mesh.neighborhood(14, 50.0), (10..20).collect::<Vec<_>>());
    }

    #[test]
    fn a_neighborhood_ends_at_its_radius() {
        let mesh = closed_mouth();
        assert_eq!(mesh.neighborhood(4, 0.0), [4]);
        let near = mesh.neighborhood(4, 1.0);
        assert!(
            near.contains(&5) && !near.contains(&0) && !near.contains(&9),
            "{near:?}"
        );
    }
}
