//! What became of the frames that were published.

use std::collections::BTreeMap;

use crate::proto::RejectedFrame;

use super::ranges::FrameRanges;

/// Counts of one publication, over all its connections.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PublishReport {
    /// Frames that went out, each counted once.
    pub sent_frames: u64,
    /// Frames that went out again after a reconnection.
    pub resent_frames: u64,
    /// Frames the server took.
    pub accepted_frames: u64,
    /// Frames whose numbers the session had before this publication began: the same content has no effect again.
    pub known_frames: u64,
    /// Frames the server refused, by reason.
    pub rejected: BTreeMap<String, Rejection>,
    /// Frames taken whose solve was skipped because newer ones waited.
    pub shed_frames: u64,
    /// Frames that fell out of the ring before the server had them.
    pub lost: FrameRanges,
    /// Frames without an answer when the publication ended.
    pub unacknowledged_frames: u64,
    /// Connections after the first.
    pub reconnections: u64,
    /// Number of the present grant.
    pub epoch: u64,
    /// The session's run; it grows when the session started over.
    pub run: u64,
    /// Runs that began during this publication, as after a restart of the server.
    pub new_runs: u64,
    /// Whether a take of the session was being recorded at the last answer.
    pub recording: bool,
    /// The last frame that is in the take, when the recording of the session ended while frames were published.
    pub recorded_through: Option<u64>,
    /// Every usable frame up to this number is with the server.
    pub accepted_through: u64,
    /// Every usable frame up to this number is on stable storage.
    pub durable_through: u64,
}

/// Frames refused for one reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// How many.
    pub frames: u64,
    /// The first of them.
    pub first_frame: u64,
    /// What the server said of the first.
    pub first_detail: String,
}

impl PublishReport {
    /// Frames refused for any reason.
    pub fn rejected_frames(&self) -> u64 {
        self.rejected.values().map(|it| it.frames).sum()
    }

    /// Counts one refused frame.
    pub(super) fn reject(&mut self, frame: RejectedFrame) {
        self.rejected
            .entry(frame.reason)
            .and_modify(|it| it.frames += 1)
            .or_insert(Rejection {
                frames: 1,
                first_frame: frame.number,
                first_detail: frame.detail,
            });
    }
}
