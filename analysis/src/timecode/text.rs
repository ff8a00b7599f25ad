//! Timecodes as people write them: `hh:mm:ss:ff`, and `hh:mm:ss;ff` where labels are dropped.

use std::fmt;

use super::{Counting, Label, Timecode, TimecodeError, TimecodeRate};
use crate::format::quoted;

impl TimecodeRate {
    /// What stands before the frames.
    fn mark(self) -> char {
        match self.counting() {
            Counting::NonDrop => ':',
            Counting::Drop => ';',
        }
    }
}

impl fmt::Display for TimecodeRate {
    /// `30000/1001`; how labels are counted is said by the mark in the label.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.numerator(), self.denominator())
    }
}

impl Timecode {
    /// Reads a label whose mark says how its rate is counted, and the rate as [`TimecodeRate`] prints it.
    ///
    /// # Errors
    ///
    /// The form of either, the rate, or the label itself.
    pub fn parse_at(text: &str, rate: &str) -> Result<Self, TimecodeError> {
        let counting = if text.contains(';') {
            Counting::Drop
        } else {
            Counting::NonDrop
        };
        let fraction = || {
            let (numerator, denominator) = rate.split_once('/')?;
            Some((numerator.parse().ok()?, denominator.parse().ok()?))
        };
        let (numerator, denominator) = fraction().ok_or_else(|| TimecodeError::RateForm {
            found: quoted(rate),
        })?;
        Self::parse(text, TimecodeRate::new(numerator, denominator, counting)?)
    }

    /// Reads what [`Timecode`] prints.
    ///
    /// # Errors
    ///
    /// The form, the mark before the frames, or the label itself.
    pub fn parse(text: &str, rate: TimecodeRate) -> Result<Self, TimecodeError> {
        let (label, mark) = label(text).ok_or_else(|| TimecodeError::Form {
            found: quoted(text),
        })?;
        let expected = rate.mark();
        if mark != expected {
            return Err(TimecodeError::Mark {
                found: quoted(text),
                mark,
                expected,
            });
        }
        Self::new(label, rate)
    }
}

fn label(text: &str) -> Option<(Label, char)> {
    let (clock, frames) = text.rsplit_once([':', ';'])?;
    let mark = text[clock.len()..].chars().next()?;
    let mut parts = clock.split(':').map(number);
    let (hours, minutes, seconds) = (parts.next()??, parts.next()??, parts.next()??);
    let frames = number(frames)?;
    let label = Label {
        hours,
        minutes,
        seconds,
        frames,
    };
    parts.next().is_none().then_some((label, mark))
}

/// Two or more digits and nothing else: `parse` alone would take a sign.
fn number(digits: &str) -> Option<u32> {
    let is_number = digits.len() >= 2 && digits.bytes().all(|it| it.is_ascii_digit());
    is_number.then(|| digits.parse().ok()).flatten()
}

impl fmt::Display for Timecode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Label {
            hours,
            minutes,
            seconds,
            frames,
        } = self.label();
        let mark = self.rate().mark();
        write!(f, "{hours:02}:{minutes:02}:{seconds:02}{mark}{frames:02}")
    }
}
