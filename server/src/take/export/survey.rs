//! The first reading of a take: everything that a format says before its rows.

use frontalis_analysis::timecode::Timecode;
use frontalis_proto::v1::{self, TakeExport, TakeFormat, TakeHeader, take_event::Event};

use super::{
    ExportError, columns::Columns, entries::Entry, glb_rows::MAX_KEYS, span::Span, turns::Turns,
};
use crate::wire::common;

/// What a take holds, as far as it was read.
#[derive(Clone, Debug)]
pub(super) struct Survey {
    is_of_markers: bool,
    pub(super) header: Option<TakeHeader>,
    pub(super) columns: Columns,
    pub(super) span: Span,
    /// Of the first row.
    pub(super) start_timecode: Option<Timecode>,
    /// Capture time of the first row, nanoseconds.
    pub(super) start_nanos: i64,
    /// Whether any row has a timecode.
    pub(super) has_timecode: bool,
    /// Of an animation: when its rows are, seconds after the first.
    pub(super) times_s: Vec<f32>,
    is_animation: bool,
    turns: Turns,
    n_recorded: u64,
}

impl Survey {
    pub(super) fn new(format: TakeFormat) -> Self {
        let formats_of_markers = [TakeFormat::Trc, TakeFormat::C3d, TakeFormat::Mcap];
        Self {
            is_of_markers: formats_of_markers.contains(&format),
            header: None,
            columns: Columns::default(),
            span: Span::default(),
            start_timecode: None,
            start_nanos: 0,
            has_timecode: false,
            times_s: Vec::new(),
            is_animation: format == TakeFormat::Glb,
            turns: Turns::of(format),
            n_recorded: 0,
        }
    }

    pub(super) fn add(&mut self, entry: &Entry) -> Result<(), ExportError> {
        match entry {
            Entry::Frame(frame) => {
                self.n_recorded += 1;
                if self.is_of_markers {
                    self.row(
                        frame.number,
                        frame.capture_time_nanos,
                        frame.timecode.as_ref(),
                    )?;
                }
            }
            Entry::Sample(sample) => {
                if !self.is_of_markers {
                    self.row(
                        sample.frame,
                        sample.capture_time_nanos,
                        sample.timecode.as_ref(),
                    )?;
                }
            }
            Entry::Event(Event::Header(header)) => self.header = Some(header.clone()),
            Entry::Event(Event::Source(source)) => {
                self.columns.add(source, self.header.as_ref())?;
            }
            Entry::Event(Event::Gap(gap)) => self.span.explain(gap),
            Entry::Event(_) | Entry::Unknown => {}
        }
        Ok(())
    }

    /// Counts a frame, if it is the next row.
    fn row(
        &mut self,
        number: u64,
        capture_time_nanos: i64,
        timecode: Option<&v1::Timecode>,
    ) -> Result<(), ExportError> {
        if !self.turns.take(number, capture_time_nanos) {
            return Ok(());
        }
        self.span.add(number);
        if self.is_animation {
            if self.times_s.len() == MAX_KEYS {
                return Err(ExportError::LongAnimation { limit: MAX_KEYS });
            }
            self.times_s.push(self.turns.last_s());
        }
        let timecode = timecode.and_then(common::timecode);
        if self.span.n_rows() == 1 {
            self.start_nanos = capture_time_nanos;
            self.start_timecode = timecode;
        }
        self.has_timecode |= timecode.is_some();
        Ok(())
    }

    /// The names of the activations.
    pub(super) fn controls(&self) -> Result<&[String], ExportError> {
        let header = self.header.as_ref().ok_or(ExportError::NoHeader)?;
        Ok(&header.controls)
    }

    pub(super) fn tell(&self, told: &mut TakeExport) {
        self.span.tell(told);
        told.n_dropped_frames = self.n_recorded.saturating_sub(self.span.n_rows());
        told.start_timecode = self.start_timecode.as_ref().map(common::timecode_to_wire);
    }
}
