//! What leaves the analysis: one sample of all muscle curves at one captured instant.

use crate::{
    face::{marker::FrameIndex, region::FaceRegion},
    space::HeadPose,
};

/// How much of what the session expects stood behind a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// From all the evidence that the session expects.
    Solved,
    /// Markers or a region were missing; the values are the best from those that were there.
    Partial,
    /// Nothing usable in this frame; the last good values stand.
    Held,
}

/// Why a region's values stand still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldReason {
    /// Fewer than three, or fewer than 60 %, of the region's own markers were seen.
    TooFewMarkers,
    /// The visible markers do not determine the head's pose: identical, collinear, or mirrored.
    DegeneratePose,
    /// The solver reached its iteration limit.
    SolverBudget,
}

impl HeldReason {
    /// The identifier on the wire.
    pub fn identifier(self) -> &'static str {
        match self {
            Self::TooFewMarkers => "TOO_FEW_MARKERS",
            Self::DegeneratePose => "DEGENERATE_POSE",
            Self::SolverBudget => "SOLVER_BUDGET",
        }
    }
}

/// One region's evidence and error in one frame (Choe & Ko 2001, section 5 and figure 5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionReport {
    /// The region.
    pub region: FaceRegion,
    /// Mean over its visible markers of |observed − reproduced|, centimeters; 0 when held.
    pub marker_error_cm: f64,
    /// Markers of the region seen in this frame.
    pub n_markers: usize,
    /// Solved, partial, or held.
    pub quality: Quality,
    /// Why it is held.
    pub held_reason: Option<HeldReason>,
    /// Weight of the evidence used, relative to all that the actor has for this region, 0..1.
    pub quality_fraction: f64,
}

/// The markers of one frame, as seen and as the activations place them, in model space with head motion taken out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarkerTrace {
    /// Indices into the actor's markers of those seen in this frame.
    pub markers: Vec<usize>,
    /// x y z of each, centimeters.
    pub observed_cm: Vec<f32>,
    /// x y z of each, centimeters.
    pub reproduced_cm: Vec<f32>,
}

/// All muscles at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveSample {
    /// The frame it was solved from.
    pub frame: FrameIndex,
    /// The frame's capture time, as published.
    pub capture_time_nanos: i64,
    /// Contractions in the order of the actor's [`crate::face::muscle::MuscleSet`]; 0 relaxed, 1 full.
    pub activations: Vec<f64>,
    /// One sigma of each contraction, in the same order: from the frame's evidence, the terms of the objective and the noise
    /// seen lately. Finite; of a held or unobserved muscle what it was when it was last seen, or more.
    pub standard_errors: Vec<f64>,
    /// The worst of the regions, except that one held region beside a solved one makes the sample partial.
    pub quality: Quality,
    /// For how many frames in a row the values have stood still; 0 unless held.
    pub held_frames: u32,
    /// One report a region, in the order of [`FaceRegion::ALL`].
    pub regions: [RegionReport; 2],
    /// The head's motion since the neutral pose; `None` when it is not tracked or not known in this frame.
    pub head: Option<HeadPose>,
    /// Muscles that the visible markers cannot determine in this frame: they decay from their last value.
    pub unobserved: Vec<usize>,
    /// Indices into the actor's markers of those seen that were masked, because they lie far from what the others say.
    pub outliers: Vec<usize>,
    /// Pairs of markers, by index, whose labels were swapped and have been put right.
    pub relabeled: Vec<[usize; 2]>,
    /// The markers behind the sample.
    pub markers: MarkerTrace,
    /// KKT residual of the solution, relative to the largest diagonal entry of Q; 0 when held.
    pub kkt_residual: f64,
}
