//! The arc of cameras around a face: 90 cm away, 640 × 480 pixels over 28°.
//!
//! Five of them stand at −60°, −30°, 0°, 30°, 60° to the side, alternating between 12° below and above the face,
//! the outer two 5° above; another number spreads over the same arc, three or fewer over less of it,
//! so that neighbors still share most markers.

use nalgebra::{UnitQuaternion, Vector3};

use super::{
    camera::{Camera, ImagePoint, Intrinsics},
    triangulation::{TriangulationError, triangulate},
};
use crate::space::PerformancePoint;

/// Fewest cameras that can tell how far a marker is.
pub const LEAST_CAMERAS: usize = 2;
/// Most cameras of a rig.
pub const MAX_CAMERAS: usize = 32;
/// From the face to every camera.
pub const DISTANCE_CM: f64 = 90.0;
/// What the width of an image spans.
pub const FIELD_OF_VIEW_DEGREES: f64 = 28.0;
/// Width and height of an image.
pub const IMAGE_SIZE_PX: (f64, f64) = (640.0, 480.0);

/// The number of cameras is outside [`LEAST_CAMERAS`]..=[`MAX_CAMERAS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found} cameras, a rig has {LEAST_CAMERAS} to {MAX_CAMERAS}")]
pub struct CameraCountError {
    /// Cameras asked for.
    pub found: usize,
}

/// Calibrated cameras around one face.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraRig {
    target: PerformancePoint,
    cameras: Vec<Camera>,
}

impl CameraRig {
    /// An arc of cameras around a face at `target`.
    ///
    /// `performance_from_subject` turns the subject's axes (+x the subject's left, +y up, +z forward)
    /// into performance space.
    ///
    /// # Errors
    ///
    /// [`CameraCountError`] when there are too few or too many.
    pub fn arc(
        n_cameras: usize,
        target: PerformancePoint,
        performance_from_subject: UnitQuaternion<f64>,
    ) -> Result<Self, CameraCountError> {
        if !(LEAST_CAMERAS..=MAX_CAMERAS).contains(&n_cameras) {
            return Err(CameraCountError { found: n_cameras });
        }
        let (width, height) = IMAGE_SIZE_PX;
        let intrinsics =
            Intrinsics::from_field_of_view(width, height, FIELD_OF_VIEW_DEGREES.to_radians());
        let up = performance_from_subject * Vector3::y();
        let camera = |camera_idx| {
            let direction = performance_from_subject * direction(camera_idx, n_cameras);
            let position = PerformancePoint(target.0 + direction * DISTANCE_CM);
            Camera::looking_at(intrinsics, position, target, up)
        };
        // No camera stands straight above the face, so none is lost here.
        let cameras = (0..n_cameras).filter_map(camera).collect();
        Ok(Self { target, cameras })
    }

    /// What every camera looks at.
    pub fn target(&self) -> PerformancePoint {
        self.target
    }

    /// The cameras, from the subject's right to left.
    pub fn cameras(&self) -> &[Camera] {
        &self.cameras
    }

    /// What each camera sees of a marker on a surface with the unit `normal`.
    pub fn views(
        &self,
        marker: PerformancePoint,
        normal: &Vector3<f64>,
    ) -> impl Iterator<Item = Option<ImagePoint>> {
        self.cameras.iter().map(move |camera| {
            let faces = camera.faces(marker, normal);
            faces.then(|| camera.project(marker)).flatten()
        })
    }

    /// The marker's place from what each camera saw of it, one entry a camera in order.
    ///
    /// # Errors
    ///
    /// [`TriangulationError`] when fewer than two cameras saw it.
    pub fn triangulate(
        &self,
        views: impl IntoIterator<Item = Option<ImagePoint>>,
    ) -> Result<PerformancePoint, TriangulationError> {
        let cameras = self.cameras.iter().zip(views);
        triangulate(cameras.filter_map(|(camera, seen)| Some((camera, seen?))))
    }
}

/// The unit vector from the face to a camera, in the subject's axes.
fn direction(camera_idx: usize, n_cameras: usize) -> Vector3<f64> {
    let half_arc_degrees = (15.0 * n_cameras as f64).min(60.0);
    let across = 2.0 * camera_idx as f64 / (n_cameras - 1) as f64 - 1.0;
    let elevation_degrees: f64 = match camera_idx {
        outer if outer == 0 || outer == n_cameras - 1 => 5.0,
        odd if odd % 2 == 1 => -12.0,
        _ => 12.0,
    };
    let (sin_aside, cos_aside) = (half_arc_degrees * across).to_radians().sin_cos();
    let (sin_up, cos_up) = elevation_degrees.to_radians().sin_cos();
    Vector3::new(sin_aside * cos_up, sin_up, cos_aside * cos_up)
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A rig of any size, anywhere on a stage.
    pub(crate) fn anywhere() -> impl Strategy<Value = CameraRig> {
        let place = [-300.0..300.0, -300.0..300.0, -300.0..300.0];
        let angles = (-3.0..3.0, -1.5..1.5, -3.0..3.0);
        (2_usize..9, place, angles).prop_map(|(n_cameras, [x, y, z], (roll, pitch, yaw))| {
            let turned = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            CameraRig::arc(n_cameras, PerformancePoint::new(x, y, z), turned).unwrap()
        })
    }

    fn standing(n_cameras: usize) -> Result<CameraRig, CameraCountError> {
        let origin = PerformancePoint::new(0.0, 0.0, 0.0);
        CameraRig::arc(n_cameras, origin, UnitQuaternion::identity())
    }

    #[test]
    fn five_cameras_stand_where_the_method_puts_them() {
        let rig = standing(5).unwrap();
        let expected = [
            (-60.0, 5.0),
            (-30.0, -12.0),
            (0.0, 12.0),
            (30.0, -12.0),
            (60.0, 5.0),
        ];
        for (camera, (azimuth, elevation)) in rig.cameras().iter().zip(expected) {
            let at = camera.position().0;
            assert!((at.x.atan2(at.z).to_degrees() - azimuth).abs() < 1e-9);
            assert!(((at.y / 90.0).asin().to_degrees() - elevation).abs() < 1e-9);
            assert!((at.coords.norm() - 90.0).abs() < 1e-9);
        }
    }

    #[test]
    fn every_number_of_cameras_within_the_limits_is_a_rig() {
        for n_cameras in 2..=MAX_CAMERAS {
            assert_eq!(standing(n_cameras).unwrap().cameras().len(), n_cameras);
        }
        for found in [0, 1, MAX_CAMERAS + 1] {
            assert_eq!(standing(found), Err(CameraCountError { found }));
        }
    }

    #[test]
    fn a_marker_on_the_cheek_is_hidden_from_the_far_side() {
        let rig = standing(5).unwrap();
        let cheek = PerformancePoint::new(6.0, 0.0, 0.0);
        let normal = Vector3::new(1.0, 0.0, 0.0);
        let seen: Vec<bool> = rig.views(cheek, &normal).map(|it| it.is_some()).collect();
        assert_eq!(seen, [false, false, false, true, true]);
        let place = rig.triangulate(rig.views(cheek, &normal)).unwrap();
        assert!((place.0 - cheek.0).norm() < 1e-9);
        assert!(rig.triangulate([None; 5]).is_err());
    }
}
