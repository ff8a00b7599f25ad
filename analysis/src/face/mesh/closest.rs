//! The point of a surface closest to a given one (Ericson, Real-Time Collision Detection, section 5.1.5).

use nalgebra::{Point3, Vector3};

use super::FaceMesh;
use crate::{face::marker::VirtualMarker, space::ModelPoint};

/// A point of the surface and how far it is from the one that was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Triangle and barycentric weights.
    pub place: VirtualMarker,
    /// Where that is.
    pub position: ModelPoint,
    /// Distance from the given point, centimeters.
    pub distance_cm: f64,
}

impl FaceMesh {
    /// The closest point over all triangles that `allowed` admits; `None` when it admits no triangle with an area.
    ///
    /// Triangles without area never carry a point. Of equally close triangles the first is taken.
    /// Cost: one bounding box test a triangle, one exact test where the box is closer than the best so far.
    pub fn closest_point(
        &self,
        point: ModelPoint,
        allowed: impl Fn(usize) -> bool,
    ) -> Option<SurfacePoint> {
        self.closest_point_among(
            point,
            (0..self.triangles.len()).filter(|&triangle| allowed(triangle)),
        )
    }

    /// The closest point over the given triangles, as [`FaceMesh::closest_point`].
    ///
    /// # Panics
    ///
    /// When one of `triangles` is not a triangle of this mesh.
    pub fn closest_point_among(
        &self,
        point: ModelPoint,
        triangles: impl IntoIterator<Item = usize>,
    ) -> Option<SurfacePoint> {
        let mut best = Best::default();
        for triangle in triangles {
            best.offer(self, point, triangle);
        }
        best.found
    }
}

/// The closest point so far; of equally close ones that of the lowest triangle, whatever the order of asking.
#[derive(Default)]
pub(super) struct Best {
    pub(super) found: Option<SurfacePoint>,
}

impl Best {
    /// Whether nothing at this squared distance or further can be closer.
    pub(super) fn beats(&self, distance_squared: f64) -> bool {
        self.found
            .is_some_and(|it| distance_squared > it.distance_cm * it.distance_cm)
    }

    /// Takes the triangle's closest point if it is closer; a triangle without area never is.
    pub(super) fn offer(&mut self, mesh: &FaceMesh, point: ModelPoint, triangle: usize) {
        let corners = mesh.corners(triangle).map(|corner| corner.0);
        let bounds = Bounds::of(&corners);
        if self.beats(bounds.distance_squared(point.0)) || mesh.is_degenerate(triangle) {
            return;
        }
        let place = VirtualMarker {
            triangle,
            barycentric: closest_on_triangle(point.0, corners),
        };
        let position = place.position(mesh);
        let offered = SurfacePoint {
            place,
            position,
            distance_cm: (position.0 - point.0).norm(),
        };
        let rank = |it: &SurfacePoint| (it.distance_cm, it.place.triangle);
        if self.found.is_none_or(|best| rank(&offered) < rank(&best)) {
            self.found = Some(offered);
        }
    }
}

/// An axis-aligned box.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) low: Vector3<f64>,
    pub(super) high: Vector3<f64>,
}

impl Bounds {
    pub(super) fn of([a, b, c]: &[Point3<f64>; 3]) -> Self {
        Self {
            low: a.coords.inf(&b.coords).inf(&c.coords),
            high: a.coords.sup(&b.coords).sup(&c.coords),
        }
    }

    pub(super) fn joined(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// Squared distance to a point; never more than that to anything inside.
    pub(super) fn distance_squared(&self, point: Point3<f64>) -> f64 {
        let nearest = point.coords.sup(&self.low).inf(&self.high);
        (point.coords - nearest).norm_squared()
    }
}

/// Barycentric weights of the point of a triangle closest to `p`, by the Voronoi region that `p` lies in.
pub(super) fn closest_on_triangle(p: Point3<f64>, [a, b, c]: [Point3<f64>; 3]) -> [f64; 3] {
    let (ab, ac) = (b - a, c - a);
    let ap = p - a;
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return [1.0 - t, t, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - t, t];
    }
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    [(1.0 - v - w).max(0.0), v, w]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = Point3<f64>> {
        [-10.0..10.0, -10.0..10.0, -10.0..10.0].prop_map(|[x, y, z]| Point3::new(x, y, z))
    }

    fn mix([a, b, c]: [Point3<f64>; 3], weights: [f64; 3]) -> Point3<f64> {
        Point3::from(a.coords * weights[0] + b.coords * weights[1] + c.coords * weights[2])
    }

    proptest! {
        #[test]
        fn no_other_point_of_the_triangle_is_closer(
            corners in [point(), point(), point()], p in point(), u in 0.0..1.0, v in 0.0..1.0,
        ) {
            let (u, v): (f64, f64) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let weights = closest_on_triangle(p, corners);
            prop_assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{weights:?}");
            prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let found = (mix(corners, weights) - p).norm();
            let other = (mix(corners, [1.0 - u - v, u, v]) - p).norm();
            prop_assert!(found <= other + 1e-9);
        }

        #[test]
        fn a_point_of_the_surface_is_its_own_closest_point(
            corners in [point(), point(), point()], u in 0.01..1.0, v in 0.01..1.0, w in 0.01..1.0,
        ) {
            let sum: f64 = u + v + w;
            let p = mix(corners, [u / sum, v / sum, w / sum]);
            let weights = closest_on_triangle(p, corners);
            prop_assert!((mix(corners, weights) - p).norm() < 1e-9);
        }
    }

    fn two_triangles() -> FaceMesh {
        FaceMesh {
            vertices: [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (2.0, 0.0)]
                .map(|(x, y)| ModelPoint::new(x, y, 0.0))
                .to_vec(),
            triangles: vec![[0, 1, 4], [0, 1, 2], [1, 3, 2]],
        }
    }

    #[test]
    fn a_triangle_without_area_never_carries_a_point() {
        let mesh = two_triangles();
        let found = mesh
            .closest_point(ModelPoint::new(0.5, -1.0, 0.0), |_| true)
            .unwrap();
        assert_eq!(found.place.triangle, 1);
        assert!((found.distance_cm - 1.0).abs() < 1e-12);
        assert_eq!(
            mesh.closest_point(ModelPoint::new(0.5, -1.0, 0.0), |it| it == 0),
            None
        );
    }

    #[test]
    fn triangles_that_are_not_allowed_are_passed_over() {
        let mesh = two_triangles();
        let found = mesh
            .closest_point(ModelPoint::new(0.1, 0.1, 1.0), |it| it == 2)
            .unwrap();
        assert_eq!(found.place.triangle, 2);
        assert!((found.position.0 - Point3::new(0.5, 0.5, 0.0)).norm() < 1e-12);
    }
}
