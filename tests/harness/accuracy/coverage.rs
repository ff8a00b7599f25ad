//! Whether standard errors keep what they claim.

use frontalis_analysis::curve::CurveSample;

use super::curves::Curves;

/// True contractions that count: at the bounds an interval is cut off.
const INSIDE: std::ops::Range<f64> = 0.05..0.95;

/// Half widths of the intervals that hold 68 % and 95 % of a normal distribution, in standard errors.
const HALF_WIDTHS: [f64; 2] = [1.0, 1.96];

/// How often the truth lies within the claimed intervals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coverage {
    within: [f64; 2],
    count: f64,
    squared_errors: f64,
    squared_claims: f64,
}

impl Coverage {
    /// Adds the samples of a take.
    ///
    /// # Panics
    ///
    /// When a sample has not one standard error a muscle.
    pub fn add(&mut self, samples: &[CurveSample], truth: &Curves) {
        for (sample, truth) in samples.iter().zip(&truth.0) {
            assert_eq!(sample.standard_errors.len(), truth.len());
            let claims = sample.activations.iter().zip(&sample.standard_errors);
            for ((found, claimed), truth) in claims.zip(truth) {
                if INSIDE.contains(truth) {
                    self.add_one(found - truth, *claimed);
                }
            }
        }
    }

    fn add_one(&mut self, error: f64, claimed: f64) {
        for (within, width) in self.within.iter_mut().zip(HALF_WIDTHS) {
            *within += f64::from(u8::from(error.abs() <= width * claimed));
        }
        self.count += 1.0;
        self.squared_errors += error * error;
        self.squared_claims += claimed * claimed;
    }

    /// Shares of true contractions within the 68 % and the 95 % interval.
    pub fn shares(&self) -> [f64; 2] {
        self.within.map(|it| it / self.count.max(1.0))
    }

    /// Root mean squares of the error and of the standard error.
    pub fn error_and_claim(&self) -> [f64; 2] {
        [self.squared_errors, self.squared_claims].map(|it| (it / self.count.max(1.0)).sqrt())
    }
}
