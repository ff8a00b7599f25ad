//! Contractions of all muscles from one frame of markers (Choe & Ko 2001, section 4.1.2).
//!
//! Displacements d = aligned markers − virtual markers, in model space; the contractions minimize |d − Dx|² within their
//! bounds, a box QP with `Q = DᵀD` and `c = Dᵀd`.
//! Occluded markers leave the sums; a region that shows too little is held, a muscle whose markers are hidden decays.

use nalgebra::{Matrix3, Vector3};

use super::{
    alignment::Alignment,
    evidence::{Evidence, Part},
    head_motion::{JointProblem, Stabilizer},
    marker_model::MarkerModel,
    neutral_watch::NeutralDoubt,
    range::MuscleRange,
    settings::{MarkerSettings, RegionMode},
    still_problem::{StillProblem, fix},
};
use crate::{
    curve::HeldReason,
    face::{actor::Actor, region::FaceRegion},
    numeric::lanes::add_multiple_of,
    space::{HeadPose, PerformancePoint},
};

/// An unobserved muscle decays by 1/e in this time.
const UNOBSERVED_DECAY_SECS: f64 = 0.2;

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
    /// s R and t of `model_from_performance`.
    linear_part: Matrix3<f64>,
    translation_cm: Vector3<f64>,
    region_mode: RegionMode,
    stabilize_head: bool,
    upper_bound: f64,
    rate_hz: f64,
    /// By which an unobserved muscle fades in one frame.
    decay: f64,

    /// Contractions in the solver's order.
    x: Vec<f64>,
    /// Where they stood before the joint problem of this frame.
    x_before: Vec<f64>,
    motion: Stabilizer,
    /// Frames since the motion was last found; `None` before the first.
    frames_since_pose: Option<u64>,
    head_known: bool,
    regions: [RegionOutcome; 2],
    kkt_residual: f64,

    evidence: Option<Evidence>,
    joint: JointProblem,
    still: StillProblem,

    visible: Vec<bool>,
    aligned: Vec<Vector3<f64>>,
    stabilized: Vec<Vector3<f64>>,
    reproduced: Vec<f64>,
    /// |observed − reproduced| of every marker, visible or not, centimeters.
    errors: Vec<f64>,
    /// The muscles that are not at rest, in front.
    active: Vec<usize>,
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
        let similarity = &alignment.model_from_performance;
        Self {
            linear_part: similarity.rotation.to_rotation_matrix().into_inner() * similarity.scale,
            translation_cm: similarity.translation_cm,
            region_mode: settings.region_mode,
            stabilize_head: settings.stabilize_head,
            upper_bound: settings.upper_bound(),
            rate_hz,
            decay: decay(rate_hz),
            x: vec![0.0; m],
            x_before: vec![0.0; m],
            motion: Stabilizer::identity(),
            frames_since_pose: None,
            head_known: false,
            regions: [RegionOutcome::default(); 2],
            kkt_residual: 0.0,
            evidence: None,
            joint: JointProblem::new(m),
            still: StillProblem::new(&model, settings.region_mode),
            visible: vec![false; n],
            aligned: vec![Vector3::zeros(); n],
            stabilized: vec![Vector3::zeros(); n],
            reproduced: vec![0.0; 3 * n],
            errors: vec![0.0; n],
            active: vec![0; m],
            model,
        }
    }

    /// Takes over the contractions and the head's motion of the solver that this one replaces between two frames.
    pub fn continue_from(&mut self, before: &Self) {
        if before.x.len() == self.x.len() {
            self.x.clone_from(&before.x);
            for it in &mut self.x {
                *it = it.min(self.upper_bound);
            }
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

    /// The declared rate of the capture, when a new publisher declares another.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        self.rate_hz = rate_hz;
        self.decay = decay(rate_hz);
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

    /// The evidence of the present visibility: the last frame's, unless a marker came or went.
    fn current_evidence(&mut self) -> Evidence {
        match self.evidence.take() {
            Some(evidence) if evidence.visible == self.visible => evidence,
            _ => {
                let evidence = Evidence::new(&self.model, self.region_mode, &self.visible);
                self.set_evidence(&evidence);
                evidence
            }
        }
    }

    fn set_evidence(&mut self, evidence: &Evidence) {
        if evidence.is_held() {
            return;
        }
        if self.stabilize_head {
            self.joint.set_evidence(evidence, self.upper_bound);
        }
        if !self.stabilize_head || self.region_mode == RegionMode::Split {
            self.still
                .set_evidence(&self.model, evidence, self.upper_bound);
        }
    }

    fn solve_visible(&mut self, evidence: &Evidence) {
        if evidence.is_degenerate(&self.aligned) {
            return self.hold_all(HeldReason::DegeneratePose);
        }
        self.decay_unobserved(evidence);
        let solved = if self.stabilize_head {
            self.solve_with_head(evidence)
        } else {
            self.stabilized.copy_from_slice(&self.aligned);
            self.solve_still(evidence);
            true
        };
        if solved {
            self.measure_errors(evidence);
        }
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
        self.x_before.copy_from_slice(&self.x);
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
            self.x.copy_from_slice(&self.x_before);
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
            self.x.copy_from_slice(&self.x_before);
            self.solve_still(evidence);
        }
        true
    }

    /// Fits the head's motion anew where the last one is too old to start from.
    fn start_motion(&mut self, evidence: &Evidence) -> bool {
        let limit = POSE_LOST_SECS * self.rate_hz;
        if self.frames_since_pose.is_some_and(|it| it as f64 <= limit) {
            return true;
        }
        self.reproduce();
        match Stabilizer::fitted(&self.model, evidence, &self.aligned, &self.reproduced) {
            Some(motion) => {
                self.motion = motion;
                true
            }
            None => false,
        }
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

    /// p = p₀ + D x at every marker.
    fn reproduce(&mut self) {
        self.reproduced.copy_from_slice(&self.model.rest_by_rows);
        // Listed without a branch a muscle: which of them are at rest changes with every frame.
        let mut n_active = 0;
        for (muscle, &x) in self.x.iter().enumerate() {
            self.active[n_active] = muscle;
            n_active += usize::from(x != 0.0);
        }
        for &muscle in &self.active[..n_active] {
            let support = self.model.support[muscle].clone();
            let column = &self.model.column(muscle)[support.clone()];
            add_multiple_of(&mut self.reproduced[support], self.x[muscle], column);
        }
    }

    /// Per-frame marker error of each region (Choe & Ko 2001, section 5).
    fn measure_errors(&mut self, evidence: &Evidence) {
        self.reproduce();
        let (reproduced, _) = self.reproduced.as_chunks::<3>();
        let pairs = self.stabilized.iter().zip(reproduced);
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

    /// Contractions in the actor's order.
    pub fn activations(&self) -> Vec<f64> {
        let mut activations = vec![0.0; self.x.len()];
        for (&muscle, &x) in self.model.muscles.iter().zip(&self.x) {
            activations[muscle] = x;
        }
        activations
    }

    /// Actor's indices of the muscles that the last frame could not tell, ascending.
    pub fn unobserved(&self) -> Vec<usize> {
        let parts = self.evidence.iter().flat_map(|it| &it.parts);
        let mut unobserved: Vec<usize> = parts
            .zip(&self.model.muscles)
            .filter(|(part, _)| **part == Part::Unobserved)
            .map(|(_, &muscle)| muscle)
            .collect();
        unobserved.sort_unstable();
        unobserved
    }

    /// One sigma of each contraction, in the actor's order.
    pub fn standard_errors(&self) -> Vec<f64> {
        vec![0.0; self.x.len()]
    }

    /// Actor's indices of the markers that were seen and masked in the last frame.
    pub fn outliers(&self) -> Vec<usize> {
        Vec::new()
    }

    /// Actor's indices of the markers whose labels were put right in the last frame.
    pub fn relabeled(&self) -> Vec<[usize; 2]> {
        Vec::new()
    }

    /// How far each muscle went, in the actor's order.
    pub fn ranges(&self) -> Vec<MuscleRange> {
        Vec::new()
    }

    /// Whether the neutral frames were neutral.
    pub fn neutral_doubt(&self) -> Option<NeutralDoubt> {
        None
    }

    /// The `n` quietest frames seen so far, fewer when there are not as many.
    pub fn quietest_frames(&self, _n: usize) -> Vec<&[Option<PerformancePoint>]> {
        Vec::new()
    }

    /// What each region showed, in the order of [`FaceRegion::ALL`].
    pub fn regions(&self) -> [(FaceRegion, RegionOutcome); 2] {
        FaceRegion::ALL.map(|it| (it, self.regions[it.index()]))
    }

    /// The head's motion in the last frame; `None` when it is not tracked or not known.
    pub fn head(&self) -> Option<HeadPose> {
        self.head_known.then(|| self.motion.head_pose())
    }

    /// KKT residual of the last solution, relative to the largest diagonal entry of Q; 0 when all is held.
    pub fn kkt_residual(&self) -> f64 {
        self.kkt_residual
    }

    /// The visible markers of the last frame as actor's index, observed and reproduced position, centimeters, head motion
    /// taken out; empty when all is held.
    pub fn visible_markers(
        &self,
    ) -> impl Iterator<Item = (usize, Vector3<f64>, Vector3<f64>)> + '_ {
        let solved = self.regions.iter().any(|it| it.held.is_none());
        let count = if solved { self.model.n_markers() } else { 0 };
        (0..count).filter(|&j| self.visible[j]).map(|j| {
            let reproduced = Vector3::from_column_slice(&self.reproduced[3 * j..3 * j + 3]);
            (self.model.markers[j], self.stabilized[j], reproduced)
        })
    }
}

/// What is left of an unobserved contraction after one frame.
fn decay(rate_hz: f64) -> f64 {
    (-1.0 / (UNOBSERVED_DECAY_SECS * rate_hz)).exp()
}
