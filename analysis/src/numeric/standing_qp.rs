//! A box QP whose Q stays as it is for many c: after a few solves it is worth its inverse.
//!
//! While Q is new, and whenever the inverse is of no use, the general method of [`super::box_qp`] solves; then exchanges
//! from the minimum without bounds, which cost a fraction of it. Which of them solves depends on the calls since Q was set,
//! so the same calls give the same bits.

use super::{
    box_qp::{BoxQp, BoxQpError, Report},
    pivots::{self, Exchanges},
    tape::{Tape, TapeError},
};

/// Solves with the same Q before its inverse is computed, which takes as long as several of them.
const SOLVES_BEFORE_INVERSE: usize = 4;

/// Minimizes ½ xᵀQx − cᵀx, l ≤ x ≤ u, for one c after another.
///
/// A solve is [`StandingQp::start`], [`StandingQp::advance`] until it says no, [`StandingQp::finish`]: so that problems that
/// do not depend on each other can take turns, and none waits alone for the result of a division.
#[derive(Clone, Debug)]
pub struct StandingQp {
    general: BoxQp,
    /// Padded with 0.
    c: Vec<f64>,
    /// Solves since Q was set.
    solves: usize,
    /// Made with the first Q.
    exchanges: Option<Box<dyn Exchanges>>,
    /// Whether the exchanges have an inverse of Q that is of use.
    inverted: bool,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Unknowns with `lower == upper`.
    fixed: usize,
}

impl StandingQp {
    /// A program of `m` unknowns, 0 ≤ x ≤ 1, whose Q is yet to be given.
    pub fn new(m: usize) -> Self {
        Self {
            general: BoxQp::new(m),
            c: vec![0.0; pivots::padded(m)],
            solves: 0,
            exchanges: None,
            inverted: false,
            lower: vec![0.0; m],
            upper: vec![1.0; m],
            fixed: 0,
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.general.len()
    }

    /// Whether there is nothing to solve for.
    pub fn is_empty(&self) -> bool {
        self.general.is_empty()
    }

    /// Distance of the columns of Q.
    pub fn stride(&self) -> usize {
        self.general.stride()
    }

    /// Replaces Q, as [`BoxQp::set_hessian`] does.
    pub fn set_hessian(&mut self, fill: impl FnOnce(&mut [f64])) {
        self.general.set_hessian(fill);
        self.solves = 0;
        self.inverted = false;
        if self.exchanges.is_none() {
            let mut exchanges = pivots::exchanges(self.len());
            for (i, (&lower, &upper)) in self.lower.iter().zip(&self.upper).enumerate() {
                exchanges.set_bounds(i, lower, upper);
            }
            self.exchanges = Some(exchanges);
        }
    }

    /// The interval of one unknown; `lower == upper` fixes it.
    ///
    /// # Panics
    ///
    /// When the interval is empty or not finite.
    pub fn set_bounds(&mut self, unknown: usize, lower: f64, upper: f64) {
        self.general.set_bounds(unknown, lower, upper);
        let was_fixed = self.lower[unknown] >= self.upper[unknown];
        (self.lower[unknown], self.upper[unknown]) = (lower, upper);
        self.fixed += usize::from(lower >= upper);
        self.fixed -= usize::from(was_fixed);
        if let Some(exchanges) = &mut self.exchanges {
            exchanges.set_bounds(unknown, lower, upper);
        }
    }

    /// Where c is written before a start: the m entries, and what pads them, which stays 0.
    pub fn c_mut(&mut self) -> &mut [f64] {
        &mut self.c
    }

    /// Starts a solve for the c that was written.
    pub fn start(&mut self) {
        self.solves = self.solves.saturating_add(1);
        if self.solves == SOLVES_BEFORE_INVERSE {
            self.invert();
        }
        if let Some(exchanges) = usable(&mut self.exchanges, self.inverted, self.fixed) {
            exchanges.start(&self.c);
        }
    }

    fn invert(&mut self) {
        let (stride, hessian) = (self.general.stride(), self.general.hessian());
        let exchanges = self.exchanges.as_mut();
        self.inverted = exchanges.is_some_and(|it| it.set_hessian(stride, hessian));
    }

    /// Names what a solve finds of those before it. Q, which is set before this is read, and the bounds are the caller's.
    pub(crate) fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        let mut solves = self.solves as u64;
        tape.integer("solves", &mut solves)?;
        self.solves = usize::try_from(solves).unwrap_or(usize::MAX);
        if tape.is_read() && self.solves >= SOLVES_BEFORE_INVERSE {
            self.invert();
        }
        self.general.lasts(tape)
    }

    /// Goes one step on; false when the solve is ready to be finished.
    pub fn advance(&mut self) -> bool {
        let exchanges = usable(&mut self.exchanges, self.inverted, self.fixed);
        exchanges.is_some_and(Exchanges::advance)
    }

    /// Ends a solve: `x` holds any values on entry (a start for the general method) and the solution on return.
    ///
    /// # Errors
    ///
    /// Those of [`BoxQp::solve`].
    pub fn finish(&mut self, x: &mut [f64]) -> Result<Report, BoxQpError> {
        if let Some(exchanges) = usable(&mut self.exchanges, self.inverted, self.fixed)
            && let Some(report) = exchanges.finish()
        {
            exchanges.read(x);
            return Ok(report);
        }
        self.general.solve(&self.c[..x.len()], x)
    }
}

/// The exchanges, where they can solve: with an inverse, and no unknown fixed.
fn usable(
    exchanges: &mut Option<Box<dyn Exchanges>>,
    inverted: bool,
    fixed: usize,
) -> Option<&mut (dyn Exchanges + 'static)> {
    exchanges.as_deref_mut().filter(|_| inverted && fixed == 0)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt as _, SeedableRng as _};
    use rand_pcg::Pcg64;

    use super::*;

    /// `Q = AᵀA + I/100`, columns m apart.
    fn random_hessian(m: usize, rng: &mut Pcg64) -> Vec<f64> {
        let a = nalgebra::DMatrix::from_fn(m, m, |_, _| rng.random_range(-1.0..1.0));
        let q = a.tr_mul(&a) + nalgebra::DMatrix::identity(m, m) * 0.01;
        ((&q + q.transpose()) * 0.5).as_slice().to_vec()
    }

    fn set(m: usize, stride: usize, hessian: &[f64]) -> impl FnOnce(&mut [f64]) {
        move |to| {
            for (to, from) in to.chunks_exact_mut(stride).zip(hessian.chunks_exact(m)) {
                to[..m].copy_from_slice(from);
            }
        }
    }

    fn solve(qp: &mut StandingQp, c: &[f64], x: &mut [f64]) -> Report {
        qp.c_mut()[..c.len()].copy_from_slice(c);
        qp.start();
        while qp.advance() {}
        qp.finish(x).unwrap()
    }

    /// Largest violation of the optimality conditions, from their definition.
    fn kkt(hessian: &[f64], c: &[f64], x: &[f64], bounds: &[(f64, f64)]) -> f64 {
        let m = c.len();
        let largest = (0..m).map(|i| hessian[i * m + i]).fold(0.0, f64::max);
        (0..m).fold(0.0, |worst: f64, i| {
            let column = &hessian[i * m..(i + 1) * m];
            let g = column.iter().zip(x).map(|(q, x)| q * x).sum::<f64>() - c[i];
            let (lower, upper) = bounds[i];
            assert!((lower..=upper).contains(&x[i]));
            let wrong = if x[i] <= lower {
                -g
            } else if x[i] >= upper {
                g
            } else {
                g.abs()
            };
            worst.max(wrong / largest)
        })
    }

    #[test]
    fn exchanges_come_to_the_solution_of_the_general_method() {
        let mut rng = Pcg64::seed_from_u64(7);
        for m in (1..=24).chain([40, 63, 64]) {
            let hessian = random_hessian(m, &mut rng);
            let bounds: Vec<(f64, f64)> = (0..m)
                .map(|_| (rng.random_range(-0.5..0.2), rng.random_range(0.3..2.0)))
                .collect();
            let (mut standing, mut general) = (StandingQp::new(m), BoxQp::new(m));
            let stride = standing.stride();
            standing.set_hessian(set(m, stride, &hessian));
            general.set_hessian(set(m, stride, &hessian));
            for (i, &(lower, upper)) in bounds.iter().enumerate() {
                standing.set_bounds(i, lower, upper);
                general.set_bounds(i, lower, upper);
            }
            let (mut x, mut expected) = (vec![0.0; m], vec![0.0; m]);
            for round in 0..12 {
                let c: Vec<f64> = (0..m).map(|_| rng.random_range(-3.0..3.0)).collect();
                let report = solve(&mut standing, &c, &mut x);
                assert_eq!(standing.inverted, round + 1 >= SOLVES_BEFORE_INVERSE);
                assert!(report.kkt_residual <= 1e-11, "m {m}: {report:?}");
                assert!(kkt(&hessian, &c, &x, &bounds) <= 1e-11);
                general.solve(&c, &mut expected).unwrap();
                for (a, b) in x.iter().zip(&expected) {
                    assert!(
                        (a - b).abs() < 1e-12 * condition(&hessian, m),
                        "m {m}: {a} {b}"
                    );
                }
            }
        }
    }

    fn condition(hessian: &[f64], m: usize) -> f64 {
        let eigenvalues =
            nalgebra::DMatrix::from_column_slice(m, m, hessian).symmetric_eigenvalues();
        eigenvalues.max() / eigenvalues.min()
    }

    #[test]
    fn the_same_c_gives_the_same_bits_whatever_came_before() {
        let mut rng = Pcg64::seed_from_u64(8);
        let m = 10;
        let hessian = random_hessian(m, &mut rng);
        let mut qp = StandingQp::new(m);
        let stride = qp.stride();
        qp.set_hessian(set(m, stride, &hessian));
        let c: Vec<f64> = (0..m).map(|_| rng.random_range(-3.0..3.0)).collect();
        let mut solutions = Vec::new();
        for _ in 0..20 {
            let other: Vec<f64> = (0..m).map(|_| rng.random_range(-3.0..3.0)).collect();
            let mut x = vec![0.0; m];
            solve(&mut qp, &other, &mut x);
            solve(&mut qp, &c, &mut x);
            solutions.push(x);
        }
        let settled = &solutions[SOLVES_BEFORE_INVERSE..];
        assert!(settled.iter().all(|it| it == &settled[0]));
    }

    #[test]
    fn a_basis_that_is_almost_deficient_is_left_to_the_general_method() {
        let mut rng = Pcg64::seed_from_u64(9);
        let (n, m) = (60, 12);
        // The last column differs from the first by a part in four million.
        let mut d = nalgebra::DMatrix::from_fn(n, m, |_, _| rng.random_range(-1.0..1.0));
        let twin =
            d.column(0) + nalgebra::DVector::from_fn(n, |_, _| rng.random_range(-2.5e-7..2.5e-7));
        d.set_column(m - 1, &twin);
        let q = d.tr_mul(&d);
        let hessian = ((&q + q.transpose()) * 0.5).as_slice().to_vec();
        let mut qp = StandingQp::new(m);
        let stride = qp.stride();
        qp.set_hessian(set(m, stride, &hessian));
        let mut x = vec![0.0; m];
        for _ in 0..50 {
            let target = nalgebra::DVector::from_fn(m, |_, _| rng.random_range(-0.3..1.3));
            let c = d.tr_mul(&(&d * target));
            let report = solve(&mut qp, c.as_slice(), &mut x);
            assert!(report.kkt_residual <= 1e-10, "{report:?}");
            assert!(kkt(&hessian, c.as_slice(), &x, &vec![(0.0, 1.0); m]) <= 1e-10);
        }
        assert!(!qp.inverted);
    }

    #[test]
    fn a_fixed_unknown_stays_and_is_free_again_when_its_interval_opens() {
        let mut rng = Pcg64::seed_from_u64(10);
        let m = 6;
        let hessian = random_hessian(m, &mut rng);
        let mut qp = StandingQp::new(m);
        let stride = qp.stride();
        qp.set_hessian(set(m, stride, &hessian));
        let c: Vec<f64> = (0..m).map(|_| rng.random_range(0.0..1.0)).collect();
        let mut x = vec![0.0; m];
        for _ in 0..6 {
            solve(&mut qp, &c, &mut x);
        }
        let open = x.clone();
        qp.set_bounds(2, 0.4, 0.4);
        solve(&mut qp, &c, &mut x);
        assert_eq!(x[2].to_bits(), 0.4_f64.to_bits());
        qp.set_bounds(2, 0.0, 1.0);
        solve(&mut qp, &c, &mut x);
        assert_eq!(x, open);
    }

    #[test]
    fn a_c_that_is_no_number_is_not_taken_for_solved_by_exchanges() {
        let mut rng = Pcg64::seed_from_u64(11);
        let m = 5;
        let hessian = random_hessian(m, &mut rng);
        let mut qp = StandingQp::new(m);
        let stride = qp.stride();
        qp.set_hessian(set(m, stride, &hessian));
        for value in [0.5, 0.5, 0.5, 0.5, f64::NAN, f64::INFINITY] {
            qp.c_mut()[..m].fill(value);
            qp.start();
            while qp.advance() {}
            let solved = qp.exchanges.as_mut().and_then(|it| it.finish());
            assert!(solved.is_none() || value.is_finite());
        }
        let c = vec![0.5; m];
        let mut x = vec![0.0; m];
        assert!(solve(&mut qp, &c, &mut x).kkt_residual <= 1e-11);
    }
}
