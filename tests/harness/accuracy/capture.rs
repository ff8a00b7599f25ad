//! What cameras make of a performance: markers in the axes of a capture system, a head that moves, noise.

use frontalis_analysis::{
    face::{
        actor::Actor,
        basis::MarkerBasis,
        marker::{FrameIndex, MarkerFrame},
    },
    space::{LengthUnit, PerformancePoint},
};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

use super::{
    curves::Curves,
    performance::RATE_HZ,
    random::{normal, normal_vector},
    take::Take,
};

/// How a performance is captured.
#[derive(Clone, Copy, Debug)]
pub struct Capture {
    /// Standard deviation of a marker's position, an axis, centimeters.
    pub noise_cm: f64,
    /// Whether the head turns and shifts.
    pub moving_head: bool,
    /// Seed of the noise and of the head's motion.
    pub seed: u64,
}

impl Capture {
    /// The markers of `actor` under `truth`, one frame a row, [`RATE_HZ`] a second.
    pub fn take(&self, actor: &Actor, truth: Curves) -> Take {
        let mut rng = Pcg64::seed_from_u64(self.seed);
        let sway = Sway::random(&mut rng);
        let basis = actor.marker_basis();
        let frames = truth.0.iter().enumerate().map(|(k, x)| {
            let seconds = k as f64 / RATE_HZ;
            let head = if self.moving_head {
                sway.at(seconds)
            } else {
                Isometry3::identity()
            };
            let mut see = |j| self.see(placed(&basis, j, x), &head, &mut rng);
            MarkerFrame {
                index: FrameIndex(k as u64 + 1),
                capture_time_nanos: nanos(seconds),
                positions: (0..basis.n_markers()).map(|j| Some(see(j))).collect(),
            }
        });
        Take {
            rate_hz: RATE_HZ,
            unit: LengthUnit::Centimeter,
            frames: frames.collect(),
            truth,
        }
    }

    fn see(&self, place: Point3<f64>, head: &Isometry3<f64>, rng: &mut Pcg64) -> PerformancePoint {
        let seen = head * place + self.noise_cm * normal_vector(rng);
        PerformancePoint(capture_axes() * seen)
    }
}

/// p = p₀ + Σ xᵢdᵢ of one marker.
fn placed(basis: &MarkerBasis, marker: usize, x: &[f64]) -> Point3<f64> {
    let moves = basis.of_marker_cm(marker).iter().zip(x);
    moves.fold(basis.neutral[marker].0, |place, (d, x)| place + d * *x)
}

/// From the head at rest to the capture system's own axes and origin.
fn capture_axes() -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -1.2, 0.2));
    Isometry3::from_parts(Translation3::new(40.0, -110.0, 75.0), rotation)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a take lasts seconds, far below 2^63 nanoseconds"
)]
fn nanos(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

/// A head's motion: slow turns of up to about 10 degrees and quick nods of 2, about each axis, and shifts of a few centimeters.
struct Sway {
    turns: [Waves; 3],
    shifts: [Waves; 3],
}

/// A slow and a quick wave: amplitude, radians a second, phase.
struct Waves([[f64; 3]; 2]);

impl Sway {
    fn random(rng: &mut Pcg64) -> Self {
        Self {
            turns: std::array::from_fn(|_| Waves::random(0.1, 0.02, rng)),
            shifts: std::array::from_fn(|_| Waves::random(1.2, 0.2, rng)),
        }
    }

    fn at(&self, seconds: f64) -> Isometry3<f64> {
        let of = |waves: &[Waves; 3]| Vector3::from_fn(|axis, _| waves[axis].at(seconds));
        Isometry3::new(of(&self.shifts), of(&self.turns))
    }
}

impl Waves {
    /// `slow` and `quick` are the standard deviations of the amplitudes.
    fn random(slow: f64, quick: f64, rng: &mut Pcg64) -> Self {
        Self([(slow, 0.1..0.3), (quick, 0.5..1.2)].map(|(size, hertz)| {
            let pace = std::f64::consts::TAU * rng.random_range(hertz);
            [
                size * normal(rng),
                pace,
                rng.random_range(0.0..std::f64::consts::TAU),
            ]
        }))
    }

    fn at(&self, seconds: f64) -> f64 {
        let waves = self.0.iter();
        waves
            .map(|[size, pace, phase]| size * (pace * seconds + phase).sin())
            .sum()
    }
}
