//! The best similarity or rigid motion between two point sets, in closed form.
//!
//! Minimizes Σ wⱼ |qⱼ − (s R pⱼ + t)|² (Umeyama 1991), the minimizer of what Choe & Ko 2001, section 4.1.1, iterate.
//! Their literal sweep over s, t and R does not converge when the capture origin is far away; the closed form is exact.

use nalgebra::{Matrix3, Point3, Rotation3, SVD, UnitQuaternion, Vector3};

/// Iteration limit of the 3 × 3 singular value decomposition, which needs about ten.
const SVD_ITERATIONS: usize = 100;

/// Singular values of the covariance below this share of the largest count as zero.
const RANK_TOLERANCE: f64 = 1e-9;

/// The minimizer, with what it says about the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Scale, 1 for a rigid fit.
    pub scale: f64,
    /// Proper rotation.
    pub rotation: UnitQuaternion<f64>,
    /// Translation.
    pub translation: Vector3<f64>,
    /// How well a mirrored fit would do: the smallest singular value's share of the second, with the sign of the determinant.
    /// Negative says that the points are closer to a mirror image.
    pub handedness: f64,
}

/// Whether the scale is fitted too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Fit s.
    Free,
    /// s = 1.
    One,
}

/// Fits `target ≈ s R source + t` with one weight (not negative) a pair.
///
/// Returns `None` when the weighted points do not determine a rotation: fewer than three, identical, or on a line.
pub fn fit(
    pairs: impl Iterator<Item = (f64, Point3<f64>, Point3<f64>)> + Clone,
    scale: Scale,
) -> Option<Fit> {
    let (total, from, to) = pairs.clone().fold(
        (0.0, Vector3::zeros(), Vector3::zeros()),
        |(total, from, to), (w, p, q)| (total + w, from + w * p.coords, to + w * q.coords),
    );
    if total.is_nan() || total <= 0.0 {
        return None;
    }
    let (from, to) = (from / total, to / total);
    let mut covariance = Matrix3::zeros();
    let mut variance = 0.0;
    for (w, p, q) in pairs {
        let (p, q) = (p.coords - from, q.coords - to);
        covariance += w * q * p.transpose();
        variance += w * p.norm_squared();
    }
    let (rotation, values, sign) = procrustes(covariance)?;
    let scale = match scale {
        Scale::Free => (values.x + values.y + sign * values.z) / variance,
        Scale::One => 1.0,
    };
    if !(scale.is_finite() && scale > 0.0) {
        return None;
    }
    Some(Fit {
        scale,
        rotation,
        translation: to - scale * (rotation * from),
        handedness: sign * values.z / values.y,
    })
}

/// The rotation that maximizes tr(RᵀS), the singular values of S in falling order, and the sign of its determinant.
fn procrustes(covariance: Matrix3<f64>) -> Option<(UnitQuaternion<f64>, Vector3<f64>, f64)> {
    if !covariance.iter().all(|it| it.is_finite()) {
        return None;
    }
    let svd = SVD::try_new(covariance, true, true, f64::EPSILON, SVD_ITERATIONS)?;
    let (u, v_t, values) = (svd.u?, svd.v_t?, svd.singular_values);
    if values.x <= 0.0 || values.y < RANK_TOLERANCE * values.x {
        return None;
    }
    let sign = if (u.determinant() * v_t.determinant()) < 0.0 {
        -1.0
    } else {
        1.0
    };
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v_t;
    let rotation =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    Some((rotation, values, sign))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn cloud() -> Vec<Point3<f64>> {
        vec![
            Point3::new(0.0, 0.0, 9.0),
            Point3::new(5.0, 1.0, 7.0),
            Point3::new(-5.0, 1.5, 7.2),
            Point3::new(0.5, -9.0, 8.0),
            Point3::new(2.0, -6.0, 9.5),
        ]
    }

    proptest! {
        #[test]
        fn a_similarity_recovers_itself(
            scale in 0.1..10.0_f64,
            axis in proptest::array::uniform3(-3.0..3.0_f64),
            shift in proptest::array::uniform3(-500.0..500.0_f64),
        ) {
            let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(axis));
            let shift = Vector3::from(shift);
            let pairs = cloud().into_iter().map(|p| (1.0, p, Point3::from(scale * (rotation * p.coords) + shift)));
            let fit = fit(pairs, Scale::Free).unwrap();
            prop_assert!((fit.scale / scale - 1.0).abs() < 1e-9);
            prop_assert!(fit.rotation.angle_to(&rotation) < 1e-7);
            prop_assert!((fit.translation - shift).norm() < 1e-7);
            prop_assert!(fit.handedness > 0.0);
        }
    }

    #[test]
    fn a_mirror_image_is_told_by_its_handedness_and_never_gives_a_reflection() {
        let pairs = cloud()
            .into_iter()
            .map(|p| (1.0, p, Point3::new(-p.x, p.y, p.z)));
        let fit = fit(pairs, Scale::One).unwrap();
        assert!(fit.handedness < 0.0);
        let determinant = fit.rotation.to_rotation_matrix().matrix().determinant();
        assert!((determinant - 1.0).abs() < 1e-12);
    }

    #[test]
    fn points_on_a_line_have_no_fit() {
        let pairs = (0..5).map(|i| {
            let p = Point3::new(f64::from(i), 2.0 * f64::from(i), 0.0);
            (1.0, p, p)
        });
        assert!(fit(pairs, Scale::Free).is_none());
    }
}
