//! A capture stage without a studio: an actor performs, cameras see the markers, triangulation finds them again.
//!
//! One second of neutral face and still head, then random, smooth, overlapping muscle events with head motion.
//! Every number is a function of the settings and the seed: there is no clock and no file here, pacing is the caller's.
//! The stage has its own axes (z up) and its own origin, a meter and a half from the head, as capture systems do;
//! its scale is that of the model.

mod head_motion;
mod performance;
mod rig;
mod skin;

use std::{f64::consts::FRAC_PI_2, sync::Arc};

use frontalis_analysis::{
    face::actor::Actor,
    space::{PerformancePoint, Similarity},
    stage::rig::{CameraCountError, CameraRig},
};
use nalgebra::{UnitQuaternion, Vector3};
use rand::SeedableRng as _;
use rand_pcg::Pcg64;

use self::{
    head_motion::HeadMotion,
    performance::Performance,
    rig::{ObservedRig, Optics},
    skin::MarkerSkin,
};

/// How long the face is neutral and the head still at the start, seconds.
pub const NEUTRAL_SECS: f64 = 1.0;
/// Slowest and fastest stage.
pub const RATE_LIMITS_HZ: (f64, f64) = (1.0, 1_000.0);
/// Longest performance: a day.
pub const MAX_SECONDS: f64 = 86_400.0;
/// Most pixel noise: beyond, a marker would leave its image.
pub const MAX_PIXEL_NOISE: f64 = 100.0;

/// What happens on the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageSettings {
    /// Frames a second; 60 by default, 1 to 1,000.
    pub rate_hz: f64,
    /// Length of the whole take in seconds, its neutral second included; 10 by default.
    pub seconds: f64,
    /// Cameras around the face; 5 by default, 2 to 32. Fewer see fewer markers, and less precisely.
    pub cameras: usize,
    /// Standard deviation of a marker's place in an image, in pixels an axis; 0.3 by default, a good camera.
    pub pixel_noise: f64,
    /// How likely a camera overlooks a marker that it could see; 0.03 by default.
    pub misses: f64,
    /// Another seed is another performance; the same seed is the same one, bit for bit.
    pub seed: u64,
}

impl Default for StageSettings {
    fn default() -> Self {
        Self {
            rate_hz: 60.0,
            seconds: 10.0,
            cameras: 5,
            pixel_noise: 0.3,
            misses: 0.03,
            seed: 1,
        }
    }
}

/// Why there is no such stage.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StageError {
    /// A setting is outside its range, or not a number.
    #[error("{setting} is {found}, and must be from {least} to {most}")]
    OutOfRange {
        /// The setting's name.
        setting: &'static str,
        /// What was asked for.
        found: f64,
        /// The least it may be.
        least: f64,
        /// The most it may be.
        most: f64,
    },
    /// Too few or too many cameras.
    #[error(transparent)]
    Cameras(#[from] CameraCountError),
}

/// One instant of the stage.
#[derive(Clone, Debug, PartialEq)]
pub struct StageFrame {
    /// From 1, without a hole.
    pub number: u64,
    /// Since the first frame.
    pub capture_time_nanos: i64,
    /// What the cameras found, one entry a marker of the actor, centimeters; `None` with fewer than two views.
    pub positions: Vec<Option<PerformancePoint>>,
    /// Where the markers really were.
    pub true_positions: Vec<PerformancePoint>,
    /// The contractions that moved the face, one a muscle of the actor, in [0, 1].
    pub truth: Vec<f64>,
}

/// The stage, as the iterator of its frames.
///
/// ```
/// use std::sync::Arc;
/// use frontalis_analysis::synthesis::reference_face;
/// use frontalis_client::simulated_stage::{SimulatedStage, StageSettings};
///
/// let settings = StageSettings { seconds: 0.5, ..StageSettings::default() };
/// let stage = SimulatedStage::new(Arc::new(reference_face::actor()), settings)?;
/// assert_eq!(stage.count(), 30);
/// # Ok::<(), frontalis_client::simulated_stage::StageError>(())
/// ```
pub struct SimulatedStage {
    actor: Arc<Actor>,
    rate_hz: f64,
    n_frames: u64,
    next_number: u64,
    model_from_performance: Similarity,
    skin: MarkerSkin,
    performance: Performance,
    head_motion: HeadMotion,
    rig: ObservedRig,
}

impl SimulatedStage {
    /// The stage with `actor` on it.
    ///
    /// # Errors
    ///
    /// [`StageError`] when a setting is outside its range.
    pub fn new(actor: Arc<Actor>, settings: StageSettings) -> Result<Self, StageError> {
        check(&settings)?;
        let skin = MarkerSkin::new(&actor);
        let model_from_performance = stage_placement();
        let rig = CameraRig::arc(
            settings.cameras,
            model_from_performance.to_performance(skin.center()),
            model_from_performance.rotation.inverse(),
        )?;
        let optics = Optics {
            pixel_noise: settings.pixel_noise,
            misses: settings.misses,
        };
        // One generator each, so that other cameras see the same performance.
        let mut seeds = Pcg64::seed_from_u64(settings.seed);
        let mut generator = || Pcg64::from_rng(&mut seeds);
        Ok(Self {
            rate_hz: settings.rate_hz,
            n_frames: n_frames(&settings),
            next_number: 1,
            model_from_performance,
            performance: Performance::new(actor.muscle_set(), generator()),
            head_motion: HeadMotion::new(skin.center(), generator()),
            rig: ObservedRig::new(rig, optics, generator()),
            skin,
            actor,
        })
    }

    /// Who performs.
    pub fn actor(&self) -> &Arc<Actor> {
        &self.actor
    }

    /// Frames that are still to come.
    pub fn remaining_frames(&self) -> u64 {
        self.n_frames + 1 - self.next_number
    }

    fn frame(&mut self, number: u64) -> StageFrame {
        let time_secs = (number - 1) as f64 / self.rate_hz;
        let truth = self.performance.activations_at(time_secs);
        let head = self.head_motion.pose_at(time_secs);
        let to_stage = self.model_from_performance;
        let mut true_positions = Vec::with_capacity(self.skin.n_markers());
        let mut positions = Vec::with_capacity(self.skin.n_markers());
        for patch in self.skin.patches(&truth) {
            let place = to_stage.to_performance(head.apply(patch.position));
            let normal = to_stage.rotation.inverse() * (head.rotation * patch.normal);
            true_positions.push(place);
            positions.push(self.rig.observe(place, &normal));
        }
        StageFrame {
            number,
            capture_time_nanos: nanos(time_secs),
            positions,
            true_positions,
            truth,
        }
    }
}

impl Iterator for SimulatedStage {
    type Item = StageFrame;

    fn next(&mut self) -> Option<StageFrame> {
        if self.next_number > self.n_frames {
            return None;
        }
        let number = self.next_number;
        self.next_number += 1;
        Some(self.frame(number))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let remaining = usize::try_from(self.remaining_frames()).ok();
        (remaining.unwrap_or(usize::MAX), remaining)
    }
}

fn check(settings: &StageSettings) -> Result<(), StageError> {
    let (slowest, fastest) = RATE_LIMITS_HZ;
    let ranges = [
        ("rate_hz", settings.rate_hz, slowest, fastest),
        ("seconds", settings.seconds, 0.0, MAX_SECONDS),
        ("pixel_noise", settings.pixel_noise, 0.0, MAX_PIXEL_NOISE),
        ("misses", settings.misses, 0.0, 1.0),
    ];
    for (setting, found, least, most) in ranges {
        if !(least..=most).contains(&found) {
            return Err(StageError::OutOfRange {
                setting,
                found,
                least,
                most,
            });
        }
    }
    Ok(())
}

/// The stage's axes have z up; the actor looks a little aside, a meter and more from the origin.
fn stage_placement() -> Similarity {
    let head_at_cm = Vector3::new(45.0, -70.0, 125.0);
    let performance_from_model = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.4)
        * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
    let rotation = performance_from_model.inverse();
    Similarity {
        scale: 1.0,
        rotation,
        translation_cm: -(rotation * head_at_cm),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most a day at 1,000 Hz, and not negative"
)]
fn n_frames(settings: &StageSettings) -> u64 {
    (settings.rate_hz * settings.seconds).round() as u64
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "at most a day of nanoseconds"
)]
fn nanos(secs: f64) -> i64 {
    (secs * 1e9).round() as i64
}

#[cfg(test)]
mod tests;
