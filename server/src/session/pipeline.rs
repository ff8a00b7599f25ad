//! A session's analyzer with everything that must leave in frame order around it.
//!
//! A frame gives one sample, at once or when the alignment is known, or one gap; gaps keep their place among samples that
//! are still to come (CONTRACTS D-3, D-4). A panic in one frame's work costs that frame (O-8).

use std::{
    collections::VecDeque,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Progress, QuietestError},
    curve::CurveSample,
    face::{
        actor::Actor,
        marker::{FrameIndex, MarkerFrame},
    },
    marker_analysis::alignment::{Alignment, AlignmentError},
    numeric::tape::TapeError,
    space::PerformancePoint,
};

use super::{
    figures::Judgement,
    frame::IncomingFrame,
    intake::MAX_CONSECUTIVE_REJECTS,
    queue::WaitingFrame,
    settings::{RestoredAlignment, SessionSettings, SessionSpec, StreamShape},
    starting_point::{StartingPoint, StreamPoint},
};
use crate::hub::{Gap, GapCause, Outgoing, PublishedSample, SampleTag};

/// Most frames and gaps that wait for an alignment. The analyzer keeps far fewer frames; this bounds what a stream of
/// gaps could add.
const MAX_AWAITING: usize = 4_096;

/// What leaves the pipeline, in frame order.
#[derive(Debug)]
pub(super) enum Outcome {
    /// A sample with what its frame brought along.
    Sample(Box<CurveSample>, FrameNote),
    /// Numbers without samples.
    Gap(Gap),
}

/// What is remembered of a frame until its sample is there.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameNote {
    pub(super) number: u64,
    pub(super) tag: SampleTag,
    pub(super) received_nanos: i64,
    pub(super) started_nanos: i64,
    /// Its sample came with the alignment; until then it waited for other frames, so its times say nothing of the work.
    pub(super) was_collected: bool,
}

/// How a frame went.
#[derive(Debug, PartialEq)]
pub(super) enum Step {
    /// As the analyzer says.
    Progress(Progress),
    /// The neutral frames could not be aligned; they gave gaps.
    NotAligned(AlignmentError),
    /// The frame's work panicked; it gave a gap.
    Panicked,
    /// The frame came after those that ended its publication; it gave a gap.
    GivenUp,
}

#[derive(Debug)]
enum Awaiting {
    Frame(FrameNote),
    Gap(Gap),
}

/// One session's way from frames to samples. Owned by its task.
pub(super) struct Pipeline {
    actor: Arc<Actor>,
    settings: MarkerSettings,
    restored: Option<RestoredAlignment>,
    /// Whether a neutral face was asked for that was not tried yet. It outlives the analyzer, which is made anew for another
    /// stream and after a panic.
    recenter_requested: bool,
    /// What frames give until the next request: those before them have ended their publication.
    giving_up: Option<GapCause>,
    /// Frames at another scale, in a row.
    n_scale_jumps: u32,
    source: Option<SourceOfFrames>,
    awaiting: VecDeque<Awaiting>,
    solved: Vec<CurveSample>,
}

/// The analyzer with the stream that it reads.
struct SourceOfFrames {
    analyzer: MarkerAnalyzer,
    shape: StreamShape,
    rate_hz: f64,
    /// For each marker of the actor its place in the stream.
    stream_idx_of_marker: Vec<Option<usize>>,
}

impl Pipeline {
    pub(super) fn new(spec: &SessionSpec) -> Self {
        Self {
            actor: Arc::clone(&spec.actor),
            settings: spec.settings.marker.clone(),
            restored: spec.restored.clone(),
            recenter_requested: false,
            giving_up: None,
            n_scale_jumps: 0,
            source: None,
            awaiting: VecDeque::new(),
            solved: Vec::new(),
        }
    }

    /// Goes on from `point`; `actor` is of its revision. Frames that wait for a neutral face there are not answered again.
    pub(super) fn restore(actor: Arc<Actor>, point: StartingPoint) -> Result<Self, TapeError> {
        let settings = point.settings.marker;
        let mut restored = point.alignment;
        let source = match point.stream {
            None => None,
            Some(stream) => {
                let alignment = restored.take().map(|it| it.alignment);
                let (unit, rate_hz) = (stream.shape.unit, stream.rate_hz);
                Some(SourceOfFrames {
                    analyzer: MarkerAnalyzer::restore(
                        Arc::clone(&actor),
                        settings.clone(),
                        unit,
                        rate_hz,
                        alignment,
                        stream.state,
                    )?,
                    stream_idx_of_marker: stream_indices(&actor, &stream.shape),
                    shape: stream.shape,
                    rate_hz,
                })
            }
        };
        Ok(Self {
            actor,
            settings,
            restored,
            recenter_requested: point.is_recentering,
            giving_up: point.giving_up,
            n_scale_jumps: point.n_scale_jumps,
            source,
            awaiting: VecDeque::new(),
            solved: Vec::new(),
        })
    }

    /// What the next frames are solved from.
    pub(super) fn starting_point(
        &mut self,
        settings: SessionSettings,
        actor_revision: u32,
    ) -> StartingPoint {
        let stream = self.source.as_mut().map(|source| StreamPoint {
            shape: source.shape.clone(),
            rate_hz: source.rate_hz,
            state: source.analyzer.state(),
        });
        StartingPoint {
            settings,
            actor_revision,
            alignment: self.alignment_with_shape(),
            stream,
            is_recentering: self.recenter_requested,
            giving_up: self.giving_up,
            n_scale_jumps: self.n_scale_jumps,
        }
    }

    /// Reads frames of this shape from now on. An alignment holds on for the same shape only; returns whether one was
    /// given up (CONTRACTS D-30a).
    pub(super) fn read_from(
        &mut self,
        shape: StreamShape,
        rate_hz: f64,
        outcomes: &mut Vec<Outcome>,
    ) -> bool {
        self.giving_up = None;
        if let Some(source) = self.source.as_mut().filter(|it| it.shape == shape) {
            source.rate_hz = rate_hz;
            source.analyzer.set_rate_hz(rate_hz);
            return false;
        }
        let had_alignment = self.alignment().is_some();
        self.give_up_awaiting(outcomes);
        let restored = self.restored.take().filter(|it| it.shape == shape);
        let alignment = restored.map(|it| it.alignment);
        let is_lost = had_alignment && alignment.is_none();
        let analyzer = self.analyzer(&shape, rate_hz, alignment);
        self.source = Some(SourceOfFrames {
            analyzer,
            stream_idx_of_marker: stream_indices(&self.actor, &shape),
            shape,
            rate_hz,
        });
        is_lost
    }

    fn analyzer(
        &self,
        shape: &StreamShape,
        rate_hz: f64,
        alignment: Option<Alignment>,
    ) -> MarkerAnalyzer {
        let actor = Arc::clone(&self.actor);
        let settings = self.settings.clone();
        let mut analyzer = match alignment {
            Some(it) => MarkerAnalyzer::resume(actor, settings, shape.unit, rate_hz, it),
            None => MarkerAnalyzer::new(actor, settings, shape.unit, rate_hz),
        };
        if self.recenter_requested {
            analyzer.recenter();
        }
        analyzer
    }

    /// Solves one frame; appends what is now known to `outcomes`.
    pub(super) fn push(
        &mut self,
        waiting: WaitingFrame,
        now_nanos: i64,
        outcomes: &mut Vec<Outcome>,
    ) -> Step {
        self.pass_gaps(waiting.gaps_before, outcomes);
        let IncomingFrame {
            number,
            capture_time_nanos,
            positions,
            tag,
            ..
        } = waiting.frame;
        if let Some(cause) = self.giving_up {
            self.pass_gaps(vec![Gap::of_frame(number, cause)], outcomes);
            return Step::GivenUp;
        }
        let Some(source) = &mut self.source else {
            // Frames follow their source through the queue, so this does not happen; if it did, no frame may be silent.
            self.pass_gaps(vec![Gap::of_frame(number, GapCause::NotAligned)], outcomes);
            return Step::Progress(Progress::Waiting);
        };
        self.awaiting.push_back(Awaiting::Frame(FrameNote {
            number,
            tag,
            received_nanos: waiting.received_nanos,
            started_nanos: now_nanos,
            was_collected: source.analyzer.alignment().is_none(),
        }));
        let frame = MarkerFrame {
            index: FrameIndex(number),
            capture_time_nanos,
            positions: in_actor_order(positions, &source.stream_idx_of_marker),
        };
        let (analyzer, solved) = (&mut source.analyzer, &mut self.solved);
        // The analyzer is made anew after a panic, so nothing half changed is seen.
        match catch_unwind(AssertUnwindSafe(|| analyzer.push(frame, solved))) {
            Ok(Ok(progress)) => {
                let was_tried = matches!(progress, Progress::Aligned | Progress::RecenterFailed);
                self.recenter_requested &= !was_tried;
                self.count_scale_jump(progress == Progress::ScaleJump);
                if progress == Progress::ScaleJump {
                    self.reject_newest(outcomes);
                }
                self.settle(progress, outcomes);
                Step::Progress(progress)
            }
            Ok(Err(error)) => {
                // The request was tried; the analyzer waits for the next one, or collects anyway.
                self.recenter_requested = false;
                self.giving_up = Some(GapCause::NotAligned);
                self.solved.clear();
                self.give_up_awaiting(outcomes);
                Step::NotAligned(error)
            }
            Err(_panic) => {
                self.recover(outcomes);
                Step::Panicked
            }
        }
    }

    /// Many in a row end the publication (CONTRACTS D-10).
    fn count_scale_jump(&mut self, is_one: bool) {
        self.n_scale_jumps = if is_one {
            self.n_scale_jumps.saturating_add(1)
        } else {
            0
        };
        if self.n_scale_jumps >= MAX_CONSECUTIVE_REJECTS {
            self.giving_up = Some(GapCause::Rejected);
        }
    }

    /// Whether the frames that follow are not looked at until the next request.
    pub(super) fn is_giving_up(&self) -> bool {
        self.giving_up.is_some()
    }

    /// Passes numbers without frames, behind what is still awaited.
    pub(super) fn pass_gaps(&mut self, gaps: Vec<Gap>, outcomes: &mut Vec<Outcome>) {
        if self.awaiting.is_empty() {
            outcomes.extend(gaps.into_iter().map(Outcome::Gap));
            return;
        }
        for gap in gaps {
            match self.awaiting.back_mut() {
                Some(Awaiting::Gap(last)) if last.is_continued_by(&gap) => last.last = gap.last,
                _ => self.awaiting.push_back(Awaiting::Gap(gap)),
            }
        }
        while self.awaiting.len() > MAX_AWAITING {
            self.give_up_oldest(outcomes);
        }
    }

    fn settle(&mut self, progress: Progress, outcomes: &mut Vec<Outcome>) {
        let mut solved = std::mem::take(&mut self.solved);
        for sample in solved.drain(..) {
            self.settle_sample(sample, outcomes);
        }
        self.solved = solved;
        // Samples come for collected frames only; what else is still here will never have one.
        if !matches!(progress, Progress::Collecting { .. }) {
            self.give_up_awaiting(outcomes);
        }
    }

    fn settle_sample(&mut self, sample: CurveSample, outcomes: &mut Vec<Outcome>) {
        let number = sample.frame.0;
        let is_awaited =
            |it: &Awaiting| matches!(it, Awaiting::Frame(note) if note.number == number);
        if !self.awaiting.iter().any(is_awaited) {
            return;
        }
        while let Some(oldest) = self.awaiting.pop_front() {
            match oldest {
                Awaiting::Frame(note) if note.number == number => {
                    outcomes.push(Outcome::Sample(Box::new(sample), note));
                    return;
                }
                other => outcomes.push(Outcome::Gap(other.into_gap())),
            }
        }
    }

    fn give_up_oldest(&mut self, outcomes: &mut Vec<Outcome>) {
        if let Some(oldest) = self.awaiting.pop_front() {
            push_gap(oldest.into_gap(), outcomes);
        }
    }

    /// Frames that wait for an alignment that will not come give gaps.
    pub(super) fn give_up_awaiting(&mut self, outcomes: &mut Vec<Outcome>) {
        while !self.awaiting.is_empty() {
            self.give_up_oldest(outcomes);
        }
    }

    /// The frame that was pushed last gives a gap; nothing before it is awaited any more.
    fn reject_newest(&mut self, outcomes: &mut Vec<Outcome>) {
        let newest = self.awaiting.pop_back();
        self.give_up_awaiting(outcomes);
        if let Some(Awaiting::Frame(note)) = newest {
            outcomes.push(Outcome::Gap(Gap::of_frame(note.number, GapCause::Rejected)));
        }
    }

    /// How many times the size of the face the last frame had, when it was not a face's.
    pub(super) fn scale_jump(&self) -> Option<f64> {
        self.source.as_ref()?.analyzer.scale_jump()
    }

    /// After a panic: its frame gives a gap, the analyzer starts again from the alignment, if there is one.
    fn recover(&mut self, outcomes: &mut Vec<Outcome>) {
        self.solved.clear();
        self.reject_newest(outcomes);
        if let Some(mut source) = self.source.take() {
            let alignment = source.analyzer.alignment().cloned();
            source.analyzer = self.analyzer(&source.shape, source.rate_hz, alignment);
            self.source = Some(source);
        }
    }

    /// Takes the next usable frames as the neutral face. An alignment holds on until the new one is known; without one,
    /// frames that were collected so far give gaps.
    pub(super) fn recenter(&mut self, outcomes: &mut Vec<Outcome>) {
        self.giving_up = None;
        self.give_up_awaiting(outcomes);
        self.recenter_requested = true;
        if let Some(source) = &mut self.source {
            source.analyzer.recenter();
        }
    }

    /// Takes the quietest frames seen so far as the neutral face, in place of any that was asked for.
    pub(super) fn recenter_on_quietest(&mut self) -> Result<(), QuietestError> {
        self.giving_up = None;
        let source = self.source.as_mut().ok_or(QuietestError::NotAligned)?;
        source.analyzer.recenter_on_quietest()?;
        self.recenter_requested = false;
        Ok(())
    }

    /// Why the neutral face that was asked for last could not be aligned, where an alignment holds on.
    pub(super) fn recenter_error(&self) -> Option<&AlignmentError> {
        self.source.as_ref()?.analyzer.recenter_error()
    }

    /// What the performance since the alignment says.
    pub(super) fn judgement(&self) -> Judgement {
        match &self.source {
            Some(source) => Judgement {
                ranges: source.analyzer.ranges(),
                neutral_doubt: source.analyzer.neutral_doubt(),
            },
            None => Judgement::default(),
        }
    }

    /// Changes settings or actor between two frames; an alignment is carried over.
    pub(super) fn update(&mut self, actor: Arc<Actor>, settings: MarkerSettings) {
        self.giving_up = None;
        if let Some(source) = &mut self.source {
            source.analyzer.update(Arc::clone(&actor), settings.clone());
            source.stream_idx_of_marker = stream_indices(&actor, &source.shape);
        } else if let Some(restored) = &mut self.restored {
            restored.alignment = restored.alignment.carried_over(&self.actor, &actor);
        }
        self.actor = actor;
        self.settings = settings;
    }

    /// The alignment in use, or waiting for its stream.
    pub(super) fn alignment(&self) -> Option<&Alignment> {
        match &self.source {
            Some(source) => source.analyzer.alignment(),
            None => self.restored.as_ref().map(|it| &it.alignment),
        }
    }

    /// The same with its stream.
    pub(super) fn alignment_with_shape(&self) -> Option<RestoredAlignment> {
        Some(RestoredAlignment {
            alignment: self.alignment()?.clone(),
            shape: self.shape()?.clone(),
        })
    }

    pub(super) fn actor(&self) -> &Arc<Actor> {
        &self.actor
    }

    /// The stream that the alignment holds for.
    pub(super) fn shape(&self) -> Option<&StreamShape> {
        match &self.source {
            Some(source) => Some(&source.shape),
            None => self.restored.as_ref().map(|it| &it.shape),
        }
    }
}

impl Outcome {
    /// On its way to whoever listens.
    pub(super) fn into_outgoing(self, solved_time_nanos: i64, actor_revision: u32) -> Outgoing {
        match self {
            Self::Gap(gap) => Outgoing::Gap(gap),
            Self::Sample(sample, note) => Outgoing::Sample(Box::new(PublishedSample {
                sequence: 0,
                sample: *sample,
                tag: note.tag,
                solved_time_nanos,
                actor_revision,
            })),
        }
    }
}

impl Awaiting {
    fn into_gap(self) -> Gap {
        match self {
            Self::Gap(gap) => gap,
            Self::Frame(note) => Gap::of_frame(note.number, GapCause::NotAligned),
        }
    }
}

fn push_gap(gap: Gap, outcomes: &mut Vec<Outcome>) {
    match outcomes.last_mut() {
        Some(Outcome::Gap(last)) if last.is_continued_by(&gap) => last.last = gap.last,
        _ => outcomes.push(Outcome::Gap(gap)),
    }
}

fn stream_indices(actor: &Actor, shape: &StreamShape) -> Vec<Option<usize>> {
    let place = |name: &str| shape.marker_names.iter().position(|it| it == name);
    actor.markers().iter().map(|it| place(&it.name)).collect()
}

/// The positions of the actor's markers; a frame without markers has none of them.
fn in_actor_order(
    positions: Vec<Option<PerformancePoint>>,
    stream_idx_of_marker: &[Option<usize>],
) -> Vec<Option<PerformancePoint>> {
    let same_order = stream_idx_of_marker.len() == positions.len()
        && (0..)
            .zip(stream_idx_of_marker)
            .all(|(i, it)| *it == Some(i));
    if same_order {
        return positions;
    }
    let position = |idx: &Option<usize>| idx.and_then(|it| positions.get(it).copied().flatten());
    stream_idx_of_marker.iter().map(position).collect()
}

#[cfg(test)]
mod tests;
