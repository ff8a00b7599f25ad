//! What a session's door hands on to a recorder, and how much of it is known to be safe.

use super::{
    clock_estimate::ClockReport,
    frame::IncomingFrame,
    pre_roll::PreRoll,
    recording::{Recorded, RecordedFrame, RecordedSource, RecordingFeed, RecordingTap, recording},
};

/// The recording side of a session's door; without a recording it only remembers who publishes.
#[derive(Debug)]
pub(super) struct Tape {
    /// Who publishes, for a recording that begins later.
    source: Option<RecordedSource>,
    /// How the publisher's clock stands.
    clock: Option<ClockReport>,
    pre_roll: PreRoll,
    tap: Option<RecordingTap>,
    /// Whether a recording is over of which not all is on stable storage yet.
    is_settling: bool,
    durable_through: u64,
}

impl Tape {
    /// Remembers `pre_roll` of what came, for recordings to come.
    pub(super) fn new(pre_roll: PreRoll) -> Self {
        Self {
            source: None,
            clock: None,
            pre_roll,
            tap: None,
            is_settling: false,
            durable_through: 0,
        }
    }

    /// Hands on all that comes in from frame `next_frame` on; an earlier recording ends.
    pub(super) fn start(
        &mut self,
        next_frame: u64,
        accepted_through: u64,
        last_capture_nanos: Option<i64>,
        pre_roll_since_nanos: Option<i64>,
    ) -> (RecordingTap, RecordingFeed) {
        let (tap, mut feed) = recording(next_frame, last_capture_nanos);
        if let Some(since_nanos) = pre_roll_since_nanos {
            feed.pre_roll = self.pre_roll.since(since_nanos);
        }
        if let Some(source) = &self.source {
            tap.record(Recorded::Source(RecordedSource {
                is_continued: true,
                is_other: false,
                ..source.clone()
            }));
        }
        if let Some(clock) = self.clock {
            tap.record(Recorded::Clock(clock));
        }
        self.durable_through = accepted_through;
        self.tap = Some(tap.clone());
        (tap, feed)
    }

    /// Hands on nothing more. Until [`Self::settled`] the publisher still waits for stable storage.
    pub(super) fn stop(&mut self) {
        self.is_settling |= self.tap.take().is_some();
    }

    /// What was handed on is on stable storage, or never will be.
    pub(super) fn settled(&mut self) {
        self.is_settling = false;
    }

    /// Whether an answer to a publisher waits for stable storage.
    pub(super) fn is_recorded(&self) -> bool {
        self.tap.is_some() || self.is_settling
    }

    /// Whether frames are handed on.
    pub(super) fn is_recording(&self) -> bool {
        self.tap.is_some()
    }

    /// Whether a frame may be taken: what cannot be recorded is not.
    pub(super) fn has_room(&self) -> bool {
        self.tap.as_ref().is_none_or(RecordingTap::has_room)
    }

    /// Every frame up to this one is on stable storage.
    pub(super) fn set_durable_through(&mut self, number: u64) {
        self.durable_through = self.durable_through.max(number);
    }

    /// The last frame that is on stable storage with all before it; 0 without a recording.
    pub(super) fn durable_through(&self) -> u64 {
        if self.is_recorded() {
            self.durable_through
        } else {
            0
        }
    }

    /// The frames that follow come from this publisher.
    pub(super) fn source(&mut self, source: RecordedSource) {
        self.note(Recorded::Source(source.clone()));
        let is_other = |it: &RecordedSource| it.shape != source.shape;
        if self.source.as_ref().is_some_and(is_other) {
            self.pre_roll.clear();
        }
        self.source = Some(source);
        // What was known is of another stream, and perhaps of another clock.
        self.clock = None;
    }

    /// The publisher's clock stands so from now on.
    pub(super) fn clock(&mut self, report: ClockReport) {
        self.note(Recorded::Clock(report));
        self.clock = Some(report);
    }

    /// Hands on what stands among the frames where it takes effect.
    pub(super) fn note(&self, recorded: Recorded) {
        if let Some(tap) = &self.tap {
            tap.record(recorded);
        }
    }

    /// Hands on a frame that was taken.
    pub(super) fn frame(&mut self, frame: &IncomingFrame, received_nanos: i64, is_late: bool) {
        let recorded = RecordedFrame {
            number: frame.number,
            received_nanos,
            timecode: frame.tag.timecode,
            sent: frame.sent.clone(),
            is_late,
        };
        if self.tap.is_some() {
            self.note(Recorded::Frame(recorded.clone()));
        }
        if !is_late {
            self.pre_roll.push(recorded);
        }
    }
}
