//! Whether the face that was taken as neutral was, and the quietest frames seen so far as a better one.
//!
//! A neutral face fits the artist's virtual markers by a similarity alone; a contraction leaves a residual that no
//! similarity explains. The frames with the least of it are the quietest.

/// Why the neutral frames are doubted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DoubtCause {
    /// Contractions explain what the neutral frames leave, far beyond their noise.
    LooksContracted,
    /// Later frames fit the neutral face clearly better than those that were taken.
    QuieterFramesSeen,
}

/// Says that the neutral frames probably were not neutral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeutralDoubt {
    /// Why.
    pub cause: DoubtCause,
    /// Root mean square distance of the neutral frames from the actor's neutral face, centimeters.
    pub residual_cm: f64,
    /// What it would be of a neutral face, centimeters: by the noise, or as seen in the quietest frames.
    pub expected_cm: f64,
}

impl DoubtCause {
    /// The identifier on the wire.
    pub fn identifier(self) -> &'static str {
        match self {
            Self::LooksContracted => "LOOKS_CONTRACTED",
            Self::QuieterFramesSeen => "QUIETER_FRAMES_SEEN",
        }
    }
}
