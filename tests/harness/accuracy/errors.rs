//! How far curves are from the contractions that made the markers.

use super::curves::Curves;

/// A contraction above this counts as one.
pub const ACTIVE: f64 = 0.02;

/// A contraction between [`ACTIVE`] and this counts as small.
pub const SMALL: f64 = 0.1;

/// Errors over all frames and muscles of a take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Mean of |found − true|.
    pub mean_absolute: f64,
    /// Root of the mean of (found − true)².
    pub root_mean_square: f64,
    /// Mean of |found − true| where the true contraction is above [`ACTIVE`]; 0 when none is.
    pub active: f64,
    /// Mean of found − true where the true contraction is between [`ACTIVE`] and [`SMALL`]; 0 when none is.
    pub small_bias: f64,
}

impl Errors {
    /// The errors of `found`.
    pub fn of(found: &Curves, truth: &Curves) -> Self {
        let (mut all, mut squares) = (Mean::default(), Mean::default());
        let (mut active, mut small) = (Mean::default(), Mean::default());
        for (found, truth) in found.pairs(truth) {
            let error = found - truth;
            all.add(error.abs());
            squares.add(error * error);
            if truth > ACTIVE {
                active.add(error.abs());
                if truth <= SMALL {
                    small.add(error);
                }
            }
        }
        Self {
            mean_absolute: all.value(),
            root_mean_square: squares.value().sqrt(),
            active: active.value(),
            small_bias: small.value(),
        }
    }
}

/// The mean absolute error of each muscle.
pub fn by_muscle(found: &Curves, truth: &Curves) -> Vec<f64> {
    let mut means = vec![Mean::default(); truth.n_muscles()];
    for (found, truth) in found.0.iter().zip(&truth.0) {
        for (mean, (found, truth)) in means.iter_mut().zip(found.iter().zip(truth)) {
            mean.add((found - truth).abs());
        }
    }
    means.into_iter().map(Mean::value).collect()
}

/// A mean that grows by one value at a time.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    fn value(self) -> f64 {
        self.sum / f64::max(self.count, 1.0)
    }
}
