//! The objective of a widely deployed blend-shape solver, within [0, 1], all muscles together.
//!
//! Sparsity is a penalty on (Σ xᵢ)², which adds μ s to every entry of Q.
//! The temporal term adds 100 λ s to the diagonal and only λ s x of the frame before to the right side, so that it
//! pulls to 0 a hundred times as hard as to that frame.
//! s, which is the face's size there, is the mean of the diagonal of Q here, since markers are not a mesh of thousands.

use harness::accuracy::curves::Curves;

use super::quadratic::Quadratic;
use crate::stabilized::Stabilized;

/// The temporal term of the matrix, relative to that of the right side.
const MATRIX_SHARE: f64 = 100.0;

/// The method with its constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deployed {
    /// μ.
    pub sparsity: f64,
    /// λ.
    pub temporal: f64,
}

impl Deployed {
    pub fn solve(&self, problem: &Stabilized) -> Curves {
        problem.each_frame(|d, x| {
            let mut objective = Quadratic::of_all(problem, d);
            let scale = objective.mean_diagonal();
            for q in &mut objective.q {
                *q += self.sparsity * scale;
            }
            objective.add_to_diagonal(MATRIX_SHARE * self.temporal * scale);
            for (c, before) in objective.c.iter_mut().zip(&*x) {
                *c += self.temporal * scale * before;
            }
            objective.minimize(0.0, 1.0, x);
        })
    }
}
