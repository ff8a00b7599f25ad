//! The markers as TRC: a row for every frame that came, with its own number and time.

use frontalis_analysis::format::trc::{TrcFrame, TrcHeading, TrcWriter};
use frontalis_proto::v1::TakeExport;

use super::{MarkerRows, remarks};
use crate::take::export::{
    ExportError, Outlet, Rows, entries::Entry, survey::Survey, turns::seconds,
};

pub(in crate::take::export) struct TrcRows {
    writer: TrcWriter<Outlet>,
    rows: MarkerRows,
    start_nanos: i64,
    n_written: u64,
}

impl TrcRows {
    pub(in crate::take::export) fn new(
        out: Outlet,
        survey: &Survey,
        told: &TakeExport,
    ) -> Result<Self, ExportError> {
        let columns = &survey.columns;
        let empty = ExportError::Empty { what: "frame" };
        let rate_hz = columns.rate_hz().ok_or(empty)?;
        let remarks = remarks(told).map(|(name, text)| format!("{}={text}", name.to_lowercase()));
        let heading = TrcHeading {
            name: &told.file_name,
            rate_hz,
            unit: columns.unit(),
            marker_names: columns.names(),
            first_frame: told.first_frame,
            n_frames: told.n_frames,
            start_timecode: survey.start_timecode,
            remarks: &remarks,
        };
        Ok(Self {
            writer: TrcWriter::new(out, &heading)?,
            rows: MarkerRows::new(survey),
            start_nanos: survey.start_nanos,
            n_written: 0,
        })
    }
}

impl Rows for TrcRows {
    fn add(&mut self, entry: Entry) -> Result<(), ExportError> {
        if let Some(row) = self.rows.row(entry)? {
            self.writer.write_frame(&TrcFrame {
                number: row.frame.number,
                time_s: seconds(self.start_nanos, row.frame.capture_time_nanos),
                positions: row.positions,
            })?;
            self.n_written += 1;
        }
        Ok(())
    }

    fn n_written(&self) -> u64 {
        self.n_written
    }

    fn finish(self: Box<Self>) -> Result<(), ExportError> {
        self.writer.finish()?;
        Ok(())
    }
}
