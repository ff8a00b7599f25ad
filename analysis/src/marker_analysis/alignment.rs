//! Coordinate alignment of a performance to the actor's neutral face (Choe & Ko 2001, section 4.1.1).

use crate::{
    face::marker::VirtualMarker,
    space::{LengthUnit, Similarity},
};

/// Where the capture system's axes lie on the actor, and where each marker sits on the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// The similarity from performance to model space.
    pub model_from_performance: Similarity,
    /// One entry a marker of the actor: its place on the mesh; `None` when it was never seen in the neutral frames.
    pub bindings: Vec<Option<VirtualMarker>>,
    /// Root mean square distance of the aligned markers from their virtual markers, centimeters.
    pub rms_residual_cm: f64,
    /// Rounds of similarity and projection.
    pub iterations: u32,
}

impl Alignment {
    /// Markers that took part.
    pub fn n_markers(&self) -> usize {
        self.bindings.iter().flatten().count()
    }
}

/// Why the neutral frames could not be aligned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AlignmentError {
    /// The face's extent is not that of a face in the declared unit.
    #[error(
        "the neutral markers span {extent_m:.4} m, a face spans 0.05 to 0.60 m: the coordinates are probably in {likely}"
    )]
    UnitsSuspect {
        /// Measured extent, in meters as declared.
        extent_m: f64,
        /// Symbol of the unit in which the extent would be plausible, or "another unit".
        likely: &'static str,
        /// The unit, when one fits, relative to the declared one's centimeters.
        unit: Option<LengthUnit>,
    },
    /// The markers fit the face only mirrored.
    #[error(
        "the neutral markers are a mirror image of the face: left and right, or an axis, are swapped"
    )]
    Mirrored,
    /// Too few markers of a region were seen in the neutral frames.
    #[error("too few markers in the neutral frames: {}", missing.join(", "))]
    NeutralIncomplete {
        /// Names of the markers never seen.
        missing: Vec<String>,
    },
    /// The markers do not span space: identical or collinear.
    #[error("the neutral markers are identical or lie on a line")]
    Degenerate,
}
