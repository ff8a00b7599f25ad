//! Samples of a server and of a file as rows of one table ([`frontalis_analysis::format::curve_csv`]).
//!
//! `frontalis watch` and `frontalis solve` write through this one file, so that a server and a file give the same bytes.

use frontalis_analysis::{
    curve::{self, Quality},
    format::curve_csv::{CurveColumns, CurveRow},
};

use crate::proto;

/// One line of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct CsvRow {
    /// The publisher's frame number.
    pub frame: u64,
    /// Capture clock, nanoseconds.
    pub capture_time_nanos: i64,
    /// `None` where the server did not say.
    pub quality: Option<Quality>,
    /// One value a control, in the header's order.
    pub activations: Vec<f32>,
    /// One sigma of each, likewise; empty when the server was not asked.
    pub standard_errors: Vec<f32>,
}

/// The table's columns, with or without standard errors.
pub fn columns(standard_errors: bool) -> CurveColumns {
    CurveColumns {
        timecode: false,
        standard_errors,
    }
}

impl CsvRow {
    /// The row as the table takes it.
    pub fn as_row(&self) -> CurveRow<'_> {
        CurveRow {
            frame: self.frame,
            capture_time_nanos: self.capture_time_nanos,
            quality: self.quality,
            timecode: None,
            activations: &self.activations,
            standard_errors: &self.standard_errors,
        }
    }
}

impl From<&curve::CurveSample> for CsvRow {
    fn from(sample: &curve::CurveSample) -> Self {
        Self {
            frame: sample.frame.0,
            capture_time_nanos: sample.capture_time_nanos,
            quality: Some(sample.quality),
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
            quality: quality(sample.quality()),
            activations: sample.activations.clone(),
            standard_errors: sample.standard_errors.clone(),
        }
    }
}

/// The quality of a sample; `None` where the server did not say.
pub fn quality(quality: proto::Quality) -> Option<Quality> {
    match quality {
        proto::Quality::Solved => Some(Quality::Solved),
        proto::Quality::Partial => Some(Quality::Partial),
        proto::Quality::Held => Some(Quality::Held),
        proto::Quality::Unspecified => None,
    }
}
