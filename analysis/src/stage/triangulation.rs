//! Linear triangulation with known cameras (direct linear transform): where the rays of two or more views meet.
//!
//! A view (u, v) of a camera with rows r₁ r₂ r₃ and center c gives two planes through the point p:
//! (f r₁ − (u − cᵤ) r₃)·(p − c) = 0 and (f r₂ − (v − cᵥ) r₃)·(p − c) = 0. The point is the least-squares solution over all views,
//! from its 3 × 3 normal equations: fixed-size arithmetic that ends for whatever numbers come off the wire.
//! The squared condition that normal equations cost is harmless here, see [`LEAST_SPREAD`].

use nalgebra::{Cholesky, Matrix3, Vector3};

use super::camera::{Camera, ImagePoint};
use crate::space::PerformancePoint;

/// Rays closer to parallel than this are no place.
///
/// It is the determinant of the normal equations over the cube of their mean eigenvalue:
/// 1 for rays from all sides, about 0.1 for two cameras 60° apart, and 1e-6 for 0.1°.
/// Above it, the equations lose six of sixteen digits at most.
pub const LEAST_SPREAD: f64 = 1e-6;

/// Why views give no place.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TriangulationError {
    /// One ray has no end.
    #[error("{found} views, a place needs two")]
    TooFewViews {
        /// Views given.
        found: usize,
    },
    /// The rays are parallel, or a number is not finite.
    #[error("the rays' spread is {spread}, below {LEAST_SPREAD}")]
    ParallelRays {
        /// As [`LEAST_SPREAD`] defines it.
        spread: f64,
    },
}

/// Where the rays of `views` meet.
///
/// All views count alike, in pixels at like distances. Nothing is allocated.
///
/// # Errors
///
/// [`TriangulationError`] for fewer than two views, and for rays that are parallel or not finite.
pub fn triangulate<'a>(
    views: impl IntoIterator<Item = (&'a Camera, ImagePoint)>,
) -> Result<PerformancePoint, TriangulationError> {
    let mut equations = Equations::default();
    for (camera, seen) in views {
        equations.add(camera, seen);
    }
    equations.solve()
}

/// N p' = b for p' = p − `origin`, which is the first camera's place: digits are not spent on where the stage stands.
#[derive(Default)]
struct Equations {
    n_views: usize,
    origin: Vector3<f64>,
    normal: Matrix3<f64>,
    right: Vector3<f64>,
}

impl Equations {
    fn add(&mut self, camera: &Camera, seen: ImagePoint) {
        let center = camera.position().0.coords;
        if self.n_views == 0 {
            self.origin = center;
        }
        self.n_views += 1;
        let rows = camera.axes();
        let intrinsics = camera.intrinsics();
        let focal = rows.fixed_rows::<2>(0) * intrinsics.focal_px;
        let off_axis = [
            seen.u_px - intrinsics.center.u_px,
            seen.v_px - intrinsics.center.v_px,
        ];
        for (axis, off_axis_px) in off_axis.into_iter().enumerate() {
            let plane = (focal.row(axis) - rows.row(2) * off_axis_px).transpose();
            self.normal += plane * plane.transpose();
            self.right += plane * plane.dot(&(center - self.origin));
        }
    }

    fn solve(&self) -> Result<PerformancePoint, TriangulationError> {
        if self.n_views < 2 {
            return Err(TriangulationError::TooFewViews {
                found: self.n_views,
            });
        }
        let mean = self.normal.trace() / 3.0;
        let spread = (self.normal / mean).determinant();
        let factor = (spread >= LEAST_SPREAD).then(|| Cholesky::new(self.normal));
        factor
            .flatten()
            .map(|it| it.solve(&self.right) + self.origin)
            // Image points near the largest number overflow on the way.
            .filter(|it| it.iter().all(|it| it.is_finite()))
            .map(|it| PerformancePoint(it.into()))
            .ok_or(TriangulationError::ParallelRays { spread })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::stage::{camera::Intrinsics, rig::tests::anywhere};

    proptest! {
        #[test]
        fn a_place_seen_by_cameras_is_found_again(
            rig in anywhere(), x in -8.0..8.0_f64, y in -8.0..8.0_f64, z in -8.0..8.0_f64,
        ) {
            let place = PerformancePoint(rig.target().0 + Vector3::new(x, y, z));
            let views = rig.cameras().iter().map(|it| (it, it.project(place).unwrap()));
            let found = triangulate(views).unwrap();
            prop_assert!((found.0 - place.0).norm() < 1e-9);
        }

        #[test]
        fn any_numbers_end_in_a_place_or_an_error(
            rig in anywhere(), u in prop::num::f64::ANY, v in prop::num::f64::ANY,
        ) {
            let seen = ImagePoint { u_px: u, v_px: v };
            let views = rig.cameras().iter().map(|it| (it, seen));
            let found = triangulate(views);
            prop_assert!(found.is_err() || found.is_ok_and(|it| it.0.iter().all(|it| it.is_finite())));
        }
    }

    #[test]
    fn one_view_is_no_place() {
        let middle = ImagePoint {
            u_px: 320.0,
            v_px: 240.0,
        };
        let camera = camera_at(0.0);
        let found = triangulate([(&camera, middle)]).unwrap_err();
        assert_eq!(found, TriangulationError::TooFewViews { found: 1 });
        assert_eq!(
            triangulate([]).unwrap_err(),
            TriangulationError::TooFewViews { found: 0 }
        );
    }

    #[test]
    fn two_views_from_one_place_are_no_place() {
        let place = PerformancePoint::new(1.0, 1.0, 0.0);
        let (one, other) = (camera_at(0.0), camera_at(1e-3));
        let views = [&one, &other].map(|it| (it, it.project(place).unwrap()));
        assert!(matches!(
            triangulate(views),
            Err(TriangulationError::ParallelRays { .. })
        ));
    }

    fn camera_at(x_cm: f64) -> Camera {
        let intrinsics = Intrinsics::from_field_of_view(640.0, 480.0, 28_f64.to_radians());
        let (position, target) = (
            PerformancePoint::new(x_cm, 0.0, 90.0),
            PerformancePoint::new(0.0, 0.0, 0.0),
        );
        Camera::looking_at(intrinsics, position, target, Vector3::y()).unwrap()
    }
}
