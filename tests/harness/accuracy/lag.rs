//! How late curves are.

use super::curves::{Curves, standard_deviation};

/// A true curve that varies less, standard deviation, has no lag to speak of.
const VARIES: f64 = 0.02;

/// The largest lag looked for, frames.
const LARGEST: usize = 10;

/// How late the curves of one take are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lags {
    /// Curves whose truth varies.
    pub n_curves: usize,
    /// Those of them that correlate best with a truth of more than a frame ago, or a truth to come.
    pub n_late: usize,
    /// The largest lag in size, frames; positive is late.
    pub largest: isize,
}

impl Lags {
    /// The lags of `found`.
    pub fn of(found: &Curves, truth: &Curves) -> Self {
        let mut lags = Self::default();
        for muscle in 0..truth.n_muscles() {
            let curve = truth.of_muscle(muscle);
            if standard_deviation(&curve) < VARIES {
                continue;
            }
            let lag = lag(&found.of_muscle(muscle), &curve);
            lags.n_curves += 1;
            lags.n_late += usize::from(lag.abs() > 1);
            if lag.abs() > lags.largest.abs() {
                lags.largest = lag;
            }
        }
        lags
    }
}

/// The shift at which the two correlate best, frames; of equals the smallest.
fn lag(found: &[f64], truth: &[f64]) -> isize {
    let mut best = (f64::NEG_INFINITY, 0);
    for size in 0..=LARGEST.min(truth.len() / 2) {
        for late in [true, false] {
            let (a, b) = if late { (found, truth) } else { (truth, found) };
            let correlation = correlation(&a[size..], &b[..b.len() - size]);
            if correlation > best.0 {
                best = (
                    correlation,
                    if late {
                        size.cast_signed()
                    } else {
                        -size.cast_signed()
                    },
                );
            }
        }
    }
    best.1
}

/// How late the curves are whose truth varies, in the mean, to a part of a frame: where the parabola through the correlations one
/// frame early, on time and one frame late peaks.
pub fn mean_lag(found: &Curves, truth: &Curves) -> f64 {
    let (mut sum, mut n_curves) = (0.0, 0.0);
    for muscle in 0..truth.n_muscles() {
        let (found, curve) = (found.of_muscle(muscle), truth.of_muscle(muscle));
        if standard_deviation(&curve) >= VARIES {
            let n = curve.len();
            let early = correlation(&found[..n - 1], &curve[1..]);
            let on_time = correlation(&found, &curve);
            let late = correlation(&found[1..], &curve[..n - 1]);
            let bend = early - 2.0 * on_time + late;
            sum += 0.5 * (early - late) / bend;
            n_curves += 1.0;
        }
    }
    sum / f64::max(n_curves, 1.0)
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len() as f64;
    let mean = |it: &[f64]| it.iter().sum::<f64>() / n;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let shared: f64 = a
        .iter()
        .zip(b)
        .map(|(a, b)| (a - mean_a) * (b - mean_b))
        .sum();
    shared / (n * standard_deviation(a) * standard_deviation(b)).max(f64::MIN_POSITIVE)
}
