//! Smooth, moderate motion of the head: turning up to 10°, nodding 6°, tilting 4°, and a centimeter to every side.
//!
//! Each of the six is a sum of slow sines with random periods and phases; the head is still while the face is neutral.

use std::f64::consts::TAU;

use frontalis_analysis::space::{HeadPose, ModelPoint};
use nalgebra::{UnitQuaternion, Vector3};
use rand::RngExt as _;
use rand_pcg::Pcg64;

use super::NEUTRAL_SECS;

/// Most of pitch, yaw and roll.
const MOST_DEGREES: [f64; 3] = [6.0, 10.0, 4.0];
/// Most of the motion along each axis.
const MOST_CM: f64 = 1.0;
/// How long the motion takes to reach its full extent.
const START_SECS: f64 = 1.5;
/// The neck, from the middle of the markers.
const PIVOT_FROM_CENTER_CM: Vector3<f64> = Vector3::new(0.0, -6.0, -10.0);
/// The sines of one sum: relative heights, which add up to 1.
const HEIGHTS: [f64; 3] = [0.5, 0.3, 0.2];

struct Sine {
    height: f64,
    frequency_hz: f64,
    phase_radians: f64,
}

/// The head's motion.
pub(super) struct HeadMotion {
    pivot: Vector3<f64>,
    /// Pitch, yaw, roll, then x, y, z; each within ±1.
    axes: [[Sine; 3]; 6],
}

impl HeadMotion {
    /// The motion of a head whose markers have their middle at `center`.
    pub(super) fn new(center: ModelPoint, mut generator: Pcg64) -> Self {
        let axes = std::array::from_fn(|_| {
            HEIGHTS.map(|height| Sine {
                height,
                frequency_hz: 1.0 / generator.random_range(2.5..9.0),
                phase_radians: generator.random_range(0.0..TAU),
            })
        });
        Self {
            pivot: center.0.coords + PIVOT_FROM_CENTER_CM,
            axes,
        }
    }

    /// Where the head is since its neutral pose.
    pub(super) fn pose_at(&self, time_secs: f64) -> HeadPose {
        let since_start = ((time_secs - NEUTRAL_SECS) / START_SECS).clamp(0.0, 1.0);
        let extent = since_start * since_start * (3.0 - 2.0 * since_start);
        let [pitch, yaw, roll, x, y, z] = self
            .axes
            .each_ref()
            .map(|sines| extent * sum(sines, time_secs));
        let [most_pitch, most_yaw, most_roll] = MOST_DEGREES.map(f64::to_radians);
        let rotation =
            UnitQuaternion::from_euler_angles(most_pitch * pitch, most_yaw * yaw, most_roll * roll);
        HeadPose {
            rotation,
            translation_cm: self.pivot - rotation * self.pivot + Vector3::new(x, y, z) * MOST_CM,
        }
    }
}

fn sum(sines: &[Sine; 3], time_secs: f64) -> f64 {
    let value =
        |it: &Sine| it.height * (TAU * it.frequency_hz * time_secs + it.phase_radians).sin();
    sines.iter().map(value).sum()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng as _;

    use super::*;

    #[test]
    fn the_head_is_still_first_and_then_moves_moderately_and_smoothly() {
        let center = ModelPoint::new(0.0, -2.0, 8.0);
        let motion = HeadMotion::new(center, Pcg64::seed_from_u64(3));
        let at = |step: i32| motion.pose_at(f64::from(step) / 60.0);
        assert_eq!(at(0), HeadPose::identity());
        assert_eq!(at(60), HeadPose::identity());
        let mut most_degrees = 0.0_f64;
        for step in 60..60 * 60 {
            let moved = (at(step).apply(center).0 - at(step - 1).apply(center).0).norm();
            assert!(moved < 0.2, "{moved} cm in a frame");
            most_degrees = most_degrees.max(at(step).rotation.angle().to_degrees());
        }
        assert!((4.0..13.0).contains(&most_degrees), "{most_degrees}°");
    }
}
