//! A synthetic performance with known contractions: overlapping raised-cosine events, head motion, noise, occlusion.
#![allow(
    dead_code,
    clippy::allow_attributes,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "shared by tests and benches that each use a part; counts and times are small and positive"
)]

use frontalis_analysis::{
    face::{
        actor::Actor,
        basis::MarkerBasis,
        marker::{FrameIndex, MarkerFrame},
    },
    space::PerformancePoint,
};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

/// Frames at the start in which nothing moves but the head.
pub const NEUTRAL_FRAMES: usize = 30;

/// What the performance is made of.
#[derive(Clone, Copy)]
pub struct Stage {
    pub n_frames: usize,
    pub rate_hz: f64,
    pub moving_head: bool,
    /// Standard deviation per axis, centimeters.
    pub noise_cm: f64,
    pub occluded: f64,
    pub seed: u64,
}

impl Stage {
    pub const STILL: Self = Self {
        n_frames: 480,
        rate_hz: 60.0,
        moving_head: false,
        noise_cm: 0.0,
        occluded: 0.0,
        seed: 1,
    };
}

pub struct Performance {
    pub frames: Vec<MarkerFrame>,
    /// The contractions that made them, one row a frame.
    pub truth: Vec<Vec<f64>>,
}

impl Performance {
    pub fn of(actor: &Actor, stage: Stage) -> Self {
        let mut rng = Pcg64::seed_from_u64(stage.seed);
        let truth = contractions(actor.muscle_set().len(), stage, &mut rng);
        Self::of_truth(actor, stage, truth, &mut rng)
    }

    pub fn of_truth(actor: &Actor, stage: Stage, truth: Vec<Vec<f64>>, rng: &mut Pcg64) -> Self {
        let basis = MarkerBasis::at(actor, actor.virtual_markers());
        let frames = truth
            .iter()
            .enumerate()
            .map(|(k, x)| capture(&basis, x, k, stage, rng))
            .collect();
        Self { frames, truth }
    }
}

/// About one event a muscle every four seconds, 0.5 to 2 s long, 0.25 to 1 high.
fn contractions(n_muscles: usize, stage: Stage, rng: &mut Pcg64) -> Vec<Vec<f64>> {
    let mut truth = vec![vec![0.0_f64; n_muscles]; stage.n_frames];
    let seconds = stage.n_frames as f64 / stage.rate_hz;
    let n_events = (seconds * n_muscles as f64 / 4.0).ceil() as usize;
    for _ in 0..n_events {
        let muscle = rng.random_range(0..n_muscles);
        let (start, length) = (rng.random_range(0.0..seconds), rng.random_range(0.5..2.0));
        let height = rng.random_range(0.25..1.0);
        for (k, x) in truth.iter_mut().enumerate().skip(NEUTRAL_FRAMES) {
            let phase = (k as f64 / stage.rate_hz - start) / length;
            if (0.0..1.0).contains(&phase) {
                let value = height * (0.5 - 0.5 * (std::f64::consts::TAU * phase).cos());
                x[muscle] = x[muscle].max(value);
            }
        }
    }
    truth
}

fn capture(basis: &MarkerBasis, x: &[f64], k: usize, stage: Stage, rng: &mut Pcg64) -> MarkerFrame {
    let time = k as f64 / stage.rate_hz;
    let sway = if stage.moving_head { 1.0 } else { 0.0 };
    let turn = Vector3::new((0.9 * time).sin(), (0.7 * time).sin(), (1.1 * time).sin());
    let rotation = UnitQuaternion::from_scaled_axis(0.15 * sway * turn);
    let shift = Vector3::new(1.5 * (0.5 * time).sin(), 0.8 * (0.8 * time).sin(), 0.0) * sway;
    // The capture system's own axes and origin.
    let rig = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -1.2, 0.2));
    let origin = Vector3::new(40.0, -110.0, 75.0);
    let positions = (0..basis.n_markers())
        .map(|j| {
            let displaced = basis.neutral[j].0.coords
                + basis
                    .of_marker_cm(j)
                    .iter()
                    .zip(x)
                    .map(|(d, x)| d * *x)
                    .sum::<Vector3<f64>>();
            let noise = Vector3::from_fn(|_, _| stage.noise_cm * normal(rng));
            let captured = rig * (rotation * displaced + shift + noise) + origin;
            (rng.random_range(0.0..1.0) >= stage.occluded)
                .then_some(PerformancePoint(Point3::from(captured)))
        })
        .collect();
    MarkerFrame {
        index: FrameIndex(k as u64 + 1),
        capture_time_nanos: (time * 1e9).round() as i64,
        positions,
    }
}

/// A standard normal deviate (Box & Muller).
fn normal(rng: &mut Pcg64) -> f64 {
    let (u, v): (f64, f64) = (
        rng.random_range(f64::MIN_POSITIVE..1.0),
        rng.random_range(0.0..1.0),
    );
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}
