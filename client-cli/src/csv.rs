//! Curves as a table: `frame,capture_time_nanos,quality`, then one column a control.
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
}

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
            activations: sample.activations.iter().map(|it| narrow(*it)).collect(),
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the wire carries f32; the same rounding as the server's"
)]
fn narrow(activation: f64) -> f32 {
    activation as f32
}

impl From<&proto::CurveSample> for CsvRow {
    fn from(sample: &proto::CurveSample) -> Self {
        Self {
            frame: sample.frame,
            capture_time_nanos: sample.capture_time_nanos,
            quality: quality_name(sample.quality()),
            activations: sample.activations.clone(),
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
}

impl<W: Write> CsvWriter<W> {
    /// Writes the heading.
    ///
    /// # Errors
    ///
    /// When `out` cannot be written.
    pub fn new<'a>(mut out: W, controls: impl IntoIterator<Item = &'a str>) -> io::Result<Self> {
        out.write_all(b"frame,capture_time_nanos,quality")?;
        for name in controls {
            write!(out, ",{}", field(name))?;
        }
        out.write_all(b"\n")?;
        Ok(Self { out })
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
        for value in &row.activations {
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

    fn table(rows: &[CsvRow], controls: &[&str]) -> String {
        let mut bytes = Vec::new();
        let mut writer = CsvWriter::new(&mut bytes, controls.iter().copied()).unwrap();
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
        };
        assert_eq!(
            table(&[row], &["frontalis_left", "jaw", "kiss"]),
            "frame,capture_time_nanos,quality,frontalis_left,jaw,kiss\n7,116666667,partial,0,0.25,1\n"
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
            let row = CsvRow { frame: 1, capture_time_nanos: 0, quality: "solved", activations: vec![value] };
            let text = table(&[row], &["x"]);
            let last = text.trim_end().rsplit(',').next().unwrap();
            prop_assert_eq!(last.parse::<f32>().unwrap().to_bits(), value.to_bits());
        }
    }
}
