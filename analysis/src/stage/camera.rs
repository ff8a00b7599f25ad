//! A pinhole camera: u = cᵤ + f x/z, v = cᵥ + f y/z in the camera's own axes (x right, y down, z forward).
//!
//! Images are taken as free of lens distortion, as capture systems deliver them.

use nalgebra::{Matrix3, Unit, Vector3};

use crate::space::PerformancePoint;

/// A surface is seen while the cosine between its normal and the line of sight exceeds this.
pub const LEAST_FACING_COSINE: f64 = 0.25;

/// A place in an image, in pixels from the outer corner of the top left pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImagePoint {
    /// To the right.
    pub u_px: f64,
    /// Down.
    pub v_px: f64,
}

/// What a camera does with a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intrinsics {
    /// Focal length; positive.
    pub focal_px: f64,
    /// Where the optical axis meets the image.
    pub center: ImagePoint,
    /// Width of the image.
    pub width_px: f64,
    /// Height of the image.
    pub height_px: f64,
}

impl Intrinsics {
    /// Square pixels and a centered axis, from the angle that the image's width spans, in radians.
    pub fn from_field_of_view(width_px: f64, height_px: f64, horizontal_radians: f64) -> Self {
        Self {
            focal_px: width_px / 2.0 / (horizontal_radians / 2.0).tan(),
            center: ImagePoint {
                u_px: width_px / 2.0,
                v_px: height_px / 2.0,
            },
            width_px,
            height_px,
        }
    }

    fn holds(&self, at: ImagePoint) -> bool {
        (0.0..self.width_px).contains(&at.u_px) && (0.0..self.height_px).contains(&at.v_px)
    }
}

/// A calibrated camera in performance space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    intrinsics: Intrinsics,
    position: PerformancePoint,
    /// Rows: the camera's right, down and forward in performance space.
    axes: Matrix3<f64>,
}

impl Camera {
    /// A camera at `position` that looks at `target` and keeps `up` upwards in its image.
    ///
    /// `None` when that leaves the direction open: the target at the camera, or straight along `up`.
    pub fn looking_at(
        intrinsics: Intrinsics,
        position: PerformancePoint,
        target: PerformancePoint,
        up: Vector3<f64>,
    ) -> Option<Self> {
        let least = 1e-9;
        let forward = Unit::try_new(target.0 - position.0, least)?;
        let right = Unit::try_new(forward.cross(&up), least * up.norm())?;
        let down = forward.cross(&right);
        Some(Self {
            intrinsics,
            position,
            axes: Matrix3::from_rows(&[right.transpose(), down.transpose(), forward.transpose()]),
        })
    }

    /// What the camera does with a direction.
    pub fn intrinsics(&self) -> &Intrinsics {
        &self.intrinsics
    }

    /// The center of projection.
    pub fn position(&self) -> PerformancePoint {
        self.position
    }

    /// The camera's right, down and forward, as rows: the rotation from performance space into the camera's axes.
    pub fn axes(&self) -> &Matrix3<f64> {
        &self.axes
    }

    /// Where `point` appears; `None` behind the camera or outside the image.
    pub fn project(&self, point: PerformancePoint) -> Option<ImagePoint> {
        let in_camera = self.axes * (point.0 - self.position.0);
        if in_camera.z <= 0.0 {
            return None;
        }
        let scale_px = self.intrinsics.focal_px / in_camera.z;
        let at = ImagePoint {
            u_px: self.intrinsics.center.u_px + scale_px * in_camera.x,
            v_px: self.intrinsics.center.v_px + scale_px * in_camera.y,
        };
        self.intrinsics.holds(at).then_some(at)
    }

    /// Whether the surface at `point` with the unit `normal` is turned to the camera enough to be seen.
    pub fn faces(&self, point: PerformancePoint, normal: &Vector3<f64>) -> bool {
        let to_camera = self.position.0 - point.0;
        normal.dot(&to_camera) > LEAST_FACING_COSINE * to_camera.norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let intrinsics = Intrinsics::from_field_of_view(640.0, 480.0, 28_f64.to_radians());
        let (position, target) = (
            PerformancePoint::new(0.0, 0.0, 90.0),
            PerformancePoint::new(0.0, 0.0, 0.0),
        );
        Camera::looking_at(intrinsics, position, target, Vector3::y()).unwrap()
    }

    #[test]
    fn the_focal_length_follows_from_the_field_of_view() {
        assert!((camera().intrinsics().focal_px - 1_283.4).abs() < 0.1);
    }

    #[test]
    fn sees_the_target_in_the_middle_and_up_and_right_where_they_belong() {
        let seen = |x, y| camera().project(PerformancePoint::new(x, y, 0.0)).unwrap();
        let middle = seen(0.0, 0.0);
        assert!((middle.u_px - 320.0).abs() < 1e-9 && (middle.v_px - 240.0).abs() < 1e-9);
        let aside = seen(1.0, 2.0);
        let px_per_cm = camera().intrinsics().focal_px / 90.0;
        assert!((aside.u_px - 320.0 - px_per_cm).abs() < 1e-9);
        assert!((aside.v_px - 240.0 + 2.0 * px_per_cm).abs() < 1e-9);
    }

    #[test]
    fn does_not_see_what_is_behind_it_or_beside_its_image() {
        assert_eq!(
            camera().project(PerformancePoint::new(0.0, 0.0, 91.0)),
            None
        );
        assert_eq!(
            camera().project(PerformancePoint::new(23.0, 0.0, 0.0)),
            None
        );
        assert_eq!(
            camera().project(PerformancePoint::new(0.0, f64::NAN, 0.0)),
            None
        );
    }

    #[test]
    fn sees_a_surface_until_it_turns_away() {
        let origin = PerformancePoint::new(0.0, 0.0, 0.0);
        let turned = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            camera().faces(origin, &Vector3::new(sin, 0.0, cos))
        };
        assert!(turned(75.0) && !turned(76.0) && !turned(180.0));
    }

    #[test]
    fn a_camera_without_a_direction_is_none() {
        let here = PerformancePoint::new(1.0, 2.0, 3.0);
        let above = PerformancePoint::new(1.0, 9.0, 3.0);
        let intrinsics = *camera().intrinsics();
        assert_eq!(
            Camera::looking_at(intrinsics, here, here, Vector3::y()),
            None
        );
        assert_eq!(
            Camera::looking_at(intrinsics, here, above, Vector3::y()),
            None
        );
    }
}
