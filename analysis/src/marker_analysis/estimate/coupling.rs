//! Muscles that belong together: mirror images that are drawn towards each other, pairs of which one at most is active.

use super::super::{marker_model::MarkerModel, objective::Objective};
use crate::{
    face::muscle::MuscleSet,
    numeric::box_qp::{BoxQp, BoxQpError, Report},
};

/// Standard deviation of the difference of two mirror images at half strength.
const USUAL_DIFFERENCE: f64 = 0.1;

/// At full strength it is not less.
const LEAST_DIFFERENCE: f64 = 0.005;

/// Pairs of muscles, in the solver's order.
#[derive(Clone, Debug)]
pub(super) struct Coupling {
    mirrored: Vec<[usize; 2]>,
    /// 1 / variance of the difference of mirror images.
    precision: f64,
    exclusive: Vec<[usize; 2]>,
    /// The solution without the second of a pair.
    other: Vec<f64>,
}

impl Coupling {
    pub fn new(
        model: &MarkerModel,
        muscles: &MuscleSet,
        mirrored: &[[usize; 2]],
        objective: &Objective,
        size: usize,
    ) -> Self {
        let place = |name: &str| {
            let index = muscles.index_of(name)?;
            model.muscles.iter().position(|it| *it == index)
        };
        let pair = |a: &str, b: &str| Some([place(a)?, place(b)?]);
        let is_symmetric = objective.symmetry > 0.0;
        let mirrored = mirrored.iter().copied();
        let exclusive = objective.exclusive_pairs.iter();
        let difference = (USUAL_DIFFERENCE * (1.0 - objective.symmetry) / objective.symmetry)
            .max(LEAST_DIFFERENCE);
        Self {
            mirrored: mirrored.filter(|_| is_symmetric).collect(),
            precision: 1.0 / (difference * difference),
            exclusive: exclusive.filter_map(|[a, b]| pair(a, b)).collect(),
            other: vec![0.0; size],
        }
    }

    /// Adds `variance / difference² · (x_left − x_right)²` to Q, whose columns are `stride` apart.
    pub fn add_to(&self, hessian: &mut [f64], stride: usize, variance: f64) {
        let k = variance * self.precision;
        for &[a, b] in &self.mirrored {
            hessian[a * stride + a] += k;
            hessian[b * stride + b] += k;
            hessian[a * stride + b] -= k;
            hessian[b * stride + a] -= k;
        }
    }

    /// Relaxes one muscle of each exclusive pair of which both are active in `solution`: the one that costs less.
    ///
    /// Pair after pair, in their order; what one pair relaxes may rouse another, so they are gone through until none is
    /// violated. Each time a muscle more is relaxed, so this ends. `boxes` has the muscles' bounds, which `qp` has on entry; on
    /// return it has what was relaxed fixed at 0.
    ///
    /// # Errors
    ///
    /// Those of [`BoxQp::solve`].
    pub fn separate(
        &mut self,
        qp: &mut BoxQp,
        linear: &[f64],
        solution: &mut [f64],
        mut report: Report,
        boxes: &[[f64; 2]],
    ) -> Result<Report, BoxQpError> {
        let is_violated = |it: &&[usize; 2], solution: &[f64]| {
            let is_open = |muscle: usize| boxes[muscle][0] < boxes[muscle][1];
            it.iter()
                .all(|&muscle| solution[muscle] > 0.0 && is_open(muscle))
        };
        while let Some(&[a, b]) = self.exclusive.iter().find(|it| is_violated(it, solution)) {
            self.other.copy_from_slice(solution);
            let without_b = relax(qp, linear, &mut self.other, b)?;
            qp.set_bounds(b, boxes[b][0], boxes[b][1]);
            report = relax(qp, linear, solution, a)?;
            if qp.objective(linear, &self.other) < qp.objective(linear, solution) {
                qp.set_bounds(a, boxes[a][0], boxes[a][1]);
                qp.set_bounds(b, 0.0, 0.0);
                solution.copy_from_slice(&self.other);
                report = without_b;
            }
        }
        Ok(report)
    }
}

/// Solves with one muscle at 0.
fn relax(
    qp: &mut BoxQp,
    linear: &[f64],
    solution: &mut [f64],
    muscle: usize,
) -> Result<Report, BoxQpError> {
    qp.set_bounds(muscle, 0.0, 0.0);
    qp.solve(linear, solution)
}
