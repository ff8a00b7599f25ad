//! Contractions over time, found or known.

use frontalis_analysis::curve::CurveSample;

/// One row a frame, one value a muscle.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves(pub Vec<Vec<f64>>);

impl Curves {
    /// The activations of samples, in order.
    pub fn of(samples: &[CurveSample]) -> Self {
        Self(samples.iter().map(|it| it.activations.clone()).collect())
    }

    /// Number of frames.
    pub fn n_frames(&self) -> usize {
        self.0.len()
    }

    /// Number of muscles.
    pub fn n_muscles(&self) -> usize {
        self.0.first().map_or(0, Vec::len)
    }

    /// One muscle's curve.
    pub fn of_muscle(&self, muscle: usize) -> Vec<f64> {
        self.0.iter().map(|row| row[muscle]).collect()
    }

    /// The curves from frame `start` on.
    #[must_use]
    pub fn from_frame(&self, start: usize) -> Self {
        Self(self.0[start.min(self.0.len())..].to_vec())
    }

    /// (found, true) of every frame and muscle.
    ///
    /// # Panics
    ///
    /// When the two are not of the same size.
    pub fn pairs<'a>(&'a self, truth: &'a Self) -> impl Iterator<Item = (f64, f64)> + 'a {
        assert_eq!(self.n_frames(), truth.n_frames(), "frames");
        assert_eq!(self.n_muscles(), truth.n_muscles(), "muscles");
        let rows = self.0.iter().zip(&truth.0);
        rows.flat_map(|(found, truth)| found.iter().copied().zip(truth.iter().copied()))
    }
}

/// The standard deviation of a curve over its frames.
pub fn standard_deviation(curve: &[f64]) -> f64 {
    let n = curve.len().max(1) as f64;
    let mean = curve.iter().sum::<f64>() / n;
    let squares: f64 = curve.iter().map(|it| (it - mean).powi(2)).sum();
    (squares / n).sqrt()
}
