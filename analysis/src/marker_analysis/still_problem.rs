//! Contractions of a face whose head does not move, or whose motion has been taken out.
//!
//! Minimizes ½ xᵀQx − xᵀc with `Q = DᵀD` and `c = Dᵀd` (Choe & Ko 2001, eq. 3): all muscles at once, or each region apart with
//! its own markers, as in the paper.

use std::ops::Range;

use nalgebra::Vector3;

use super::{
    evidence::{Evidence, Part, gram},
    head_motion::RIDGE,
    marker_model::MarkerModel,
    settings::RegionMode,
};
use crate::numeric::box_qp::{BoxQp, BoxQpError};

/// Muscles that are solved together from the markers that observe them.
#[derive(Clone, Debug)]
struct Block {
    qp: BoxQp,
    muscles: Range<usize>,
    /// The region whose own markers are used; `None`: all.
    region: Option<usize>,
}

/// One block, or one a region.
#[derive(Clone, Debug)]
pub(super) struct StillProblem {
    blocks: Vec<Block>,
    linear: Vec<f64>,
    /// Where x started: a block that fails stands still.
    before: Vec<f64>,
}

impl StillProblem {
    pub fn new(model: &MarkerModel, mode: RegionMode) -> Self {
        let block = |muscles: Range<usize>, region| Block {
            qp: BoxQp::new(muscles.len()),
            muscles,
            region,
        };
        let blocks = match mode {
            RegionMode::Joint => vec![block(0..model.n_muscles(), None)],
            RegionMode::Split => (0..2)
                .map(|index| block(model.own_muscles[index].clone(), Some(index)))
                .collect(),
        };
        Self {
            blocks,
            linear: vec![0.0; model.n_muscles()],
            before: vec![0.0; model.n_muscles()],
        }
    }

    /// Takes over Q of the markers that are used, and gives every muscle its box.
    pub fn set_evidence(&mut self, model: &MarkerModel, evidence: &Evidence, upper: f64) {
        for block in &mut self.blocks {
            match block.region {
                None => block.set_hessian(&evidence.gram, model.n_muscles()),
                Some(index) => {
                    let own = gram(model, &evidence.own_used[index]);
                    block.set_hessian(&own, model.n_muscles());
                }
            }
            for i in 0..block.qp.len() {
                block.qp.set_bounds(i, 0.0, upper);
            }
        }
    }

    /// Solves for `x`, warm, from the markers at `positions`.
    ///
    /// Returns the largest KKT residual, and for each block that failed its region (`None`: the whole face).
    pub fn solve(
        &mut self,
        model: &MarkerModel,
        evidence: &Evidence,
        positions: &[Vector3<f64>],
        x: &mut [f64],
        mut failed: impl FnMut(Option<usize>),
    ) -> f64 {
        let mut kkt_residual = 0.0_f64;
        self.before.copy_from_slice(x);
        for block in &mut self.blocks {
            let held = |index: usize| evidence.regions[index].held.is_some();
            if block.region.is_some_and(held) {
                continue;
            }
            match block.solve(model, evidence, positions, &mut self.linear, x) {
                Ok(residual) => kkt_residual = kkt_residual.max(residual),
                Err(_) => {
                    let muscles = block.muscles.clone();
                    x[muscles.clone()].copy_from_slice(&self.before[muscles]);
                    failed(block.region);
                }
            }
        }
        kkt_residual
    }
}

impl Block {
    /// Takes the block's part of `gram`, whose columns are m apart.
    fn set_hessian(&mut self, gram: &[f64], m: usize) {
        let (size, stride) = (self.muscles.len(), self.qp.stride());
        let muscles = self.muscles.clone();
        self.qp.set_hessian(|q| {
            for (i, muscle) in muscles.clone().enumerate() {
                let column = &gram[muscle * m..(muscle + 1) * m];
                q[i * stride..i * stride + size].copy_from_slice(&column[muscles.clone()]);
                q[i * stride + i] += RIDGE;
            }
        });
    }

    fn solve(
        &mut self,
        model: &MarkerModel,
        evidence: &Evidence,
        positions: &[Vector3<f64>],
        linear: &mut [f64],
        x: &mut [f64],
    ) -> Result<f64, BoxQpError> {
        let linear = &mut linear[self.muscles.clone()];
        let x = &mut x[self.muscles.clone()];
        let used = self
            .region
            .map_or(&evidence.used, |index| &evidence.own_used[index]);
        correlate(model, used, positions, self.muscles.clone(), linear);
        fix(&mut self.qp, &evidence.parts[self.muscles.clone()], x);
        Ok(self.qp.solve(linear, x)?.kkt_residual)
    }
}

/// `c = Dᵀd` over some markers for a range of muscles.
fn correlate(
    model: &MarkerModel,
    used: &[usize],
    positions: &[Vector3<f64>],
    muscles: Range<usize>,
    linear: &mut [f64],
) {
    linear.fill(0.0);
    for &j in used {
        let displacement = positions[j] - model.rest[j];
        let rows = [0, 1, 2].map(|axis| &model.row(j, axis)[muscles.clone()]);
        let columns = rows[0].iter().zip(rows[1]).zip(rows[2]);
        for (c, ((x, y), z)) in linear.iter_mut().zip(columns) {
            *c += x * displacement.x + y * displacement.y + z * displacement.z;
        }
    }
}

/// Fixes the muscles that are not solved for where they stand.
pub(super) fn fix(qp: &mut BoxQp, parts: &[Part], x: &[f64]) {
    for (i, (part, &x)) in parts.iter().zip(x).enumerate() {
        if *part != Part::Solved {
            qp.set_bounds(i, x, x);
        }
    }
}
