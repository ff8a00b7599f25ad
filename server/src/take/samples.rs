//! The samples of a take from any of them on, a bounded piece at a time (CONTRACTS D-17, D-20).
//!
//! What stands where in a file that grows is told by its [`Growth`]; in the final form the chunk is found by halving, which
//! reads a few of them. Samples and the gaps between them stand in a file in the order of their frames.

use std::path::Path;

use frontalis_proto::v1::{self, take_event::Event};
use prost::Message as _;

use super::{
    channel::Channel, growth::Growth, places::Places, read::TakeRecord, rewrite::TakeFileError,
};
use crate::fs::Fs;

/// Stored bytes of one piece: what is kept for one reader.
const PIECE_BYTES: usize = 128 << 10;

/// Memory of an entry beside its bytes.
const ENTRY_BYTES: usize = size_of::<StoredEntry>();

/// What a take holds of a run's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleSpan {
    /// The run.
    pub run: u64,
    /// Sequence of the first sample, or of the one that would have been.
    pub first: u64,
    /// Frame of the first sample.
    pub first_frame: u64,
    /// Sequence of the last sample; before `first` when there is none.
    pub last: u64,
}

/// One entry of a run, as it is stored.
#[derive(Clone, Debug, PartialEq)]
pub enum StoredEntry {
    /// A `frontalis.v1.CurveSample`.
    Sample {
        /// Its sequence.
        sequence: u64,
        /// Its frame.
        frame: u64,
        /// The message.
        data: Box<[u8]>,
    },
    /// Frames without one.
    Gap(v1::Gap),
}

/// The number that a message begins with: that of a frame, or of a sample's frame.
#[derive(Clone, PartialEq, prost::Message)]
struct Numbered {
    #[prost(uint64, tag = "1")]
    number: u64,
}

/// Of a sample, what its place is.
#[derive(Clone, PartialEq, prost::Message)]
struct Placed {
    #[prost(uint64, tag = "1")]
    frame: u64,
    #[prost(uint64, tag = "12")]
    sequence: u64,
}

/// Where a reader of samples stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    /// The next sample.
    sequence: u64,
    /// The last frame that is known.
    last_frame: u64,
}

/// Reads the samples of one take. It goes on with the file that it began with, also when a file of the final form takes its
/// place.
pub struct SampleReader {
    places: Places,
    place: Place,
    frames_through: u64,
}

impl SampleReader {
    /// Opens `file` at sample `sequence`, for somebody who knows of all frames through `last_frame`; `growth` is that of a
    /// take under way.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`] when the file cannot be read.
    pub fn open(
        fs: &dyn Fs,
        file: &Path,
        growth: Option<&Growth>,
        sequence: u64,
        last_frame: u64,
    ) -> Result<Self, TakeFileError> {
        let n_bytes = growth.map_or(u64::MAX, |it| it.committed().n_bytes);
        let mut places = Places::open(fs, file, n_bytes)?;
        let start = match (&mut places, growth) {
            (Places::Growing(_), Some(growth)) => Some(growth.before_sample(sequence)),
            (Places::Growing(_), None) => None,
            (Places::Finished(_), _) => chunk_before(&mut places, sequence)?,
        };
        if let Some(start) = start {
            places.go_to(start);
        }
        Ok(Self {
            places,
            place: Place {
                sequence,
                last_frame,
            },
            frames_through: 0,
        })
    }

    /// What follows, as far as it is on stable storage: `n_bytes` of a take under way. Nothing: the end, for now.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`] when the file cannot be read.
    pub fn next_piece(&mut self, n_bytes: Option<u64>) -> Result<Vec<StoredEntry>, TakeFileError> {
        if let Some(n_bytes) = n_bytes {
            self.places.grow(n_bytes);
        }
        let mut piece = Vec::new();
        let mut piece_bytes = 0;
        loop {
            let start = self.places.offset();
            let Some(records) = self.places.next()? else {
                return Ok(piece);
            };
            for record in &records {
                if piece_bytes >= PIECE_BYTES {
                    // The rest of the chunk is read again for the next piece.
                    self.places.go_to(start);
                    return Ok(piece);
                }
                let n_before = piece.len();
                self.take(record, &mut piece);
                match piece.len() {
                    0 => piece_bytes = 0,
                    n if n > n_before => piece_bytes += record.data.len() + ENTRY_BYTES,
                    _ => {}
                }
            }
        }
    }

    /// The last frames that were read past, if no sample and no gap answers for them.
    pub fn unsolved(&self) -> Option<v1::Gap> {
        let first = self.place.last_frame.saturating_add(1);
        (self.frames_through >= first).then(|| v1::Gap {
            first,
            last: self.frames_through,
            cause: v1::GapCause::Shed.into(),
        })
    }

    fn take(&mut self, record: &TakeRecord, piece: &mut Vec<StoredEntry>) {
        let data = record.data.as_slice();
        match record.channel {
            Channel::Markers => {
                let number = Numbered::decode(data).map_or(0, |it| it.number);
                self.frames_through = self.frames_through.max(number);
            }
            Channel::Curves => {
                if let Ok(placed) = Placed::decode(data) {
                    self.take_sample(&placed, data, piece);
                }
            }
            Channel::Events => {
                if let Ok(event) = v1::TakeEvent::decode(data)
                    && let Some(Event::Gap(gap)) = event.event
                    && gap.last > self.place.last_frame
                {
                    self.place.last_frame = gap.last;
                    piece.push(StoredEntry::Gap(gap));
                }
            }
        }
    }

    fn take_sample(&mut self, placed: &Placed, data: &[u8], piece: &mut Vec<StoredEntry>) {
        let Placed { frame, sequence } = *placed;
        self.place.last_frame = self.place.last_frame.max(frame);
        if sequence < self.place.sequence {
            // Nor are the gaps wanted that stand before a sample that is not.
            piece.clear();
            return;
        }
        self.place.sequence = sequence.saturating_add(1);
        piece.push(StoredEntry::Sample {
            sequence,
            frame,
            data: data.into(),
        });
    }

    /// What a take that is over holds of a run's samples; `None` when not even its header is there.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`] when the file cannot be read.
    pub fn span(fs: &dyn Fs, file: &Path) -> Result<Option<SampleSpan>, TakeFileError> {
        let mut places = Places::open(fs, file, u64::MAX)?;
        let mut header = None;
        let mut first = None;
        while let Some(records) = places.next()? {
            header = header.or_else(|| header_of(&records));
            first = samples(&records).next();
            if first.is_some() {
                break;
            }
        }
        let run = header.as_ref().map_or(0, |it| it.run);
        let Some(first) = first else {
            return Ok(header.map(|it| SampleSpan {
                run,
                first: it.next_sequence,
                first_frame: it.next_frame,
                last: it.next_sequence.saturating_sub(1),
            }));
        };
        let last = last_sample(&mut places)?.unwrap_or(first.sequence);
        Ok(Some(SampleSpan {
            run,
            first: first.sequence,
            first_frame: first.frame,
            last: last.max(first.sequence),
        }))
    }
}

fn samples(records: &[TakeRecord]) -> impl DoubleEndedIterator<Item = Placed> {
    let curves = records.iter().filter(|it| it.channel == Channel::Curves);
    curves.filter_map(|it| Placed::decode(it.data.as_slice()).ok())
}

fn header_of(records: &[TakeRecord]) -> Option<v1::TakeHeader> {
    let mut events = records.iter().filter(|it| it.channel == Channel::Events);
    events.find_map(|it| match v1::TakeEvent::decode(it.data.as_slice()) {
        Ok(v1::TakeEvent {
            event: Some(Event::Header(header)),
        }) => Some(header),
        _ => None,
    })
}

/// Sequence of the last sample.
fn last_sample(places: &mut Places) -> Result<Option<u64>, TakeFileError> {
    let starts = match places {
        Places::Finished(finished) => finished.chunks()?,
        // One that was never put into its final form: all of it is looked at, from where it stands.
        Places::Growing(_) => {
            let mut last = None;
            while let Some(records) = places.next()? {
                last = samples(&records).next_back().or(last);
            }
            return Ok(last.map(|it| it.sequence));
        }
    };
    for start in starts.into_iter().rev() {
        places.go_to(start);
        let records = places.next()?.unwrap_or_default();
        if let Some(last) = samples(&records).next_back() {
            return Ok(Some(last.sequence));
        }
    }
    Ok(None)
}

/// The last chunk whose first sample comes before `sequence`.
fn chunk_before(places: &mut Places, sequence: u64) -> Result<Option<u64>, TakeFileError> {
    let Places::Finished(finished) = places else {
        return Ok(None);
    };
    let starts = finished.chunks()?;
    let (mut low, mut high) = (0, starts.len());
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if first_sample_from(places, &starts[middle..high])?.is_some_and(|it| it < sequence) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(starts.get(low).copied())
}

/// Sequence of the first sample in these chunks.
fn first_sample_from(places: &mut Places, starts: &[u64]) -> Result<Option<u64>, TakeFileError> {
    for start in starts {
        places.go_to(*start);
        let records = places.next()?.unwrap_or_default();
        if let Some(first) = samples(&records).next() {
            return Ok(Some(first.sequence));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests;
