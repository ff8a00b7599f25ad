//! Contractions of all muscles from one frame of markers (Choe & Ko 2001, section 4.1.2).
//!
//! Displacements d = aligned markers − virtual markers, in model space; the contractions minimize |d − Dx|² within their
//! bounds, a box QP with `Q = DᵀD` and `c = Dᵀd`.
//! Occluded markers leave the sums; a region that shows too little is held, a muscle whose markers are hidden decays.

mod reading;

use nalgebra::{Matrix3, Vector3};

use super::{
    alignment::Alignment,
    diagnosis::{Diagnosis, SolvedFrame},
    estimate::Frame,
    estimated::Estimated,
    evidence::{Evidence, Part},
    head_motion::{JointProblem, MOTION, Stabilizer},
    marker_model::MarkerModel,
    objective::Objective,
    plain_uncertainty::{PlainFrame, PlainUncertainty},
    reproduction::Reproduction,
    settings::{MarkerSettings, RegionMode},
    still_problem::{StillProblem, fix},
};
use crate::{
    curve::HeldReason,
    face::actor::Actor,
    numeric::tape::{Tape, TapeError},
    space::PerformancePoint,
};

/// An unobserved muscle decays by 1/e in this time.
const UNOBSERVED_DECAY_SECS: f64 = 0.2;

/// A head that jumps further in a frame is found anew, centimeters: no muscle moves most markers as far.
const HEAD_JUMP_CM: f64 = 2.0;

/// After a longer time without a solved frame the head's pose is fitted anew.
const POSE_LOST_SECS: f64 = 0.3;

/// What one region showed in the frame that was solved last.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegionOutcome {
    /// Why the region stands still.
    pub held: Option<HeldReason>,
    /// Its own markers that were seen.
    pub visible: usize,
    /// Its own markers that the actor has.
    pub expected: usize,
    /// Mean of |observed − reproduced| over those seen, centimeters; 0 when held.
    pub marker_error_cm: f64,
}

/// Solves frame after frame, each warm from the one before.
#[derive(Clone, Debug)]
pub struct ContractionSolver {
    model: MarkerModel,
    n_actor_markers: usize,
    /// s R and t of `model_from_performance`.
    linear_part: Matrix3<f64>,
    translation_cm: Vector3<f64>,
    region_mode: RegionMode,
    stabilize_head: bool,
    /// Bounds of each muscle in the solver's order.
    boxes: Vec<[f64; 2]>,
    rate_hz: f64,
    /// By which an unobserved muscle fades in one frame.
    decay: f64,

    /// Contractions in the solver's order.
    x: Vec<f64>,
    motion: Stabilizer,
    /// Frames since the motion was last found; `None` before the first.
    frames_since_pose: Option<u64>,
    head_known: bool,
    regions: [RegionOutcome; 2],
    kkt_residual: f64,
    /// How many times the size of the face the last frame had, when it was not a face's.
    scale_jump: Option<f64>,

    /// `None` only while a frame is solved.
    evidence: Option<Evidence>,
    joint: JointProblem,
    still: StillProblem,
    /// `None` where no term is added to the paper's objective.
    estimated: Option<Estimated>,
    plain_uncertainty: PlainUncertainty,
    diagnosis: Diagnosis,
    /// x before the frame.
    before: Vec<f64>,

    visible: Vec<bool>,
    aligned: Vec<Vector3<f64>>,
    stabilized: Vec<Vector3<f64>>,
    reproduction: Reproduction,
    /// |observed − reproduced| of every marker, visible or not, centimeters.
    errors: Vec<f64>,
}

impl ContractionSolver {
    /// A solver at rest. `rate_hz` is the declared rate of the capture: finite, positive.
    pub fn new(
        actor: &Actor,
        alignment: &Alignment,
        settings: &MarkerSettings,
        rate_hz: f64,
    ) -> Self {
        let model = MarkerModel::new(actor, alignment);
        let (n, m) = (model.n_markers(), model.n_muscles());
        let boxes = boxes(&model, actor, settings);
        let similarity = &alignment.model_from_performance;
        Self {
            n_actor_markers: actor.markers().len(),
            linear_part: similarity.rotation.to_rotation_matrix().into_inner() * similarity.scale,
            translation_cm: similarity.translation_cm,
            region_mode: settings.region_mode,
            stabilize_head: settings.stabilize_head,
            rate_hz,
            decay: decay(rate_hz),
            x: boxes.iter().map(|[lower, _]| *lower).collect(),
            motion: Stabilizer::identity(),
            frames_since_pose: None,
            head_known: false,
            regions: [RegionOutcome::default(); 2],
            kkt_residual: 0.0,
            scale_jump: None,
            evidence: Some(Evidence::new(&model, settings.region_mode)),
            joint: JointProblem::new(m),
            still: StillProblem::new(&model, settings.region_mode),
            estimated: needs_estimator(&settings.objective)
                .then(|| Estimated::new(&model, actor.muscle_set(), settings, &boxes, rate_hz)),
            plain_uncertainty: PlainUncertainty::new(&model, n_unknowns(m, settings)),
            diagnosis: Diagnosis::new(actor, &model, settings.neutral_frames, rate_hz),
            before: vec![0.0; m],
            boxes,
            visible: vec![false; n],
            aligned: vec![Vector3::zeros(); n],
            stabilized: vec![Vector3::zeros(); n],
            reproduction: Reproduction::new(&model),
            errors: vec![0.0; n],
            model,
        }
    }

    /// Takes over the contractions and the head's motion of the solver that this one replaces between two frames.
    pub fn continue_from(&mut self, before: &Self) {
        if before.x.len() == self.x.len() {
            self.x.clone_from(&before.x);
            for (it, [lower, upper]) in self.x.iter_mut().zip(&self.boxes) {
                *it = it.clamp(*lower, *upper);
            }
        }
        if let (Some(estimated), Some(before)) = (&mut self.estimated, &before.estimated) {
            estimated.continue_from(before);
        }
        self.motion = before.motion;
        self.frames_since_pose = before.frames_since_pose;
        self.head_known = self.stabilize_head && before.head_known;
    }

    /// Goes on on another alignment: the head is found anew, the contractions may move at once.
    pub fn continue_realigned(&mut self, before: &Self) {
        self.continue_from(before);
        self.frames_since_pose = None;
    }

    /// Names what a frame finds of those before it; what is read belongs to the same actor, alignment, settings and rate.
    pub(crate) fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        self.evidence_lasts(tape)?;
        tape.reals("x", &mut self.x)?;
        tape.reals("rotation", self.motion.rotation.as_mut_slice())?;
        tape.reals("translation", self.motion.translation.as_mut_slice())?;
        tape.maybe_integer("frames_since_pose", &mut self.frames_since_pose)?;
        tape.within("joint", |tape| self.joint.qp.lasts(tape))?;
        tape.within("still", |tape| self.still.lasts(tape))?;
        if let Some(estimated) = &mut self.estimated {
            tape.within("estimated", |tape| estimated.lasts(tape))?;
        } else {
            let uncertainty = &mut self.plain_uncertainty;
            tape.within("uncertainty", |tape| uncertainty.lasts(tape))?;
        }
        let n_markers = self.n_actor_markers;
        let diagnosis = &mut self.diagnosis;
        tape.within("diagnosis", |tape| diagnosis.lasts(tape, n_markers))
    }

    /// The visibility that all sums belong to.
    fn evidence_lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        let shown = self.evidence.iter().flat_map(|it| &it.visible);
        let mut shown: Vec<bool> = shown.copied().collect();
        tape.flags("visible", &mut shown)?;
        if tape.is_read() {
            self.visible = shown;
            self.evidence = Some(self.current_evidence());
        }
        Ok(())
    }

    /// The declared rate of the capture, when a new publisher declares another.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        self.rate_hz = rate_hz;
        self.decay = decay(rate_hz);
        self.diagnosis.set_rate_hz(rate_hz);
        if let Some(estimated) = &mut self.estimated {
            estimated.set_rate_hz(rate_hz);
        }
    }

    /// Frames that were captured and did not come: the next one is so much later.
    pub fn pass(&mut self, n_frames: u64) {
        self.frames_since_pose = self.frames_since_pose.map(|it| it.saturating_add(n_frames));
    }

    /// Solves one frame: one position a marker of the actor, in the actor's order.
    ///
    /// # Panics
    ///
    /// When there are fewer positions than markers: the caller has counted them.
    pub fn solve(&mut self, positions: &[Option<PerformancePoint>]) {
        self.align(positions);
        let evidence = self.current_evidence();
        self.frames_since_pose = self.frames_since_pose.map(|it| it.saturating_add(1));
        for (outcome, region) in self.regions.iter_mut().zip(&evidence.regions) {
            *outcome = RegionOutcome {
                held: region.held,
                visible: region.visible,
                expected: region.expected,
                marker_error_cm: 0.0,
            };
        }
        self.kkt_residual = 0.0;
        self.head_known = false;
        self.scale_jump = None;
        if !evidence.is_held() {
            self.solve_visible(&evidence);
        }
        self.evidence = Some(evidence);
    }

    /// Moves the visible markers into model space.
    fn align(&mut self, positions: &[Option<PerformancePoint>]) {
        let places = self.visible.iter_mut().zip(&mut self.aligned);
        for (&marker, (visible, aligned)) in self.model.markers.iter().zip(places) {
            *visible = positions[marker].is_some();
            *aligned = positions[marker].map_or(Vector3::zeros(), |it| {
                self.linear_part * it.0.coords + self.translation_cm
            });
        }
    }

    /// The evidence of the present visibility.
    fn current_evidence(&mut self) -> Evidence {
        let mut evidence = self
            .evidence
            .take()
            .unwrap_or_else(|| Evidence::new(&self.model, self.region_mode));
        if evidence.show(&self.model, &self.visible)
            && self.estimated.is_none()
            && !evidence.is_held()
        {
            self.set_evidence(&evidence);
        }
        evidence
    }

    fn set_evidence(&mut self, evidence: &Evidence) {
        if self.stabilize_head {
            self.joint.set_evidence(evidence, &self.boxes);
        }
        if !self.stabilize_head || self.region_mode == RegionMode::Split {
            self.still.set_evidence(&self.model, evidence, &self.boxes);
        }
    }

    fn solve_visible(&mut self, evidence: &Evidence) {
        let shape = evidence.shape(&self.aligned);
        self.scale_jump = shape.scale_jump();
        if self.scale_jump.is_some() || shape.is_degenerate() {
            return self.hold_all(HeldReason::DegeneratePose);
        }
        let solved = if self.estimated.is_some() {
            self.estimate(evidence)
        } else if self.stabilize_head {
            self.decay_unobserved(evidence);
            self.solve_with_head(evidence)
        } else {
            self.decay_unobserved(evidence);
            self.stabilized.copy_from_slice(&self.aligned);
            self.solve_still(evidence);
            true
        };
        if solved {
            self.measure_errors(evidence);
        }
    }

    /// The problem with the terms of the objective.
    fn estimate(&mut self, evidence: &Evidence) -> bool {
        let is_first = self.frames_since_pose.is_none();
        let is_lost = !is_first && !self.pose_is_recent();
        if self.stabilize_head && !self.start_motion(evidence) {
            self.hold_all(HeldReason::DegeneratePose);
            return false;
        }
        let Some(estimated) = &mut self.estimated else {
            return false;
        };
        if is_lost {
            estimated.forget();
        }
        self.before.copy_from_slice(&self.x);
        let mut frame = Frame {
            model: &self.model,
            evidence,
            aligned: &mut self.aligned,
            stabilized: &mut self.stabilized,
            decay: self.decay,
            elapsed: self.frames_since_pose.unwrap_or(1) as f64,
        };
        let Ok(report) = estimated.solve(&mut frame, &mut self.motion, &mut self.x) else {
            self.x.copy_from_slice(&self.before);
            self.hold_all(HeldReason::SolverBudget);
            return false;
        };
        self.frames_since_pose = Some(0);
        self.head_known = self.stabilize_head;
        self.kkt_residual = report.kkt_residual;
        true
    }

    fn hold_all(&mut self, reason: HeldReason) {
        for region in &mut self.regions {
            region.held.get_or_insert(reason);
        }
    }

    /// Hidden muscles fade (METHODS 5b, step 2); held ones stand still.
    fn decay_unobserved(&mut self, evidence: &Evidence) {
        for (x, part) in self.x.iter_mut().zip(&evidence.parts) {
            if *part == Part::Unobserved {
                *x *= self.decay;
            }
        }
    }

    /// The joint problem; regions apart then take its pose and solve again on their own.
    fn solve_with_head(&mut self, evidence: &Evidence) -> bool {
        if !self.start_motion(evidence) {
            self.hold_all(HeldReason::DegeneratePose);
            return false;
        }
        self.before.copy_from_slice(&self.x);
        fix(&mut self.joint.qp, &evidence.parts, &self.x);
        let report = self.joint.solve(
            &self.model,
            evidence,
            &self.aligned,
            &mut self.stabilized,
            &mut self.motion,
            &mut self.x,
        );
        let Ok(report) = report else {
            self.x.copy_from_slice(&self.before);
            self.hold_all(HeldReason::SolverBudget);
            return false;
        };
        self.frames_since_pose = Some(0);
        self.head_known = true;
        self.kkt_residual = report.kkt_residual;
        for (stabilized, aligned) in self.stabilized.iter_mut().zip(&self.aligned) {
            *stabilized = self.motion.apply(aligned);
        }
        if self.region_mode == RegionMode::Split {
            self.x.copy_from_slice(&self.before);
            self.solve_still(evidence);
        }
        true
    }

    fn pose_is_recent(&self) -> bool {
        let limit = POSE_LOST_SECS * self.rate_hz;
        self.frames_since_pose.is_some_and(|it| it as f64 <= limit)
    }

    /// Fits the head's motion anew where the last one is too old to start from, or the head has jumped away from it.
    fn start_motion(&mut self, evidence: &Evidence) -> bool {
        self.reproduction.of(&self.x);
        if self.pose_is_recent() && !self.head_jumped(evidence) {
            return true;
        }
        match Stabilizer::fitted(
            &self.model,
            evidence,
            &self.aligned,
            self.reproduction.positions(),
        ) {
            Some(motion) => {
                self.motion = motion;
                true
            }
            None => false,
        }
    }

    /// Whether most markers are further from where the last pose puts them than a face can move in a frame.
    fn head_jumped(&self, evidence: &Evidence) -> bool {
        let is_far = |j: &&usize| {
            let expected = self.reproduction.at(**j);
            let distance = self.motion.apply(&self.aligned[**j]) - expected;
            distance.norm_squared() > HEAD_JUMP_CM * HEAD_JUMP_CM
        };
        2 * evidence.used.iter().filter(is_far).count() > evidence.used.len()
    }

    /// The problem over the stabilized markers, without a pose.
    fn solve_still(&mut self, evidence: &Evidence) {
        let regions = &mut self.regions;
        self.kkt_residual = self.still.solve(
            &self.model,
            evidence,
            &self.stabilized,
            &mut self.x,
            |failed| {
                for (index, region) in regions.iter_mut().enumerate() {
                    if failed.is_none_or(|it| it == index) {
                        region.held.get_or_insert(HeldReason::SolverBudget);
                    }
                }
            },
        );
    }

    /// Per-frame marker error of each region (Choe & Ko 2001, section 5).
    fn measure_errors(&mut self, evidence: &Evidence) {
        self.reproduction.of(&self.x);
        let pairs = self.stabilized.iter().zip(self.reproduction.positions());
        for (error, (observed, reproduced)) in self.errors.iter_mut().zip(pairs) {
            *error = (observed - Vector3::from(*reproduced)).norm_squared();
        }
        // In a loop of their own, so that two roots are taken at once.
        for error in &mut self.errors {
            *error = error.sqrt();
        }
        for (index, region) in self.regions.iter_mut().enumerate() {
            if region.held.is_some() {
                continue;
            }
            let own = self.model.own_markers[index].clone();
            let errors = evidence.visible[own.clone()].iter().zip(&self.errors[own]);
            let mut sum = 0.0;
            for (visible, error) in errors {
                sum += if *visible { *error } else { 0.0 };
            }
            region.marker_error_cm = sum / region.visible.max(1) as f64;
        }
    }

    /// Says how far the frame that was just solved can be trusted, and what it says about the actor's draft.
    ///
    /// `positions` are those that were solved.
    pub fn assess(&mut self, positions: &[Option<PerformancePoint>]) {
        let Some(evidence) = self.evidence.as_ref().filter(|_| self.is_solved()) else {
            return;
        };
        if self.estimated.is_none() {
            let joint = self.stabilize_head && self.region_mode == RegionMode::Joint;
            self.plain_uncertainty.observe(&PlainFrame {
                model: &self.model,
                evidence,
                stabilized: &self.stabilized,
                reproduction: &self.reproduction,
                x: &self.x,
                boxes: &self.boxes,
                mode: self.region_mode,
                joint: joint.then_some(&self.joint.qp),
                rate_hz: self.rate_hz,
            });
        }
        if self.diagnosis.is_due() {
            let estimated = self.estimated.as_ref();
            self.diagnosis.look(&SolvedFrame {
                model: &self.model,
                evidence,
                positions,
                stabilized: &self.stabilized,
                is_masked: &|j| estimated.is_some_and(|it| it.last().is_masked(j)),
                x: &self.x,
                standard_errors: estimated.map_or_else(
                    || self.plain_uncertainty.standard_errors(),
                    |it| it.last().standard_errors(),
                ),
            });
        }
    }
}

/// Bounds of each muscle in the solver's order.
fn boxes(model: &MarkerModel, actor: &Actor, settings: &MarkerSettings) -> Vec<[f64; 2]> {
    let own = |name: &str| {
        let mut bounds = settings.objective.bounds.iter();
        bounds.find(|it| it.muscle == name)
    };
    let muscles = model.muscles.iter();
    let box_of = |muscle: &usize| match own(&actor.muscle_set().muscles()[*muscle].name) {
        Some(bounds) => [bounds.lower, bounds.upper],
        None => [0.0, settings.upper_bound()],
    };
    muscles.map(box_of).collect()
}

/// Whether anything is asked for that the paper's own problem does not have.
fn needs_estimator(objective: &Objective) -> bool {
    !objective.is_plain() || !objective.exclusive_pairs.is_empty()
}

fn n_unknowns(n_muscles: usize, settings: &MarkerSettings) -> usize {
    let has_motion = settings.stabilize_head && settings.region_mode == RegionMode::Joint;
    n_muscles + if has_motion { MOTION } else { 0 }
}

/// What is left of an unobserved contraction after one frame.
fn decay(rate_hz: f64) -> f64 {
    (-1.0 / (UNOBSERVED_DECAY_SECS * rate_hz)).exp()
}
