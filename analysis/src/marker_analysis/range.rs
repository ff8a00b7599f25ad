//! What a performance says about the basis: how far each muscle went, bounded and unbounded, and what that means for its
//! draft (Choe & Ko 2001, section 3; METHODS 6 for what the paper's rule misses).

mod histogram;

use histogram::Histogram;

/// Frames in which a muscle must have been active, beyond [`ACTIVE`], before its draft is judged.
const LEAST_ACTIVE_FRAMES: u64 = 15;

/// A contraction that counts as one.
const ACTIVE: f64 = 0.1;

/// Where an unbounded p99 says that the draft is too weak (METHODS 6).
const TOO_WEAK: f64 = 1.15;

/// Where the p99 of a muscle's isolated attempts says that the draft is too strong (METHODS 6).
const TOO_STRONG: f64 = 0.85;

/// Where an unbounded p1 says that the draft points the wrong way (METHODS 6), beyond what noise alone does.
const WRONG_DIRECTION: f64 = -0.25;
const NOISE_SIGMAS: f64 = 2.5;

/// A muscle with a larger standard error in the mean is hardly observable.
const HARDLY_OBSERVABLE: f64 = 0.25;

/// A frame is an isolated attempt of the muscle that makes at least this share of all displacement in it.
const ISOLATED_SHARE: f64 = 0.8;

/// The unbounded solution counts as out of range beyond these.
const IN_RANGE: std::ops::RangeInclusive<f64> = -0.1..=1.1;

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

impl MuscleRange {
    /// Says nothing of the draft, because the neutral face is in doubt.
    pub fn withhold(&mut self) {
        if self.verdict != Verdict::NotYetSeen {
            self.verdict = Verdict::NeutralInDoubt;
        }
    }
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
    /// Nothing can be said while the neutral face is in doubt.
    NeutralInDoubt,
}

/// One frame for the tracker; everything by muscle, in the solver's order.
pub(super) struct Looked<'a> {
    pub bounded: &'a [f64],
    pub unbounded: &'a [f64],
    pub standard_errors: &'a [f64],
    /// How far a full contraction moves all markers together, centimeters.
    pub mobility_cm: &'a [f64],
}

/// Ranges of all muscles, as they are seen.
#[derive(Clone, Debug)]
pub(super) struct RangeTracker {
    muscles: Vec<Seen>,
}

#[derive(Clone, Debug, Default)]
struct Seen {
    bounded: Histogram,
    unbounded: Histogram,
    /// Of its isolated attempts only.
    isolated: Histogram,
    n_active: u64,
    n_out_of_range: u64,
    standard_errors: f64,
}

impl RangeTracker {
    pub fn new(n_muscles: usize) -> Self {
        Self {
            muscles: vec![Seen::default(); n_muscles],
        }
    }

    /// Takes in one frame in which every muscle was observed.
    pub fn look(&mut self, frame: &Looked<'_>) {
        let moved = |i: usize| frame.bounded[i] * frame.mobility_cm[i];
        let all: f64 = (0..self.muscles.len()).map(moved).sum();
        for (i, seen) in self.muscles.iter_mut().enumerate() {
            let (bounded, unbounded) = (frame.bounded[i], frame.unbounded[i]);
            seen.bounded.add(bounded);
            seen.unbounded.add(unbounded);
            seen.standard_errors += frame.standard_errors[i];
            seen.n_active += u64::from(bounded > ACTIVE);
            seen.n_out_of_range += u64::from(!IN_RANGE.contains(&unbounded));
            if bounded > ACTIVE && moved(i) >= ISOLATED_SHARE * all {
                seen.isolated.add(unbounded);
            }
        }
    }

    /// The range of the muscle at `place`, to be called `muscle`.
    pub fn range(&self, place: usize, muscle: usize) -> MuscleRange {
        let seen = &self.muscles[place];
        let n_frames = seen.bounded.total();
        let percentiles = |it: &Histogram| Percentiles {
            p1: it.quantile(0.01),
            p99: it.quantile(0.99),
        };
        MuscleRange {
            muscle,
            n_frames,
            bounded: percentiles(&seen.bounded),
            unbounded: percentiles(&seen.unbounded),
            out_of_range: seen.n_out_of_range as f64 / n_frames.max(1) as f64,
            verdict: seen.verdict(),
        }
    }
}

impl Seen {
    fn verdict(&self) -> Verdict {
        let n_frames = self.bounded.total();
        let error = self.standard_errors / n_frames.max(1) as f64;
        let lowest = self.unbounded.quantile(0.01);
        if n_frames < LEAST_ACTIVE_FRAMES {
            Verdict::NotYetSeen
        } else if error > HARDLY_OBSERVABLE {
            Verdict::HardlyObservable
        } else if lowest < WRONG_DIRECTION && lowest < -NOISE_SIGMAS * error {
            Verdict::WrongDirection
        } else if self.n_active < LEAST_ACTIVE_FRAMES {
            Verdict::NotYetSeen
        } else if self.unbounded.quantile(0.99) > TOO_WEAK + NOISE_SIGMAS * error {
            Verdict::TooWeak
        } else if self.isolated.total() >= LEAST_ACTIVE_FRAMES
            && self.isolated.quantile(0.99) < TOO_STRONG
        {
            Verdict::TooStrong
        } else {
            Verdict::Sound
        }
    }
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
            Self::NeutralInDoubt => "NEUTRAL_IN_DOUBT",
        }
    }
}
