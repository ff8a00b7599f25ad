//! The state of one session: marker frame in, curve sample out.

use std::sync::Arc;

use crate::{
    curve::CurveSample,
    face::{actor::Actor, marker::MarkerFrame},
    marker_analysis::alignment::{Alignment, AlignmentError},
};

/// How the regions of the face share one frame's problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RegionMode {
    /// All markers, all muscles and the head's pose in one problem.
    #[default]
    Joint,
    /// Upper and lower region apart, as in the paper (Choe & Ko 2001, section 4.1.2).
    Split,
}

/// What a session may choose about the analysis of its markers.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkerSettings {
    /// Frames registered rigidly and averaged for the alignment, 1..=256; the paper uses 1.
    pub neutral_frames: usize,
    /// Upper bound 2 instead of 1 for every contraction.
    pub allow_exaggeration: bool,
    /// One problem or two.
    pub region_mode: RegionMode,
    /// Solve for head motion in every frame.
    pub stabilize_head: bool,
    /// Align only after [`MarkerAnalyzer::recenter`], not on the first frames.
    pub align_on_request: bool,
}

impl Default for MarkerSettings {
    fn default() -> Self {
        Self {
            neutral_frames: 15,
            allow_exaggeration: false,
            region_mode: RegionMode::Joint,
            stabilize_head: true,
            align_on_request: false,
        }
    }
}

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Not used: alignment waits for a request. No sample will come of this frame.
    Waiting,
    /// Kept as a neutral frame; its sample follows when the alignment is known.
    Collecting {
        /// Neutral frames kept so far.
        collected: usize,
        /// Neutral frames wanted.
        wanted: usize,
    },
    /// The alignment is now known; the samples of all neutral frames were appended, in order.
    Aligned,
    /// One sample was appended.
    Solved,
}

/// Markers to muscle curves, one frame at a time.
pub struct MarkerAnalyzer {
    actor: Arc<Actor>,
}

impl MarkerAnalyzer {
    /// Starts without an alignment; `rate_hz` is the declared rate of the capture (finite, positive).
    pub fn new(actor: Arc<Actor>, settings: MarkerSettings, rate_hz: f64) -> Self {
        unimplemented!()
    }

    /// Starts from an alignment found before, with this actor or an earlier revision of it.
    pub fn resume(
        actor: Arc<Actor>,
        settings: MarkerSettings,
        rate_hz: f64,
        alignment: Alignment,
    ) -> Self {
        unimplemented!()
    }

    /// Takes one frame, markers in the actor's order; appends the samples that are now known to `samples`.
    ///
    /// # Errors
    ///
    /// When the collected neutral frames cannot be aligned: they are dropped, and collection starts over
    /// (or waits for the next request, with `align_on_request`).
    pub fn push(
        &mut self,
        frame: MarkerFrame,
        samples: &mut Vec<CurveSample>,
    ) -> Result<Progress, AlignmentError> {
        unimplemented!()
    }

    /// Takes the next usable frames as the neutral face again. The old alignment is forgotten at once.
    pub fn recenter(&mut self) {}

    /// Changes settings or moves to another revision of the actor, between two frames.
    /// The alignment is kept, its bindings carried over to the new mesh.
    pub fn update(&mut self, actor: Arc<Actor>, settings: MarkerSettings) {}

    /// The declared rate of the capture, when a new publisher declares another.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {}

    /// The alignment in use.
    pub fn alignment(&self) -> Option<&Alignment> {
        None
    }

    /// The actor in use.
    pub fn actor(&self) -> &Arc<Actor> {
        &self.actor
    }
}
