//! Monotone piecewise cubic interpolation (Fritsch & Butland 1984), as `scipy.interpolate.PchipInterpolator` does it.
//!
//! Inner slopes are weighted harmonic means of the neighboring secants, zero at a local extremum;
//! end slopes come from a one-sided three-point formula that keeps the shape.

/// A cubic through given knots that never overshoots them.
#[derive(Clone, Debug)]
pub(super) struct Pchip {
    x: Vec<f64>,
    y: Vec<f64>,
    slopes: Vec<f64>,
}

impl Pchip {
    /// The curve through (`x`, `y`); `x` increases, and there are at least three knots.
    pub(super) fn new(x: &[f64], y: &[f64]) -> Self {
        assert!(
            x.len() == y.len() && x.len() > 2,
            "a table has three or more knots"
        );
        Self {
            x: x.to_vec(),
            y: y.to_vec(),
            slopes: slopes(x, y),
        }
    }

    /// The curve's value; outside the knots the outer cubics go on.
    pub(super) fn at(&self, x: f64) -> f64 {
        let k = self
            .x
            .partition_point(|knot| *knot <= x)
            .clamp(1, self.x.len() - 1)
            - 1;
        let h = self.x[k + 1] - self.x[k];
        let t = (x - self.x[k]) / h;
        let rise = self.y[k + 1] - self.y[k];
        let start = h * self.slopes[k];
        let end = h * self.slopes[k + 1];
        let quadratic = 3.0 * rise - 2.0 * start - end;
        let cubic = start + end - 2.0 * rise;
        self.y[k] + t * (start + t * (quadratic + t * cubic))
    }
}

fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secants: Vec<f64> = y
        .windows(2)
        .zip(&h)
        .map(|(pair, h)| (pair[1] - pair[0]) / h)
        .collect();
    let last = h.len() - 1;
    let mut slopes = vec![end_slope(h[0], h[1], secants[0], secants[1])];
    slopes.extend((1..=last).map(|k| inner_slope(h[k - 1], h[k], secants[k - 1], secants[k])));
    slopes.push(end_slope(
        h[last],
        h[last - 1],
        secants[last],
        secants[last - 1],
    ));
    slopes
}

fn inner_slope(h_before: f64, h_after: f64, before: f64, after: f64) -> f64 {
    if before * after <= 0.0 {
        return 0.0;
    }
    let w_before = 2.0 * h_after + h_before;
    let w_after = h_after + 2.0 * h_before;
    (w_before + w_after) / (w_before / before + w_after / after)
}

/// The slope at an end: `h` and `secant` of the interval there, then those of its neighbor.
fn end_slope(h: f64, h_next: f64, secant: f64, secant_next: f64) -> f64 {
    let slope = ((2.0 * h + h_next) * secant - h * secant_next) / (h + h_next);
    if slope * secant <= 0.0 {
        0.0
    } else if secant * secant_next <= 0.0 && slope.abs() > 3.0 * secant.abs() {
        3.0 * secant
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked by hand from the formulas: secants 1, 2, −1 over unit intervals.
    #[test]
    fn takes_the_slopes_of_the_published_formulas() {
        let curve = Pchip::new(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 3.0, 2.0]);
        let expected = [0.5, 6.0 / (3.0 + 1.5), 0.0, -2.5];
        for (found, expected) in curve.slopes.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-15,
                "{found} instead of {expected}"
            );
        }
    }

    #[test]
    fn limits_an_end_slope_where_the_curve_turns() {
        // The three-point formula gives 8.5, which would overshoot; SciPy and MATLAB cap it at three secants.
        assert!((end_slope(1.0, 1.0, 1.0, -14.0) - 3.0).abs() < 1e-15);
        // And the wrong sign becomes flat.
        assert!(end_slope(1.0, 1.0, 1.0, 14.0).abs() < 1e-15);
    }

    #[test]
    fn passes_its_knots_and_never_leaves_their_range() {
        let (x, y) = ([0.0, 0.7, 1.0, 4.0, 5.5], [1.0, 3.0, 3.0, -2.0, -2.5]);
        let curve = Pchip::new(&x, &y);
        for (x, y) in x.iter().zip(y) {
            assert!((curve.at(*x) - y).abs() < 1e-14);
        }
        for pair in 0..4 {
            let (low, high) = (y[pair].min(y[pair + 1]), y[pair].max(y[pair + 1]));
            for step in 0..=20 {
                let at = x[pair] + (x[pair + 1] - x[pair]) * f64::from(step) / 20.0;
                assert!((low - 1e-12..=high + 1e-12).contains(&curve.at(at)));
            }
        }
    }

    #[test]
    fn goes_on_with_the_outer_cubic() {
        let straight = Pchip::new(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0]);
        assert!((straight.at(-1.0) + 1.0).abs() < 1e-14);
        assert!((straight.at(3.5) - 3.5).abs() < 1e-14);
    }
}
