//! Pseudo-muscles: simple functions of distance that pull skin as a muscle would (Hung & Huang, "Pseudo-Muscles").
//!
//! Linear: p' = p + cos(π/2 · d) (pd − p0), where d = ‖p − p0‖ₐ / r.
//! Sphincter: p' = p − cos(π/2 · d) k ∘ (p − p0).
//! The bare cosine turns negative beyond d = 1, which the paper reports as singularities for a small r;
//! here the pull ends at d = 1.

use nalgebra::Vector3;

/// A muscle that moves the skin around its point of application in parallel.
///
/// The paper's other forms pull every point towards pd and pinch the skin; this one keeps (pd − p0) for all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearMuscle {
    /// p0, where the force applies, centimeters.
    pub origin_cm: Vector3<f64>,
    /// pd, where p0 goes at full contraction, centimeters.
    pub target_cm: Vector3<f64>,
    /// r, how far the muscle reaches, centimeters; positive.
    pub radius_cm: f64,
    /// How much each axis counts in the distance; below 1 widens the reach along that axis.
    pub axis_weights: Vector3<f64>,
}

impl LinearMuscle {
    /// How full contraction displaces the skin at `place`, centimeters.
    pub fn displacement(&self, place: &Vector3<f64>) -> Vector3<f64> {
        let distance = weighted_distance(place - self.origin_cm, self.axis_weights);
        (self.target_cm - self.origin_cm) * falloff(distance / self.radius_cm)
    }

    /// The same muscle on the other side of the face.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self {
            origin_cm: mirror(self.origin_cm),
            target_cm: mirror(self.target_cm),
            ..self
        }
    }
}

/// A ring muscle: it draws the skin towards its center, or lets it expand, each axis by its own measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphincterMuscle {
    /// p0, the ring's center, centimeters.
    pub center_cm: Vector3<f64>,
    /// r, how far the muscle reaches, centimeters; positive.
    pub radius_cm: f64,
    /// k: what part of the distance an axis loses at full contraction; negative expands it.
    pub contraction: Vector3<f64>,
    /// How much each axis counts in the distance.
    pub axis_weights: Vector3<f64>,
}

impl SphincterMuscle {
    /// How full contraction displaces the skin at `place`, centimeters.
    pub fn displacement(&self, place: &Vector3<f64>) -> Vector3<f64> {
        let from_center = place - self.center_cm;
        let distance = weighted_distance(from_center, self.axis_weights);
        -self.contraction.component_mul(&from_center) * falloff(distance / self.radius_cm)
    }
}

/// `point` mirrored at the face's plane of symmetry, x = 0.
pub fn mirror(point: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(-point.x, point.y, point.z)
}

/// 0 below `start`, 1 beyond `end`, a cubic t²(3 − 2t) between; `start` may be the greater.
pub fn smoothstep(start: f64, end: f64, value: f64) -> f64 {
    let t = ((value - start) / (end - start)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn weighted_distance(difference: Vector3<f64>, axis_weights: Vector3<f64>) -> f64 {
    difference.component_mul(&axis_weights).norm()
}

fn falloff(relative_distance: f64) -> f64 {
    if relative_distance < 1.0 {
        (std::f64::consts::FRAC_PI_2 * relative_distance).cos()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const PULL: LinearMuscle = LinearMuscle {
        origin_cm: Vector3::new(1.0, 2.0, 3.0),
        target_cm: Vector3::new(1.5, 4.0, 2.5),
        radius_cm: 2.0,
        axis_weights: Vector3::new(1.0, 0.5, 0.6),
    };
    const RING: SphincterMuscle = SphincterMuscle {
        center_cm: Vector3::new(0.0, -7.0, 9.6),
        radius_cm: 4.0,
        contraction: Vector3::new(0.5, -0.2, 0.0),
        axis_weights: Vector3::new(1.0, 1.0, 0.3),
    };

    #[test]
    fn takes_its_origin_to_its_target() {
        let moved = PULL.origin_cm + PULL.displacement(&PULL.origin_cm);
        assert!((moved - PULL.target_cm).norm() < 1e-15);
    }

    #[test]
    fn reaches_farther_along_an_axis_that_counts_less() {
        let three_cm = 3.0;
        let sideways = PULL.origin_cm + Vector3::x() * three_cm;
        let upwards = PULL.origin_cm + Vector3::y() * three_cm;
        assert_eq!(PULL.displacement(&sideways), Vector3::zeros());
        assert!(PULL.displacement(&upwards).norm() > 0.1);
    }

    #[test]
    fn a_ring_contracts_the_positive_axis_and_expands_the_negative_one() {
        let pulled = RING.displacement(&(RING.center_cm + Vector3::new(1.0, 1.0, 0.0)));
        assert!(pulled.x < 0.0 && pulled.y > 0.0 && pulled.z == 0.0);
    }

    proptest! {
        #[test]
        fn no_muscle_pushes_backwards_or_acts_beyond_its_reach(
            x in -20.0..20.0_f64, y in -20.0..20.0_f64, z in -20.0..20.0_f64,
        ) {
            let offset = Vector3::new(x, y, z);
            let along = PULL.displacement(&(PULL.origin_cm + offset)).dot(&(PULL.target_cm - PULL.origin_cm));
            prop_assert!(along >= 0.0);
            let far = offset.component_mul(&RING.axis_weights).norm() >= RING.radius_cm;
            prop_assert!(!far || RING.displacement(&(RING.center_cm + offset)) == Vector3::zeros());
        }

        #[test]
        fn the_other_side_is_the_exact_mirror(x in -5.0..5.0_f64, y in -5.0..5.0_f64, z in -5.0..9.0_f64) {
            let place = Vector3::new(x, y, z);
            let there = PULL.mirrored().displacement(&mirror(place));
            prop_assert_eq!(mirror(there), PULL.displacement(&place));
        }
    }
}
