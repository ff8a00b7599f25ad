//! Writing a take row by row with tabs, as most programs expect it.

use std::io::{self, Write};

use super::{TrcFrame, TrcTake, start_timecode};
use crate::{format::curve_csv::inert, space::LengthUnit, timecode::Timecode};

/// What stands above the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct TrcHeading<'a> {
    /// A name for the take, for the first line.
    pub name: &'a str,
    /// Frames a second.
    pub rate_hz: f64,
    /// The unit of all positions.
    pub unit: LengthUnit,
    /// In column order.
    pub marker_names: &'a [String],
    /// The first row's number.
    pub first_frame: u64,
    /// How many rows follow.
    pub n_frames: u64,
    /// The first row's timecode. TRC has no place of its own for it: it stands behind the name in the first line, which
    /// readers pass over.
    pub start_timecode: Option<Timecode>,
    /// What else is to be said of the take, likewise, a cell each.
    pub remarks: &'a [String],
}

/// Why a TRC cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum TrcWriteError {
    /// The sink cannot take more.
    #[error("the TRC cannot be written")]
    Io(#[from] io::Error),
    /// More or fewer rows than the heading states, which stands before them.
    #[error("{found} rows were written; the heading states {expected}")]
    FrameCount {
        /// In the heading.
        expected: u64,
        /// Up to now.
        found: u64,
    },
    /// A row of another number of markers.
    #[error("a row has {found} positions; {expected} are expected")]
    PositionCount {
        /// Markers of the heading.
        expected: usize,
        /// In the row.
        found: usize,
    },
}

/// Writes a take row by row, so that an export never holds the whole of it.
///
/// What is written reads back to the same bits.
#[derive(Debug)]
pub struct TrcWriter<W> {
    out: W,
    n_markers: usize,
    expected: u64,
    written: u64,
}

impl<W: Write> TrcWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    ///
    /// When `out` cannot be written.
    pub fn new(mut out: W, heading: &TrcHeading<'_>) -> Result<Self, TrcWriteError> {
        header(&mut out, heading)?;
        Ok(Self {
            out,
            n_markers: heading.marker_names.len(),
            expected: heading.n_frames,
            written: 0,
        })
    }

    /// Writes the next row.
    ///
    /// # Errors
    ///
    /// A row that is not the heading's, one too many, or a sink that cannot take it.
    pub fn write_frame(&mut self, frame: &TrcFrame) -> Result<(), TrcWriteError> {
        let (expected, found) = (self.n_markers, frame.positions.len());
        if found != expected {
            return Err(TrcWriteError::PositionCount { expected, found });
        }
        if self.written == self.expected {
            return Err(self.frame_count(1));
        }
        row(&mut self.out, frame)?;
        self.written += 1;
        Ok(())
    }

    /// Hands the sink back, flushed.
    ///
    /// # Errors
    ///
    /// Fewer rows than the heading states, or a sink that cannot take them.
    pub fn finish(mut self) -> Result<W, TrcWriteError> {
        if self.written != self.expected {
            return Err(self.frame_count(0));
        }
        self.out.flush()?;
        Ok(self.out)
    }

    fn frame_count(&self, more: u64) -> TrcWriteError {
        TrcWriteError::FrameCount {
            expected: self.expected,
            found: self.written + more,
        }
    }
}

/// Writes a take that is there as a whole; `name` goes into the first line. What is written reads back to the same bits.
///
/// # Panics
///
/// If a frame has not one position a marker.
pub fn write(take: &TrcTake, name: &str) -> String {
    let heading = TrcHeading {
        name,
        rate_hz: take.rate_hz,
        unit: take.unit,
        marker_names: &take.marker_names,
        first_frame: take.frames.first().map_or(1, |frame| frame.number),
        n_frames: take.frames.len() as u64,
        start_timecode: take.start_timecode,
        remarks: &[],
    };
    let write_all = || {
        let mut writer = TrcWriter::new(Vec::new(), &heading)?;
        for frame in &take.frames {
            writer.write_frame(frame)?;
        }
        writer.finish()
    };
    let bytes = write_all().expect("invariant: a Vec accepts every row of a sound take");
    String::from_utf8(bytes).expect("invariant: only text was written")
}

fn header(out: &mut impl Write, heading: &TrcHeading<'_>) -> io::Result<()> {
    let (rate, frames, markers) = (
        heading.rate_hz,
        heading.n_frames,
        heading.marker_names.len(),
    );
    let (unit, name) = (heading.unit.symbol(), one_cell(heading.name));
    let first = heading.first_frame;
    write!(out, "PathFileType\t4\t(X/Y/Z)\t{name}")?;
    if let Some(timecode) = &heading.start_timecode {
        write!(out, "\t{}", start_timecode::cell(timecode))?;
    }
    for remark in heading.remarks {
        write!(out, "\t{}", one_cell(remark))?;
    }
    writeln!(out)?;
    writeln!(
        out,
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames"
    )?;
    writeln!(
        out,
        "{rate}\t{rate}\t{frames}\t{markers}\t{unit}\t{rate}\t{first}\t{frames}"
    )?;
    write!(out, "Frame#\tTime")?;
    for name in heading.marker_names {
        write!(out, "\t{}\t\t", one_cell(name))?;
    }
    write!(out, "\n\t")?;
    for marker in 1..=markers {
        write!(out, "\tX{marker}\tY{marker}\tZ{marker}")?;
    }
    writeln!(out, "\n")
}

fn row(out: &mut impl Write, frame: &TrcFrame) -> io::Result<()> {
    write!(out, "{}\t{}", frame.number, frame.time_s)?;
    for coordinate in frame.positions.iter().flatten() {
        if coordinate.is_nan() {
            write!(out, "\t")?;
        } else {
            write!(out, "\t{coordinate}")?;
        }
    }
    writeln!(out)
}

/// A text without what would end its cell or its line, and never a formula of a spreadsheet.
fn one_cell(text: &str) -> String {
    let printable = |c: char| if c.is_control() { '_' } else { c };
    let text: String = text.chars().map(printable).collect();
    inert(&text).into_owned()
}
