//! What a session publishes: samples, and gaps where frames gave none (CONTRACTS D-2, D-4).

use frontalis_analysis::{curve::CurveSample, timecode::Timecode};

/// One curve sample with its place in the stream and what its frame brought along.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedSample {
    /// Position in the run: from 1, without holes. The hub assigns it.
    pub sequence: u64,
    /// The curves.
    pub sample: CurveSample,
    /// What the frame brought along.
    pub tag: SampleTag,
    /// When the sample left the session's worker, server clock.
    pub solved_time_nanos: i64,
    /// Revision of the actor that solved it.
    pub actor_revision: u32,
}

/// What a frame brings along that the analysis does not use.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleTag {
    /// The capture system's own number.
    pub source_frame: u64,
    /// Time of day on the stage, when it was valid.
    pub timecode: Option<Timecode>,
    /// The capture time on the server's clock, once the publisher's clock is known.
    pub capture_time_server_nanos: Option<i64>,
    /// The frame's timecode was not one, and was dropped.
    pub timecode_invalid: bool,
    /// The capture time did not grow.
    pub time_non_monotonic: bool,
}

impl PublishedSample {
    /// Bytes of memory that the sample holds, for the limits of the window.
    pub(super) fn cost_bytes(&self) -> usize {
        let sample = &self.sample;
        let trace = &sample.markers;
        size_of::<Self>()
            + size_of_val(sample.activations.as_slice())
            + size_of_val(sample.standard_errors.as_slice())
            + size_of_val(sample.unobserved.as_slice())
            + size_of_val(sample.outliers.as_slice())
            + size_of_val(sample.relabeled.as_slice())
            + size_of_val(trace.markers.as_slice())
            + size_of_val(trace.observed_cm.as_slice())
            + size_of_val(trace.reproduced_cm.as_slice())
    }
}

/// Frame numbers from first to last, both included, that gave no sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gap {
    /// First number without a sample.
    pub first: u64,
    /// Last number without a sample.
    pub last: u64,
    /// Why.
    pub cause: GapCause,
}

impl Gap {
    /// The gap of one frame.
    pub fn of_frame(number: u64, cause: GapCause) -> Self {
        Self {
            first: number,
            last: number,
            cause,
        }
    }

    /// How many numbers it spans.
    pub fn n_frames(&self) -> u64 {
        (self.last - self.first).saturating_add(1)
    }

    /// Appends to a list in order, joining a gap that continues the last one for the same cause.
    pub fn append_to(self, gaps: &mut Vec<Self>) {
        match gaps.last_mut() {
            Some(last) if last.is_continued_by(&self) => last.last = self.last,
            _ => gaps.push(self),
        }
    }

    /// Whether `next` is the same gap, going on.
    pub fn is_continued_by(&self, next: &Self) -> bool {
        self.cause == next.cause && self.last.checked_add(1) == Some(next.first)
    }
}

/// Why frame numbers gave no sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GapCause {
    /// The capture system skipped these numbers.
    CaptureSkip,
    /// The frames could not be used.
    Rejected,
    /// The session could not keep up.
    Shed,
    /// Another publisher went on with a later number.
    PublisherChange,
    /// Taken before the neutral face was known.
    NotAligned,
}

/// One entry on its way to the subscribers, in frame order.
#[derive(Clone, Debug)]
pub enum Outgoing {
    /// A sample; the hub sets its `sequence`.
    Sample(Box<PublishedSample>),
    /// Numbers without samples.
    Gap(Gap),
}

/// The life of a session (CONTRACTS D-23).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SessionState {
    /// No usable frame yet, or waiting for the request to align.
    #[default]
    Waiting,
    /// Collecting neutral frames.
    Aligning,
    /// Samples flow.
    Live,
    /// Was live; no frame for the stale timeout.
    Stale,
    /// Over.
    Ended,
    /// Broken; its status says why.
    Failed,
}

/// The session's state as a subscriber hears it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamState {
    /// The state, or the transition's target.
    pub session_state: SessionState,
    /// Time since the newest frame was received; 0 before the first.
    pub last_frame_age_nanos: i64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_that_continue_each_other_are_one() {
        let mut gaps = Vec::new();
        Gap::of_frame(3, GapCause::Shed).append_to(&mut gaps);
        Gap::of_frame(4, GapCause::Shed).append_to(&mut gaps);
        Gap::of_frame(5, GapCause::Rejected).append_to(&mut gaps);
        Gap::of_frame(7, GapCause::Rejected).append_to(&mut gaps);
        assert_eq!(gaps.len(), 3);
        assert_eq!(gaps[0].n_frames(), 2);
    }

    #[test]
    fn the_largest_gap_does_not_overflow() {
        let whole = Gap {
            first: 0,
            last: u64::MAX,
            cause: GapCause::CaptureSkip,
        };
        assert_eq!(whole.n_frames(), u64::MAX);
        assert!(!whole.is_continued_by(&Gap::of_frame(0, GapCause::CaptureSkip)));
    }
}
