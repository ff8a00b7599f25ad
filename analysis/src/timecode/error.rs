//! Why something is no timecode.

use super::Label;

/// What is wrong with a timecode.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimecodeError {
    /// A rate of nothing.
    #[error("a rate of {numerator}/{denominator} frames a second; neither may be 0")]
    Rate {
        /// As stated.
        numerator: u32,
        /// As stated.
        denominator: u32,
    },
    /// Drop-frame counting at a rate that has none.
    #[error(
        "drop-frame counting at {numerator}/{denominator}; it exists at 30000/1001 and 60000/1001 only"
    )]
    DropRate {
        /// As stated.
        numerator: u32,
        /// As stated.
        denominator: u32,
    },
    /// A part out of range.
    #[error("{part} is {found}, which is not below {limit}")]
    Part {
        /// `hours`, `minutes`, `seconds` or `frames`.
        part: &'static str,
        /// As stated.
        found: u32,
        /// The first number that does not occur.
        limit: u32,
    },
    /// The label does not occur.
    #[error(
        "{:02}:{:02}:{:02};{:02} does not occur: drop-frame counting begins this minute at a later frame",
        label.hours, label.minutes, label.seconds, label.frames
    )]
    Dropped {
        /// As stated.
        label: Label,
    },
    /// Not a fraction of a frame.
    #[error("the sub-frame is not a number from 0 to below 1")]
    SubFrame,
    /// Not the form of a timecode.
    #[error("not a timecode: {found}; hh:mm:ss:ff is expected, or hh:mm:ss;ff for drop-frame")]
    Form {
        /// As written, escaped.
        found: String,
    },
    /// Not the form of a rate.
    #[error("not a rate: {found}; frames and seconds are expected, as 30000/1001")]
    RateForm {
        /// As written, escaped.
        found: String,
    },
    /// `;` at a rate that drops nothing, or `:` at one that does.
    #[error("{found} is written with `{mark}` before the frames; at this rate `{expected}` is")]
    Mark {
        /// As written, escaped.
        found: String,
        /// As found.
        mark: char,
        /// As the rate's counting wants it.
        expected: char,
    },
}
