//! ½ xᵀQx − cᵀx of one frame: `Q = DᵀD` and `c = Dᵀd` over what the frame shows, and what a method adds to them.

use frontalis_analysis::numeric::box_qp::BoxQp;

use crate::stabilized::Stabilized;

/// Added to the diagonal of Q, so that a muscle whose markers are hidden has a solution: 0.
const RIDGE: f64 = 1e-9;

/// The objective of one frame over some of the muscles.
pub struct Quadratic {
    /// m × m, symmetric.
    pub q: Vec<f64>,
    /// m entries.
    pub c: Vec<f64>,
}

impl Quadratic {
    /// Least squares over the rows and muscles that `is_row` and `muscles` choose, as far as the frame shows them.
    pub fn of(
        problem: &Stabilized,
        d: &[f64],
        is_row: impl Fn(usize) -> bool,
        muscles: &[usize],
    ) -> Self {
        let m = muscles.len();
        let mut it = Self {
            q: vec![0.0; m * m],
            c: vec![0.0; m],
        };
        for (row, d) in d
            .iter()
            .enumerate()
            .filter(|(row, d)| !d.is_nan() && is_row(*row))
        {
            let basis = &problem.basis[row];
            for (i, &muscle) in muscles.iter().enumerate() {
                it.c[i] += basis[muscle] * d;
                for (q, &other) in it.q[i * m..(i + 1) * m].iter_mut().zip(muscles) {
                    *q += basis[muscle] * basis[other];
                }
            }
        }
        it.add_to_diagonal(RIDGE);
        it
    }

    /// Least squares over everything that the frame shows.
    pub fn of_all(problem: &Stabilized, d: &[f64]) -> Self {
        let muscles: Vec<usize> = (0..problem.n_muscles()).collect();
        Self::of(problem, d, |_| true, &muscles)
    }

    /// The mean of the diagonal of Q, the scale of a penalty.
    pub fn mean_diagonal(&self) -> f64 {
        let m = self.c.len();
        self.q.iter().step_by(m + 1).sum::<f64>() / m as f64
    }

    pub fn add_to_diagonal(&mut self, value: f64) {
        let m = self.c.len();
        for q in self.q.iter_mut().step_by(m + 1) {
            *q += value;
        }
    }

    /// The minimizer within `lower` and `upper`, from `x` on; `x` stays when there is none within the steps allowed.
    pub fn minimize(&self, lower: f64, upper: f64, x: &mut [f64]) {
        let m = self.c.len();
        let mut program = BoxQp::new(m);
        let stride = program.stride();
        program.set_hessian(|h| {
            for (column, q) in h.chunks_exact_mut(stride).zip(self.q.chunks_exact(m)) {
                column[..m].copy_from_slice(q);
            }
        });
        for unknown in 0..m {
            program.set_bounds(unknown, lower, upper);
        }
        let mut found = x.to_vec();
        if program.solve(&self.c, &mut found).is_ok() {
            x.copy_from_slice(&found);
        }
    }
}
