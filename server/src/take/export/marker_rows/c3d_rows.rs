//! The markers as C3D: a place for every number between the first frame and the last, empty where no frame came.

use frontalis_analysis::format::c3d::{
    C3dHeading, C3dPoint, C3dWriteError, C3dWriter, MAX_POSITIONS,
};
use frontalis_proto::v1::TakeExport;

use super::{MarkerRow, MarkerRows, remarks};
use crate::take::export::{
    ExportError, ExportSource, Outlet, Rows, entries::Entry, survey::Survey,
};

pub(in crate::take::export) struct C3dRows {
    writer: C3dWriter<Outlet>,
    rows: MarkerRows,
    /// Number of the next place.
    next_number: u64,
    /// A frame that waits until the places before it are filled.
    waiting: Option<MarkerRow>,
    n_written: u64,
}

impl C3dRows {
    pub(in crate::take::export) fn new(
        out: Outlet,
        survey: &Survey,
        source: &ExportSource,
        told: &TakeExport,
    ) -> Result<Self, ExportError> {
        let heading = heading(survey)?;
        let mut remarks = remarks(told).to_vec();
        remarks.push(("TAKE", source.take.name.clone()));
        Ok(Self {
            writer: C3dWriter::with_remarks(out, &heading, &remarks)?,
            rows: MarkerRows::new(survey),
            next_number: told.first_frame,
            waiting: None,
            n_written: 0,
        })
    }
}

fn heading(survey: &Survey) -> Result<C3dHeading, ExportError> {
    let columns = &survey.columns;
    let (first, last) = (survey.span.ends()).ok_or(ExportError::Empty { what: "frame" })?;
    let rate_hz = (columns.rate_hz()).ok_or(ExportError::NoSource { frame: first })?;
    let n_markers = columns.names().len();
    let too_long = || ExportError::LongC3d {
        first,
        last,
        n_markers,
    };
    let n_places = (last - first).checked_add(1).ok_or_else(too_long)?;
    let n_positions = n_places.checked_mul(n_markers as u64);
    n_positions
        .filter(|&it| it <= MAX_POSITIONS as u64)
        .ok_or_else(too_long)?;
    let n_frames = u32::try_from(n_places).map_err(|_| too_long())?;
    let beyond = |_| C3dWriteError::FrameNumbers {
        first_frame: u32::MAX,
        n_frames,
    };
    Ok(C3dHeading {
        rate_hz,
        unit: Some(columns.unit()),
        first_frame: u32::try_from(first).map_err(beyond)?,
        n_frames,
        marker_names: columns.names().to_vec(),
        start_timecode: survey.start_timecode,
    })
}

impl Rows for C3dRows {
    fn add(&mut self, entry: Entry) -> Result<(), ExportError> {
        self.waiting = self.rows.row(entry)?;
        Ok(())
    }

    fn go_on(&mut self) -> Result<bool, ExportError> {
        let Some(row) = self.waiting.take() else {
            return Ok(false);
        };
        if self.next_number < row.frame.number {
            let n_markers = row.positions.len();
            self.writer.write_frame(&vec![None; n_markers])?;
            self.waiting = Some(row);
        } else {
            let points: Vec<_> = row.positions.iter().map(point).collect();
            self.writer.write_frame(&points)?;
            self.n_written += 1;
        }
        self.next_number += 1;
        Ok(true)
    }

    fn n_written(&self) -> u64 {
        self.n_written
    }

    fn finish(self: Box<Self>) -> Result<(), ExportError> {
        self.writer.finish()?;
        Ok(())
    }
}

/// A point, if all of it was seen.
fn point(position: &[f32; 3]) -> Option<C3dPoint> {
    let is_seen = position.iter().all(|it| it.is_finite());
    is_seen.then_some(C3dPoint {
        position: *position,
        residual: 0.0,
        cameras: 0,
    })
}
