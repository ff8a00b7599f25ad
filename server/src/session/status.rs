//! The state of a session in figures, for people and programs that watch over it.

use frontalis_analysis::marker_analysis::{neutral_watch::NeutralDoubt, range::MuscleRange};

use super::clock_estimate::ClockReport;
use crate::hub::{Latency, SessionState, SubscriberStatus};

/// A session's figures at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SessionStatus {
    /// The state.
    pub state: SessionState,
    /// Why the session failed.
    pub failure: Option<String>,
    /// The run.
    pub run: u64,
    /// Largest accepted frame number; 0 before the first.
    pub last_frame: u64,
    /// Sequence of the newest sample; 0 before the first.
    pub last_sequence: u64,
    /// Accepted frames a second, measured over the last seconds.
    pub frame_rate_hz: f64,
    /// Frames accepted.
    pub frames_received: u64,
    /// Frames refused, late ones included.
    pub frames_rejected: u64,
    /// Frames refused because their number had been passed.
    pub frames_late: u64,
    /// Frames that were sent again.
    pub frames_duplicate: u64,
    /// Frames taken but not solved, because newer ones waited.
    pub frames_shed: u64,
    /// Numbers that the capture system skipped.
    pub frames_missing: u64,
    /// Coordinate triples in which only one or two were missing.
    pub markers_partial: u64,
    /// The alignment in use.
    pub alignment: Option<AlignmentReport>,
    /// Why the last neutral face that was asked for could not be aligned: `UNITS_SUSPECT`, `MIRRORED`, ...
    /// Where there is an alignment it holds on.
    pub alignment_problem: Option<&'static str>,
    /// Why the face that was taken as neutral probably was not.
    pub neutral_doubt: Option<NeutralDoubt>,
    /// Time spent in each stage.
    pub latencies: Vec<StageLatency>,
    /// Everyone who listens.
    pub subscribers: Vec<SubscriberStatus>,
    /// Revision of the actor in use.
    pub actor_revision: u32,
    /// Range seen per control, in activation order.
    pub ranges: Vec<ControlRange>,
    /// Streamed markers that the actor does not have.
    pub unknown_markers: Vec<String>,
    /// How its publisher's clock stands to the server's; `None` before eight exchanges.
    pub clock: Option<ClockReport>,
    /// Who owns the session.
    pub publisher: Option<String>,
}

/// How well the neutral face was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignmentReport {
    /// Model centimeters per performance centimeter.
    pub scale: f64,
    /// Root mean square distance of the aligned markers from the mesh, centimeters.
    pub rms_residual_cm: f64,
    /// Rounds of similarity and projection.
    pub iterations: u32,
    /// Markers that took part.
    pub n_markers: usize,
}

/// One stage's times. Neutral frames are left out: their samples wait for the alignment, not for the server.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageLatency {
    /// `queued`, `solved`, `published`, `sent` from published to handed to a subscriber that keeps up, or `total` from frame
    /// received to sample published.
    pub stage: &'static str,
    /// Over the last thousand samples.
    pub latency: Latency,
}

/// What one control went through.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlRange {
    /// Name of the muscle.
    pub control: String,
    /// Smallest activation.
    pub min: f64,
    /// Largest activation.
    pub max: f64,
    /// What that says of its draft; `None` before the first look at it.
    pub judged: Option<MuscleRange>,
}
