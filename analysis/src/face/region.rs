//! The two regions of the face that the paper solves apart (Choe & Ko 2001, section 4.1.2).

/// The part of the face that a muscle moves and that a marker observes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FaceRegion {
    /// Brows, forehead, eyelids.
    Upper,
    /// Cheeks, mouth, jaw.
    Lower,
}

impl FaceRegion {
    /// Both regions, in the order of every per-region array.
    pub const ALL: [Self; 2] = [Self::Upper, Self::Lower];

    /// Position in [`FaceRegion::ALL`].
    pub fn index(self) -> usize {
        match self {
            Self::Upper => 0,
            Self::Lower => 1,
        }
    }

    /// `upper` or `lower`, as in an actor package.
    pub fn name(self) -> &'static str {
        match self {
            Self::Upper => "upper",
            Self::Lower => "lower",
        }
    }
}
