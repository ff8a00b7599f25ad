//! Which markers and muscles take part in a frame, and the sums over them that stay the same while they do.
//!
//! Recomputed only when the set of visible markers changes, and then from the sums over all markers less what is hidden.

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

/// Sizes that the neutral face may seem to have, by expression, noise and what is hidden of it.
const FACE_SIZES: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// Markers that fill at least this share of the neutral volume at their own size have the shape of the face.
const LIKE_A_FACE: f64 = 0.3;

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
    /// Neutral markers about the mean of the used ones, one a marker.
    rest_arms: Vec<Vector3<f64>>,
    /// Determinant of the scatter of the used neutral markers; 0 where they are flat.
    rest_volume: f64,
    /// Their squared distances from their mean, summed.
    rest_spread: f64,
    mode: RegionMode,
    /// `Σ DⱼᵀDⱼ` over all markers.
    whole_gram: Vec<f64>,
}

impl Evidence {
    /// Evidence of no marker at all, with buffers for all of them.
    pub fn new(model: &MarkerModel, mode: RegionMode) -> Self {
        let (n, m) = (model.n_markers(), model.n_muscles());
        let mut gram = vec![0.0; m * m];
        for j in 0..n {
            model.change_gram(&mut gram, m, j, 1.0);
        }
        Self {
            mode,
            visible: vec![false; n],
            used: Vec::with_capacity(n),
            own_used: [0, 1].map(|_: usize| Vec::with_capacity(n)),
            regions: FaceRegion::ALL.map(|region| region_evidence(model, region, &vec![false; n])),
            parts: vec![Part::Held; m],
            gram: vec![0.0; m * m],
            displacement_sums: vec![Vector3::zeros(); m],
            rest_arms: vec![Vector3::zeros(); n],
            rest_volume: 0.0,
            rest_spread: 0.0,
            whole_gram: gram,
        }
    }

    /// Takes over which markers are visible; returns whether anything changed.
    pub fn show(&mut self, model: &MarkerModel, visible: &[bool]) -> bool {
        if self.visible == visible && !self.used.is_empty() {
            return false;
        }
        self.visible.copy_from_slice(visible);
        self.regions = FaceRegion::ALL.map(|region| region_evidence(model, region, visible));
        self.find_used(model);
        self.find_parts(model);
        self.find_sums(model);
        self.find_rest(model);
        true
    }

    /// The markers at `positions` beside the neutral face. Markers that are not used may stand anywhere.
    pub fn shape(&self, positions: &[Vector3<f64>]) -> Shape {
        let n = self.used.len().max(1) as f64;
        let origin = self
            .used
            .first()
            .map_or(Vector3::zeros(), |&j| positions[j]);
        let (mut sum, mut spread) = (Vector3::zeros(), 0.0);
        let mut covariance = Matrix3::zeros();
        for &j in &self.used {
            let position = positions[j] - origin;
            sum += position;
            spread += position.norm_squared();
            // The arms sum to 0: the mean of the positions needs not be taken out.
            covariance += self.rest_arms[j] * position.transpose();
        }
        Shape {
            volume: covariance.determinant(),
            rest_volume: self.rest_volume,
            size: ((spread - sum.norm_squared() / n) / self.rest_spread).sqrt(),
        }
    }

    /// Whether neither region can be solved.
    pub fn is_held(&self) -> bool {
        self.regions.iter().all(|it| it.held.is_some())
    }
}

/// What the markers of one frame show of the face, before its motion is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Determinant of the covariance with the neutral markers.
    volume: f64,
    /// The same of the neutral markers with themselves; 0 where they are flat.
    rest_volume: f64,
    /// Root of the ratio of the scatters.
    size: f64,
}

impl Shape {
    /// How many times larger than the neutral face the markers are, when that is no face's doing: the unit of the capture has
    /// changed.
    ///
    /// What has not the shape of the neutral face at any size says nothing about its size.
    pub fn scale_jump(&self) -> Option<f64> {
        let is_face = self.volume > LIKE_A_FACE * self.rest_volume * self.size.powi(3);
        let is_jump = is_face && self.rest_volume > 0.0 && !FACE_SIZES.contains(&self.size);
        is_jump.then_some(self.size)
    }

    /// Whether the markers lie on a point, a line or a plane, or are a mirror image: no proper pose then fits.
    ///
    /// The determinant of the covariance with the neutral markers is that of a rotation times the neutral volume;
    /// expressions change it by a fraction, flat and mirrored sets make it vanish or turn its sign.
    pub fn is_degenerate(&self) -> bool {
        let least = LEAST_VOLUME_SHARE * self.rest_volume;
        self.rest_volume <= 0.0 || self.volume.is_nan() || self.volume < least
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

impl Evidence {
    fn find_used(&mut self, model: &MarkerModel) {
        self.used.clear();
        for own in &mut self.own_used {
            own.clear();
        }
        for j in 0..model.n_markers() {
            let region = model.own_markers.iter().position(|it| it.contains(&j));
            if !self.visible[j] || region.is_some_and(|it| self.regions[it].held.is_some()) {
                continue;
            }
            self.used.push(j);
            if let Some(region) = region {
                self.own_used[region].push(j);
            }
        }
    }

    fn find_parts(&mut self, model: &MarkerModel) {
        for (index, region) in self.regions.iter().enumerate() {
            for i in model.own_muscles[index].clone() {
                self.parts[i] = if region.held.is_some() {
                    Part::Held
                } else if self.tells(model, i, |_| true) {
                    Part::Solved
                } else {
                    Part::Unobserved
                };
            }
        }
    }

    /// Whether the used markers that are `trusted` tell what a muscle does.
    pub fn tells(
        &self,
        model: &MarkerModel,
        muscle: usize,
        trusted: impl Fn(usize) -> bool,
    ) -> bool {
        let own = model.own_muscles.iter().position(|it| it.contains(&muscle));
        // Regions apart, a muscle is observed by its own region only.
        let counts = |j: &usize| {
            self.mode == RegionMode::Joint
                || own.is_some_and(|it| model.own_markers[it].contains(j))
        };
        let energy = |j: usize| model.displacement(muscle, j).norm_squared();
        let used = self.used.iter().copied().filter(|&j| trusted(j));
        let seen: f64 = used.filter(counts).map(energy).sum();
        let all: f64 = (0..model.n_markers()).filter(counts).map(energy).sum();
        seen > LEAST_ENERGY_SHARE * all
    }

    /// The sums over the used markers: those over all of them less what is hidden, unless most is.
    fn find_sums(&mut self, model: &MarkerModel) {
        let m = model.n_muscles();
        let n_hidden = model.n_markers() - self.used.len();
        if n_hidden <= self.used.len() {
            self.gram.copy_from_slice(&self.whole_gram);
            let mut used = self.used.iter().peekable();
            for j in 0..model.n_markers() {
                if used.next_if(|it| **it == j).is_none() {
                    model.change_gram(&mut self.gram, m, j, -1.0);
                }
            }
        } else {
            self.gram.fill(0.0);
            for &j in &self.used {
                model.change_gram(&mut self.gram, m, j, 1.0);
            }
        }
        for (i, sum) in self.displacement_sums.iter_mut().enumerate() {
            *sum = self.used.iter().map(|&j| model.displacement(i, j)).sum();
        }
    }

    fn find_rest(&mut self, model: &MarkerModel) {
        let (mean, volume) = rest_volume(model, &self.used);
        self.rest_spread = 0.0;
        for &j in &self.used {
            self.rest_arms[j] = model.rest[j] - mean;
            self.rest_spread += self.rest_arms[j].norm_squared();
        }
        self.rest_volume = volume;
    }
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
