//! A frame on its way into a session, and the answer to one that cannot be used.

use bytes::Bytes;
use frontalis_analysis::space::PerformancePoint;

use crate::hub::SampleTag;

/// A frame that is valid in itself; the session judges its number and its time.
#[derive(Clone, Debug, PartialEq)]
pub struct IncomingFrame {
    /// The publisher's number.
    pub number: u64,
    /// When the shutter opened, on the publisher's clock.
    pub capture_time_nanos: i64,
    /// One entry a marker of the publisher's list; `None` is occluded. Empty when the frame had no markers.
    pub positions: Vec<Option<PerformancePoint>>,
    /// What travels along to the sample.
    pub tag: SampleTag,
    /// Hash of everything that was sent, to tell a resent frame from another one.
    pub content_hash: u64,
    /// Markers of which only one or two coordinates were missing.
    pub n_partial_markers: usize,
    /// The message that brought it, for whoever records it.
    pub sent: Bytes,
}

impl IncomingFrame {
    /// Bytes of memory that the frame holds while it waits.
    pub(super) fn cost_bytes(&self) -> usize {
        size_of::<Self>()
            + self.sent.len()
            + self.positions.capacity() * size_of::<Option<PerformancePoint>>()
    }
}

/// A frame that was not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// The frame's number.
    pub number: u64,
    /// Identifier of the bad-input table: `NON_FINITE`, `MARKER_COUNT`, ...
    pub reason: &'static str,
    /// For a person; without coordinates.
    pub detail: String,
}
