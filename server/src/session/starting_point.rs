//! What the frames of a recording are solved from: a session's analysis between two frames.

use frontalis_analysis::numeric::tape::Entry;

use super::settings::{RestoredAlignment, SessionSettings, StreamShape};
use crate::hub::GapCause;

/// All that the samples of the frames that follow depend on, beside those frames and the actor.
#[derive(Clone, Debug, PartialEq)]
pub struct StartingPoint {
    /// In force.
    pub settings: SessionSettings,
    /// In use.
    pub actor_revision: u32,
    /// In use, or waiting for its stream.
    pub alignment: Option<RestoredAlignment>,
    /// The stream that is read; `None` before the first publisher.
    pub stream: Option<StreamPoint>,
    /// A neutral face was asked for that was not tried yet.
    pub is_recentering: bool,
    /// What frames give until the next request.
    pub giving_up: Option<GapCause>,
    /// Frames at another scale, in a row.
    pub n_scale_jumps: u32,
}

/// A stream with what the analyzer knows of it.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamPoint {
    /// As its publisher declared it.
    pub shape: StreamShape,
    /// Declared rate.
    pub rate_hz: f64,
    /// By [`MarkerAnalyzer::state`](frontalis_analysis::analyzer::MarkerAnalyzer::state).
    pub state: Vec<Entry>,
}
