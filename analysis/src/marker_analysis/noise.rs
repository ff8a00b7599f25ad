//! The noise of the markers, estimated from what the solution leaves of them.
//!
//! Two levels are kept. The scatter of the residuals about 0 is all that the basis does not explain: noise and misfit. Their
//! change from frame to frame is noise alone, for misfit stays while a face stays. Weights and standard errors go by the first, the
//! trust in what was known before by the second: with a wrong basis the scatter grows, and priors that grew with it would
//! shrink and delay what the markers plainly show.

use nalgebra::Vector3;

use crate::numeric::tape::{Tape, TapeError};

/// Standard deviation of a coordinate before anything was seen, centimeters.
const START_CM: f64 = 0.02;

/// The estimate follows a change of the noise to 1/e in this time.
const TIME_CONSTANT_SECS: f64 = 0.5;

/// In the first frames it moves faster, by this share a frame.
const FIRST_SHARE: f64 = 0.3;
const FIRST_FRAMES: u32 = 6;

/// One frame cannot say that the variance is more than this many times what was known.
const LARGEST_STEP: f64 = 9.0;

/// The variance is not less: 0.01 mm, better than any capture system.
const LEAST_VARIANCE: f64 = 1e-6;

/// Fewest degrees of freedom over which the noise is estimated.
const LEAST_FREEDOM: f64 = 6.0;

/// Markers that two frames must share, in weight, for their change to say anything.
const LEAST_SHARED: f64 = 4.0;

/// Variance of one coordinate of one marker, square centimeters, over the last half second.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Level {
    variance: f64,
    n_frames: u32,
}

/// Both levels of one session.
#[derive(Clone, Debug)]
pub(super) struct Noise {
    scatter: Level,
    change: Level,
    /// What the last frame left of each marker; `None` where it had no weight.
    before: Vec<Option<Vector3<f64>>>,
}

/// What a frame leaves of its markers.
pub(super) struct Left<'a> {
    pub used: &'a [usize],
    /// Observed less reproduced position, one a marker, centimeters.
    pub residuals: &'a [Vector3<f64>],
    /// One a marker.
    pub weights: &'a [f64],
    /// Unknowns that were fitted to them.
    pub n_fitted: f64,
}

impl Level {
    const START: Self = Self {
        variance: START_CM * START_CM,
        n_frames: 0,
    };

    fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.real("variance", &mut self.variance)?;
        tape.small("n_frames", &mut self.n_frames)
    }

    fn observe(&mut self, squares: f64, freedom: f64, rate_hz: f64) {
        let share = if self.n_frames < FIRST_FRAMES {
            FIRST_SHARE
        } else {
            1.0 - (-1.0 / (TIME_CONSTANT_SECS * rate_hz)).exp()
        };
        self.n_frames = self.n_frames.saturating_add(1);
        let seen = (squares / freedom).min(LARGEST_STEP * self.variance);
        self.variance = ((1.0 - share) * self.variance + share * seen).max(LEAST_VARIANCE);
    }
}

impl Noise {
    pub fn new(n_markers: usize) -> Self {
        Self {
            scatter: Level::START,
            change: Level::START,
            before: vec![None; n_markers],
        }
    }

    /// Takes over the levels of the session's noise; what single markers left is not comparable any more.
    pub fn continue_from(&mut self, before: &Self) {
        (self.scatter, self.change) = (before.scatter, before.change);
    }

    /// Names what a frame finds of those before it.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.within("scatter", |tape| self.scatter.lasts(tape))?;
        tape.within("change", |tape| self.change.lasts(tape))?;
        let mut had_weight: Vec<bool> = self.before.iter().map(Option::is_some).collect();
        let mut left: Vec<f64> = self
            .before
            .iter()
            .flat_map(|it| <[f64; 3]>::from(it.unwrap_or_default()))
            .collect();
        tape.flags("had_weight", &mut had_weight)?;
        tape.reals("left", &mut left)?;
        let (left, _) = left.as_chunks::<3>();
        for ((it, left), had_weight) in self.before.iter_mut().zip(left).zip(had_weight) {
            *it = had_weight.then_some((*left).into());
        }
        Ok(())
    }

    /// Standard deviation of a coordinate about what the basis explains, centimeters.
    pub fn sigma_cm(&self) -> f64 {
        self.scatter.variance.sqrt()
    }

    /// Variance of a coordinate about what the basis explains.
    pub fn variance(&self) -> f64 {
        self.scatter.variance
    }

    /// Variance of a coordinate as far as it changes from frame to frame: by which the terms of the objective are weighed.
    pub fn changing_variance(&self) -> f64 {
        self.change.variance.min(self.scatter.variance)
    }

    /// Takes in one frame.
    pub fn observe(&mut self, left: &Left<'_>, rate_hz: f64) {
        let (mut squares, mut total, mut changes, mut shared) = (0.0, 0.0, 0.0, 0.0);
        for &j in left.used {
            let (weight, residual) = (left.weights[j], left.residuals[j]);
            squares += weight * residual.norm_squared();
            total += weight;
            if let Some(before) = self.before[j].filter(|_| weight > 0.0) {
                changes += weight * (residual - before).norm_squared();
                shared += weight;
            }
        }
        let freedom = (3.0 * total - left.n_fitted).max(LEAST_FREEDOM);
        self.scatter.observe(squares, freedom, rate_hz);
        if shared > LEAST_SHARED {
            // The difference of two frames has twice the variance.
            let freedom = freedom * shared / total;
            self.change.observe(changes / 2.0, freedom, rate_hz);
        }
        self.before.fill(None);
        for &j in left.used {
            self.before[j] = (left.weights[j] > 0.0).then_some(left.residuals[j]);
        }
    }
}
