//! Contractions of a face whose head does not move, or whose motion has been taken out.
//!
//! Minimizes ½ xᵀQx − xᵀc with `Q = DᵀD` and `c = Dᵀd` (Choe & Ko 2001, eq. 3): all muscles at once, or each region apart with
//! its own markers, as in the paper.

use std::ops::Range;

use nalgebra::Vector3;

use super::{
    evidence::{Evidence, Part},
    head_motion::RIDGE,
    marker_model::MarkerModel,
    settings::RegionMode,
};
use crate::numeric::{box_qp::BoxQp, dot::dot};

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
    /// d by rows: 0 where a marker is not used.
    displacements: Vec<f64>,
    /// Where x started: a block that fails stands still.
    before: Vec<f64>,
    /// `Σ DⱼᵀDⱼ` over one region's own markers.
    own_gram: Vec<f64>,
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
            displacements: vec![0.0; 3 * model.n_markers()],
            before: vec![0.0; model.n_muscles()],
            own_gram: vec![0.0; model.n_muscles() * model.n_muscles()],
        }
    }

    /// Takes over Q of the markers that are used, and gives every muscle its box.
    pub fn set_evidence(&mut self, model: &MarkerModel, evidence: &Evidence, boxes: &[[f64; 2]]) {
        for block in &mut self.blocks {
            match block.region {
                None => block.set_hessian(&evidence.gram, model.n_muscles()),
                Some(index) => {
                    self.own_gram.fill(0.0);
                    for &j in &evidence.own_used[index] {
                        model.change_gram(&mut self.own_gram, model.n_muscles(), j, 1.0);
                    }
                    block.set_hessian(&self.own_gram, model.n_muscles());
                }
            }
            for (i, [lower, upper]) in boxes[block.muscles.clone()].iter().enumerate() {
                block.qp.set_bounds(i, *lower, *upper);
            }
        }
        self.displacements.fill(0.0);
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
        for &j in &evidence.used {
            let displacement = positions[j] - model.rest[j];
            self.displacements[3 * j..3 * j + 3].copy_from_slice(displacement.as_slice());
        }
        for block in &mut self.blocks {
            let held = |index: usize| evidence.regions[index].held.is_some();
            if block.region.is_some_and(held) {
                continue;
            }
            let muscles = block.muscles.clone();
            let linear = &mut self.linear[muscles.clone()];
            correlate(model, block, &self.displacements, linear);
            let x = &mut x[muscles.clone()];
            fix(&mut block.qp, &evidence.parts[muscles.clone()], x);
            if let Ok(report) = block.qp.solve(linear, x) {
                kkt_residual = kkt_residual.max(report.kkt_residual);
            } else {
                x.copy_from_slice(&self.before[muscles]);
                failed(block.region);
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
}

/// `c = Dᵀd` over the block's markers for the block's muscles.
fn correlate(model: &MarkerModel, block: &Block, displacements: &[f64], linear: &mut [f64]) {
    let own = block.region.map_or(0..model.n_markers(), |index| {
        model.own_markers[index].clone()
    });
    for (c, muscle) in linear.iter_mut().zip(block.muscles.clone()) {
        let support = &model.support[muscle];
        let rows = support.start.max(3 * own.start)..support.end.min(3 * own.end);
        *c = if rows.is_empty() {
            0.0
        } else {
            dot(&model.column(muscle)[rows.clone()], &displacements[rows])
        };
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
