//! The state of one session: marker frame in, curve sample out.

mod lasting;

pub use crate::marker_analysis::{
    objective::{MuscleBounds, Objective, ObjectiveError},
    settings::{MarkerSettings, RegionMode},
};

use std::sync::Arc;

use crate::{
    curve::{CurveSample, MarkerTrace, Quality, RegionReport},
    face::{actor::Actor, marker::MarkerFrame},
    marker_analysis::{
        alignment::{Alignment, AlignmentError},
        contraction::{ContractionSolver, RegionOutcome},
        neutral,
        neutral_watch::{NeutralDoubt, NeutralEvidence},
        range::MuscleRange,
    },
    space::{LengthUnit, PerformancePoint},
};

/// A neutral frame shows at least this many markers.
const MARKERS_IN_A_NEUTRAL_FRAME: usize = 4;

/// Frames kept beyond the neutral frames wanted, while too few of them show a face: then the alignment has failed.
const UNUSABLE_FRAMES_KEPT: usize = 512;

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Not used: alignment waits for a request. No sample will come of this frame.
    Waiting,
    /// Kept as a neutral frame; its sample follows when the alignment is known.
    Collecting {
        /// Frames kept so far that show a face.
        collected: usize,
        /// Neutral frames wanted.
        wanted: usize,
    },
    /// The alignment is now known; the samples of all kept frames were appended, in order.
    Aligned,
    /// One sample was appended.
    Solved,
    /// The face is at another scale than before, so the unit has changed: no sample will come of this frame.
    /// [`MarkerAnalyzer::scale_jump`] says by how much.
    ScaleJump,
    /// The new neutral face that was asked for could not be aligned, and the old one holds on. One sample was appended, unless
    /// the face is at another scale.
    /// [`MarkerAnalyzer::recenter_error`] says why.
    RecenterFailed,
}

/// Where a new neutral face comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NeutralSource {
    /// The next usable frames.
    #[default]
    NextFrames,
    /// The quietest frames seen so far.
    QuietestFrames,
}

/// Why the quietest frames cannot be taken as the neutral face.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum QuietestError {
    /// There is no alignment yet, so no frame has been looked at.
    #[error("no frame has been aligned yet: there are no quietest frames to take")]
    NotAligned,
    /// Too few frames have been looked at.
    #[error("{found} quiet frames have been seen, {needed} are needed")]
    TooFew {
        /// How many there are.
        found: usize,
        /// How many are needed.
        needed: usize,
    },
    /// They do not fit the actor's face.
    #[error("the quietest frames could not be aligned")]
    Alignment(#[source] AlignmentError),
}

/// Markers to muscle curves, one frame at a time.
pub struct MarkerAnalyzer {
    actor: Arc<Actor>,
    settings: MarkerSettings,
    unit: LengthUnit,
    rate_hz: f64,
    stage: Stage,
    recenter_error: Option<AlignmentError>,
}

enum Stage {
    /// No alignment, and none asked for.
    Waiting,
    /// Frames since the start or the last request, usable or not, in order.
    Collecting(Vec<MarkerFrame>),
    Solving(Box<Solving>),
}

struct Solving {
    alignment: Alignment,
    solver: ContractionSolver,
    held_frames: u32,
    /// Number of the last frame.
    last_index: Option<u64>,
    /// `None` of an alignment that was found in an earlier run.
    neutral: Option<NeutralEvidence>,
    /// The frames of the neutral face that was asked for while curves flow.
    recentering: Option<Vec<MarkerFrame>>,
}

impl MarkerAnalyzer {
    /// Starts without an alignment; `rate_hz` is the declared rate of the capture (finite, positive), `unit` its unit.
    pub fn new(
        actor: Arc<Actor>,
        settings: MarkerSettings,
        unit: LengthUnit,
        rate_hz: f64,
    ) -> Self {
        let stage = if settings.align_on_request {
            Stage::Waiting
        } else {
            Stage::Collecting(Vec::new())
        };
        Self {
            actor,
            settings,
            unit,
            rate_hz,
            stage,
            recenter_error: None,
        }
    }

    /// Starts from an alignment found before, on this revision of the actor.
    pub fn resume(
        actor: Arc<Actor>,
        settings: MarkerSettings,
        unit: LengthUnit,
        rate_hz: f64,
        alignment: Alignment,
    ) -> Self {
        let solving = Solving::new(&actor, &settings, rate_hz, alignment);
        Self {
            actor,
            settings,
            unit,
            rate_hz,
            stage: Stage::Solving(Box::new(solving)),
            recenter_error: None,
        }
    }

    /// Takes one frame, markers in the actor's order; appends the samples that are now known to `samples`.
    ///
    /// # Errors
    ///
    /// When the collected neutral frames cannot be aligned: they are dropped, without samples, and collection starts over
    /// (or waits for the next request, with `align_on_request`).
    ///
    /// # Panics
    ///
    /// When the frame has not one position a marker of the actor: the boundary has made sure of that.
    pub fn push(
        &mut self,
        frame: MarkerFrame,
        samples: &mut Vec<CurveSample>,
    ) -> Result<Progress, AlignmentError> {
        match &mut self.stage {
            Stage::Waiting => Ok(Progress::Waiting),
            Stage::Collecting(frames) => {
                frames.push(frame);
                self.try_align(samples)
            }
            Stage::Solving(solving) => {
                let sample = solving.solve(&frame);
                let is_at_scale = solving.solver.scale_jump().is_none();
                if is_at_scale {
                    samples.push(sample);
                }
                // A new neutral face may be asked for just because the unit has changed.
                let progress = match &mut solving.recentering {
                    None => Progress::Solved,
                    Some(frames) => {
                        frames.push(frame);
                        self.try_recenter()
                    }
                };
                Ok(match progress {
                    Progress::Solved if !is_at_scale => Progress::ScaleJump,
                    progress => progress,
                })
            }
        }
    }

    fn try_align(&mut self, samples: &mut Vec<CurveSample>) -> Result<Progress, AlignmentError> {
        let Stage::Collecting(frames) = &mut self.stage else {
            return Ok(Progress::Waiting);
        };
        let wanted = self.settings.neutral_frames.max(1);
        let Some(usable) = complete(frames.iter(), wanted) else {
            let collected = frames.iter().filter(|it| shows_a_face(it)).count();
            return Ok(Progress::Collecting { collected, wanted });
        };
        let alignment = find_alignment(&self.actor, &usable, self.unit);
        let kept = std::mem::take(frames);
        let (alignment, neutral) = match alignment {
            Ok(found) => found,
            Err(error) => {
                if self.settings.align_on_request {
                    self.stage = Stage::Waiting;
                }
                return Err(error);
            }
        };
        let mut solving = Solving::new(&self.actor, &self.settings, self.rate_hz, alignment);
        solving.neutral = Some(neutral);
        samples.extend(kept.iter().map(|frame| solving.solve(frame)));
        self.stage = Stage::Solving(Box::new(solving));
        Ok(Progress::Aligned)
    }

    /// Moves to the new neutral face once its frames are complete; until then, and when it fails, the old one holds.
    fn try_recenter(&mut self) -> Progress {
        let Stage::Solving(solving) = &mut self.stage else {
            return Progress::Waiting;
        };
        let wanted = self.settings.neutral_frames.max(1);
        let frames = solving.recentering.iter().flatten();
        let Some(usable) = complete(frames, wanted) else {
            return Progress::Solved;
        };
        let alignment = find_alignment(&self.actor, &usable, self.unit);
        solving.recentering = None;
        match alignment {
            Ok((alignment, neutral)) => {
                self.realign(alignment, neutral);
                Progress::Aligned
            }
            Err(error) => {
                self.recenter_error = Some(error);
                Progress::RecenterFailed
            }
        }
    }

    /// Goes on from where the curves are, on another alignment.
    fn realign(&mut self, alignment: Alignment, neutral: NeutralEvidence) {
        let mut next = Solving::new(&self.actor, &self.settings, self.rate_hz, alignment);
        next.neutral = Some(neutral);
        if let Stage::Solving(before) = &self.stage {
            next.solver.continue_realigned(&before.solver);
            next.held_frames = before.held_frames;
            next.last_index = before.last_index;
        }
        self.stage = Stage::Solving(Box::new(next));
        self.recenter_error = None;
    }

    /// Takes the next usable frames as the neutral face again.
    ///
    /// Where there is an alignment, curves go on with it until the new one is known, so that the values move by no more
    /// than the new neutral face changes. Before that, frames collected so far are dropped, without samples.
    pub fn recenter(&mut self) {
        self.recenter_error = None;
        match &mut self.stage {
            Stage::Solving(solving) => solving.recentering = Some(Vec::new()),
            stage => *stage = Stage::Collecting(Vec::new()),
        }
    }

    /// Takes the quietest frames seen so far as the neutral face, at once.
    ///
    /// # Errors
    ///
    /// When there are too few of them, or they cannot be aligned; the alignment stays as it was.
    pub fn recenter_on_quietest(&mut self) -> Result<(), QuietestError> {
        let Stage::Solving(solving) = &self.stage else {
            return Err(QuietestError::NotAligned);
        };
        let needed = self.settings.neutral_frames.max(1);
        let quietest = solving.solver.quietest_frames(needed);
        if quietest.len() < needed {
            let found = quietest.len();
            return Err(QuietestError::TooFew { found, needed });
        }
        let (alignment, neutral) =
            find_alignment(&self.actor, &quietest, self.unit).map_err(QuietestError::Alignment)?;
        self.realign(alignment, neutral);
        Ok(())
    }

    /// How many times the size of the face the last frame had, when that is another unit's doing.
    pub fn scale_jump(&self) -> Option<f64> {
        match &self.stage {
            Stage::Solving(solving) => solving.solver.scale_jump(),
            _ => None,
        }
    }

    /// Why the new neutral face that was asked for last could not be aligned.
    pub fn recenter_error(&self) -> Option<&AlignmentError> {
        self.recenter_error.as_ref()
    }

    /// Changes settings or moves to another revision of the actor, between two frames.
    /// The alignment is kept, its bindings carried over to the new mesh.
    /// An analyzer that waits for a request to align, and no longer should, starts to collect neutral frames.
    pub fn update(&mut self, actor: Arc<Actor>, settings: MarkerSettings) {
        if let Stage::Solving(solving) = &mut self.stage {
            let alignment = solving.alignment.carried_over(&self.actor, &actor);
            let mut next = Solving::new(&actor, &settings, self.rate_hz, alignment);
            next.solver.continue_from(&solving.solver);
            next.held_frames = solving.held_frames;
            next.last_index = solving.last_index;
            next.neutral = solving.neutral;
            next.recentering = solving.recentering.take();
            **solving = next;
        }
        if matches!(self.stage, Stage::Waiting) && !settings.align_on_request {
            self.stage = Stage::Collecting(Vec::new());
        }
        self.actor = actor;
        self.settings = settings;
    }

    /// The declared rate of the capture, when a new publisher declares another.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        self.rate_hz = rate_hz;
        if let Stage::Solving(solving) = &mut self.stage {
            solving.solver.set_rate_hz(rate_hz);
        }
    }

    /// The alignment in use.
    pub fn alignment(&self) -> Option<&Alignment> {
        match &self.stage {
            Stage::Solving(solving) => Some(&solving.alignment),
            _ => None,
        }
    }

    /// How far each muscle went since the alignment, and what that says about the basis; empty before it.
    pub fn ranges(&self) -> Vec<MuscleRange> {
        match &self.stage {
            Stage::Solving(solving) => {
                let mut ranges = solving.solver.ranges();
                // A face that was not at rest moves every muscle's zero: the shapes are not to blame.
                if solving.doubt().is_some() {
                    ranges.iter_mut().for_each(MuscleRange::withhold);
                }
                ranges
            }
            _ => Vec::new(),
        }
    }

    /// Whether the face that was taken as neutral is not; `None` while nothing says so.
    pub fn neutral_doubt(&self) -> Option<NeutralDoubt> {
        match &self.stage {
            Stage::Solving(solving) => solving.doubt(),
            _ => None,
        }
    }

    /// The actor in use.
    pub fn actor(&self) -> &Arc<Actor> {
        &self.actor
    }
}

/// The positions of the frames that show a face, once they are enough, or none more is waited for.
fn complete<'a>(
    frames: impl IntoIterator<Item = &'a MarkerFrame>,
    wanted: usize,
) -> Option<Vec<&'a [Option<PerformancePoint>]>> {
    let mut n_frames = 0;
    let usable: Vec<_> = frames
        .into_iter()
        .inspect(|_| n_frames += 1)
        .filter(|it| shows_a_face(it))
        .map(|it| it.positions.as_slice())
        .collect();
    (usable.len() >= wanted || n_frames >= wanted + UNUSABLE_FRAMES_KEPT).then_some(usable)
}

fn find_alignment(
    actor: &Actor,
    frames: &[&[Option<PerformancePoint>]],
    unit: LengthUnit,
) -> Result<(Alignment, NeutralEvidence), AlignmentError> {
    let mut mean = neutral::average(frames);
    mean.positions.resize(actor.markers().len(), None);
    let alignment = Alignment::find(actor, &mean, unit)?;
    Ok((alignment, NeutralEvidence::of(actor, frames, &mean)))
}

fn shows_a_face(frame: &MarkerFrame) -> bool {
    frame.positions.iter().flatten().count() >= MARKERS_IN_A_NEUTRAL_FRAME
}

impl Solving {
    fn new(actor: &Actor, settings: &MarkerSettings, rate_hz: f64, alignment: Alignment) -> Self {
        Self {
            solver: ContractionSolver::new(actor, &alignment, settings, rate_hz),
            alignment,
            held_frames: 0,
            last_index: None,
            neutral: None,
            recentering: None,
        }
    }

    /// What says that the neutral frames were not neutral.
    fn doubt(&self) -> Option<NeutralDoubt> {
        let neutral = self.neutral?;
        let quieter = || self.solver.quieter_frames_seen(neutral.residual_cm);
        neutral.contracted.or_else(quieter)
    }

    fn solve(&mut self, frame: &MarkerFrame) -> CurveSample {
        let solver = &mut self.solver;
        if let Some(last) = self.last_index {
            let missing = frame.index.0.saturating_sub(last.saturating_add(1));
            solver.pass(missing);
        }
        self.last_index = Some(frame.index.0);
        solver.solve(&frame.positions);
        solver.assess(&frame.positions);
        let regions = solver.regions().map(|(region, outcome)| RegionReport {
            region,
            marker_error_cm: outcome.marker_error_cm,
            n_markers: outcome.visible,
            quality: region_quality(&outcome),
            held_reason: outcome.held,
            quality_fraction: outcome.visible as f64 / outcome.expected.max(1) as f64,
        });
        let quality = overall_quality(regions.map(|it| it.quality));
        self.held_frames = match quality {
            Quality::Held => self.held_frames.saturating_add(1),
            Quality::Solved | Quality::Partial => 0,
        };
        CurveSample {
            frame: frame.index,
            capture_time_nanos: frame.capture_time_nanos,
            activations: solver.activations(),
            quality,
            held_frames: self.held_frames,
            regions,
            head: solver.head(),
            standard_errors: solver.standard_errors(),
            outliers: solver.outliers(),
            relabeled: solver.relabeled(),
            unobserved: solver.unobserved(),
            markers: trace(solver),
            kkt_residual: solver.kkt_residual(),
        }
    }
}

fn region_quality(outcome: &RegionOutcome) -> Quality {
    if outcome.held.is_some() {
        Quality::Held
    } else if outcome.visible < outcome.expected {
        Quality::Partial
    } else {
        Quality::Solved
    }
}

fn overall_quality([upper, lower]: [Quality; 2]) -> Quality {
    if upper == lower {
        upper
    } else {
        Quality::Partial
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the trace is for display, in f32 as it is sent"
)]
fn trace(solver: &ContractionSolver) -> MarkerTrace {
    let mut trace = MarkerTrace::default();
    for (marker, observed, reproduced) in solver.visible_markers() {
        trace.markers.push(marker);
        trace
            .observed_cm
            .extend(observed.iter().map(|it| *it as f32));
        trace
            .reproduced_cm
            .extend(reproduced.iter().map(|it| *it as f32));
    }
    trace
}
