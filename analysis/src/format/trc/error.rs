//! Why a TRC cannot be read.

use super::{MAX_LINE_BYTES, MAX_POSITIONS};
use crate::face::actor::MAX_MARKERS;

/// The first line of a TRC that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct TrcError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub problem: TrcProblem,
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TrcProblem {
    /// Not a TRC at all.
    #[error("not a TRC file: it does not begin with PathFileType")]
    NotTrc,
    /// The file ends before its table begins.
    #[error("the file ends in its header")]
    HeaderEnds,
    /// Longer than [`MAX_LINE_BYTES`].
    #[error("longer than {MAX_LINE_BYTES} bytes")]
    LineTooLong,
    /// A key that the header needs is not there.
    #[error("the header has no {0}")]
    MissingKey(&'static str),
    /// The rate is not a positive number.
    #[error("DataRate is not a positive number of frames a second")]
    Rate,
    /// The unit is none of ours.
    #[error("Units is {found}; mm, cm or m are known")]
    Unit {
        /// As written, escaped.
        found: String,
    },
    /// No markers, or more than the limit, or not a number.
    #[error("NumMarkers is not between 1 and {MAX_MARKERS}")]
    MarkerCount,
    /// The names are not as many as declared.
    #[error("NumMarkers is {expected}, but {found} marker names follow")]
    NameCount {
        /// Declared.
        expected: usize,
        /// Found before the first empty one; all of them if those are as many as declared.
        found: usize,
    },
    /// Two markers of one name.
    #[error("two markers are named {name}")]
    DuplicateName {
        /// The name, escaped.
        name: String,
    },
    /// The frame number is not a whole number.
    #[error("the frame number is not a whole number from 0")]
    FrameNumber,
    /// The time is not a number.
    #[error("the time is not a number of seconds")]
    Time,
    /// A cell is not a number.
    #[error("{axis} of marker {marker} is not a number (decimals are written with a point)")]
    NotANumber {
        /// The marker's name, escaped.
        marker: String,
        /// `x`, `y` or `z`.
        axis: char,
    },
    /// A cell is infinite or beyond `f32`.
    #[error("{axis} of marker {marker} is beyond the range of a coordinate")]
    NonFinite {
        /// The marker's name, escaped.
        marker: String,
        /// `x`, `y` or `z`.
        axis: char,
    },
    /// More cells than the markers have.
    #[error("more cells than the {expected} markers have")]
    TooManyCells {
        /// Markers.
        expected: usize,
    },
    /// The last row has no end and lacks cells.
    #[error("the file ends in the middle of a row")]
    CutRow,
    /// More than [`MAX_POSITIONS`].
    #[error("more than {MAX_POSITIONS} positions (markers × frames)")]
    TooLong,
}
