//! Random numbers that a generator of `rand` does not give by itself.

use nalgebra::Vector3;
use rand::RngExt as _;
use rand_pcg::Pcg64;

/// A standard normal deviate (Box & Muller).
pub(super) fn normal(rng: &mut Pcg64) -> f64 {
    let (u, v): (f64, f64) = (
        rng.random_range(f64::MIN_POSITIVE..1.0),
        rng.random_range(0.0..1.0),
    );
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

/// Three independent standard normal deviates.
pub(super) fn normal_vector(rng: &mut Pcg64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| normal(rng))
}

/// A direction, all alike likely.
pub(super) fn direction(rng: &mut Pcg64) -> Vector3<f64> {
    normal_vector(rng).normalize()
}
