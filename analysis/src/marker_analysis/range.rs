//! What a performance says about the basis: how far each muscle went, bounded and unbounded, and what that means for its
//! draft (Choe & Ko 2001, section 3; METHODS 6 for what the paper's rule misses).

/// What one muscle went through since the alignment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MuscleRange {
    /// Index into the actor's muscles.
    pub muscle: usize,
    /// Frames that were looked at.
    pub n_frames: u64,
    /// Of the contractions as they were sent.
    pub bounded: Percentiles,
    /// Of the least-squares solution without bounds, of the same frames.
    pub unbounded: Percentiles,
    /// Share of those frames in which the unbounded solution lay outside -0.1..=1.1.
    pub out_of_range: f64,
    /// What the artist should know.
    pub verdict: Verdict,
}

/// The first and the ninety-ninth percentile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Percentiles {
    /// Below it lies 1 % of the values.
    pub p1: f64,
    /// Above it lies 1 % of the values.
    pub p99: f64,
}

/// A muscle's draft, judged by a performance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Verdict {
    /// Too little was seen of it to say.
    #[default]
    NotYetSeen,
    /// Nothing speaks against it.
    Sound,
    /// Full contractions move the markers further than the draft does.
    TooWeak,
    /// Its own contractions never come near 1.
    TooStrong,
    /// The markers move against it.
    WrongDirection,
    /// The markers hardly tell it from noise or from other muscles.
    HardlyObservable,
}

impl Verdict {
    /// The identifier on the wire.
    pub fn identifier(self) -> &'static str {
        match self {
            Self::NotYetSeen => "NOT_YET_SEEN",
            Self::Sound => "SOUND",
            Self::TooWeak => "TOO_WEAK",
            Self::TooStrong => "TOO_STRONG",
            Self::WrongDirection => "WRONG_DIRECTION",
            Self::HardlyObservable => "HARDLY_OBSERVABLE",
        }
    }
}
