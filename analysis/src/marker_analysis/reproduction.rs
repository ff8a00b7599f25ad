//! Where the contractions put the markers: p = p₀ + D x (Choe & Ko 2001, section 4.1.2).

use nalgebra::Vector3;

use super::marker_model::MarkerModel;
use crate::numeric::lanes::add_multiple_of;

/// The markers as one x moves them, in model space, in buffers that are kept.
#[derive(Clone, Debug)]
pub(super) struct Reproduction {
    /// Centimeters, one a marker.
    positions: Vec<[f64; 3]>,
    /// The muscles that are not at rest, in front.
    active: Vec<usize>,
}

impl Reproduction {
    /// Buffers for the markers and muscles of `model`.
    pub fn new(model: &MarkerModel) -> Self {
        Self {
            positions: vec![[0.0; 3]; model.n_markers()],
            active: vec![0; model.n_muscles()],
        }
    }

    /// Takes over p = p₀ + D x at every marker.
    pub fn of(&mut self, model: &MarkerModel, x: &[f64]) {
        for (to, rest) in self.positions.iter_mut().zip(&model.rest) {
            *to = (*rest).into();
        }
        // Listed without a branch a muscle: which of them are at rest changes with every frame.
        let mut n_active = 0;
        for (muscle, &x) in x.iter().enumerate() {
            self.active[n_active] = muscle;
            n_active += usize::from(x != 0.0);
        }
        let coordinates = self.positions.as_flattened_mut();
        for &muscle in &self.active[..n_active] {
            let support = model.support[muscle].clone();
            let column = &model.column(muscle)[support.clone()];
            add_multiple_of(&mut coordinates[support], x[muscle], column);
        }
    }

    /// Every marker, centimeters.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// One marker, centimeters.
    pub fn at(&self, marker: usize) -> Vector3<f64> {
        self.positions[marker].into()
    }
}
