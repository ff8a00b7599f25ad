//! What the frames before say about this one: a Kalman-style prior whose process noise has heavy tails (METHODS 5b).
//!
//! Before a frame the contractions are known with covariance P + diag(q²). Every frame starts with q wide and takes back
//! what the solution does not support: `qᵢ² ← (ν q̄ᵢ² + uᵢ²) / (ν + 1)` with uᵢ the expected step, which is a Student-t
//! process. Holds are smoothed, jumps pass.
//!
//! P is full among the muscles that were free in the last frame; one at its bound does not vary with the others, so that only
//! a small block is inverted.

use crate::numeric::{
    factor::NotPositiveDefinite,
    inverse::SymmetricInverse,
    posterior::Posterior,
    tape::{Entry, Tape, TapeError, expect},
};

/// Standard deviation of a contraction's step from frame to frame at 30 Hz, at least.
const LEAST_STEP_AT_30_HZ: f64 = 0.008;

/// Standard deviation of the step that a frame starts with, however strong the smoothing: a jump must pass, or its marker would be
/// taken for wrong.
const START_STEP: f64 = 0.5;

/// ν, degrees of freedom of the Student-t step.
const FREEDOM: f64 = 0.7;

/// The volatility of a muscle takes this share of its last squared step.
const VOLATILITY_SHARE: f64 = 0.5;

/// Standard deviation of a contraction after a gap, and the most that is ever claimed not to be known.
pub(in super::super) const UNKNOWN: f64 = 0.5;

/// The prior of one session.
#[derive(Clone, Debug)]
pub(super) struct TemporalPrior {
    /// By which every step is scaled: 1 at the usual strength of smoothing, less when it is stronger.
    step_scale: f64,
    least_variance: f64,
    /// q̄², the volatility of each muscle a frame.
    volatility: Vec<f64>,
    /// q² of this frame.
    step_variance: Vec<f64>,
    /// P's diagonal.
    variance: Vec<f64>,
    /// The muscles among which P is full.
    linked: Vec<usize>,
    /// P among them, rows m apart.
    covariance: Vec<f64>,
    /// (P + diag(q²))⁻¹: among the linked muscles, and the diagonal for the others.
    precision: Vec<f64>,
    precision_diagonal: Vec<f64>,
    inverse: SymmetricInverse,
    /// Precision times the distance of x from where it was expected.
    pull: Vec<f64>,
    /// Frames since the last one that was solved, this one included.
    elapsed: f64,
    /// Whether q is still what every frame starts with.
    is_wide: bool,
    state: State,
}

/// What the prior knows before a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Nothing: this is the first frame.
    New,
    /// P after a gap, which takes no part in the heavy tails.
    Lost,
    /// P after a frame.
    Known,
}

impl TemporalPrior {
    pub fn new(m: usize, step_scale: f64, rate_hz: f64) -> Self {
        let mut prior = Self {
            step_scale,
            least_variance: 0.0,
            volatility: vec![0.0; m],
            step_variance: vec![0.0; m],
            variance: vec![0.0; m],
            linked: Vec::with_capacity(m),
            covariance: vec![0.0; m * m],
            precision: vec![0.0; m * m],
            precision_diagonal: vec![0.0; m],
            inverse: SymmetricInverse::with_capacity(m),
            pull: vec![0.0; m],
            elapsed: 1.0,
            is_wide: true,
            state: State::New,
        };
        prior.set_rate_hz(rate_hz);
        prior
    }

    /// Takes over what was known of the same muscles.
    pub fn continue_from(&mut self, before: &Self) {
        self.volatility.clone_from(&before.volatility);
        self.variance.clone_from(&before.variance);
        self.linked.clone_from(&before.linked);
        self.covariance.clone_from(&before.covariance);
        self.state = before.state;
    }

    /// Names what a frame finds of those before it.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        let m = self.variance.len();
        tape.reals("volatility", &mut self.volatility)?;
        tape.reals("variance", &mut self.variance)?;
        tape.places("linked", &mut self.linked, m)?;
        self.covariance_lasts(tape)?;
        let mut state = self.state as u64;
        tape.integer("known", &mut state)?;
        let known = [State::New, State::Lost, State::Known];
        let known = known.into_iter().find(|it| *it as u64 == state);
        self.state = known.ok_or_else(|| tape.wrong("known"))?;
        Ok(())
    }

    /// P among the linked muscles: what else stands in its rows is of frames before.
    fn covariance_lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        let (m, k) = (self.variance.len(), self.linked.len());
        let write = |it: &mut Entry| {
            for row in self.covariance.chunks_exact(m.max(1)).take(k) {
                it.reals.extend_from_slice(&row[..k]);
            }
        };
        let square = |reals, integers| expect(reals == k * k && integers == 0, k * k);
        if let Some(found) = tape.entry("covariance", write, square)? {
            let rows = self.covariance.chunks_exact_mut(m.max(1));
            for (to, from) in rows.zip(found.reals.chunks_exact(k.max(1))) {
                to[..k].copy_from_slice(from);
            }
        }
        Ok(())
    }

    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        let step = LEAST_STEP_AT_30_HZ * self.step_scale;
        self.least_variance = step * step * 30.0 / rate_hz;
        for it in &mut self.volatility {
            *it = it.max(self.least_variance);
        }
    }

    /// Forgets everything but that contractions lie somewhere: after a gap, or a change of the basis.
    pub fn forget(&mut self) {
        if self.state == State::Known {
            self.variance.fill(UNKNOWN * UNKNOWN);
            self.linked.clear();
            self.state = State::Lost;
        }
    }

    /// Begins a frame that comes `elapsed` frames after the last one that was solved.
    pub fn begin(&mut self, elapsed: f64) {
        self.step_variance.fill(START_STEP * START_STEP);
        self.elapsed = elapsed;
        self.is_wide = true;
    }

    /// Whether there is something to say about this frame.
    pub fn is_known(&self) -> bool {
        self.state != State::New
    }

    /// Takes back process noise that the solution `x` of the last round, `expected` before the frame, does not support.
    pub fn shrink(&mut self, x: &[f64], expected: &[f64]) {
        if self.state != State::Known {
            return;
        }
        self.find_pull(x, expected);
        self.is_wide = false;
        let steps = self.step_variance.iter_mut().zip(&self.pull);
        for ((q, u), bar) in steps.zip(&self.volatility) {
            let step = *q * u;
            *q = (FREEDOM * bar * self.elapsed + step * step) / (FREEDOM + 1.0);
        }
    }

    /// Adds the prior's pull towards `expected` to Q, whose columns are `stride` apart, and c, in units of `variance`.
    ///
    /// # Errors
    ///
    /// When P is not positive definite, which rounding alone can bring about.
    pub fn add_to(
        &mut self,
        hessian: &mut [f64],
        stride: usize,
        linear: &mut [f64],
        expected: &[f64],
        variance: f64,
    ) -> Result<(), NotPositiveDefinite> {
        self.find_precision()?;
        let m = self.variance.len();
        for (i, it) in self.precision_diagonal.iter().enumerate() {
            hessian[i * stride + i] += variance * it;
            linear[i] += variance * it * expected[i];
        }
        for (row, &i) in self.precision.chunks_exact(m.max(1)).zip(&self.linked) {
            let column = &mut hessian[i * stride..];
            for (precision, &j) in row.iter().zip(&self.linked) {
                column[j] += variance * precision;
                linear[i] += variance * precision * expected[j];
            }
        }
        Ok(())
    }

    /// (P + diag(q²))⁻¹ for the present q.
    fn find_precision(&mut self) -> Result<(), NotPositiveDefinite> {
        let m = self.variance.len();
        for (i, it) in self.precision_diagonal.iter_mut().enumerate() {
            *it = 1.0 / (self.variance[i] + self.step_variance[i]);
        }
        if self.is_wide {
            // Beside the step that a frame starts with, what P links is nothing.
            for (place, &i) in self.linked.iter().enumerate() {
                let variance = self.covariance[place * m + place] + self.step_variance[i];
                self.precision_diagonal[i] = 1.0 / variance;
            }
            self.precision.fill(0.0);
            return Ok(());
        }
        self.precision.copy_from_slice(&self.covariance);
        for (place, &i) in self.linked.iter().enumerate() {
            self.precision[place * m + place] += self.step_variance[i];
            self.precision_diagonal[i] = 0.0;
        }
        self.inverse
            .invert(&mut self.precision, self.linked.len(), m)
    }

    /// Precision times the distance of `x` from where it was expected: the force with which the prior holds it back.
    pub fn pull(&mut self, x: &[f64], expected: &[f64]) -> &[f64] {
        self.find_pull(x, expected);
        &self.pull
    }

    fn find_pull(&mut self, x: &[f64], expected: &[f64]) {
        let m = self.variance.len();
        for (i, pull) in self.pull.iter_mut().enumerate() {
            *pull = self.precision_diagonal[i] * (x[i] - expected[i]);
        }
        for (row, &i) in self.precision.chunks_exact(m.max(1)).zip(&self.linked) {
            let steps = self.linked.iter().map(|&j| x[j] - expected[j]);
            self.pull[i] += row.iter().zip(steps).map(|(p, step)| p * step).sum::<f64>();
        }
    }

    /// Ends a frame with its solution, of which the muscles `free` (ascending) have `posterior`, and the others at a bound the
    /// inverse of their diagonal entry of Q, both in units of `noise`.
    pub fn end(
        &mut self,
        [x, expected]: [&[f64]; 2],
        posterior: &Posterior,
        free: &[usize],
        diagonal: impl Fn(usize) -> f64,
        noise: f64,
    ) {
        if self.state == State::Known {
            self.learn_volatility(x, expected);
        }
        self.state = State::Known;
        let m = self.variance.len();
        for (i, it) in self.variance.iter_mut().enumerate() {
            *it = (noise / diagonal(i)).min(UNKNOWN * UNKNOWN);
        }
        self.linked.clear();
        self.linked.extend_from_slice(free);
        for (place, row) in self
            .covariance
            .chunks_exact_mut(m.max(1))
            .take(free.len())
            .enumerate()
        {
            for (to, from) in row.iter_mut().zip(posterior.row(place)) {
                *to = noise * from;
            }
        }
        self.cap();
    }

    fn learn_volatility(&mut self, x: &[f64], expected: &[f64]) {
        self.find_pull(x, expected);
        let steps = self.step_variance.iter().zip(&self.pull);
        for (bar, (q, u)) in self.volatility.iter_mut().zip(steps) {
            let step = q * u;
            let seen = step * step / self.elapsed;
            let mixed = (1.0 - VOLATILITY_SHARE) * *bar + VOLATILITY_SHARE * seen;
            *bar = mixed.max(self.least_variance);
        }
    }

    /// Scales rows and columns so that no standard deviation is beyond [`UNKNOWN`].
    fn cap(&mut self) {
        let (m, k) = (self.variance.len(), self.linked.len());
        for i in 0..k {
            let deviation = self.covariance[i * m + i].sqrt();
            if deviation > UNKNOWN {
                let scale = UNKNOWN / deviation;
                for j in 0..k {
                    self.covariance[i * m + j] *= scale;
                    self.covariance[j * m + i] *= scale;
                }
            }
        }
    }
}
