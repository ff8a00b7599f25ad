//! C3D (c3d.org): marker takes as biomechanics and motion capture systems keep them, in blocks of 512 bytes.
//!
//! A header, a section of named parameters, then the frames: for every point x y z and a word of residual and cameras,
//! then analog values, which are passed over.
//! All three processors (Intel, DEC, MIPS) and both kinds of storage (scaled integers, reals) are read; Intel reals are
//! written. Where the header and the parameters state the same thing, the parameters are believed.
//! Frames are decoded one by one from the file's bytes, so that a long take is never held twice.

mod error;
mod frames;
mod heading;
mod layout;
mod number;
mod parameters;
mod write;

pub use error::{C3dError, C3dProblem};
pub use write::{C3dWriteError, C3dWriter};

use crate::{space::LengthUnit, timecode::Timecode};
use layout::Layout;

/// Most points × frames, as in a TRC.
pub const MAX_POSITIONS: usize = super::trc::MAX_POSITIONS;
/// Most groups and parameters; real files have a few hundred.
pub const MAX_PARAMETERS: usize = 8_192;

/// The unit in which a C3D counts its parts.
const BLOCK_BYTES: usize = 512;
/// The second byte of a C3D.
const KEY: u8 = 80;

/// What a C3D says about its frames.
#[derive(Clone, Debug, PartialEq)]
pub struct C3dHeading {
    /// Frames a second, in the precision of an `f32`; finite and positive.
    pub rate_hz: f64,
    /// The unit of all positions and residuals; some files do not state one.
    pub unit: Option<LengthUnit>,
    /// The first frame's number; the others follow without gaps.
    pub first_frame: u32,
    /// Number of frames.
    pub n_frames: u32,
    /// In the points' order; not empty, all different.
    ///
    /// A point without a label is `unlabeled_` and its number from 1; points that share a label are the label, `_`, and
    /// their numbers.
    pub marker_names: Vec<String>,
    /// The first frame's timecode, without sub-frame and user bits, where Frontalis wrote the file.
    ///
    /// C3D has no place of its own for it: it stands in the group `TIMECODE`, as the texts `START` and `RATE`.
    pub start_timecode: Option<Timecode>,
}

/// One point that was seen in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct C3dPoint {
    /// x y z in the take's unit; finite.
    pub position: [f32; 3],
    /// Mean distance between the cameras' rays and the point, in the take's unit; 0 when it was interpolated or not
    /// measured.
    pub residual: f32,
    /// Bit i: camera i + 1 saw it. Seven bits.
    pub cameras: u8,
}

/// A marker take inside the bytes of a C3D.
#[derive(Clone, Debug)]
pub struct C3dTake<'a> {
    heading: C3dHeading,
    layout: Layout,
    bytes: &'a [u8],
}

impl<'a> C3dTake<'a> {
    /// Reads what stands before the frames, and checks that the bytes hold all of them.
    ///
    /// # Errors
    ///
    /// The first part that cannot be used, by its byte from 0.
    pub fn open(bytes: &'a [u8]) -> Result<Self, C3dError> {
        let (heading, layout) = heading::read(bytes)?;
        Ok(Self {
            heading,
            layout,
            bytes,
        })
    }

    /// What the file says about its frames.
    pub fn heading(&self) -> &C3dHeading {
        &self.heading
    }

    /// The frames in order: one entry a marker, `None` for one that was not seen.
    ///
    /// # Errors
    ///
    /// A coordinate that is infinite, with the byte of its point.
    pub fn frames(
        &self,
    ) -> impl ExactSizeIterator<Item = Result<Vec<Option<C3dPoint>>, C3dError>> + '_ {
        (0..self.heading.n_frames as usize).map(|frame| self.frame(frame))
    }
}

#[cfg(test)]
mod tests;
