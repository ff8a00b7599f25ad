//! Which markers and muscles take part in a frame, and the sums over them that stay the same while they do.
//!
//! Recomputed only when the set of visible markers changes.

use nalgebra::{Matrix3, Vector3};

use super::{marker_model::MarkerModel, settings::RegionMode};
use crate::{curve::HeldReason, face::region::FaceRegion};

/// A region with a smaller share of its own markers is held (CONTRACTS D-27).
const LEAST_SHARE: f64 = 0.6;

/// A region with fewer of its own markers is held (CONTRACTS D-27).
const LEAST_MARKERS: usize = 3;

/// A muscle with a smaller share of its displacement energy at visible markers cannot be told.
const LEAST_ENERGY_SHARE: f64 = 0.15;

/// Markers whose spread across their flattest direction is less than this do not determine a pose, centimeters.
const LEAST_SPREAD_CM: f64 = 0.05;

/// The pose of a frame whose markers fill less than this share of the neutral volume is not determined.
const LEAST_VOLUME_SHARE: f64 = 0.05;

/// What a muscle does in this frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Solved for.
    Solved,
    /// Its markers are hidden: decays.
    Unobserved,
    /// Its region is held: stands still.
    Held,
}

/// One region's markers in this frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RegionEvidence {
    pub visible: usize,
    pub expected: usize,
    pub held: Option<HeldReason>,
}

#[derive(Clone, Debug)]
pub(super) struct Evidence {
    /// The visibility that all this belongs to, in the solver's marker order.
    pub visible: Vec<bool>,
    /// Markers used: visible and not of a held region.
    pub used: Vec<usize>,
    /// Those of them that are a region's own.
    pub own_used: [Vec<usize>; 2],
    pub regions: [RegionEvidence; 2],
    pub parts: Vec<Part>,
    /// `Σ DⱼᵀDⱼ` over the used markers, m × m.
    pub gram: Vec<f64>,
    /// Σ dᵢⱼ over the used markers, one a muscle.
    pub displacement_sums: Vec<Vector3<f64>>,
    /// Neutral markers about the mean of the used ones, one a marker; 0 for those not used.
    rest_arms: Vec<Vector3<f64>>,
    /// Determinant of the scatter of the used neutral markers; 0 where they are flat.
    rest_volume: f64,
}

impl Evidence {
    pub fn new(model: &MarkerModel, mode: RegionMode, visible: &[bool]) -> Self {
        let regions = FaceRegion::ALL.map(|region| region_evidence(model, region, visible));
        let used = used_markers(model, &regions, visible);
        let own_used = [0, 1].map(|index: usize| {
            let own = &model.own_markers[index];
            used.iter().copied().filter(|it| own.contains(it)).collect()
        });
        let (rest_mean, rest_volume) = rest_volume(model, &used);
        Self {
            parts: parts(model, mode, &regions, &used),
            gram: gram(model, &used),
            displacement_sums: (0..model.n_muscles())
                .map(|i| used.iter().map(|&j| model.displacement(i, j)).sum())
                .collect(),
            rest_arms: rest_arms(model, &used, &rest_mean),
            visible: visible.to_vec(),
            used,
            own_used,
            regions,
            rest_volume,
        }
    }

    /// Whether neither region can be solved.
    pub fn is_held(&self) -> bool {
        self.regions.iter().all(|it| it.held.is_some())
    }

    /// Whether markers at `positions` lie on a point, a line or a plane, or are a mirror image: no proper pose then fits.
    ///
    /// The determinant of the covariance with the neutral markers is that of a rotation times the neutral volume;
    /// expressions change it by a fraction, flat and mirrored sets make it vanish or turn its sign.
    pub fn is_degenerate(&self, positions: &[Vector3<f64>]) -> bool {
        let mut covariance = Matrix3::zeros();
        for (arm, position) in self.rest_arms.iter().zip(positions) {
            covariance += arm * position.transpose();
        }
        let volume = covariance.determinant();
        self.rest_volume <= 0.0 || volume.is_nan() || volume < LEAST_VOLUME_SHARE * self.rest_volume
    }
}

fn region_evidence(model: &MarkerModel, region: FaceRegion, visible: &[bool]) -> RegionEvidence {
    let index = region.index();
    let expected = model.expected[index];
    let own = model.own_markers[index].clone();
    let seen = own.filter(|&j| visible[j]).count();
    let too_few = seen < LEAST_MARKERS || (seen as f64) < LEAST_SHARE * expected as f64;
    let has_muscles = !model.own_muscles[index].is_empty();
    RegionEvidence {
        visible: seen,
        expected,
        held: (too_few && has_muscles).then_some(HeldReason::TooFewMarkers),
    }
}

fn used_markers(
    model: &MarkerModel,
    regions: &[RegionEvidence; 2],
    visible: &[bool],
) -> Vec<usize> {
    let of_held = |j: &usize| {
        (0..2).any(|it| regions[it].held.is_some() && model.own_markers[it].contains(j))
    };
    (0..model.n_markers())
        .filter(|j| visible[*j] && !of_held(j))
        .collect()
}

fn parts(
    model: &MarkerModel,
    mode: RegionMode,
    regions: &[RegionEvidence; 2],
    used: &[usize],
) -> Vec<Part> {
    let mut parts = vec![Part::Solved; model.n_muscles()];
    for (index, region) in regions.iter().enumerate() {
        for i in model.own_muscles[index].clone() {
            // Regions apart, a muscle is observed by its own region only.
            let counts =
                |j: usize| mode == RegionMode::Joint || model.own_markers[index].contains(&j);
            let energy = |markers: &mut dyn Iterator<Item = usize>| -> f64 {
                markers
                    .filter(|&j| counts(j))
                    .map(|j| model.displacement(i, j).norm_squared())
                    .sum()
            };
            let seen = energy(&mut used.iter().copied());
            let all = energy(&mut (0..model.n_markers()));
            parts[i] = if region.held.is_some() {
                Part::Held
            } else if seen <= LEAST_ENERGY_SHARE * all {
                Part::Unobserved
            } else {
                Part::Solved
            };
        }
    }
    parts
}

/// `Σ DⱼᵀDⱼ` over `used`, m × m, columns m apart.
pub(super) fn gram(model: &MarkerModel, used: &[usize]) -> Vec<f64> {
    let m = model.n_muscles();
    let mut gram = vec![0.0; m * m];
    for &j in used {
        for axis in 0..3 {
            let row = model.row(j, axis);
            for (i, &d) in row.iter().enumerate() {
                if d != 0.0 {
                    let column = &mut gram[i * m..(i + 1) * m];
                    for (q, other) in column.iter_mut().zip(row) {
                        *q += d * other;
                    }
                }
            }
        }
    }
    gram
}

fn rest_arms(model: &MarkerModel, used: &[usize], mean: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let mut arms = vec![Vector3::zeros(); model.n_markers()];
    for &j in used {
        arms[j] = model.rest[j] - mean;
    }
    arms
}

fn rest_volume(model: &MarkerModel, used: &[usize]) -> (Vector3<f64>, f64) {
    let n = used.len().max(1) as f64;
    let mean: Vector3<f64> = used.iter().map(|&j| model.rest[j]).sum::<Vector3<f64>>() / n;
    let mut scatter = Matrix3::zeros();
    for &j in used {
        let d = model.rest[j] - mean;
        scatter += d * d.transpose();
    }
    let smallest = scatter.symmetric_eigenvalues().min();
    let flat = smallest < n * LEAST_SPREAD_CM * LEAST_SPREAD_CM;
    (mean, if flat { 0.0 } else { scatter.determinant() })
}
