//! Strictly convex quadratic programs with one interval an unknown, by an active set method.
//!
//! Minimizes ½ xᵀQx − cᵀx subject to l ≤ x ≤ u (Choe & Ko 2001, eq. 3, with the common factor 2 dropped).
//! Each step solves the free unknowns exactly, the others at their bounds.
//! The first steps then exchange every unknown that is wrong at once: free ones beyond a bound, bound ones whose Lagrange
//! multiplier has the wrong sign (block pivoting). Started from the frame before, one or two such steps are usual.
//! Block pivoting may go in circles; the primal method takes over after a few steps and cannot: it walks towards the solution
//! of the free unknowns, stops at the first bound in the way, and, once none is, releases the worst multiplier alone.

use super::{
    factor::Factor,
    lanes::{padded, subtract_multiple},
    tape::{Tape, TapeError},
};

/// How far, relative to the largest diagonal entry of Q, a multiplier may have the wrong sign in a solution.
pub const MULTIPLIER_TOLERANCE: f64 = 1e-11;

/// Steps that exchange every wrong unknown at once, before the primal method takes over.
const BLOCK_STEPS: usize = 8;

/// Primal steps allowed for m unknowns: `STEPS_FIXED + STEPS_PER_UNKNOWN * m`.
const STEPS_FIXED: usize = 40;
const STEPS_PER_UNKNOWN: usize = 10;

/// The program and everything its solver reuses between frames.
///
/// Where an unknown stands is kept as numbers, so that the loops over all unknowns have no branches to mispredict.
#[derive(Clone, Debug)]
pub struct BoxQp {
    m: usize,
    /// Distance of the columns of Q: m, padded.
    stride: usize,
    /// Symmetric, stored in full.
    hessian: Vec<f64>,
    largest_diagonal: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The sign that the gradient must not have: 1 at the lower bound, -1 at the upper one, 0 where free or fixed.
    side: Vec<f64>,
    /// 1 where free, else 0.
    is_free: Vec<f64>,
    /// The free unknowns, those that have been free for longest first.
    free: Vec<usize>,
    /// Which are in `free`.
    is_listed: Vec<bool>,
    /// The unknowns that are bound at another value than 0, ascending.
    offset: Vec<usize>,
    /// The last solution; `side`, `free` and `offset` are those of it while `is_settled`.
    solution: Vec<f64>,
    is_settled: bool,
    /// The free set that `factor` belongs to; empty when Q has changed since.
    factored: Vec<usize>,
    factor: Factor,
    /// Solution of the free unknowns, in the order of `free`.
    target: Vec<f64>,
    /// c less what the bound unknowns take of it.
    remainder: Vec<f64>,
    gradient: Vec<f64>,
}

/// How a solve ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Linear solves made.
    pub steps: usize,
    /// Largest violation of the Karush-Kuhn-Tucker conditions, relative to the largest diagonal entry of Q.
    pub kkt_residual: f64,
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BoxQpError {
    /// Q is not positive definite on the free unknowns.
    #[error("the objective is not strictly convex")]
    NotConvex,
    /// The step limit was reached.
    #[error("no solution within {0} active set steps")]
    Budget(usize),
}

impl BoxQp {
    /// A program of `m` unknowns, 0 ≤ x ≤ 1, whose Q is yet to be given.
    pub fn new(m: usize) -> Self {
        let stride = padded(m);
        Self {
            m,
            stride,
            hessian: vec![0.0; m * stride],
            largest_diagonal: 0.0,
            lower: vec![0.0; m],
            upper: vec![1.0; m],
            side: vec![0.0; m],
            is_free: vec![0.0; m],
            free: Vec::with_capacity(m),
            is_listed: vec![false; m],
            offset: Vec::with_capacity(m),
            solution: vec![0.0; m],
            is_settled: false,
            factored: Vec::with_capacity(m),
            factor: Factor::with_capacity(m),
            target: vec![0.0; stride],
            remainder: vec![0.0; stride],
            gradient: vec![0.0; stride],
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.m
    }

    /// Distance of the columns of Q: m, padded to whole lanes; the padding is 0.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Whether there is nothing to solve for.
    pub fn is_empty(&self) -> bool {
        self.m == 0
    }

    /// Replaces Q, m × m, symmetric: `fill` changes what is there, in full, columns [`BoxQp::stride`] apart.
    pub fn set_hessian(&mut self, fill: impl FnOnce(&mut [f64])) {
        fill(&mut self.hessian);
        self.factored.clear();
        let diagonal = self.hessian.iter().step_by(self.stride + 1);
        self.largest_diagonal = diagonal.fold(0.0, |largest: f64, &it| largest.max(it));
    }

    /// Q in full, columns [`BoxQp::stride`] apart.
    pub fn hessian(&self) -> &[f64] {
        &self.hessian
    }

    /// Whether the last solution has the unknown between its bounds.
    pub fn is_free(&self, unknown: usize) -> bool {
        self.is_free[unknown] > 0.0
    }

    /// ½ xᵀQx − cᵀx.
    pub fn objective(&self, c: &[f64], x: &[f64]) -> f64 {
        let columns = self.hessian.chunks_exact(self.stride.max(1));
        let terms = columns.zip(c).zip(x).map(|((column, c), x_i)| {
            let product: f64 = column.iter().zip(x).map(|(q, x)| q * x).sum();
            x_i * (0.5 * product - c)
        });
        terms.sum()
    }

    /// The interval of one unknown; `lower == upper` fixes it.
    ///
    /// # Panics
    ///
    /// When the interval is empty or not finite: bounds are chosen by the caller, never by input.
    pub fn set_bounds(&mut self, unknown: usize, lower: f64, upper: f64) {
        assert!(lower.is_finite() && upper.is_finite() && lower <= upper);
        self.lower[unknown] = lower;
        self.upper[unknown] = upper;
        self.is_settled = false;
    }

    /// Solves for `x`, which holds the start on entry (any values; they are moved into the box) and the solution on return.
    ///
    /// # Errors
    ///
    /// When Q is not positive definite on the free unknowns, or the step limit is reached; `x` is then some point of the box.
    pub fn solve(&mut self, c: &[f64], x: &mut [f64]) -> Result<Report, BoxQpError> {
        if !std::mem::take(&mut self.is_settled) || self.solution != x {
            self.start(x);
        }
        let report = self.solve_started(c, x)?;
        self.solution.copy_from_slice(x);
        self.is_settled = true;
        Ok(report)
    }

    fn solve_started(&mut self, c: &[f64], x: &mut [f64]) -> Result<Report, BoxQpError> {
        for steps in 1..=BLOCK_STEPS {
            self.solve_free(c, x)?;
            for (&i, &target) in self.free.iter().zip(&self.target) {
                x[i] = target;
            }
            self.compute_gradient(x);
            if self.is_solved(x) {
                return Ok(self.report(steps));
            }
            self.exchange(x);
        }
        self.start(x);
        self.solve_primal(c, x)
    }

    /// One exchange at a time, with a falling objective.
    fn solve_primal(&mut self, c: &[f64], x: &mut [f64]) -> Result<Report, BoxQpError> {
        let budget = STEPS_FIXED + STEPS_PER_UNKNOWN * self.m;
        for steps in 1..=budget {
            self.solve_free(c, x)?;
            if self.advance(x) {
                continue;
            }
            self.compute_gradient(x);
            match self.worst_multiplier() {
                Some(unknown) => {
                    (self.side[unknown], self.is_free[unknown]) = (0.0, 1.0);
                    self.list(x);
                }
                None => return Ok(self.report(BLOCK_STEPS + steps)),
            }
        }
        Err(BoxQpError::Budget(budget))
    }

    fn report(&self, steps: usize) -> Report {
        let unknowns = self.gradient.iter().zip(&self.side).zip(&self.is_free);
        let worst = unknowns.fold(0.0, |worst: f64, ((g, side), free)| {
            worst.max(-side * g).max(free * g.abs())
        });
        Report {
            steps,
            kkt_residual: worst / self.largest_diagonal.max(f64::MIN_POSITIVE),
        }
    }

    fn tolerance(&self) -> f64 {
        MULTIPLIER_TOLERANCE * self.largest_diagonal
    }

    /// Whether every free unknown is in its box and every multiplier has the right sign.
    #[expect(
        clippy::needless_bitwise_bool,
        reason = "a branch an unknown would be mispredicted, once or twice a frame"
    )]
    fn is_solved(&self, x: &[f64]) -> bool {
        let tolerance = self.tolerance();
        let bounds = self.lower.iter().zip(&self.upper);
        let signs = self.gradient.iter().zip(&self.side);
        let wrong = x.iter().zip(bounds).zip(signs).fold(
            false,
            |wrong, ((x, (lower, upper)), (g, side))| {
                wrong | (x < lower) | (x > upper) | (-side * g > tolerance)
            },
        );
        !wrong
    }

    /// Exchanges every unknown that is wrong.
    fn exchange(&mut self, x: &mut [f64]) {
        let tolerance = self.tolerance();
        for (i, x) in x.iter_mut().enumerate() {
            if -self.side[i] * self.gradient[i] > tolerance {
                (self.side[i], self.is_free[i]) = (0.0, 1.0);
            } else if *x < self.lower[i] {
                *x = self.lower[i];
                (self.side[i], self.is_free[i]) = (1.0, 0.0);
            } else if *x > self.upper[i] {
                *x = self.upper[i];
                (self.side[i], self.is_free[i]) = (-1.0, 0.0);
            }
        }
        self.list(x);
    }

    /// Moves the start into the box and reads off which bounds it touches.
    fn start(&mut self, x: &mut [f64]) {
        for (i, x) in x.iter_mut().enumerate() {
            let (lower, upper) = (self.lower[i], self.upper[i]);
            let (value, side, is_free) = if lower >= upper {
                (lower, 0.0, 0.0)
            } else if *x >= upper {
                (upper, -1.0, 0.0)
            } else if *x > lower {
                (*x, 0.0, 1.0)
            } else {
                // Also where the start is undefined: NaN fails both comparisons.
                (lower, 1.0, 0.0)
            };
            (*x, self.side[i], self.is_free[i]) = (value, side, is_free);
        }
        self.list(x);
    }

    /// Lists the free unknowns, and those bound at another value than 0.
    ///
    /// What stays free keeps its place, what is newly free comes last: unknowns that flicker at a bound gather at the end, and
    /// the factor of those before them stays good.
    fn list(&mut self, x: &[f64]) {
        self.free.retain(|&i| {
            self.is_listed[i] = self.is_free[i] > 0.0;
            self.is_listed[i]
        });
        self.offset.clear();
        for (i, (&x, &is_free)) in x.iter().zip(&self.is_free).enumerate() {
            if is_free <= 0.0 {
                if x != 0.0 {
                    self.offset.push(i);
                }
            } else if !self.is_listed[i] {
                self.is_listed[i] = true;
                self.free.push(i);
            }
        }
    }

    /// Names what a solve finds of those before it. Q and the bounds are the caller's.
    pub(crate) fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.places("free", &mut self.free, self.m)?;
        tape.reals("side", &mut self.side)?;
        tape.reals("is_free", &mut self.is_free)?;
        tape.reals("solution", &mut self.solution)?;
        tape.flag("is_settled", &mut self.is_settled)?;
        if tape.is_read() {
            self.is_listed.fill(false);
            for &i in &self.free {
                self.is_listed[i] = true;
            }
            let unknowns = self.solution.iter().zip(&self.is_free).enumerate();
            let is_offset = |(x, is_free): (&f64, &f64)| *is_free <= 0.0 && *x != 0.0;
            let offset = unknowns.filter(|(_, it)| is_offset(*it)).map(|(i, _)| i);
            self.offset.clear();
            self.offset.extend(offset);
            self.factored.clear();
        }
        Ok(())
    }

    /// Minimizes over the free unknowns alone, the others at their bounds; the result is `target`.
    fn solve_free(&mut self, c: &[f64], x: &[f64]) -> Result<(), BoxQpError> {
        self.remainder[..self.m].copy_from_slice(c);
        for &j in &self.offset {
            let column = &self.hessian[j * self.stride..(j + 1) * self.stride];
            subtract_multiple(&mut self.remainder, x[j], column);
        }
        self.refactor()?;
        for (t, &i) in self.target.iter_mut().zip(&self.free) {
            *t = self.remainder[i];
        }
        self.factor.solve(&mut self.target);
        Ok(())
    }

    /// Factors Q on the free unknowns, as far as the factor does not hold it already.
    fn refactor(&mut self) -> Result<(), BoxQpError> {
        let same = |(old, new): &(&usize, &usize)| old == new;
        let kept = self
            .factored
            .iter()
            .zip(&self.free)
            .take_while(same)
            .count();
        if kept == self.free.len() && kept == self.factored.len() {
            return Ok(());
        }
        self.factored.clear();
        self.factor
            .factor(&self.hessian, self.stride, &self.free, kept)
            .map_err(|_| BoxQpError::NotConvex)?;
        self.factored.extend_from_slice(&self.free);
        Ok(())
    }

    /// Walks towards `target` up to the first bound in the way, and says whether there was one.
    fn advance(&mut self, x: &mut [f64]) -> bool {
        let mut length = 1.0;
        let mut blocking = None;
        for (&i, &target) in self.free.iter().zip(&self.target) {
            let (bound, side) = if target < self.lower[i] {
                (self.lower[i], 1.0)
            } else if target > self.upper[i] {
                (self.upper[i], -1.0)
            } else {
                continue;
            };
            let reach = (bound - x[i]) / (target - x[i]);
            if blocking.is_none() || reach < length {
                length = reach.clamp(0.0, 1.0);
                blocking = Some((i, bound, side));
            }
        }
        for (&i, &target) in self.free.iter().zip(&self.target) {
            x[i] = if blocking.is_some() {
                (x[i] + length * (target - x[i])).clamp(self.lower[i], self.upper[i])
            } else {
                target
            };
        }
        if let Some((unknown, bound, side)) = blocking {
            x[unknown] = bound;
            (self.side[unknown], self.is_free[unknown]) = (side, 0.0);
            self.list(x);
        }
        blocking.is_some()
    }

    /// g = Qx − c, of which the bound unknowns' part is known from the remainder.
    fn compute_gradient(&mut self, x: &[f64]) {
        for (g, r) in self.gradient.iter_mut().zip(&self.remainder) {
            *g = -r;
        }
        for &j in &self.free {
            let column = &self.hessian[j * self.stride..(j + 1) * self.stride];
            subtract_multiple(&mut self.gradient, -x[j], column);
        }
    }

    /// The bound unknown whose release would lower the objective most steeply.
    fn worst_multiplier(&self) -> Option<usize> {
        let violations = self
            .gradient
            .iter()
            .zip(&self.side)
            .map(|(g, side)| -side * g);
        let mut worst = (None, self.tolerance());
        for (i, violation) in violations.enumerate() {
            if violation > worst.1 {
                worst = (Some(i), violation);
            }
        }
        worst.0
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt as _, SeedableRng as _};
    use rand_pcg::Pcg64;

    use super::*;

    /// `Q = AᵀA + I/100` with random A, and a c that leaves about half of the unknowns at bounds.
    fn random(m: usize, rng: &mut Pcg64) -> (BoxQp, Vec<f64>) {
        let a = nalgebra::DMatrix::from_fn(m, m, |_, _| rng.random_range(-1.0..1.0));
        let q = a.tr_mul(&a) + nalgebra::DMatrix::identity(m, m) * 0.01;
        let mut qp = BoxQp::new(m);
        let stride = qp.stride();
        qp.set_hessian(|it| {
            for (to, from) in it.chunks_exact_mut(stride).zip(q.column_iter()) {
                to[..m].copy_from_slice(from.as_slice());
            }
        });
        let c = (0..m).map(|_| rng.random_range(-3.0..3.0)).collect();
        (qp, c)
    }

    #[test]
    fn the_primal_method_alone_comes_to_the_same_solution() {
        let mut rng = Pcg64::seed_from_u64(3);
        for m in 1..=40 {
            let (mut qp, c) = random(m, &mut rng);
            let mut together = vec![0.0; m];
            let report = qp.solve(&c, &mut together).unwrap();
            assert!(report.kkt_residual <= 1e-10, "{report:?}");
            let mut alone: Vec<f64> = (0..m).map(|_| rng.random_range(-0.5..1.5)).collect();
            qp.start(&mut alone);
            let report = qp.solve_primal(&c, &mut alone).unwrap();
            assert!(report.kkt_residual <= 1e-10, "{report:?}");
            for (a, b) in together.iter().zip(&alone) {
                assert!((a - b).abs() < 1e-9, "m {m}: {a} {b}");
            }
        }
    }

    #[test]
    fn a_fixed_unknown_stays_and_the_others_take_it_into_account() {
        let mut rng = Pcg64::seed_from_u64(4);
        let (mut qp, c) = random(6, &mut rng);
        qp.set_bounds(2, 0.4, 0.4);
        let mut x = vec![0.0; 6];
        let report = qp.solve(&c, &mut x).unwrap();
        assert_eq!(x[2].to_bits(), 0.4_f64.to_bits());
        assert!(report.kkt_residual <= 1e-10);
    }

    #[test]
    fn an_undefined_start_and_an_empty_problem_do_no_harm() {
        let mut rng = Pcg64::seed_from_u64(5);
        let (mut qp, c) = random(4, &mut rng);
        let mut x = vec![f64::NAN; 4];
        qp.solve(&c, &mut x).unwrap();
        assert!(x.iter().all(|it| (0.0..=1.0).contains(it)));
        assert!(BoxQp::new(0).solve(&[], &mut []).is_ok());
    }

    #[test]
    fn a_problem_that_is_not_convex_is_refused() {
        let mut qp = BoxQp::new(1);
        qp.set_hessian(|it| it[0] = -1.0);
        let mut x = [0.5];
        assert_eq!(qp.solve(&[1.0], &mut x), Err(BoxQpError::NotConvex));
    }
}
