//! What a session's door hands on to a recorder, and how much of it is known to be safe.

use super::{
    frame::IncomingFrame,
    recording::{Recorded, RecordedFrame, RecordedSource, RecordingFeed, RecordingTap, recording},
};

/// The recording side of a session's door; without a recording it only remembers who publishes.
#[derive(Debug, Default)]
pub(super) struct Tape {
    /// Who publishes, for a recording that begins later.
    source: Option<RecordedSource>,
    tap: Option<RecordingTap>,
    /// Whether a recording is over of which not all is on stable storage yet.
    is_settling: bool,
    durable_through: u64,
}

impl Tape {
    /// Hands on all that comes in from frame `next_frame` on; an earlier recording ends.
    pub(super) fn start(&mut self, next_frame: u64, accepted_through: u64) -> RecordingFeed {
        let (tap, feed) = recording(next_frame);
        if let Some(source) = &self.source {
            tap.record(Recorded::Source(source.clone()));
        }
        self.durable_through = accepted_through;
        self.tap = Some(tap);
        feed
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
        self.source = Some(source);
    }

    /// Hands on what stands among the frames where it takes effect.
    pub(super) fn note(&self, recorded: Recorded) {
        if let Some(tap) = &self.tap {
            tap.record(recorded);
        }
    }

    /// Hands on a frame that was taken.
    pub(super) fn frame(&self, frame: &IncomingFrame, received_nanos: i64, is_late: bool) {
        self.note(Recorded::Frame(RecordedFrame {
            number: frame.number,
            received_nanos,
            sent: frame.sent.clone(),
            is_late,
        }));
    }
}
