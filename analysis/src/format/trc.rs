//! TRC (Track Row Column): marker takes as a table of text, one row a frame.
//!
//! Five header lines (path, keys, values, marker names, axes), then frame number, time and x y z of every marker,
//! separated by tabs or by commas; an empty cell is a marker that was not seen.
//! Coordinates are rounded to `f32` in the file's own unit, as the wire carries them, so that a file that is published
//! and a file that is solved in place give the same bits.

mod error;
mod header;
mod rows;
mod start_timecode;
mod write;

pub use error::{TrcError, TrcProblem};
pub use write::{TrcHeading, TrcWriteError, TrcWriter, write};

use crate::{space::LengthUnit, timecode::Timecode};

/// Longest line, bytes without its end: 1,024 markers with three numbers of a hundred characters each.
pub const MAX_LINE_BYTES: usize = 1 << 20;
/// Most markers × frames; 12 bytes each.
pub const MAX_POSITIONS: usize = 50_000_000;

/// A marker take.
#[derive(Clone, Debug, PartialEq)]
pub struct TrcTake {
    /// Frames a second; finite and positive.
    pub rate_hz: f64,
    /// The unit of all positions.
    pub unit: LengthUnit,
    /// In column order; not empty, all different.
    pub marker_names: Vec<String>,
    /// In row order.
    pub frames: Vec<TrcFrame>,
    /// The first row's timecode, without sub-frame and user bits, where Frontalis wrote the file.
    pub start_timecode: Option<Timecode>,
}

/// One row of a take.
#[derive(Clone, Debug, PartialEq)]
pub struct TrcFrame {
    /// The frame's number as written.
    pub number: u64,
    /// The frame's time as written, seconds; finite.
    pub time_s: f64,
    /// One entry a marker, in the take's unit; a coordinate that was not seen is NaN.
    pub positions: Vec<[f32; 3]>,
}

impl TrcFrame {
    /// The time in whole nanoseconds, as publishing and solving state it.
    pub fn capture_time_nanos(&self) -> i64 {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the cast saturates, and no take lasts 292 years"
        )]
        let nanos = (self.time_s * 1e9).round() as i64;
        nanos
    }
}

/// Reads a take.
///
/// # Errors
///
/// The first line that cannot be used, by its number from 1.
pub fn parse(bytes: &[u8]) -> Result<TrcTake, TrcError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = Lines {
        rest: bytes,
        number: 0,
    };
    let header = header::read(&mut lines)?;
    let frames = rows::read(&mut lines, &header)?;
    Ok(TrcTake {
        rate_hz: header.rate_hz,
        unit: header.unit,
        marker_names: header.marker_names,
        frames,
        start_timecode: header.start_timecode,
    })
}

/// The lines of a file, numbered from 1.
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

struct Line<'a> {
    number: usize,
    text: std::borrow::Cow<'a, str>,
    is_whole: bool,
}

impl Line<'_> {
    fn error(&self, problem: TrcProblem) -> TrcError {
        let line = self.number;
        TrcError { line, problem }
    }
}

impl<'a> Lines<'a> {
    /// The next line; `None` at the end. Names may be in any encoding, so what is not UTF-8 is replaced.
    fn next(&mut self) -> Result<Option<Line<'a>>, TrcError> {
        if self.rest.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let raw = &self.rest[..end.unwrap_or(self.rest.len())];
        self.rest = end.map_or(&[], |end| &self.rest[end + 1..]);
        let raw = raw.strip_suffix(b"\r").unwrap_or(raw);
        if raw.len() > MAX_LINE_BYTES {
            let (line, problem) = (self.number, TrcProblem::LineTooLong);
            return Err(TrcError { line, problem });
        }
        Ok(Some(Line {
            number: self.number,
            text: String::from_utf8_lossy(raw),
            is_whole: end.is_some(),
        }))
    }
}

#[cfg(test)]
mod tests;
