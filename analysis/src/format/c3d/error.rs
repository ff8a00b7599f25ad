//! Why a C3D cannot be read.

use super::{MAX_PARAMETERS, MAX_POSITIONS};
use crate::face::actor::MAX_MARKERS;

/// The first part of a C3D that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("byte {offset}: {problem}")]
pub struct C3dError {
    /// Where the part begins, from 0.
    pub offset: usize,
    /// What is wrong with it.
    pub problem: C3dProblem,
}

/// What is wrong with a part.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum C3dProblem {
    /// Not a C3D at all.
    #[error("not a C3D file: its second byte is not 80")]
    NotC3d,
    /// The file ends before its parameters begin.
    #[error("the file ends before its parameters")]
    HeaderEnds,
    /// The block of the parameters is the header's own, or none.
    #[error("the parameters are said to begin in block {found}; 2 or later is expected")]
    ParameterBlock {
        /// As stated, from 1.
        found: usize,
    },
    /// Numbers in a form that is not known.
    #[error("processor type {found}; 84 (Intel), 85 (DEC) and 86 (MIPS) are known")]
    Processor {
        /// As stated.
        found: u8,
    },
    /// A group or a parameter goes on where its section has ended.
    #[error("a group or parameter does not end inside the parameter section")]
    CutParameter,
    /// A group or parameter that would begin inside the one before it.
    #[error("the next group or parameter would begin inside this one")]
    NextParameter,
    /// More than [`MAX_PARAMETERS`].
    #[error("more than {MAX_PARAMETERS} groups and parameters")]
    TooManyParameters,
    /// A parameter is not what it must be.
    #[error("{name} is not {expected}")]
    Parameter {
        /// Group and parameter: `POINT:RATE`.
        name: &'static str,
        /// What it must be.
        expected: &'static str,
    },
    /// Header and parameters contradict each other, so that frames cannot be told apart.
    #[error("the header states {header} {what}, the parameters {parameters}")]
    Contradiction {
        /// Of what.
        what: &'static str,
        /// As the header states.
        header: usize,
        /// As the parameters state.
        parameters: usize,
    },
    /// Integers by the header, reals by the parameters, or the other way round.
    #[error(
        "header and POINT:SCALE differ in sign, so that integers and reals cannot be told apart"
    )]
    Storage,
    /// No points, or more than the limit.
    #[error("{found} points; between 1 and {MAX_MARKERS} are expected")]
    PointCount {
        /// As stated.
        found: usize,
    },
    /// The rate is not a positive number.
    #[error("the rate is not a positive number of frames a second")]
    Rate,
    /// The scale is not a number, or 0.
    #[error("the scale is not a number other than 0")]
    Scale,
    /// The unit is none of ours.
    #[error("POINT:UNITS is {found}; mm, cm or m are known")]
    Unit {
        /// As written, escaped.
        found: String,
    },
    /// Two points of one name, even with their numbers behind labels that are the same.
    #[error("two points are named {name}")]
    DuplicateName {
        /// The name, escaped.
        name: String,
    },
    /// The frames' numbers go backwards.
    #[error("the last frame is {last}, but the first is {first}")]
    FrameNumbers {
        /// As stated.
        first: u32,
        /// As stated.
        last: u32,
    },
    /// The block of the frames is the header's own, or none.
    #[error("the frames are said to begin in block {found}; 2 or later is expected")]
    DataBlock {
        /// As stated, from 1.
        found: usize,
    },
    /// The file ends before its frames do.
    #[error(
        "the file ends in its frames: {expected} bytes of them are expected from here, {found} are there"
    )]
    CutFrames {
        /// Bytes of all frames.
        expected: usize,
        /// Bytes from the frames' beginning to the file's end.
        found: usize,
    },
    /// More than [`MAX_POSITIONS`].
    #[error("more than {MAX_POSITIONS} positions (points × frames)")]
    TooLong,
    /// A coordinate is infinite.
    #[error("{axis} of marker {marker} is beyond the range of a coordinate")]
    NonFinite {
        /// The marker's name, escaped.
        marker: String,
        /// `x`, `y` or `z`.
        axis: char,
    },
}

impl C3dProblem {
    pub(super) fn at(self, offset: usize) -> C3dError {
        C3dError {
            offset,
            problem: self,
        }
    }
}
