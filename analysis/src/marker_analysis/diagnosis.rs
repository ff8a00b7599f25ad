//! What a performance says about the actor's draft while it runs: ranges of the muscles, and whether the neutral face was one.
//!
//! Frames are looked at some thirty times a second, whatever the rate: percentiles do not gain by more.

use nalgebra::Vector3;

use super::{
    evidence::{Evidence, Part},
    head_motion::RIDGE,
    marker_model::MarkerModel,
    neutral_watch::{NeutralDoubt, NeutralWatch},
    range::{Looked, MuscleRange, RangeTracker},
};
use crate::{
    face::actor::Actor,
    numeric::{
        factor::Factor,
        tape::{Tape, TapeError},
    },
    space::PerformancePoint,
};

/// Frames that are looked at a second.
const LOOKS_PER_SEC: f64 = 30.0;

/// Trackers of one session since its alignment.
#[derive(Clone, Debug)]
pub(super) struct Diagnosis {
    ranges: RangeTracker,
    watch: NeutralWatch,
    /// The artist's neutral face at the markers.
    virtual_markers: Vec<Vector3<f64>>,
    mobility_cm: Vec<f64>,
    every: u64,
    n_frames: u64,
    hessian: Vec<f64>,
    factor: Factor,
    unbounded: Vec<f64>,
    all: Vec<usize>,
}

/// A solved frame.
pub(super) struct SolvedFrame<'a> {
    pub model: &'a MarkerModel,
    pub evidence: &'a Evidence,
    /// As they came, in the actor's order.
    pub positions: &'a [Option<PerformancePoint>],
    /// Head motion taken out, in the solver's order.
    pub stabilized: &'a [Vector3<f64>],
    /// Whether a marker was masked.
    pub is_masked: &'a dyn Fn(usize) -> bool,
    pub x: &'a [f64],
    pub standard_errors: &'a [f64],
}

impl Diagnosis {
    pub fn new(actor: &Actor, model: &MarkerModel, n_quiet_frames: usize, rate_hz: f64) -> Self {
        let m = model.n_muscles();
        let places = actor.virtual_markers().iter();
        let energy = |i: usize| model.column(i).iter().map(|it| it * it).sum::<f64>();
        Self {
            ranges: RangeTracker::new(m),
            watch: NeutralWatch::new(n_quiet_frames),
            virtual_markers: places
                .map(|it| it.position(actor.mesh()).0.coords)
                .collect(),
            mobility_cm: (0..m).map(|i| energy(i).sqrt()).collect(),
            every: every(rate_hz),
            n_frames: 0,
            hessian: vec![0.0; m * m],
            factor: Factor::with_capacity(m),
            unbounded: vec![0.0; m],
            all: (0..m).collect(),
        }
    }

    /// The declared rate of the capture.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        self.every = every(rate_hz);
    }

    /// Names what curves may yet depend on: the quietest frames, and which frames are looked at. Ranges begin anew.
    pub fn lasts(&mut self, tape: &mut Tape, n_markers: usize) -> Result<(), TapeError> {
        tape.integer("n_frames", &mut self.n_frames)?;
        self.watch.lasts(tape, n_markers)
    }

    /// Counts a frame; whether it is to be looked at.
    pub fn is_due(&mut self) -> bool {
        self.n_frames += 1;
        self.n_frames.is_multiple_of(self.every)
    }

    /// Takes in a frame.
    pub fn look(&mut self, frame: &SolvedFrame<'_>) {
        self.watch.look(frame.positions, &self.virtual_markers);
        let is_whole = frame.evidence.parts.iter().all(|it| *it == Part::Solved);
        if is_whole && self.solve_unbounded(frame) {
            self.ranges.look(&Looked {
                bounded: frame.x,
                unbounded: &self.unbounded,
                standard_errors: frame.standard_errors,
                mobility_cm: &self.mobility_cm,
            });
        }
    }

    /// The least-squares solution without bounds or other terms, from the markers that were not masked.
    fn solve_unbounded(&mut self, frame: &SolvedFrame<'_>) -> bool {
        let (model, m) = (frame.model, self.all.len());
        self.hessian.copy_from_slice(&frame.evidence.gram);
        self.unbounded.fill(0.0);
        for &j in &frame.evidence.used {
            if (frame.is_masked)(j) {
                model.change_gram(&mut self.hessian, m, j, -1.0);
                continue;
            }
            let displacement = frame.stabilized[j] - model.rest[j];
            for axis in 0..3 {
                for (c, d) in self.unbounded.iter_mut().zip(model.row(j, axis)) {
                    *c += d * displacement[axis];
                }
            }
        }
        for i in 0..m {
            self.hessian[i * m + i] += RIDGE;
        }
        let factored = self.factor.factor(&self.hessian, m, &self.all, 0);
        if factored.is_ok() {
            self.factor.solve(&mut self.unbounded);
        }
        factored.is_ok()
    }

    /// How far each muscle went, in the actor's order.
    pub fn ranges(&self, model: &MarkerModel) -> Vec<MuscleRange> {
        let muscles = model.muscles.iter().enumerate();
        let mut ranges: Vec<_> = muscles
            .map(|(place, &muscle)| self.ranges.range(place, muscle))
            .collect();
        ranges.sort_by_key(|it| it.muscle);
        ranges
    }

    /// Whether later frames were quieter than the neutral ones, which left `aligned_cm`.
    pub fn doubt(&self, aligned_cm: f64, sigma_cm: f64) -> Option<NeutralDoubt> {
        self.watch.doubt(aligned_cm, sigma_cm)
    }

    /// The `n` quietest frames, fewer when not as many were seen.
    pub fn quietest(&self, n: usize) -> Vec<&[Option<PerformancePoint>]> {
        self.watch.quietest(n)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at least 1, and rates are far below 2^53"
)]
fn every(rate_hz: f64) -> u64 {
    (rate_hz / LOOKS_PER_SEC).round().max(1.0) as u64
}
