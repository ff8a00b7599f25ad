//! What can be said of a basis without a performance: how well its markers tell its muscles apart.
//!
//! The solver inverts Q = Dᵀ D (Choe & Ko 2001, eq. 3), so Q's condition number bounds how much marker noise grows;
//! two muscles whose marker displacements point the same way trade contractions against each other.

use nalgebra::{DMatrix, SymmetricEigen};

use super::MarkerBasis;
use crate::face::{
    marker::Marker,
    muscle::{Muscle, MuscleSet},
    region::FaceRegion,
};

/// Largest ratio of singular values of the markers' basis, its columns scaled to unit length, that counts as full rank.
///
/// Real actors measure 6.0 (16 muscles, 27 markers), 66 (30 shapes, 27 markers) and 40 (30 shapes, 60 markers).
/// A scaled copy of a real shape, rounded to five decimals of a centimeter, measures 1.4e4 (7 % of it) to 7.5e4 (half of
/// it). The limit is the geometric middle of 66 and 1.4e4.
const MAX_SCALED_CONDITION: f64 = 1e3;

/// A muscle that moves no marker by more than a micrometer is not observed by any capture system.
const LEAST_DISPLACEMENT_CM: f64 = 1e-4;

/// Pairs whose displacements correlate less than this are told apart easily.
const LEAST_CORRELATION: f64 = 0.5;

/// The report names the worst pairs only, so that 256 like muscles do not make 32,640 entries.
const MAX_AMBIGUOUS_PAIRS: usize = 256;

/// Rounds of the eigenvalue iteration; a symmetric matrix needs about two an eigenvalue.
const MAX_EIGEN_ROUNDS: usize = 100_000;

/// Condition numbers and look-alikes of a basis at its markers.
#[derive(Clone, Debug, PartialEq)]
pub struct BasisReport {
    /// Condition number of Q over the upper region's muscles and its own markers that are not head-fixed.
    ///
    /// 1 without muscles, infinite when the markers cannot tell them apart at all.
    pub condition_upper: f64,
    /// The same for the lower region.
    pub condition_lower: f64,
    /// Pairs of muscles that the markers hardly tell apart, the worst first.
    pub ambiguous: Vec<AmbiguousPair>,
}

/// Two muscles that move the markers alike, or oppositely.
#[derive(Clone, Debug, PartialEq)]
pub struct AmbiguousPair {
    /// The first muscle's index.
    pub first: usize,
    /// The second muscle's index; larger than the first.
    pub second: usize,
    /// Cosine between their displacements of all markers, −1..1; at least 0.5 in size.
    pub correlation: f64,
}

impl BasisReport {
    /// Judges a basis at `markers`.
    pub(crate) fn of(basis: &MarkerBasis, markers: &[Marker], muscles: &MuscleSet) -> Self {
        let condition = |region| region_condition(basis, markers, muscles.muscles(), region);
        Self {
            condition_upper: condition(FaceRegion::Upper),
            condition_lower: condition(FaceRegion::Lower),
            ambiguous: ambiguous_pairs(basis),
        }
    }
}

/// Columns of D that depend on each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RankDeficiency {
    /// The muscles concerned, ascending.
    pub(crate) columns: Vec<usize>,
    /// Ratio of the singular values of D with columns of unit length; infinite when one is 0.
    pub(crate) condition: f64,
}

/// The columns that make D rank-deficient, if it is.
pub(crate) fn rank_deficiency(basis: &MarkerBasis) -> Option<RankDeficiency> {
    let q = gram(basis, 0..basis.n_markers(), &all_muscles(basis));
    let still = unmoved(basis);
    let moved: Vec<_> = all_muscles(basis)
        .into_iter()
        .filter(|muscle| !still.contains(muscle))
        .collect();
    let mut columns = still;
    let spectrum = Spectrum::of(scaled_to_unit_diagonal(&q, &moved));
    let condition = match &spectrum {
        Some(spectrum) if columns.is_empty() => spectrum.condition().sqrt(),
        _ => f64::INFINITY,
    };
    match spectrum {
        Some(spectrum) => {
            columns.extend(spectrum.dependent().into_iter().map(|place| moved[place]));
        }
        None => columns.extend(moved),
    }
    columns.sort_unstable();
    (!columns.is_empty()).then_some(RankDeficiency { columns, condition })
}

fn all_muscles(basis: &MarkerBasis) -> Vec<usize> {
    (0..basis.n_muscles()).collect()
}

/// Muscles that move no marker.
fn unmoved(basis: &MarkerBasis) -> Vec<usize> {
    let moves = |muscle: usize| {
        (0..basis.n_markers())
            .any(|marker| basis.of_marker_cm(marker)[muscle].norm() > LEAST_DISPLACEMENT_CM)
    };
    all_muscles(basis)
        .into_iter()
        .filter(|&muscle| !moves(muscle))
        .collect()
}

fn region_condition(
    basis: &MarkerBasis,
    markers: &[Marker],
    muscles: &[Muscle],
    region: FaceRegion,
) -> f64 {
    let own_markers = (0..markers.len())
        .filter(|&marker| markers[marker].region == region && !markers[marker].head_fixed);
    let own_muscles: Vec<_> = (0..muscles.len())
        .filter(|&muscle| muscles[muscle].region == region)
        .collect();
    if own_muscles.is_empty() {
        return 1.0;
    }
    Spectrum::of(gram(basis, own_markers, &own_muscles))
        .map_or(f64::INFINITY, |spectrum| spectrum.condition())
}

fn ambiguous_pairs(basis: &MarkerBasis) -> Vec<AmbiguousPair> {
    let q = gram(basis, 0..basis.n_markers(), &all_muscles(basis));
    let cosines = scaled_to_unit_diagonal(&q, &all_muscles(basis));
    let mut pairs: Vec<_> = (0..basis.n_muscles())
        .flat_map(|first| (first + 1..basis.n_muscles()).map(move |second| (first, second)))
        .map(|(first, second)| AmbiguousPair {
            first,
            second,
            correlation: cosines[(first, second)].clamp(-1.0, 1.0),
        })
        .filter(|pair| pair.correlation.abs() >= LEAST_CORRELATION)
        .collect();
    pairs.sort_by(|a, b| b.correlation.abs().total_cmp(&a.correlation.abs()));
    pairs.truncate(MAX_AMBIGUOUS_PAIRS);
    pairs
}

/// Q = Dᵀ D over some markers and some muscles.
fn gram(
    basis: &MarkerBasis,
    markers: impl Iterator<Item = usize>,
    muscles: &[usize],
) -> DMatrix<f64> {
    let mut q = DMatrix::zeros(muscles.len(), muscles.len());
    for marker in markers {
        let d = basis.of_marker_cm(marker);
        for (row, &first) in muscles.iter().enumerate() {
            for (column, &second) in muscles.iter().enumerate().skip(row) {
                q[(row, column)] += d[first].dot(&d[second]);
            }
        }
    }
    q.fill_lower_triangle_with_upper_triangle();
    q
}

/// Q of columns scaled to unit length: the cosines between them. Columns of length 0 stay 0.
fn scaled_to_unit_diagonal(q: &DMatrix<f64>, muscles: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(muscles.len(), muscles.len(), |row, column| {
        let (row, column) = (muscles[row], muscles[column]);
        let lengths = q[(row, row)].sqrt() * q[(column, column)].sqrt();
        if lengths > 0.0 {
            q[(row, column)] / lengths
        } else {
            0.0
        }
    })
}

/// Eigenvalues and eigenvectors of a Q.
struct Spectrum(SymmetricEigen<f64, nalgebra::Dyn>);

impl Spectrum {
    /// `None` when the iteration does not end; an empty or non-finite matrix never enters it.
    fn of(q: DMatrix<f64>) -> Option<Self> {
        if q.is_empty() || q.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        SymmetricEigen::try_new(q, f64::EPSILON, MAX_EIGEN_ROUNDS).map(Self)
    }

    fn largest(&self) -> f64 {
        self.0.eigenvalues.max()
    }

    /// λmax / λmin; infinite when λmin is not above the rounding of λmax.
    fn condition(&self) -> f64 {
        let least = self.0.eigenvalues.min();
        let rounding = f64::EPSILON * self.largest() * self.0.eigenvalues.len() as f64;
        if least > rounding {
            self.largest() / least
        } else {
            f64::INFINITY
        }
    }

    /// Columns with a large part in a combination that comes to nothing.
    fn dependent(&self) -> Vec<usize> {
        // A member of a dependent group has a share comparable to the group's largest; numerical dust is far below.
        const LEAST_SHARE: f64 = 0.01;
        let vanishing = self.largest() / (MAX_SCALED_CONDITION * MAX_SCALED_CONDITION);
        let mut columns: Vec<usize> = (0..self.0.eigenvalues.len())
            .filter(|&it| self.0.eigenvalues[it] <= vanishing)
            .flat_map(|it| {
                let vector = self.0.eigenvectors.column(it);
                let least = LEAST_SHARE * vector.amax();
                (0..vector.len()).filter(move |&place| vector[place].abs() >= least)
            })
            .collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}
