//! What a session may choose about the analysis of its markers.

use super::objective::{LARGEST_BOUND, Objective};

/// How the regions of the face share one frame's problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RegionMode {
    /// All markers, all muscles and the head's pose in one problem.
    #[default]
    Joint,
    /// Upper and lower region apart, as in the paper (Choe & Ko 2001, section 4.1.2).
    Split,
}

/// The choices of one session.
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
    /// Align only after [`recenter`](crate::analyzer::MarkerAnalyzer::recenter), not on the first frames.
    pub align_on_request: bool,
    /// Terms beside the paper's least squares, and bounds.
    pub objective: Objective,
}

impl Default for MarkerSettings {
    fn default() -> Self {
        Self {
            neutral_frames: 15,
            allow_exaggeration: false,
            region_mode: RegionMode::Joint,
            stabilize_head: true,
            align_on_request: false,
            objective: Objective::default(),
        }
    }
}

impl MarkerSettings {
    /// The paper's objective, nothing added; everything else by default.
    pub fn plain() -> Self {
        Self {
            objective: Objective::plain(),
            ..Self::default()
        }
    }

    /// Upper bound of every contraction that has none of its own.
    pub fn upper_bound(&self) -> f64 {
        if self.allow_exaggeration {
            LARGEST_BOUND
        } else {
            1.0
        }
    }
}
