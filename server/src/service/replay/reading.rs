//! One subscriber's way through one take, a piece at a time.
//!
//! A piece is read on the bounded pool when the last one is used up, and by nobody else: a subscriber that does not ask
//! costs one piece and an open file (CONTRACTS D-19, D-20).

use std::{collections::VecDeque, io, path::Path, sync::Arc};

use frontalis_proto::v1;
use prost::Message as _;
use tokio::sync::watch;
use tonic::Status;

use super::{Held, Replays, unreadable};
use crate::{
    fs::Fs,
    name::TakeId,
    take::{Growth, SampleReader, StoredEntry, TakeFileError, file_name},
    wire::curve::SampleDetail,
};

/// What comes next.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Samples and the gaps among them, in the order of their frames.
    Entries {
        /// As they went.
        samples: Vec<v1::CurveSample>,
        /// Frames without one.
        gaps: Vec<v1::Gap>,
    },
    /// The next sample that the take has is a later one.
    Hole {
        /// Its sequence.
        sequence: u64,
        /// Its frame.
        frame: u64,
    },
    /// Everything that is on stable storage was given; more will follow.
    Caught,
    /// Everything was given, and the take is over.
    Over {
        /// The last frames, if it has some that were recorded and not solved.
        unsolved: Option<v1::Gap>,
    },
}

/// Reads one take from a sample on.
pub struct Replay {
    replays: Replays,
    id: TakeId,
    growth: Option<(Arc<Growth>, watch::Receiver<u64>)>,
    /// Absent before the first piece, and when a piece was asked for and not waited for.
    reader: Option<SampleReader>,
    waiting: VecDeque<StoredEntry>,
    next_sequence: u64,
    last_frame: u64,
}

/// What a reading gave.
enum Piece {
    Read(SampleReader, Vec<StoredEntry>),
    /// The take was erased meanwhile.
    Gone,
}

impl Replay {
    pub(super) fn new(replays: Replays, held: Held, sequence: u64, last_frame: u64) -> Self {
        let growth = held.growth.map(|it| {
            let watch = it.watch();
            (it, watch)
        });
        Self {
            replays,
            id: held.id,
            growth,
            reader: None,
            waiting: VecDeque::new(),
            next_sequence: sequence,
            last_frame,
        }
    }

    /// The take that is read.
    pub fn take(&self) -> &TakeId {
        &self.id
    }

    /// The next sample that was not given yet.
    pub fn next_sequence(&self) -> u64 {
        self.next_sequence
    }

    /// The last frame that was told of.
    pub fn last_frame(&self) -> u64 {
        self.last_frame
    }

    /// Notes that a gap was told.
    pub fn tell(&mut self, gap: &v1::Gap) {
        self.last_frame = self.last_frame.max(gap.last);
    }

    /// Waits until more may be on stable storage.
    pub async fn grown(&mut self) {
        if let Some((_, watch)) = &mut self.growth
            && watch.changed().await.is_ok()
        {
            return;
        }
        std::future::pending::<()>().await;
    }

    /// What comes next: `max_samples` at most, and as many gaps.
    ///
    /// # Errors
    ///
    /// That the take cannot be read.
    pub async fn step(&mut self, max_samples: usize, detail: SampleDetail) -> Result<Step, Status> {
        loop {
            if !self.waiting.is_empty() {
                return Ok(self.hand_out(max_samples, detail));
            }
            let committed = self.growth.as_mut().map(|(growth, watch)| {
                // Marked as seen before it is looked at, so that a commit in between wakes.
                watch.borrow_and_update();
                growth.committed()
            });
            let n_bytes = committed.map(|it| it.n_bytes);
            match self.read(n_bytes).await? {
                Piece::Gone => return Ok(Step::Over { unsolved: None }),
                Piece::Read(reader, piece) if piece.is_empty() => {
                    let unsolved = reader.unsolved();
                    self.reader = Some(reader);
                    return Ok(match committed {
                        Some(it) if !it.is_over => Step::Caught,
                        _ => Step::Over { unsolved },
                    });
                }
                Piece::Read(reader, piece) => {
                    self.reader = Some(reader);
                    self.waiting.extend(piece);
                }
            }
        }
    }

    async fn read(&mut self, n_bytes: Option<u64>) -> Result<Piece, Status> {
        let fs = Arc::clone(&self.replays.fs);
        let file = self.replays.dir.join(file_name(&self.id));
        let growth = self.growth.as_ref().map(|(it, _)| Arc::clone(it));
        let (sequence, last_frame) = (self.next_sequence, self.last_frame);
        let present = self.reader.take();
        let read = move || {
            if is_gone(&*fs, &file) {
                return Ok(Piece::Gone);
            }
            let mut reader = match present {
                Some(reader) => reader,
                None => SampleReader::open(&*fs, &file, growth.as_deref(), sequence, last_frame)?,
            };
            let piece = reader.next_piece(n_bytes)?;
            Ok::<_, TakeFileError>(Piece::Read(reader, piece))
        };
        let read = self.replays.recorder.read(read).await;
        read.map_err(|error| unreadable(&self.id, &error))
    }

    fn hand_out(&mut self, max_samples: usize, detail: SampleDetail) -> Step {
        let (mut samples, mut gaps) = (Vec::new(), Vec::new());
        while samples.len() < max_samples && gaps.len() < max_samples {
            let Some(entry) = self.waiting.pop_front() else {
                break;
            };
            match entry {
                StoredEntry::Gap(gap) => {
                    self.last_frame = self.last_frame.max(gap.last);
                    gaps.push(gap);
                }
                StoredEntry::Sample {
                    sequence, frame, ..
                } if sequence > self.next_sequence => {
                    self.waiting.push_front(entry);
                    if samples.is_empty() && gaps.is_empty() {
                        return Step::Hole { sequence, frame };
                    }
                    break;
                }
                StoredEntry::Sample {
                    sequence,
                    frame,
                    data,
                } => {
                    self.next_sequence = sequence.saturating_add(1);
                    self.last_frame = self.last_frame.max(frame);
                    samples.extend(sample(&data, detail));
                }
            }
        }
        Step::Entries { samples, gaps }
    }
}

/// A sample as it went to subscribers then. Markers as seen and as reproduced are not stored.
fn sample(data: &[u8], detail: SampleDetail) -> Option<v1::CurveSample> {
    // What was written is what was encoded, and its checksum was looked at.
    let mut sample = v1::CurveSample::decode(data).ok()?;
    if !detail.with_uncertainty {
        sample.standard_errors.clear();
    }
    Some(sample)
}

/// An open file stays readable when it was erased; who reads on must not.
fn is_gone(fs: &dyn Fs, file: &Path) -> bool {
    fs.open(file)
        .is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}
