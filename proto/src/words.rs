//! What values that judge something say to people: the sentences that statuses carry and programs print.

use crate::v1::{NeutralDoubtCause, RangeVerdict};

impl RangeVerdict {
    /// What it says to the artist who made the muscle's shape.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Unspecified => "",
            Self::NotYetSeen => {
                "Too little was seen of this muscle to judge its shape: let the actor contract it fully."
            }
            Self::Sound => "Nothing speaks against this shape.",
            Self::TooWeak => {
                "Full contractions move the markers further than this shape does: make it stronger."
            }
            Self::TooStrong => {
                "Even the strongest contractions stay far below 1: let the actor contract this muscle fully, and if it stays so, make the shape weaker."
            }
            Self::WrongDirection => {
                "The markers move against this shape: correct the direction in which it moves the skin."
            }
            Self::NeutralInDoubt => {
                "The neutral face is in doubt, and with it all that could be said of this shape: recenter first."
            }
            Self::HardlyObservable => {
                "The markers hardly tell this muscle from noise or from other muscles, so its curve means little: put a marker where it moves the skin most."
            }
        }
    }
}

impl NeutralDoubtCause {
    /// What it says of the face that was taken as neutral.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Unspecified => "",
            Self::LooksContracted => {
                "The face was probably not at rest when it was taken as neutral."
            }
            Self::QuieterFramesSeen => {
                "Later frames fit the actor's neutral face better than those that were taken as neutral."
            }
        }
    }

    /// What to do about it in a session.
    pub fn advice(self) -> &'static str {
        match self {
            Self::Unspecified => "",
            Self::LooksContracted => {
                "Let the actor relax the face and recenter the session, or recenter it on its quietest frames."
            }
            Self::QuieterFramesSeen => {
                "Recenter the session on its quietest frames, or let the actor relax the face and recenter it on the next ones."
            }
        }
    }
}
