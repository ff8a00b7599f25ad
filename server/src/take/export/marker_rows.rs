//! The markers as they came, for the formats of capture systems.

mod c3d_rows;
mod trc_rows;

use frontalis_proto::v1::{MarkerFrame, TakeExport, TakeFormat, TakeHeader, take_event::Event};

use super::{
    ExportError,
    columns::{Columns, Places},
    entries::Entry,
    survey::Survey,
    turns::Turns,
};

pub(super) use c3d_rows::C3dRows;
pub(super) use trc_rows::TrcRows;

/// A frame in the columns of the take.
struct MarkerRow {
    frame: MarkerFrame,
    /// One entry a column; NaN where a coordinate was not seen.
    positions: Vec<[f32; 3]>,
}

/// Frames in their turn, whoever publishes them.
struct MarkerRows {
    columns: Columns,
    header: Option<TakeHeader>,
    places: Option<Places>,
    turns: Turns,
}

impl MarkerRows {
    fn new(survey: &Survey) -> Self {
        Self {
            columns: survey.columns.clone(),
            header: survey.header.clone(),
            places: None,
            turns: Turns::of(TakeFormat::Trc),
        }
    }

    /// The frame, if it is the next row.
    fn row(&mut self, entry: Entry) -> Result<Option<MarkerRow>, ExportError> {
        let frame = match entry {
            Entry::Frame(frame) => frame,
            Entry::Event(Event::Source(source)) => {
                self.places = Some(self.columns.places(&source, self.header.as_ref()));
                return Ok(None);
            }
            Entry::Event(_) | Entry::Sample(_) | Entry::Unknown => return Ok(None),
        };
        if !self.turns.take(frame.number, frame.capture_time_nanos) {
            return Ok(None);
        }
        let places = self.places.as_ref().ok_or(ExportError::NoSource {
            frame: frame.number,
        })?;
        let positions = places.positions(&frame);
        Ok(Some(MarkerRow { frame, positions }))
    }
}

/// What is to be said of an export, as names and texts.
fn remarks(told: &TakeExport) -> [(&'static str, String); 4] {
    let (first, last) = (told.first_frame, told.last_frame);
    [
        ("FRAMES", format!("{first}-{last}")),
        ("GAPS", told.n_gaps.to_string()),
        ("MISSING", told.n_missing_frames.to_string()),
        ("DROPPED", told.n_dropped_frames.to_string()),
    ]
}
