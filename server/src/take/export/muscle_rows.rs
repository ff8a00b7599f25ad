//! Curves as a table, one row a sample.

use frontalis_analysis::{
    curve::Quality,
    format::curve_csv::{CurveColumns, CurveCsvWriter, CurveRow},
};
use frontalis_proto::v1::{CurveSample, Quality as WireQuality, TakeFormat};

use super::{ExportError, Outlet, Rows, entries::Entry, survey::Survey, turns::Turns};
use crate::wire::common;

pub(super) struct MuscleRows {
    writer: CurveCsvWriter<Outlet>,
    n_muscles: usize,
    turns: Turns,
    n_written: u64,
}

impl MuscleRows {
    pub(super) fn new(out: Outlet, survey: &Survey) -> Result<Self, ExportError> {
        let controls = survey.controls()?;
        let columns = CurveColumns {
            timecode: survey.has_timecode,
            standard_errors: false,
        };
        Ok(Self {
            writer: CurveCsvWriter::new(out, controls.iter().map(String::as_str), columns)?,
            n_muscles: controls.len(),
            turns: Turns::of(TakeFormat::Csv),
            n_written: 0,
        })
    }
}

impl Rows for MuscleRows {
    fn add(&mut self, entry: Entry) -> Result<(), ExportError> {
        let Some(sample) = in_turn(&mut self.turns, entry) else {
            return Ok(());
        };
        check_activations(&sample, self.n_muscles)?;
        self.n_written += 1;
        Ok(self.writer.write_row(&CurveRow {
            frame: sample.frame,
            capture_time_nanos: sample.capture_time_nanos,
            quality: quality(sample.quality()),
            timecode: sample.timecode.as_ref().and_then(common::timecode),
            activations: &sample.activations,
            standard_errors: &[],
        })?)
    }

    fn n_written(&self) -> u64 {
        self.n_written
    }

    fn finish(self: Box<Self>) -> Result<(), ExportError> {
        self.writer.finish()?;
        Ok(())
    }
}

/// The sample that is the next row.
pub(super) fn in_turn(turns: &mut Turns, entry: Entry) -> Option<CurveSample> {
    match entry {
        Entry::Sample(it) if turns.take(it.frame, it.capture_time_nanos) => Some(it),
        _ => None,
    }
}

pub(super) fn check_activations(sample: &CurveSample, expected: usize) -> Result<(), ExportError> {
    let found = sample.activations.len();
    if found == expected {
        return Ok(());
    }
    Err(ExportError::Activations {
        frame: sample.frame,
        expected,
        found,
    })
}

fn quality(quality: WireQuality) -> Option<Quality> {
    match quality {
        WireQuality::Solved => Some(Quality::Solved),
        WireQuality::Partial => Some(Quality::Partial),
        WireQuality::Held => Some(Quality::Held),
        WireQuality::Unspecified => None,
    }
}
