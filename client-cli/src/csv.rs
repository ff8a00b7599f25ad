//! Curves as a table: `frame,capture_time_nanos,quality`, then one column a control, then, where they are wanted, one
//! column with the standard error of each control.
//!
//! `frontalis watch` and `frontalis solve` write through this one file, so that a server and a file give the same bytes.
//! Values are `f32`, as on the wire, in the shortest form that reads back to the same bits.

use std::io::{self, Write};

use frontalis_analysis::curve;

use crate::proto;

/// One line of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct CsvRow {
    /// The publisher's frame number.
    pub frame: u64,
    /// Capture clock, nanoseconds.
    pub capture_time_nanos: i64,
    /// `solved`, `partial` or `held`.
    pub quality: &'static str,
    /// One value a control, in the header's order.
    pub activations: Vec<f32>,
    /// One sigma of each, likewise; empty when the server was not asked.
    pub standard_errors: Vec<f32>,
}

/// What the table holds of each control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Columns {
    /// Its activation.
    #[default]
    Activations,
    /// Its activation, and behind all of them its standard error.
    WithStandardErrors,
}

impl Columns {
    /// With or without standard errors, as a person asked.
    pub fn wanted(standard_errors: bool) -> Self {
        if standard_errors {
            Self::WithStandardErrors
        } else {
            Self::Activations
        }
    }
}

/// Ends the heading of a column of standard errors.
const STANDARD_ERROR: &str = "_standard_error";

impl From<&curve::CurveSample> for CsvRow {
    fn from(sample: &curve::CurveSample) -> Self {
        Self {
            frame: sample.frame.0,
            capture_time_nanos: sample.capture_time_nanos,
            quality: match sample.quality {
                curve::Quality::Solved => "solved",
                curve::Quality::Partial => "partial",
                curve::Quality::Held => "held",
            },
            activations: narrow(&sample.activations),
            standard_errors: narrow(&sample.standard_errors),
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the wire carries f32; the same rounding as the server's"
)]
fn narrow(values: &[f64]) -> Vec<f32> {
    values.iter().map(|it| *it as f32).collect()
}

impl From<&proto::CurveSample> for CsvRow {
    fn from(sample: &proto::CurveSample) -> Self {
        Self {
            frame: sample.frame,
            capture_time_nanos: sample.capture_time_nanos,
            quality: quality_name(sample.quality()),
            activations: sample.activations.clone(),
            standard_errors: sample.standard_errors.clone(),
        }
    }
}

/// `solved`, `partial`, `held`, or `unspecified`.
pub fn quality_name(quality: proto::Quality) -> &'static str {
    match quality {
        proto::Quality::Solved => "solved",
        proto::Quality::Partial => "partial",
        proto::Quality::Held => "held",
        proto::Quality::Unspecified => "unspecified",
    }
}

/// Writes the table line by line.
#[derive(Debug)]
pub struct CsvWriter<W> {
    out: W,
    columns: Columns,
}

impl<W: Write> CsvWriter<W> {
    /// Writes the heading.
    ///
    /// # Errors
    ///
    /// When `out` cannot be written.
    pub fn new<'a>(
        mut out: W,
        controls: impl IntoIterator<Item = &'a str> + Clone,
        columns: Columns,
    ) -> io::Result<Self> {
        out.write_all(b"frame,capture_time_nanos,quality")?;
        for name in controls.clone() {
            write!(out, ",{}", field(name))?;
        }
        if columns == Columns::WithStandardErrors {
            for name in controls {
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
    pub fn write(&mut self, row: &CsvRow) -> io::Result<()> {
        write!(
            self.out,
            "{},{},{}",
            row.frame, row.capture_time_nanos, row.quality
        )?;
        let errors: &[f32] = match self.columns {
            Columns::Activations => &[],
            Columns::WithStandardErrors => &row.standard_errors,
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
}

/// A name as one field: quoted when it holds a separator, and never a formula of a spreadsheet.
pub fn field(name: &str) -> String {
    let inert = if name.starts_with(['=', '+', '-', '@']) {
        format!("'{name}")
    } else {
        name.to_owned()
    };
    if inert.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", inert.replace('"', "\"\""))
    } else {
        inert
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn table(rows: &[CsvRow], controls: &[&str], columns: Columns) -> String {
        let mut bytes = Vec::new();
        let mut writer = CsvWriter::new(&mut bytes, controls.iter().copied(), columns).unwrap();
        for row in rows {
            writer.write(row).unwrap();
        }
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn a_line_holds_frame_time_quality_and_every_control() {
        let row = CsvRow {
            frame: 7,
            capture_time_nanos: 116_666_667,
            quality: "partial",
            activations: vec![0.0, 0.25, 1.0],
            standard_errors: vec![0.5, 0.0, 0.125],
        };
        let controls = ["frontalis_left", "jaw", "kiss"];
        assert_eq!(
            table(std::slice::from_ref(&row), &controls, Columns::Activations),
            "frame,capture_time_nanos,quality,frontalis_left,jaw,kiss\n7,116666667,partial,0,0.25,1\n"
        );
        assert_eq!(
            table(&[row], &controls[..], Columns::WithStandardErrors),
            "frame,capture_time_nanos,quality,frontalis_left,jaw,kiss,\
             frontalis_left_standard_error,jaw_standard_error,kiss_standard_error\n\
             7,116666667,partial,0,0.25,1,0.5,0,0.125\n"
        );
    }

    #[test]
    fn names_stay_one_inert_field() {
        assert_eq!(field("a,b"), "\"a,b\"");
        assert_eq!(field("say \"a\""), "\"say \"\"a\"\"\"");
        assert_eq!(field("=1,1"), "\"'=1,1\"");
    }

    #[test]
    fn i13_a_name_is_never_a_formula() {
        for name in ["=1+1", "+1", "-1+1", "@SUM(A1)"] {
            assert_eq!(field(name), format!("'{name}"));
        }
    }

    proptest! {
        #[test]
        fn every_value_reads_back_to_the_same_bits(value in any::<f32>().prop_filter("finite", |it| it.is_finite())) {
            let row = CsvRow { frame: 1, capture_time_nanos: 0, quality: "solved", activations: vec![value], standard_errors: vec![] };
            let text = table(&[row], &["x"], Columns::Activations);
            let last = text.trim_end().rsplit(',').next().unwrap();
            prop_assert_eq!(last.parse::<f32>().unwrap().to_bits(), value.to_bits());
        }
    }
}
