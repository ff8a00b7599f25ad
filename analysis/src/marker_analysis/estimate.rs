//! Contractions and head motion that stay right when markers are wrong: robust, smooth, sparse (METHODS 5b).
//!
//! One frame is a few rounds of the joint box QP. Each round weighs the markers by what the last one left of them, takes
//! back process noise that it did not need, solves exactly, and turns the motion by the solution.
//! The noise level and the covariance of the solution go on to the next frame.

mod coupling;
mod mirrors;
mod normal_equations;
mod standard_errors;
mod swaps;
mod temporal;
mod weights;

use nalgebra::Vector3;

use super::{
    evidence::{Evidence, Part},
    head_motion::{MOTION, MOTION_BOUND, RIDGE, Stabilizer},
    marker_model::MarkerModel,
    noise::{Left, Noise},
    objective::{Objective, USUAL_STRENGTH},
    reproduction::Reproduction,
};
use crate::{
    face::muscle::MuscleSet,
    numeric::{
        box_qp::{BoxQp, BoxQpError, Report},
        posterior::Posterior,
        tape::{Tape, TapeError},
    },
};
use coupling::Coupling;
use mirrors::{Follower, Mirrors};
use normal_equations::NormalEquations;
use temporal::TemporalPrior;

pub(super) use temporal::UNKNOWN;

/// Rounds of a frame.
const ROUNDS: usize = 4;

/// λ of the L1 term at the usual strength, in units of the noise's variance.
const USUAL_LAMBDA: f64 = 10.0;

/// The L1 term never asks for more than so many standard deviations of what one muscle alone would be known by: a noisy capture
/// would else lock muscles at 0.
const LARGEST_THRESHOLD: f64 = 1.0;

/// The L1 weight of a muscle falls to a quarter where its contraction is this.
const VANISHING: f64 = 0.022;

/// A head that turns by more than this in a round, radians, has its arms measured anew.
const LARGE_TURN: f64 = 0.01;

/// The solver of one session with the terms of its objective.
#[derive(Clone, Debug)]
pub(super) struct Estimator {
    robust: bool,
    lambda: f64,
    has_motion: bool,
    rate_hz: f64,
    /// Lower and upper bound of each muscle.
    boxes: Vec<[f64; 2]>,
    /// The same in this frame: what is held is fixed.
    bounds: Vec<[f64; 2]>,
    qp: BoxQp,
    equations: NormalEquations,
    coupling: Coupling,
    mirrors: Mirrors,
    /// What each muscle does in this frame, once masked markers are counted as hidden.
    parts: Vec<Part>,
    /// What is left in a frame of a contraction that is not observed.
    decay: f64,
    prior: Option<TemporalPrior>,
    noise: Noise,
    posterior: Posterior,
    /// What is not at a bound: muscles, then the motion.
    free: Vec<usize>,
    /// x before the frame, as far as it is expected to stay.
    expected: Vec<f64>,
    unknowns: Vec<f64>,
    linear: Vec<f64>,
    weights: Vec<f64>,
    residuals: Vec<Vector3<f64>>,
    squares: Vec<f64>,
    sorted: Vec<f64>,
    reproduction: Reproduction,
    swaps: Vec<[usize; 2]>,
    standard_errors: Vec<f64>,
}

/// One frame for the estimator.
pub(super) struct Frame<'a> {
    pub model: &'a MarkerModel,
    pub evidence: &'a Evidence,
    /// Markers in model space; swapped ones are put right.
    pub aligned: &'a mut [Vector3<f64>],
    /// The same with head motion taken out, once solved.
    pub stabilized: &'a mut [Vector3<f64>],
    /// What is left in a frame of a contraction that is not observed.
    pub decay: f64,
    /// Frames since the last one that was solved.
    pub elapsed: f64,
}

impl Estimator {
    /// `boxes` has the bounds of each muscle in the solver's order.
    pub fn new(
        model: &MarkerModel,
        muscles: &MuscleSet,
        objective: &Objective,
        boxes: &[[f64; 2]],
        has_motion: bool,
        rate_hz: f64,
    ) -> Self {
        let (n, m) = (model.n_markers(), model.n_muscles());
        let size = if has_motion { m + MOTION } else { m };
        let mut qp = BoxQp::new(size);
        for i in m..size {
            qp.set_bounds(i, -MOTION_BOUND, MOTION_BOUND);
        }
        let mirrors = Mirrors::new(model, muscles);
        let prior = (objective.smoothing > 0.0)
            .then(|| TemporalPrior::new(m, step_scale(objective.smoothing), rate_hz));
        Self {
            robust: objective.robust,
            lambda: USUAL_LAMBDA * objective.sparsity / USUAL_STRENGTH,
            has_motion,
            rate_hz,
            boxes: boxes.to_vec(),
            bounds: boxes.to_vec(),
            equations: NormalEquations::new(model, has_motion, qp.stride()),
            coupling: Coupling::new(model, muscles, mirrors.pairs(), objective, size),
            mirrors,
            parts: vec![Part::Held; m],
            decay: 1.0,
            prior,
            noise: Noise::new(n),
            posterior: Posterior::with_capacity(size),
            free: Vec::with_capacity(size),
            expected: vec![0.0; m],
            unknowns: vec![0.0; size],
            linear: vec![0.0; size],
            weights: vec![1.0; n],
            residuals: vec![Vector3::zeros(); n],
            squares: vec![0.0; n],
            sorted: Vec::with_capacity(n),
            reproduction: Reproduction::new(model),
            swaps: Vec::with_capacity(swaps::MAX_SWAPS),
            standard_errors: vec![UNKNOWN; m],
            qp,
        }
    }

    /// The declared rate of the capture.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        self.rate_hz = rate_hz;
        if let Some(prior) = &mut self.prior {
            prior.set_rate_hz(rate_hz);
        }
    }

    /// Takes over what the estimator that this one replaces knew of the noise and the contractions.
    pub fn continue_from(&mut self, before: &Self) {
        self.noise.continue_from(&before.noise);
        self.mirrors.continue_from(&before.mirrors);
        if self.standard_errors.len() != before.standard_errors.len() {
            return;
        }
        self.standard_errors.clone_from(&before.standard_errors);
        if let (Some(prior), Some(before)) = (&mut self.prior, &before.prior) {
            prior.continue_from(before);
        }
    }

    /// Names what a frame finds of those before it.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.within("qp", |tape| self.qp.lasts(tape))?;
        tape.within("noise", |tape| self.noise.lasts(tape))?;
        tape.within("mirrors", |tape| self.mirrors.lasts(tape))?;
        if let Some(prior) = &mut self.prior {
            tape.within("prior", |tape| prior.lasts(tape))?;
        }
        tape.reals("standard_errors", &mut self.standard_errors)
    }

    /// What was known before a gap is not known any more.
    pub fn forget(&mut self) {
        if let Some(prior) = &mut self.prior {
            prior.forget();
        }
    }

    /// What each muscle did in the last frame.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// One sigma of each contraction.
    pub fn standard_errors(&self) -> &[f64] {
        &self.standard_errors
    }

    /// Pairs of markers whose labels were put right in the last frame.
    pub fn swaps(&self) -> &[[usize; 2]] {
        &self.swaps
    }

    /// Whether the last frame masked a marker.
    pub fn is_masked(&self, marker: usize) -> bool {
        self.weights[marker] <= 0.0
    }

    /// Noise of a coordinate of a marker, centimeters.
    pub fn sigma_cm(&self) -> f64 {
        self.noise.sigma_cm()
    }

    /// Solves one frame for `x` and, where the motion is unknown, for `motion`.
    ///
    /// # Errors
    ///
    /// When a round has no solution; `x` and `motion` are then those of the round before.
    pub fn solve(
        &mut self,
        frame: &mut Frame<'_>,
        motion: &mut Stabilizer,
        x: &mut [f64],
    ) -> Result<Report, BoxQpError> {
        self.begin(frame, motion, x);
        let mut report = None;
        let mut turned = f64::INFINITY;
        for round in 0..ROUNDS {
            if turned > LARGE_TURN {
                self.equations
                    .begin(frame.model, frame.evidence, frame.stabilized);
            }
            self.weigh(frame.evidence, round);
            self.count_masked_as_hidden(frame.model, frame.evidence);
            self.equations
                .reweigh(frame.model, frame.evidence, &self.weights);
            self.equations
                .form_linear(frame.model, frame.evidence, frame.stabilized);
            report = Some(self.solve_round(x, round)?);
            turned = self.turn(motion);
            self.measure(frame, motion, x);
        }
        self.mirrors.end(&self.parts, x);
        self.learn(frame.evidence, x)?;
        report.ok_or(BoxQpError::Budget(ROUNDS))
    }

    fn begin(&mut self, frame: &mut Frame<'_>, motion: &Stabilizer, x: &[f64]) {
        self.parts.copy_from_slice(&frame.evidence.parts);
        self.decay = frame.decay;
        self.expected.copy_from_slice(x);
        for (i, &before) in x.iter().enumerate() {
            self.bounds[i] = match self.parts[i] {
                Part::Held => [before; 2],
                Part::Solved | Part::Unobserved => self.boxes[i],
            };
            if self.parts[i] == Part::Unobserved {
                self.let_go(i);
            }
        }
        self.mirrors
            .begin(&self.parts, frame.elapsed / self.rate_hz);
        if let Some(prior) = &mut self.prior {
            prior.begin(frame.elapsed);
        }
        self.measure(frame, motion, x);
        self.swaps.clear();
        if self.robust {
            self.undo_swaps(frame, motion, x);
        }
    }

    fn let_go(&mut self, muscle: usize) {
        let [lower, _] = self.boxes[muscle];
        self.expected[muscle] = (self.expected[muscle] * self.decay).max(lower);
    }

    /// A muscle whose markers are masked is as little observed as one whose markers are hidden. It is let go and does not follow
    /// its mirror image: most masks last for a frame, in which to hold still is best.
    fn count_masked_as_hidden(&mut self, model: &MarkerModel, evidence: &Evidence) {
        if evidence.used.iter().all(|&j| self.weights[j] > 0.0) {
            return;
        }
        for muscle in 0..self.parts.len() {
            let is_trusted = |j: usize| self.weights[j] > 0.0;
            if self.parts[muscle] == Part::Solved && !evidence.tells(model, muscle, is_trusted) {
                self.parts[muscle] = Part::Unobserved;
                self.let_go(muscle);
            }
        }
    }

    /// Fixes the muscles that follow their mirror image where that was found in the round before.
    fn follow(&mut self, x: &[f64]) {
        for it in self.mirrors.followers() {
            let [lower, upper] = self.boxes[it.muscle];
            let place = (x[it.leader] + it.difference).clamp(lower, upper);
            self.bounds[it.muscle] = [place; 2];
            self.expected[it.muscle] = place;
        }
    }

    fn undo_swaps(&mut self, frame: &mut Frame<'_>, motion: &Stabilizer, x: &[f64]) {
        let used = &frame.evidence.used;
        let scatter_cm = weights::scatter_cm(used, &self.squares, &mut self.sorted);
        let sigma_cm = self.noise.sigma_cm().max(scatter_cm);
        let expected = self.reproduction.positions();
        swaps::find(used, frame.stabilized, expected, sigma_cm, &mut self.swaps);
        for &[a, b] in &self.swaps {
            frame.aligned.swap(a, b);
        }
        if !self.swaps.is_empty() {
            self.measure(frame, motion, x);
        }
    }

    /// Moves the markers by the present motion and measures how far each is from where x puts it.
    fn measure(&mut self, frame: &mut Frame<'_>, motion: &Stabilizer, x: &[f64]) {
        self.reproduction.of(x);
        for &j in &frame.evidence.used {
            frame.stabilized[j] = if self.has_motion {
                motion.apply(&frame.aligned[j])
            } else {
                frame.aligned[j]
            };
            self.residuals[j] = frame.stabilized[j] - self.reproduction.at(j);
            self.squares[j] = self.residuals[j].norm_squared();
        }
    }

    fn weigh(&mut self, evidence: &Evidence, round: usize) {
        if !self.robust {
            return;
        }
        let mut sigma_cm = self.noise.sigma_cm();
        if round == 0 {
            // A face that just moved scatters by its motion.
            let used = &evidence.used;
            let scatter_cm = weights::scatter_cm(used, &self.squares, &mut self.sorted);
            sigma_cm = sigma_cm.max(scatter_cm);
        }
        weights::weigh(
            &evidence.used,
            &self.squares,
            sigma_cm,
            round,
            &mut self.weights,
        );
    }

    /// Adds the terms of the objective and solves for the unknowns.
    fn solve_round(&mut self, x: &mut [f64], round: usize) -> Result<Report, BoxQpError> {
        self.follow(x);
        let stride = self.qp.stride();
        let variance = self.noise.changing_variance();
        self.linear.copy_from_slice(&self.equations.linear);
        if let Some(prior) = self.prior.as_mut().filter(|_| round > 0) {
            prior.shrink(x, &self.expected);
        }
        let (equations, prior, coupling) = (&self.equations, &mut self.prior, &self.coupling);
        let (linear, expected) = (&mut self.linear, &self.expected);
        let mut is_definite = true;
        self.qp.set_hessian(|q| {
            equations.write_hessian(q);
            for i in 0..equations.size() {
                q[i * stride + i] += RIDGE;
            }
            if let Some(prior) = prior.as_mut().filter(|it| it.is_known()) {
                let added = prior.add_to(q, stride, linear, expected, variance);
                is_definite = added.is_ok();
            }
            coupling.add_to(q, stride, variance);
        });
        if !is_definite {
            return Err(BoxQpError::NotConvex);
        }
        self.add_sparsity(variance);
        for (i, [lower, upper]) in self.bounds.iter().enumerate() {
            self.qp.set_bounds(i, *lower, *upper);
        }
        let m = x.len();
        self.unknowns[..m].copy_from_slice(x);
        self.unknowns[m..].fill(0.0);
        let report = self.qp.solve(&self.linear, &mut self.unknowns)?;
        let report = self.coupling.separate(
            &mut self.qp,
            &self.linear,
            &mut self.unknowns,
            report,
            &self.bounds,
        )?;
        x.copy_from_slice(&self.unknowns[..m]);
        Ok(report)
    }

    /// The reweighted L1 term: what it takes from c vanishes where a muscle is active.
    fn add_sparsity(&mut self, variance: f64) {
        if self.lambda <= 0.0 {
            return;
        }
        let usual = self.lambda * variance;
        let (relative, sigma_cm) = (self.lambda / USUAL_LAMBDA, variance.sqrt());
        for (i, before) in self.expected.iter().enumerate() {
            let largest = LARGEST_THRESHOLD * sigma_cm * self.equations.diagonal(i).sqrt();
            let share = VANISHING / (VANISHING + before);
            self.linear[i] -= usual.min(relative * largest) * share * share;
        }
    }

    /// Turns the motion by the solution; returns by how much, radians.
    fn turn(&self, motion: &mut Stabilizer) -> f64 {
        if !self.has_motion {
            return 0.0;
        }
        let [omega, tau] = [0, 3].map(|from| {
            let start = self.expected.len() + from;
            Vector3::from_column_slice(&self.unknowns[start..start + 3])
        });
        motion.advance(omega, tau, self.equations.center());
        omega.norm()
    }

    /// Takes noise level and covariance over to the next frame.
    fn learn(&mut self, evidence: &Evidence, x: &[f64]) -> Result<(), BoxQpError> {
        let size = self.unknowns.len();
        self.free.clear();
        self.free.extend((0..size).filter(|&i| self.qp.is_free(i)));
        let left = Left {
            used: &evidence.used,
            residuals: &self.residuals,
            weights: &self.weights,
            n_fitted: self.free.len() as f64,
        };
        self.noise.observe(&left, self.rate_hz);
        let (hessian, stride) = (self.qp.hessian(), self.qp.stride());
        self.posterior
            .find(hessian, stride, &self.free)
            .map_err(|_| BoxQpError::NotConvex)?;
        self.find_standard_errors(x);
        if let Some(prior) = &mut self.prior {
            let n_muscles = self.free.partition_point(|it| *it < x.len());
            let hessian = self.qp.hessian();
            prior.end(
                [x, &self.expected],
                &self.posterior,
                &self.free[..n_muscles],
                |i| hessian[i * stride + i],
                self.noise.changing_variance(),
            );
        }
        Ok(())
    }
}

/// Process noise relative to that of the usual strength: more smoothing is less noise, no smoothing any.
fn step_scale(smoothing: f64) -> f64 {
    /// Full strength leaves so much: a contraction that could not move at all would not be measured.
    const LEAST: f64 = 0.05;
    ((1.0 - smoothing) / smoothing).max(LEAST)
}
