//! Weights of the markers by how far each is from where the others put it (Huber 1964), 0 for what cannot be noise.

/// A residual of more than this many standard deviations of a coordinate loses weight.
const HUBER_SIGMAS: f64 = 2.5;

/// A residual of more than this many is no noise: the marker is masked.
const REJECT_SIGMAS: f64 = 6.0;

/// Nothing is masked before this round: the first solutions are still drawn by the outliers themselves.
const FIRST_REJECTING_ROUND: usize = 2;

/// Where all weights together are less than this many markers, they say nothing, and every visible marker counts alike.
const LEAST_TOTAL: f64 = 6.0;

/// The median of |r| of three coordinates of unit variance.
const MEDIAN_OF_NORM: f64 = 1.54;

/// Writes the weight of each marker of `used` by its squared residual, square centimeters; both are indexed by marker.
pub(super) fn weigh(
    used: &[usize],
    squares: &[f64],
    sigma_cm: f64,
    round: usize,
    weights: &mut [f64],
) {
    let (bend, limit) = (HUBER_SIGMAS * sigma_cm, REJECT_SIGMAS * sigma_cm);
    let mut total = 0.0;
    for &j in used {
        let r2 = squares[j];
        weights[j] = if r2 <= bend * bend {
            1.0
        } else if round >= FIRST_REJECTING_ROUND && r2 > limit * limit {
            0.0
        } else {
            bend / r2.sqrt()
        };
        total += weights[j];
    }
    if total < LEAST_TOTAL {
        for &j in used {
            weights[j] = 1.0;
        }
    }
}

/// Standard deviation of a coordinate by the median of the squared residuals, centimeters; `sorted` is a buffer.
pub(super) fn scatter_cm(used: &[usize], squares: &[f64], sorted: &mut Vec<f64>) -> f64 {
    sorted.clear();
    sorted.extend(used.iter().map(|&j| squares[j]));
    if sorted.is_empty() {
        return 0.0;
    }
    let middle = sorted.len() / 2;
    let (_, median, _) = sorted.select_nth_unstable_by(middle, f64::total_cmp);
    median.sqrt() / MEDIAN_OF_NORM
}
