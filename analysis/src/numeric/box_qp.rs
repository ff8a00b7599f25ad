//! Strictly convex quadratic programs with one interval an unknown, by a primal active set method.
//!
//! Minimizes ½ xᵀQx − cᵀx subject to l ≤ x ≤ u (Choe & Ko 2001, eq. 3, with the common factor 2 dropped).
//! Each step solves the free unknowns exactly, stops at the first bound in the way, and, once none is, releases the bound
//! whose Lagrange multiplier has the wrong sign by most.
//! Started from the solution of the frame before, a frame usually costs one solve with a factor that is already there.

use super::cholesky::Cholesky;

/// How far, relative to the largest diagonal entry of Q, a multiplier may have the wrong sign in a solution.
pub const MULTIPLIER_TOLERANCE: f64 = 1e-11;

/// Steps allowed for m unknowns: `STEPS_FIXED + STEPS_PER_UNKNOWN * m`. Real frames need one to five.
const STEPS_FIXED: usize = 40;
const STEPS_PER_UNKNOWN: usize = 10;

/// Where an unknown stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Lower,
    Free,
    Upper,
}

/// The program and everything its solver reuses between frames.
#[derive(Clone, Debug)]
pub struct BoxQp {
    m: usize,
    /// Symmetric, stored in full, columns m apart.
    hessian: Vec<f64>,
    largest_diagonal: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    place: Vec<Place>,
    free: Vec<usize>,
    /// The free set that `cholesky` holds the factor of; `None` when Q has changed since.
    factored: Option<Vec<usize>>,
    cholesky: Cholesky,
    target: Vec<f64>,
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
        Self {
            m,
            hessian: vec![0.0; m * m],
            largest_diagonal: 0.0,
            lower: vec![0.0; m],
            upper: vec![1.0; m],
            place: vec![Place::Lower; m],
            free: Vec::with_capacity(m),
            factored: None,
            cholesky: Cholesky::with_capacity(m),
            target: vec![0.0; m],
            gradient: vec![0.0; m],
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.m
    }

    /// Whether there is nothing to solve for.
    pub fn is_empty(&self) -> bool {
        self.m == 0
    }

    /// Replaces Q, m × m, symmetric: `fill` writes it in full, columns m apart.
    pub fn set_hessian(&mut self, fill: impl FnOnce(&mut [f64])) {
        fill(&mut self.hessian);
        self.factored = None;
        let diagonal = self.hessian.iter().step_by(self.m + 1);
        self.largest_diagonal = diagonal.fold(0.0, |largest: f64, &it| largest.max(it));
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
    }

    /// Solves for `x`, which holds the start on entry (any values; they are moved into the box) and the solution on return.
    ///
    /// # Errors
    ///
    /// When Q is not positive definite on the free unknowns, or the step limit is reached; `x` is then some point of the box.
    pub fn solve(&mut self, c: &[f64], x: &mut [f64]) -> Result<Report, BoxQpError> {
        self.start(x);
        let budget = STEPS_FIXED + STEPS_PER_UNKNOWN * self.m;
        for steps in 1..=budget {
            self.solve_free(c, x)?;
            if self.advance(x) {
                continue;
            }
            self.compute_gradient(c, x);
            let Some(unknown) = self.worst_multiplier() else {
                let kkt_residual = self.kkt_residual();
                return Ok(Report {
                    steps,
                    kkt_residual,
                });
            };
            self.place[unknown] = Place::Free;
        }
        Err(BoxQpError::Budget(budget))
    }

    /// Moves the start into the box and reads off which bounds it touches.
    fn start(&mut self, x: &mut [f64]) {
        for (i, it) in x.iter_mut().enumerate() {
            let (lower, upper) = (self.lower[i], self.upper[i]);
            if *it >= upper && lower < upper {
                (*it, self.place[i]) = (upper, Place::Upper);
            } else if *it > lower && lower < upper {
                self.place[i] = Place::Free;
            } else {
                // Also where the start is undefined: NaN fails both comparisons.
                (*it, self.place[i]) = (lower, Place::Lower);
            }
        }
    }

    /// Minimizes over the free unknowns alone, the others at their bounds; the result is `target`.
    fn solve_free(&mut self, c: &[f64], x: &[f64]) -> Result<(), BoxQpError> {
        self.free.clear();
        let place = &self.place;
        self.free
            .extend((0..self.m).filter(|&i| place[i] == Place::Free));
        self.refactor()?;
        // What the bound unknowns leave of c, in full length so that the loop runs over contiguous columns.
        self.gradient.copy_from_slice(c);
        for (j, &value) in x.iter().enumerate() {
            if self.place[j] != Place::Free && value != 0.0 {
                let column = &self.hessian[j * self.m..(j + 1) * self.m];
                for (g, q) in self.gradient.iter_mut().zip(column) {
                    *g -= q * value;
                }
            }
        }
        for (t, &i) in self.target.iter_mut().zip(&self.free) {
            *t = self.gradient[i];
        }
        self.cholesky.solve(&mut self.target[..self.free.len()]);
        Ok(())
    }

    /// Factors Q on the free unknowns, unless that is what the factor already holds.
    fn refactor(&mut self) -> Result<(), BoxQpError> {
        if self.factored.as_ref() == Some(&self.free) {
            return Ok(());
        }
        let mut factored = self.factored.take().unwrap_or_default();
        self.cholesky
            .factor(&self.hessian, self.m, &self.free)
            .map_err(|_| BoxQpError::NotConvex)?;
        factored.clone_from(&self.free);
        self.factored = Some(factored);
        Ok(())
    }

    /// Walks towards `target` up to the first bound in the way, and says whether there was one.
    fn advance(&mut self, x: &mut [f64]) -> bool {
        let mut length = 1.0;
        let mut blocking = None;
        for (&i, &target) in self.free.iter().zip(&self.target) {
            let (bound, place) = if target < self.lower[i] {
                (self.lower[i], Place::Lower)
            } else if target > self.upper[i] {
                (self.upper[i], Place::Upper)
            } else {
                continue;
            };
            let reach = (bound - x[i]) / (target - x[i]);
            if blocking.is_none() || reach < length {
                length = reach.clamp(0.0, 1.0);
                blocking = Some((i, bound, place));
            }
        }
        for (&i, &target) in self.free.iter().zip(&self.target) {
            x[i] = if blocking.is_some() {
                (x[i] + length * (target - x[i])).clamp(self.lower[i], self.upper[i])
            } else {
                target
            };
        }
        if let Some((unknown, bound, place)) = blocking {
            x[unknown] = bound;
            self.place[unknown] = place;
        }
        blocking.is_some()
    }

    /// g = Qx − c.
    fn compute_gradient(&mut self, c: &[f64], x: &[f64]) {
        for (g, c) in self.gradient.iter_mut().zip(c) {
            *g = -c;
        }
        for (j, &value) in x.iter().enumerate() {
            if value != 0.0 {
                let column = &self.hessian[j * self.m..(j + 1) * self.m];
                for (g, q) in self.gradient.iter_mut().zip(column) {
                    *g += q * value;
                }
            }
        }
    }

    /// By how much the gradient at unknown `i` could still lower the objective inside the box; 0 for a fixed unknown.
    fn violation(&self, i: usize) -> f64 {
        let g = self.gradient[i];
        match self.place[i] {
            Place::Free => g.abs(),
            _ if self.lower[i] >= self.upper[i] => 0.0,
            Place::Lower => (-g).max(0.0),
            Place::Upper => g.max(0.0),
        }
    }

    fn worst_multiplier(&self) -> Option<usize> {
        let tolerance = MULTIPLIER_TOLERANCE * self.largest_diagonal;
        let mut worst = (None, tolerance);
        for i in 0..self.m {
            let violation = self.violation(i);
            if self.place[i] != Place::Free && violation > worst.1 {
                worst = (Some(i), violation);
            }
        }
        worst.0
    }

    fn kkt_residual(&self) -> f64 {
        let worst = (0..self.m).fold(0.0, |worst: f64, i| worst.max(self.violation(i)));
        worst / self.largest_diagonal.max(f64::MIN_POSITIVE)
    }
}
