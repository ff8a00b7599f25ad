//! The conditions under which synthetic performances are captured.

use std::fmt;

use frontalis_analysis::face::actor::Actor;

use super::{capture::Capture, corruption::Corruption, performance::contractions, take::Take};

/// Seeds that nothing was tuned on.
pub const FRESH_SEEDS: [u64; 5] = [101, 102, 103, 104, 105];

/// The levels of noise, standard deviation an axis, millimeters.
pub const NOISE_MM: [f64; 3] = [0.2, 0.5, 1.0];

/// One condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Standard deviation of a marker's position, an axis, millimeters.
    pub noise_mm: f64,
    /// What goes wrong.
    pub corruption: Corruption,
    /// Whether the head moves.
    pub moving_head: bool,
}

impl Condition {
    /// Nothing goes wrong under a moving head.
    pub fn clean(noise_mm: f64) -> Self {
        Self {
            noise_mm,
            corruption: Corruption {
                occluded: 0.0,
                outliers: 0.0,
            },
            moving_head: true,
        }
    }

    /// 10 % occlusion and 2 % outliers under a moving head.
    pub fn corrupted(noise_mm: f64) -> Self {
        Self {
            corruption: Corruption::USUAL,
            ..Self::clean(noise_mm)
        }
    }

    /// Every combination of noise, occlusion, outliers and head.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for moving_head in [false, true] {
            for (occluded, outliers) in [(0.0, 0.0), (0.1, 0.0), (0.0, 0.02), (0.1, 0.02)] {
                for noise_mm in NOISE_MM {
                    all.push(Self {
                        noise_mm,
                        corruption: Corruption { occluded, outliers },
                        moving_head,
                    });
                }
            }
        }
        all
    }

    /// The performance of this seed as it is captured under this condition.
    ///
    /// The neutral frames are complete. The same seed gives the same contractions, head and noise under every condition, so
    /// that rows compare.
    pub fn take(&self, actor: &Actor, seed: u64) -> Take {
        let clean = self.clean_take(actor, seed);
        self.corruption.after_neutral(&clean, seed + 2_000)
    }

    /// The same with neutral frames that are as corrupted as the others.
    pub fn take_from_corrupted_neutral(&self, actor: &Actor, seed: u64) -> Take {
        let clean = self.clean_take(actor, seed);
        self.corruption.everywhere(&clean, seed + 2_000)
    }

    fn clean_take(&self, actor: &Actor, seed: u64) -> Take {
        let capture = Capture {
            noise_cm: 0.1 * self.noise_mm,
            moving_head: self.moving_head,
            seed: seed + 1_000,
        };
        capture.take(actor, contractions(seed))
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let head = if self.moving_head { "moving" } else { "still" };
        let Corruption { occluded, outliers } = self.corruption;
        let [occluded, outliers] = [occluded, outliers].map(|it| 100.0 * it);
        write!(
            f,
            "{} mm, {occluded} % hidden, {outliers} % jumped, {head} head",
            self.noise_mm
        )
    }
}
