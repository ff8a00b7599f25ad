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
use crate::numeric::{
    box_qp::BoxQp,
    projection::Projection,
    standing_qp::StandingQp,
    tape::{Tape, TapeError},
};

/// Muscles that are solved together from the markers that observe them.
#[derive(Clone, Debug)]
struct Block {
    qp: StandingQp,
    muscles: Range<usize>,
    /// The region whose own markers are used; `None`: all.
    region: Option<usize>,
    /// D of the muscles, at the coordinates of the markers that are used.
    projection: Projection,
    coordinates: Range<usize>,
}

/// One block, or one a region.
#[derive(Clone, Debug)]
pub(super) struct StillProblem {
    blocks: Vec<Block>,
    /// d by rows: 0 where a marker is not used.
    displacements: Vec<f64>,
    /// Where x started: a block that fails stands still.
    before: Vec<f64>,
    /// `Σ DⱼᵀDⱼ` over one region's own markers.
    own_gram: Vec<f64>,
}

impl StillProblem {
    pub fn new(model: &MarkerModel, mode: RegionMode) -> Self {
        let block = |muscles, region| Block::new(model, muscles, region);
        let blocks = match mode {
            RegionMode::Joint => vec![block(0..model.n_muscles(), None)],
            RegionMode::Split => (0..2)
                .map(|index| block(model.own_muscles[index].clone(), Some(index)))
                .collect(),
        };
        Self {
            blocks,
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

    /// Names what a frame finds of those before it; the evidence is set before it is read.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        for block in &mut self.blocks {
            let part = match block.region {
                None => "whole",
                Some(0) => "upper",
                Some(_) => "lower",
            };
            tape.within(part, |tape| block.qp.lasts(tape))?;
        }
        Ok(())
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
        let (displacements, _) = self.displacements.as_chunks_mut::<3>();
        for &j in &evidence.used {
            displacements[j] = (positions[j] - model.rest[j]).into();
        }
        let solved = |it: &&mut Block| !it.is_held(evidence);
        for block in self.blocks.iter_mut().filter(solved) {
            block.start(&self.displacements, evidence, x);
        }
        // By turns: while one block waits for its division, the other goes on.
        let mut goes_on = true;
        while goes_on {
            goes_on = false;
            for block in self.blocks.iter_mut().filter(solved) {
                goes_on |= block.qp.advance();
            }
        }
        for block in self.blocks.iter_mut().filter(solved) {
            let x = &mut x[block.muscles.clone()];
            if let Ok(report) = block.qp.finish(x) {
                kkt_residual = kkt_residual.max(report.kkt_residual);
            } else {
                x.copy_from_slice(&self.before[block.muscles.clone()]);
                failed(block.region);
            }
        }
        kkt_residual
    }
}

impl Block {
    fn new(model: &MarkerModel, muscles: Range<usize>, region: Option<usize>) -> Self {
        let markers = region.map_or(0..model.n_markers(), |it| model.own_markers[it].clone());
        let coordinates = 3 * markers.start..3 * markers.end;
        let columns = muscles
            .clone()
            .map(|it| &model.column(it)[coordinates.clone()]);
        Self {
            qp: StandingQp::new(muscles.len()),
            projection: Projection::new(columns),
            muscles,
            region,
            coordinates,
        }
    }

    /// Whether the block's region stands still in this frame.
    fn is_held(&self, evidence: &Evidence) -> bool {
        let region = self.region.map(|it| &evidence.regions[it]);
        region.is_some_and(|it| it.held.is_some())
    }

    /// Forms `c = Dᵀd` and starts.
    fn start(&mut self, displacements: &[f64], evidence: &Evidence, x: &[f64]) {
        let displacements = &displacements[self.coordinates.clone()];
        self.projection.apply(displacements, self.qp.c_mut());
        for (i, muscle) in self.muscles.clone().enumerate() {
            if evidence.parts[muscle] != Part::Solved {
                self.qp.set_bounds(i, x[muscle], x[muscle]);
            }
        }
        self.qp.start();
    }

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

/// Fixes the muscles that are not solved for where they stand.
pub(super) fn fix(qp: &mut BoxQp, parts: &[Part], x: &[f64]) {
    for (i, (part, &x)) in parts.iter().zip(x).enumerate() {
        if *part != Part::Solved {
            qp.set_bounds(i, x, x);
        }
    }
}
