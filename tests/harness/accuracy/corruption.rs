//! What goes wrong in a capture: markers hide for a while, and single markers jump.

use frontalis_analysis::{face::marker::MarkerFrame, space::PerformancePoint};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

use super::{
    random::direction,
    take::{N_NEUTRAL, Take},
};

/// Frames that a marker stays hidden.
const BURST_FRAMES: usize = 7;

/// How far a jumping marker is off, centimeters.
const JUMP_CM: std::ops::Range<f64> = 0.5..2.0;

/// What share of all positions goes wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corruption {
    /// Share that is hidden, in bursts.
    pub occluded: f64,
    /// Share that has jumped, each for one frame.
    pub outliers: f64,
}

impl Corruption {
    /// 10 % occlusion and 2 % outliers.
    pub const USUAL: Self = Self {
        occluded: 0.1,
        outliers: 0.02,
    };

    /// The take with this done to every frame.
    #[must_use]
    pub fn everywhere(&self, take: &Take, seed: u64) -> Take {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut spoilt = take.clone();
        for frame in &mut spoilt.frames {
            self.displace(frame, &mut rng);
        }
        self.hide(&mut spoilt.frames, &mut rng);
        spoilt
    }

    /// The take with this done to the frames after the neutral ones, the same to each as [`Corruption::everywhere`] does.
    #[must_use]
    pub fn after_neutral(&self, take: &Take, seed: u64) -> Take {
        let mut spoilt = self.everywhere(take, seed);
        let neutral = N_NEUTRAL.min(take.frames.len());
        spoilt.frames[..neutral].clone_from_slice(&take.frames[..neutral]);
        spoilt
    }

    fn displace(&self, frame: &mut MarkerFrame, rng: &mut Pcg64) {
        for position in frame.positions.iter_mut().flatten() {
            if rng.random_range(0.0..1.0) < self.outliers {
                let jump = rng.random_range(JUMP_CM) * direction(rng);
                *position = PerformancePoint(position.0 + jump);
            }
        }
    }

    fn hide(&self, frames: &mut [MarkerFrame], rng: &mut Pcg64) {
        let start = self.share_of_starts();
        let n_markers = frames.first().map_or(0, |it| it.positions.len());
        for marker in 0..n_markers {
            let mut left = 0;
            for frame in &mut *frames {
                if left == 0 && rng.random_range(0.0..1.0) < start {
                    left = BURST_FRAMES;
                }
                if left > 0 {
                    left -= 1;
                    frame.positions[marker] = None;
                }
            }
        }
    }

    /// The chance that a marker which was seen hides now: bursts of b frames after 1/p − 1 visible ones on average give
    /// the share o = b / (b + 1/p − 1).
    fn share_of_starts(&self) -> f64 {
        let burst = BURST_FRAMES as f64;
        self.occluded / (burst + self.occluded * (1.0 - burst))
    }
}
