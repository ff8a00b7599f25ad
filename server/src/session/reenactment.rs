//! A recorded performance, solved again by the way from frames to samples that a session's task takes.
//!
//! Whoever has the recording calls in its order; nothing here knows time or tasks.

use std::sync::Arc;

use frontalis_analysis::{
    analyzer::{NeutralSource, Progress},
    face::actor::Actor,
    numeric::tape::TapeError,
};

use super::{
    capture_order::CaptureOrder,
    clock_estimate::ClockReport,
    frame::IncomingFrame,
    pipeline::{Outcome, Pipeline, Step},
    queue::WaitingFrame,
    settings::{RestoredAlignment, SessionSettings, StreamShape},
    starting_point::StartingPoint,
};
use crate::hub::{Gap, Outgoing};

/// A session's analysis without the session.
pub struct Reenactment {
    pipeline: Pipeline,
    settings: SessionSettings,
    actor_revision: u32,
    capture_order: CaptureOrder,
    clock: Option<ClockReport>,
    outcomes: Vec<Outcome>,
    is_newly_aligned: bool,
}

impl Reenactment {
    /// Goes on from `point`; `actor` is of its revision. `last_capture_nanos` is the capture time of the frame before, where the
    /// next one's can be compared with it.
    ///
    /// # Errors
    ///
    /// [`TapeError`] when the point is not one of this actor and these settings.
    pub fn start(
        actor: Arc<Actor>,
        point: StartingPoint,
        last_capture_nanos: Option<i64>,
    ) -> Result<Self, TapeError> {
        Ok(Self {
            settings: point.settings.clone(),
            actor_revision: point.actor_revision,
            pipeline: Pipeline::restore(actor, point)?,
            capture_order: CaptureOrder::after(last_capture_nanos),
            clock: None,
            outcomes: Vec::new(),
            is_newly_aligned: false,
        })
    }

    /// Where it stands.
    pub fn starting_point(&mut self) -> StartingPoint {
        let settings = self.settings.clone();
        self.pipeline.starting_point(settings, self.actor_revision)
    }

    /// The frames that follow come from another grant, and perhaps another publisher.
    pub fn source(&mut self, shape: StreamShape, rate_hz: f64, is_other: bool) {
        if is_other {
            self.capture_order.another_clock();
        }
        self.clock = None;
        let _is_lost = self.pipeline.read_from(shape, rate_hz, &mut self.outcomes);
    }

    /// The frames that follow are solved so.
    pub fn change(&mut self, settings: SessionSettings, actor: Arc<Actor>, actor_revision: u32) {
        self.pipeline.update(actor, settings.marker.clone());
        self.is_newly_aligned |=
            actor_revision != self.actor_revision && self.pipeline.alignment().is_some();
        self.settings = settings;
        self.actor_revision = actor_revision;
    }

    /// Another neutral face was asked for.
    pub fn recenter(&mut self, source: NeutralSource) {
        match source {
            NeutralSource::NextFrames => self.pipeline.recenter(&mut self.outcomes),
            NeutralSource::QuietestFrames => {
                // Where there were too few of them the request was refused, as it is now.
                self.is_newly_aligned |= self.pipeline.recenter_on_quietest().is_ok();
            }
        }
    }

    /// Numbers without frames.
    pub fn gaps(&mut self, gaps: Vec<Gap>) {
        self.pipeline.pass_gaps(gaps, &mut self.outcomes);
    }

    /// The publisher's clock stood so from here on.
    pub fn clock(&mut self, report: ClockReport) {
        self.clock = Some(report);
    }

    /// A frame that was taken, to be solved or shed: says of its time what was said of it then.
    pub fn pass_time(&mut self, frame: &mut IncomingFrame) {
        let clock = self.clock;
        frame.tag.capture_time_server_nanos =
            clock.map(|it| it.on_server_clock(frame.capture_time_nanos));
        frame.tag.time_non_monotonic = self.capture_order.is_broken_by(frame.capture_time_nanos);
    }

    /// Solves a frame.
    pub fn frame(&mut self, frame: IncomingFrame, gaps_before: Vec<Gap>) {
        let waiting = WaitingFrame {
            frame,
            gaps_before,
            received_nanos: 0,
        };
        let step = self.pipeline.push(waiting, 0, &mut self.outcomes);
        self.is_newly_aligned |= step == Step::Progress(Progress::Aligned);
    }

    /// Nothing follows: frames that wait for a neutral face give gaps.
    pub fn finish(&mut self) {
        self.pipeline.give_up_awaiting(&mut self.outcomes);
    }

    /// What is known since the last call, in frame order; samples carry `solved_time_nanos`.
    pub fn outgoing(&mut self, solved_time_nanos: i64) -> impl Iterator<Item = Outgoing> + '_ {
        let revision = self.actor_revision;
        self.outcomes
            .drain(..)
            .map(move |it| it.into_outgoing(solved_time_nanos, revision))
    }

    /// The neutral face, once it is another than before.
    pub fn new_alignment(&mut self) -> Option<(RestoredAlignment, u32)> {
        if !std::mem::take(&mut self.is_newly_aligned) {
            return None;
        }
        Some((self.pipeline.alignment_with_shape()?, self.actor_revision))
    }

    /// In force.
    pub fn settings(&self) -> &SessionSettings {
        &self.settings
    }

    /// In use.
    pub fn actor_revision(&self) -> u32 {
        self.actor_revision
    }

    /// In use.
    pub fn actor(&self) -> &Arc<Actor> {
        self.pipeline.actor()
    }
}
