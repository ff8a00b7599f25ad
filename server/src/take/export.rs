//! A take in an exchange format, made piece by piece from what is on stable storage (CONTRACTS U-13).
//!
//! The file is read twice: once for what stands before the rows of most formats (their number, the first and last frame,
//! the gaps, the markers), and once for the rows. Each step does a little work and holds a little memory, so that whoever
//! takes the pieces sets the pace and holds nobody up.

mod columns;
mod entries;
mod error;
mod glb_rows;
mod live_link_rows;
mod marker_rows;
mod muscle_rows;
mod outlet;
mod row_clock;
mod span;
mod survey;
mod turns;
mod whole_file;

use std::{path::PathBuf, sync::Arc};

use frontalis_analysis::face::actor::Actor;
use frontalis_proto::v1::{self, TakeFormat};

use crate::fs::Fs;
use entries::{Entries, Entry};
use outlet::Outlet;
use survey::Survey;
use whole_file::WholeFile;

pub use error::ExportError;

/// Bytes of one piece.
pub const PIECE_BYTES: usize = 64 * 1024;

/// Most messages of a take that one step reads.
const MESSAGES_A_STEP: usize = 2_048;

/// The take that is exported.
#[derive(Clone, Debug)]
pub struct ExportSource {
    /// Where its file is.
    pub fs: Arc<dyn Fs>,
    /// Its file.
    pub file: PathBuf,
    /// Bytes of a file that grows, as far as they are on stable storage; one of the final form is read to its end.
    pub n_bytes: u64,
    /// What is known of it.
    pub take: v1::Take,
    /// Whose face a GLB shows; no other format looks at it.
    pub actor: Option<Arc<Actor>>,
}

/// An export on its way.
pub struct Export {
    source: ExportSource,
    told: v1::TakeExport,
    outlet: Outlet,
    stage: Stage,
}

enum Stage {
    /// Looks through the take.
    Surveying(Box<(Entries, Survey)>),
    /// The figures are known.
    Surveyed(Box<Survey>),
    /// Writes rows.
    Rows(Entries, Box<dyn Rows>),
    /// Hands out the stored bytes.
    Whole(WholeFile),
    /// Nothing more is written.
    Written,
    /// Nothing more is said.
    Over,
}

/// What one step came to.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// There is more to do before something can be said.
    Working,
    /// To be sent.
    Piece(Box<v1::ExportTakeResponse>),
    /// All was said.
    Over,
}

/// Writes the rows of one format into an [`Outlet`].
trait Rows: Send {
    /// Takes in the next thing that the take holds.
    fn add(&mut self, entry: Entry) -> Result<(), ExportError>;

    /// Writes a row that is owed from before; whether there was one.
    fn go_on(&mut self) -> Result<bool, ExportError> {
        Ok(false)
    }

    /// Rows so far.
    fn n_written(&self) -> u64;

    /// Writes the end.
    fn finish(self: Box<Self>) -> Result<(), ExportError>;
}

impl Export {
    /// Begins an export; nothing is read before the first step.
    ///
    /// # Errors
    ///
    /// That the file cannot be opened.
    pub fn start(source: ExportSource, format: TakeFormat) -> Result<Self, ExportError> {
        let stage = match Entries::open(&source) {
            Ok(entries) => Stage::Surveying(Box::new((entries, Survey::new(format)))),
            // Whatever the file is, its bytes can be had.
            Err(_) if format == TakeFormat::Mcap => Stage::Surveyed(Box::new(Survey::new(format))),
            Err(error) => return Err(error),
        };
        Ok(Self {
            told: v1::TakeExport {
                format: format.into(),
                file_name: frontalis_proto::export_file_name(&source.take, format),
                ..v1::TakeExport::default()
            },
            source,
            outlet: Outlet::default(),
            stage,
        })
    }

    fn format(&self) -> TakeFormat {
        self.told.format()
    }

    /// Does a little more.
    ///
    /// # Errors
    ///
    /// A take that cannot be read, or that the format cannot hold.
    pub fn step(&mut self) -> Result<Step, ExportError> {
        let is_over = match std::mem::replace(&mut self.stage, Stage::Over) {
            Stage::Surveying(surveying) => {
                self.survey(surveying)?;
                return Ok(Step::Working);
            }
            Stage::Surveyed(survey) => return self.begin(&survey),
            Stage::Rows(entries, rows) => {
                self.write(entries, rows)?;
                false
            }
            Stage::Whole(file) => {
                self.copy(file)?;
                false
            }
            Stage::Written => {
                self.stage = Stage::Written;
                self.outlet.is_empty()
            }
            Stage::Over => return Ok(Step::Over),
        };
        Ok(if is_over { self.end() } else { self.piece() })
    }

    fn survey(&mut self, mut surveying: Box<(Entries, Survey)>) -> Result<(), ExportError> {
        let (entries, survey) = &mut *surveying;
        for _ in 0..MESSAGES_A_STEP {
            let added = entries.next().and_then(|next| match next {
                Some(entry) => survey.add(&entry).map(|()| true),
                None => Ok(false),
            });
            let goes_on = match added {
                // What cannot be read of a take is in its own bytes all the same.
                Err(_) if self.format() == TakeFormat::Mcap => false,
                added => added?,
            };
            if !goes_on {
                self.stage = Stage::Surveyed(Box::new(surveying.1));
                return Ok(());
            }
        }
        self.stage = Stage::Surveying(surveying);
        Ok(())
    }

    /// Says what comes, and writes what stands before the rows.
    fn begin(&mut self, survey: &Survey) -> Result<Step, ExportError> {
        survey.tell(&mut self.told);
        self.stage = if self.format() == TakeFormat::Mcap {
            let file = WholeFile::open(&self.source)?;
            self.told.n_bytes = file.n_bytes();
            Stage::Whole(file)
        } else {
            let entries = Entries::open(&self.source)?;
            Stage::Rows(entries, self.rows(survey)?)
        };
        Ok(Step::Piece(Box::new(v1::ExportTakeResponse {
            export: Some(self.told.clone()),
            ..v1::ExportTakeResponse::default()
        })))
    }

    fn rows(&mut self, survey: &Survey) -> Result<Box<dyn Rows>, ExportError> {
        let out = self.outlet.clone();
        let (source, told) = (&self.source, &mut self.told);
        Ok(match told.format() {
            TakeFormat::LiveLinkCsv => {
                let rows = live_link_rows::LiveLinkRows::new(out, survey)?;
                told.undriven_shapes = rows.undriven();
                Box::new(rows)
            }
            TakeFormat::Glb => Box::new(glb_rows::GlbRows::new(out, survey, source, told)?),
            TakeFormat::Trc => Box::new(marker_rows::TrcRows::new(out, survey, told)?),
            TakeFormat::C3d => Box::new(marker_rows::C3dRows::new(out, survey, source, told)?),
            TakeFormat::Csv | TakeFormat::Mcap | TakeFormat::Unspecified => {
                Box::new(muscle_rows::MuscleRows::new(out, survey)?)
            }
        })
    }

    fn write(&mut self, mut entries: Entries, mut rows: Box<dyn Rows>) -> Result<(), ExportError> {
        for _ in 0..MESSAGES_A_STEP {
            if self.outlet.n_waiting() >= PIECE_BYTES {
                break;
            }
            if rows.go_on()? {
                continue;
            }
            // A take that has grown since it was surveyed is exported as it was then.
            let is_whole = rows.n_written() == self.told.n_frames;
            let next = if is_whole { None } else { entries.next()? };
            let Some(entry) = next else {
                self.outlet.frames_done = rows.n_written();
                rows.finish()?;
                self.stage = Stage::Written;
                return Ok(());
            };
            rows.add(entry)?;
        }
        self.outlet.frames_done = rows.n_written();
        self.stage = Stage::Rows(entries, rows);
        Ok(())
    }

    fn copy(&mut self, mut file: WholeFile) -> Result<(), ExportError> {
        let is_over = file.copy(&mut self.outlet)?;
        self.outlet.frames_done = file.n_copied();
        self.stage = if is_over {
            Stage::Written
        } else {
            Stage::Whole(file)
        };
        Ok(())
    }

    /// What was written, as far as it goes into one piece.
    fn piece(&mut self) -> Step {
        let chunk = self.outlet.take(PIECE_BYTES);
        if chunk.is_empty() {
            return Step::Working;
        }
        Step::Piece(Box::new(v1::ExportTakeResponse {
            chunk,
            frames_done: self.outlet.frames_done,
            export: None,
        }))
    }

    /// The last words: figures and checksum.
    fn end(&mut self) -> Step {
        self.stage = Stage::Over;
        (self.told.n_bytes, self.told.sha256) = self.outlet.sum();
        Step::Piece(Box::new(v1::ExportTakeResponse {
            chunk: Vec::new(),
            frames_done: self.outlet.frames_done,
            export: Some(self.told.clone()),
        }))
    }
}

#[cfg(test)]
mod tests;
