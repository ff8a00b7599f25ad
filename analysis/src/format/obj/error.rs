//! Why a line of an OBJ cannot be used.

use super::{MAX_CORNERS, MAX_LINE_BYTES};
use crate::face::actor::{MAX_TRIANGLES, MAX_VERTICES};

/// The first line of an OBJ that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct ObjError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub problem: ObjProblem,
}

/// What is wrong with a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObjProblem {
    /// Longer than [`MAX_LINE_BYTES`].
    #[error("longer than {MAX_LINE_BYTES} bytes")]
    LineTooLong,
    /// Not text.
    #[error("not UTF-8")]
    NotUtf8,
    /// Not text either.
    #[error("contains a NUL byte")]
    Nul,
    /// A word that should be a number is none; decimals are written with a point.
    #[error("a coordinate is not a number (decimals are written with a point)")]
    NotANumber,
    /// Fewer than three coordinates, or more words than a vertex can have.
    #[error("a vertex has 3 coordinates, or up to 7 with weight and color; found {found}")]
    Coordinates {
        /// Words found, counted up to the first too many.
        found: usize,
    },
    /// NaN, infinite, or beyond the range of `f32`.
    #[error("a coordinate is not a finite number")]
    NonFinite,
    /// The whole file has no vertex.
    #[error("the file ends without a vertex")]
    NoVertices,
    /// More than [`MAX_VERTICES`].
    #[error("more than {MAX_VERTICES} vertices")]
    TooManyVertices,
    /// More than [`MAX_TRIANGLES`] after fanning.
    #[error("more than {MAX_TRIANGLES} triangles")]
    TooManyTriangles,
    /// A corner that is not a vertex index, or one with `/` and what follows.
    #[error("a face's corner is not a vertex index")]
    CornerSyntax,
    /// Index 0: the first vertex is 1.
    #[error("a face names vertex 0; the first vertex is 1")]
    IndexZero,
    /// A vertex after the last, or counted back to before the first.
    #[error(
        "a face names vertex {index}, the file has {n_vertices} (counted back: up to this line)"
    )]
    IndexBeyond {
        /// As written.
        index: i64,
        /// Vertices in the file, or before the face for a negative index.
        n_vertices: usize,
    },
    /// One vertex twice in a face.
    #[error("a face names vertex {index} twice")]
    RepeatedVertex {
        /// The vertex, from 1.
        index: u64,
    },
    /// One or two corners, or none.
    #[error("a face has at least 3 corners, found {found}")]
    TooFewCorners {
        /// Corners found.
        found: usize,
    },
    /// More than [`MAX_CORNERS`].
    #[error("a face has more than {MAX_CORNERS} corners")]
    TooManyCorners,
}

impl ObjError {
    /// The identifier on the wire.
    pub fn reason(&self) -> &'static str {
        match self.problem {
            ObjProblem::LineTooLong
            | ObjProblem::NotUtf8
            | ObjProblem::Nul
            | ObjProblem::NotANumber
            | ObjProblem::Coordinates { .. }
            | ObjProblem::NoVertices => "PARSE",
            ObjProblem::NonFinite => "NON_FINITE",
            ObjProblem::TooManyVertices | ObjProblem::TooManyTriangles => "BASIS_SIZE",
            ObjProblem::CornerSyntax
            | ObjProblem::IndexZero
            | ObjProblem::IndexBeyond { .. }
            | ObjProblem::RepeatedVertex { .. }
            | ObjProblem::TooFewCorners { .. }
            | ObjProblem::TooManyCorners => "FACE_INDEX",
        }
    }
}
