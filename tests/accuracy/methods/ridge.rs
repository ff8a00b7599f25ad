//! Least squares within [0, 1] and a penalty on Σ xᵢ², all muscles together.

use harness::accuracy::curves::Curves;

use super::quadratic::Quadratic;
use crate::stabilized::Stabilized;

/// The method with its constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    /// What is added to the diagonal of Q, as a share of its mean.
    pub strength: f64,
}

impl Ridge {
    pub fn solve(self, problem: &Stabilized) -> Curves {
        problem.each_frame(|d, x| {
            let mut objective = Quadratic::of_all(problem, d);
            objective.add_to_diagonal(self.strength * objective.mean_diagonal());
            objective.minimize(0.0, 1.0, x);
        })
    }
}
