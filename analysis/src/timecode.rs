//! SMPTE timecode: labels of frames, the days they count, and the labels that drop-frame counting leaves out.
//!
//! At 30000/1001 and 60000/1001 frames a second a day of labels is 3.6 s an hour longer than a day; drop-frame counting
//! leaves out the first 2 (at 60000/1001 the first 4) labels of every minute that is no multiple of ten, so that labels
//! follow the clock (SMPTE ST 12-1, section 5.2). No frame is dropped, only its number.

mod error;
mod text;

pub use error::TimecodeError;

const MINUTES_A_DAY: u64 = 24 * 60;

/// Frames per second as a fraction, and how its labels are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TimecodeRate {
    numerator: u32,
    denominator: u32,
    counting: Counting,
}

/// Which labels occur.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Counting {
    /// All of them.
    NonDrop,
    /// All but the first 2 (of 30) or 4 (of 60) of a minute that is no multiple of ten.
    Drop,
}

impl TimecodeRate {
    /// 30000/1001 frames a second, drop-frame: the `;` of broadcast in NTSC countries.
    pub const NTSC_DROP: Self = Self {
        numerator: 30_000,
        denominator: 1_001,
        counting: Counting::Drop,
    };

    /// A rate of `numerator / denominator` frames a second.
    ///
    /// # Errors
    ///
    /// [`TimecodeError::Rate`] when either is 0, [`TimecodeError::DropRate`] when drop-frame counting is asked for at a
    /// rate other than 30000/1001 and 60000/1001.
    pub fn new(
        numerator: u32,
        denominator: u32,
        counting: Counting,
    ) -> Result<Self, TimecodeError> {
        if numerator == 0 || denominator == 0 {
            return Err(TimecodeError::Rate {
                numerator,
                denominator,
            });
        }
        let may_drop = matches!((numerator, denominator), (30_000 | 60_000, 1_001));
        if counting == Counting::Drop && !may_drop {
            return Err(TimecodeError::DropRate {
                numerator,
                denominator,
            });
        }
        Ok(Self {
            numerator,
            denominator,
            counting,
        })
    }

    /// Frames in `denominator()` seconds.
    pub fn numerator(self) -> u32 {
        self.numerator
    }

    /// Not 0.
    pub fn denominator(self) -> u32 {
        self.denominator
    }

    /// Which labels occur.
    pub fn counting(self) -> Counting {
        self.counting
    }

    /// Labels of a second: the rate, rounded up (24 of 23.976).
    pub fn labels_a_second(self) -> u32 {
        self.numerator.div_ceil(self.denominator)
    }

    /// Frames a second.
    pub fn hz(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }

    /// Frames that get a label of their own between midnight and midnight.
    pub fn frames_a_day(self) -> u64 {
        let all = MINUTES_A_DAY * self.labels_a_minute();
        all - self.dropped_a_minute() * (MINUTES_A_DAY - MINUTES_A_DAY / 10)
    }

    fn labels_a_minute(self) -> u64 {
        60 * u64::from(self.labels_a_second())
    }

    /// How many labels are left out at the start of a minute that is no multiple of ten.
    fn dropped_a_minute(self) -> u64 {
        match self.counting {
            Counting::NonDrop => 0,
            Counting::Drop => u64::from(self.labels_a_second() / 15),
        }
    }
}

/// What a clock on the stage shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label {
    /// 0..=23.
    pub hours: u32,
    /// 0..=59.
    pub minutes: u32,
    /// 0..=59.
    pub seconds: u32,
    /// 0 to the labels of a second, exclusive.
    pub frames: u32,
}

/// A label that occurs at its rate.
///
/// ```
/// use frontalis_analysis::timecode::{Timecode, TimecodeRate};
///
/// let last_of_a_minute = Timecode::parse("00:00:59;29", TimecodeRate::NTSC_DROP)?;
/// assert_eq!(last_of_a_minute.plus_frames(1).to_string(), "00:01:00;02");
/// # Ok::<(), frontalis_analysis::timecode::TimecodeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timecode {
    label: Label,
    rate: TimecodeRate,
    sub_frame: f32,
    user_bits: u32,
}

impl Timecode {
    /// The timecode of a label, without sub-frame or user bits.
    ///
    /// # Errors
    ///
    /// The first part of the label that is out of range, or that drop-frame counting leaves the label out.
    pub fn new(label: Label, rate: TimecodeRate) -> Result<Self, TimecodeError> {
        for (part, found, limit) in [
            ("hours", label.hours, 24),
            ("minutes", label.minutes, 60),
            ("seconds", label.seconds, 60),
            ("frames", label.frames, rate.labels_a_second()),
        ] {
            if found >= limit {
                return Err(TimecodeError::Part { part, found, limit });
            }
        }
        let begins_a_minute = label.seconds == 0 && !label.minutes.is_multiple_of(10);
        if begins_a_minute && u64::from(label.frames) < rate.dropped_a_minute() {
            return Err(TimecodeError::Dropped { label });
        }
        Ok(Self {
            label,
            rate,
            sub_frame: 0.0,
            user_bits: 0,
        })
    }

    /// The same at a fraction of its frame.
    ///
    /// # Errors
    ///
    /// [`TimecodeError::SubFrame`] unless 0 ≤ `sub_frame` < 1.
    pub fn with_sub_frame(self, sub_frame: f32) -> Result<Self, TimecodeError> {
        if !(0.0..1.0).contains(&sub_frame) {
            return Err(TimecodeError::SubFrame);
        }
        Ok(Self { sub_frame, ..self })
    }

    /// The same with the stage's own 32 bits, which mean nothing here.
    #[must_use]
    pub fn with_user_bits(self, user_bits: u32) -> Self {
        Self { user_bits, ..self }
    }

    /// The label of the `count`-th frame since midnight; days wrap.
    pub fn from_frame_count(count: u64, rate: TimecodeRate) -> Self {
        let number = labels_before(count % rate.frames_a_day(), rate);
        let fps = u64::from(rate.labels_a_second());
        let seconds = number / fps;
        let label = Label {
            hours: narrow(seconds / 3_600),
            minutes: narrow(seconds / 60 % 60),
            seconds: narrow(seconds % 60),
            frames: narrow(number % fps),
        };
        Self {
            label,
            rate,
            sub_frame: 0.0,
            user_bits: 0,
        }
    }

    /// Frames since midnight: what [`Timecode::from_frame_count`] takes back.
    pub fn frame_count(&self) -> u64 {
        let Label {
            hours,
            minutes,
            seconds,
            frames,
        } = self.label;
        let minutes = u64::from(hours) * 60 + u64::from(minutes);
        let seconds = minutes * 60 + u64::from(seconds);
        let labels = seconds * u64::from(self.rate.labels_a_second()) + u64::from(frames);
        labels - self.rate.dropped_a_minute() * (minutes - minutes / 10)
    }

    /// The timecode so many frames later (earlier, if negative), through midnight; sub-frame and user bits stay.
    #[must_use]
    pub fn plus_frames(&self, frames: i64) -> Self {
        let a_day = self.rate.frames_a_day();
        let magnitude = frames.unsigned_abs() % a_day;
        let forward = if frames < 0 {
            a_day - magnitude
        } else {
            magnitude
        };
        Self {
            sub_frame: self.sub_frame,
            user_bits: self.user_bits,
            ..Self::from_frame_count(self.frame_count() + forward, self.rate)
        }
    }

    /// What the clock shows.
    pub fn label(&self) -> Label {
        self.label
    }

    /// How fast it counts.
    pub fn rate(&self) -> TimecodeRate {
        self.rate
    }

    /// 0 <= fraction of a frame < 1.
    pub fn sub_frame(&self) -> f32 {
        self.sub_frame
    }

    /// The stage's own 32 bits.
    pub fn user_bits(&self) -> u32 {
        self.user_bits
    }
}

/// The label of a frame as a number without gaps: the frames before it and the labels left out before it.
fn labels_before(count: u64, rate: TimecodeRate) -> u64 {
    let dropped = rate.dropped_a_minute();
    let minute = rate.labels_a_minute() - dropped;
    let ten_minutes = 10 * minute + dropped;
    let (tens, rest) = (count / ten_minutes, count % ten_minutes);
    // The first minute of ten is longer by the labels that the other nine leave out.
    let minutes_begun = rest.saturating_sub(dropped) / minute;
    count + dropped * (9 * tens + minutes_begun)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "parts of a label: below 60, or below a rate that is u32"
)]
fn narrow(part: u64) -> u32 {
    part as u32
}

#[cfg(test)]
mod tests;
