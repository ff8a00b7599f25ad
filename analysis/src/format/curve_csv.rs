//! Curves as a table: `frame,capture_time_nanos,quality`, then, where it is wanted, `timecode`, then one column a muscle,
//! then, where they are wanted, one column with the standard error of each.
//!
//! Values are `f32`, as on the wire, in the shortest form that reads back to the same bits.
//! Lines end with LF; fields are quoted as RFC 4180 says, and no text is a formula of a spreadsheet.

use std::{
    borrow::Cow,
    io::{self, Write},
};

use crate::{curve::Quality, timecode::Timecode};

/// Ends the heading of a column of standard errors.
const STANDARD_ERROR: &str = "_standard_error";

/// Columns beside those that every table has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CurveColumns {
    /// The frame's timecode, behind the quality; empty where a frame has none.
    pub timecode: bool,
    /// The standard error of each muscle, behind all activations.
    pub standard_errors: bool,
}

/// One line of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveRow<'a> {
    /// The publisher's frame number.
    pub frame: u64,
    /// Capture clock, nanoseconds.
    pub capture_time_nanos: i64,
    /// `unspecified` where it is not known.
    pub quality: Option<Quality>,
    /// Ignored by a table without the column.
    pub timecode: Option<Timecode>,
    /// One value a muscle, in the heading's order.
    pub activations: &'a [f32],
    /// One sigma of each, likewise; ignored by a table without the columns.
    pub standard_errors: &'a [f32],
}

/// Writes the table line by line.
#[derive(Debug)]
pub struct CurveCsvWriter<W> {
    out: W,
    columns: CurveColumns,
}

impl<W: Write> CurveCsvWriter<W> {
    /// Writes the heading.
    ///
    /// # Errors
    ///
    /// When `out` cannot be written.
    pub fn new<'a>(
        mut out: W,
        muscles: impl IntoIterator<Item = &'a str> + Clone,
        columns: CurveColumns,
    ) -> io::Result<Self> {
        out.write_all(b"frame,capture_time_nanos,quality")?;
        if columns.timecode {
            out.write_all(b",timecode")?;
        }
        for name in muscles.clone() {
            write!(out, ",{}", field(name))?;
        }
        if columns.standard_errors {
            for name in muscles {
                write!(out, ",{}", field(&format!("{name}{STANDARD_ERROR}")))?;
            }
        }
        out.write_all(b"\n")?;
        Ok(Self { out, columns })
    }

    /// Writes one line.
    ///
    /// # Errors
    ///
    /// When the output cannot be written.
    pub fn write_row(&mut self, row: &CurveRow<'_>) -> io::Result<()> {
        let (frame, nanos) = (row.frame, row.capture_time_nanos);
        write!(self.out, "{frame},{nanos},{}", quality_name(row.quality))?;
        if self.columns.timecode {
            self.out.write_all(b",")?;
            if let Some(timecode) = row.timecode {
                write!(self.out, "{timecode}")?;
            }
        }
        let errors: &[f32] = if self.columns.standard_errors {
            row.standard_errors
        } else {
            &[]
        };
        for value in row.activations.iter().chain(errors) {
            write!(self.out, ",{value}")?;
        }
        self.out.write_all(b"\n")
    }

    /// Hands buffered lines on.
    ///
    /// # Errors
    ///
    /// When the output cannot be written.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }

    /// Hands the sink back, flushed.
    ///
    /// # Errors
    ///
    /// When the output cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }
}

/// `solved`, `partial`, `held`, or `unspecified` where it is not known.
pub fn quality_name(quality: Option<Quality>) -> &'static str {
    match quality {
        Some(Quality::Solved) => "solved",
        Some(Quality::Partial) => "partial",
        Some(Quality::Held) => "held",
        None => "unspecified",
    }
}

/// A text as one field: quoted when it holds a separator, a quote or a line's end, and never a formula of a spreadsheet.
pub fn field(text: &str) -> Cow<'_, str> {
    let inert = inert(text);
    if inert.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", inert.replace('"', "\"\"")))
    } else {
        inert
    }
}

/// A text that no spreadsheet takes for a formula: an apostrophe before what looks like one (`BAD_INPUT` I13).
pub fn inert(text: &str) -> Cow<'_, str> {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']) {
        Cow::Owned(format!("'{text}"))
    } else {
        Cow::Borrowed(text)
    }
}

#[cfg(test)]
mod tests;
