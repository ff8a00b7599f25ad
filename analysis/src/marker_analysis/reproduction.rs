//! Where the contractions put the markers: p = p₀ + D x (Choe & Ko 2001, section 4.1.2).

use std::ops::Range;

use nalgebra::Vector3;

use super::marker_model::MarkerModel;
use crate::numeric::lanes::add_multiple;

/// Coordinates whose sums run side by side, in registers.
const BLOCK: usize = 8;

/// The markers as one x moves them, in model space, in buffers that are kept.
#[derive(Clone, Debug)]
pub(super) struct Reproduction {
    n_markers: usize,
    /// x y z of each marker after the other, centimeters, made whole blocks.
    coordinates: Vec<[f64; BLOCK]>,
    blocks: Vec<Block>,
    /// D by blocks of rows, and in a block by the muscles that move it.
    entries: Vec<[f64; BLOCK]>,
}

/// Some coordinates, and what moves them.
#[derive(Clone, Debug)]
struct Block {
    rest: [f64; BLOCK],
    muscles: Range<usize>,
    /// Where its first muscle stands in `entries`.
    start: usize,
}

impl Reproduction {
    /// Lays out the basis of `model`.
    pub fn new(model: &MarkerModel) -> Self {
        let n_coordinates = 3 * model.n_markers();
        let n_blocks = n_coordinates.div_ceil(BLOCK);
        let mut laid_out = Self {
            n_markers: model.n_markers(),
            coordinates: vec![[0.0; BLOCK]; n_blocks],
            blocks: Vec::with_capacity(n_blocks),
            entries: Vec::new(),
        };
        for first in (0..n_coordinates).step_by(BLOCK) {
            laid_out.add(model, first..n_coordinates.min(first + BLOCK));
        }
        laid_out
    }

    fn add(&mut self, model: &MarkerModel, rows: Range<usize>) {
        let moves = |muscle: &usize| {
            model.column(*muscle)[rows.clone()]
                .iter()
                .any(|it| *it != 0.0)
        };
        let mut moving = (0..model.n_muscles()).filter(moves);
        let start = moving.next().unwrap_or(0);
        let muscles = start
            ..moving
                .next_back()
                .map_or(start + 1, |it| it + 1)
                .min(model.n_muscles());
        let padded = |entry: &dyn Fn(usize) -> f64| {
            let mut block = [0.0; BLOCK];
            for (to, row) in block.iter_mut().zip(rows.clone()) {
                *to = entry(row);
            }
            block
        };
        self.blocks.push(Block {
            rest: padded(&|row| model.rest[row / 3][row % 3]),
            start: self.entries.len(),
            muscles: muscles.clone(),
        });
        self.entries
            .extend(muscles.map(|muscle| padded(&|row| model.column(muscle)[row])));
    }

    /// Takes over p = p₀ + D x at every marker.
    pub fn of(&mut self, x: &[f64]) {
        for (to, block) in self.coordinates.iter_mut().zip(&self.blocks) {
            let mut sums = block.rest;
            let entries = &self.entries[block.start..];
            for (entries, &x) in entries.iter().zip(&x[block.muscles.clone()]) {
                add_multiple(&mut sums, x, entries);
            }
            *to = sums;
        }
    }

    /// Every marker, centimeters.
    pub fn positions(&self) -> &[[f64; 3]] {
        let (positions, _) = self.coordinates.as_flattened().as_chunks();
        &positions[..self.n_markers]
    }

    /// One marker, centimeters.
    pub fn at(&self, marker: usize) -> Vector3<f64> {
        self.positions()[marker].into()
    }
}
