//! Whether the face that was taken as neutral was, and the quietest frames seen so far as a better one.
//!
//! A neutral face fits the artist's virtual markers by a similarity alone; a contraction leaves a residual that no
//! similarity explains. The frames with the least of it are the quietest.

use nalgebra::Vector3;

use super::{head_motion::RIDGE, neutral::Neutral, positions_on_tape};
use crate::{
    face::{actor::Actor, basis::MarkerBasis},
    numeric::box_qp::BoxQp,
    numeric::similarity_fit::{Scale, fit},
    numeric::tape::{Tape, TapeError},
    space::PerformancePoint,
};

/// A frame that shows a smaller share of the markers is not looked at.
const LEAST_VISIBLE_SHARE: f64 = 0.9;

/// What quieter frames must fit better by, root mean square centimeters a marker: three tenths of a smile.
const QUIETER_CM: f64 = 0.05;

/// And by how much more than the noise's own scatter, in standard deviations of a coordinate.
const QUIETER_SIGMAS: f64 = 2.0;

/// Contractions that explain a larger share of the squares that the similarity leaves are no accident of hand-marking.
const EXPLAINED_SHARE: f64 = 0.5;

/// And one of them must be at least this.
const CONTRACTED: f64 = 0.15;

/// One captured instant, one entry a marker of the actor.
type Positions = [Option<PerformancePoint>];

/// What the neutral frames themselves say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeutralEvidence {
    /// Root mean square of what the similarity leaves of each of them, centimeters.
    pub residual_cm: f64,
    /// That they are not neutral, where contractions explain it.
    pub contracted: Option<NeutralDoubt>,
}

impl NeutralEvidence {
    /// Of the frames that an alignment was found from, and their mean.
    pub(crate) fn of(actor: &Actor, frames: &[&Positions], mean: &Neutral) -> Self {
        let places = actor.virtual_markers().iter();
        let places: Vec<_> = places
            .map(|it| it.position(actor.mesh()).0.coords)
            .collect();
        let residuals: Vec<_> = frames
            .iter()
            .filter_map(|it| residual_cm(it, &places))
            .collect();
        let squares: f64 = residuals.iter().map(|it| it * it).sum();
        Self {
            residual_cm: (squares / residuals.len().max(1) as f64).sqrt(),
            contracted: looks_contracted(actor, &mean.positions, &places),
        }
    }
}

/// The quietest frames since the alignment.
#[derive(Clone, Debug)]
pub(super) struct NeutralWatch {
    capacity: usize,
    /// Residual and positions of the quietest frames, unordered.
    quietest: Vec<(f64, Vec<Option<PerformancePoint>>)>,
}

impl NeutralWatch {
    /// Keeps the `capacity` quietest frames.
    pub fn new(capacity: usize) -> Self {
        Self {
            capacity,
            quietest: Vec::with_capacity(capacity),
        }
    }

    /// Looks at one frame; `virtual_markers` is the actor's neutral face as the artist marked it.
    pub fn look(&mut self, positions: &Positions, virtual_markers: &[Vector3<f64>]) {
        let Some(residual_cm) = residual_cm(positions, virtual_markers) else {
            return;
        };
        if self.quietest.len() < self.capacity {
            self.quietest.push((residual_cm, positions.to_vec()));
            return;
        }
        let loudest = self
            .quietest
            .iter_mut()
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|it| residual_cm < it.0);
        if let Some((loudest_cm, kept)) = loudest {
            *loudest_cm = residual_cm;
            kept.copy_from_slice(positions);
        }
    }

    /// Names the frames that are kept.
    pub fn lasts(&mut self, tape: &mut Tape, n_markers: usize) -> Result<(), TapeError> {
        let mut n_kept = self.quietest.len() as u64;
        tape.integer("n_kept", &mut n_kept)?;
        if n_kept > self.capacity as u64 {
            return Err(tape.wrong("n_kept"));
        }
        if tape.is_read() {
            let nothing = (0.0, vec![None; n_markers]);
            self.quietest = (0..n_kept).map(|_| nothing.clone()).collect();
        }
        for (residual_cm, positions) in &mut self.quietest {
            tape.real("residual_cm", residual_cm)?;
            positions_on_tape::last(positions, tape)?;
        }
        Ok(())
    }

    /// The `n` quietest frames, fewer when not as many were seen.
    pub fn quietest(&self, n: usize) -> Vec<&Positions> {
        let mut sorted: Vec<_> = self.quietest.iter().collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let frames = sorted.into_iter().take(n);
        frames.map(|(_, positions)| positions.as_slice()).collect()
    }

    /// Whether the quietest frames fit clearly better than those of the alignment, which left `aligned_cm`.
    pub fn doubt(&self, aligned_cm: f64, sigma_cm: f64) -> Option<NeutralDoubt> {
        if self.capacity == 0 || self.quietest.len() < self.capacity {
            return None;
        }
        let squares = self.quietest.iter().map(|(it, _)| it * it).sum::<f64>();
        let quiet_squares = squares / self.capacity as f64;
        let excess_cm = (aligned_cm * aligned_cm - quiet_squares).max(0.0).sqrt();
        (excess_cm > QUIETER_CM.max(QUIETER_SIGMAS * sigma_cm)).then(|| NeutralDoubt {
            cause: DoubtCause::QuieterFramesSeen,
            residual_cm: aligned_cm,
            expected_cm: quiet_squares.sqrt(),
        })
    }
}

/// Rounds of similarity and contraction in which the neutral frames are explained.
const ROUNDS: usize = 4;

/// Whether contractions explain most of what the similarity leaves of the mean neutral frame, which then is none.
///
/// Judged at the markers as the artist placed them: projected onto the surface, they would follow the contraction.
fn looks_contracted(
    actor: &Actor,
    mean: &Positions,
    virtual_markers: &[Vector3<f64>],
) -> Option<NeutralDoubt> {
    let basis = MarkerBasis::at(actor, actor.virtual_markers());
    let seen: Vec<usize> = (0..mean.len()).filter(|&j| mean[j].is_some()).collect();
    let mut problem = BoxQp::new(basis.n_muscles());
    fill(&mut problem, &basis, &seen);
    let mut x = vec![0.0; basis.n_muscles()];
    let mut expected = virtual_markers.to_vec();
    let residual_cm = residual_cm(mean, &expected)?;
    for _ in 0..ROUNDS {
        let aligned = aligned(mean, &expected)?;
        let linear: Vec<f64> = (0..x.len())
            .map(|i| {
                let part =
                    |j: &usize| basis.of_marker_cm(*j)[i].dot(&(aligned[*j] - virtual_markers[*j]));
                seen.iter().map(part).sum()
            })
            .collect();
        problem.solve(&linear, &mut x).ok()?;
        for &j in &seen {
            let moved = basis.of_marker_cm(j).iter().zip(&x).map(|(d, x)| d * *x);
            expected[j] = virtual_markers[j] + moved.sum::<Vector3<f64>>();
        }
    }
    let expected_cm = self::residual_cm(mean, &expected)?;
    let is_contracted = x.iter().any(|it| *it > CONTRACTED);
    let explained = 1.0 - (expected_cm / residual_cm).powi(2);
    (is_contracted && explained > EXPLAINED_SHARE && residual_cm > QUIETER_CM).then_some(
        NeutralDoubt {
            cause: DoubtCause::LooksContracted,
            residual_cm,
            expected_cm,
        },
    )
}

fn fill(problem: &mut BoxQp, basis: &MarkerBasis, seen: &[usize]) {
    let (m, stride) = (basis.n_muscles(), problem.stride());
    problem.set_hessian(|q| {
        for &j in seen {
            let d = basis.of_marker_cm(j);
            for (i, column) in q.chunks_exact_mut(stride).enumerate().take(m) {
                for (q, other) in column.iter_mut().zip(d) {
                    *q += d[i].dot(other);
                }
            }
        }
        for (i, column) in q.chunks_exact_mut(stride).enumerate().take(m) {
            column[i] += RIDGE;
        }
    });
}

/// The positions under the best similarity to `expected`; where a marker is not seen, what is expected.
fn aligned(positions: &Positions, expected: &[Vector3<f64>]) -> Option<Vec<Vector3<f64>>> {
    let pairs = positions
        .iter()
        .zip(expected)
        .filter_map(|(seen, place)| Some((1.0, (*seen)?.0, (*place).into())));
    let found = fit(pairs, Scale::Free)?;
    let moved = positions.iter().zip(expected).map(|(seen, place)| {
        seen.map_or(*place, |it| {
            found.scale * (found.rotation * it.0.coords) + found.translation
        })
    });
    Some(moved.collect())
}

/// Root mean square of what the best similarity to the artist's neutral face leaves, centimeters in model space.
///
/// `None` for a frame that shows too little.
fn residual_cm(positions: &Positions, virtual_markers: &[Vector3<f64>]) -> Option<f64> {
    let pairs = positions
        .iter()
        .zip(virtual_markers)
        .filter_map(|(seen, place)| Some((1.0, (*seen)?.0, (*place).into())));
    let n = pairs.clone().count() as f64;
    if n < LEAST_VISIBLE_SHARE * virtual_markers.len() as f64 {
        return None;
    }
    let found = fit(pairs.clone(), Scale::Free)?;
    let squares: f64 = pairs
        .map(|(_, p, q)| {
            let moved = found.scale * (found.rotation * p.coords) + found.translation;
            (moved - q.coords).norm_squared()
        })
        .sum();
    Some((squares / n).sqrt())
}

/// Why the neutral frames are doubted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DoubtCause {
    /// Contractions explain what the neutral frames leave, far beyond their noise.
    LooksContracted,
    /// Later frames fit the neutral face clearly better than those that were taken.
    QuieterFramesSeen,
}

/// Says that the neutral frames probably were not neutral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeutralDoubt {
    /// Why.
    pub cause: DoubtCause,
    /// Root mean square distance of the neutral frames from the actor's neutral face, centimeters.
    pub residual_cm: f64,
    /// What it would be of a neutral face, centimeters: by the noise, or as seen in the quietest frames.
    pub expected_cm: f64,
}

impl DoubtCause {
    /// The identifier on the wire.
    pub fn identifier(self) -> &'static str {
        match self {
            Self::LooksContracted => "LOOKS_CONTRACTED",
            Self::QuieterFramesSeen => "QUIETER_FRAMES_SEEN",
        }
    }
}
