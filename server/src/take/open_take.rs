//! A take that is being recorded: what waits for the next commit, and the file that commits go to.

use std::{
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use frontalis_proto::v1;
use prost::Message as _;

use super::{
    channel::Channel,
    chunk::{ChunkBuffer, Message},
    disk_room::IngestRate,
    figures::TakeFigures,
    growth::{Growth, Written},
    head::growing_head,
};
use crate::{
    executor::Workers,
    fs::{AppendFile, Fs},
    name::TakeId,
    session::{RecordedFrame, SessionHandle},
};

/// How a recording goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// Everything that was acknowledged is on stable storage.
    Sound,
    /// Something could not be written; the take ends with what is on stable storage (CONTRACTS U-8).
    Degraded,
    /// The disk was full; likewise (CONTRACTS U-9).
    DiskFull,
}

/// The file of a take in the directory of takes.
pub fn file_name(id: &TakeId) -> String {
    format!("{id}.mcap")
}

/// One take under way.
#[derive(Debug)]
pub(super) struct OpenTake {
    pub(super) id: TakeId,
    pub(super) session: SessionHandle,
    /// What of it can be read.
    pub(super) growth: Arc<Growth>,
    pending: Mutex<Pending>,
    /// `None` once nothing is written any more.
    file: tokio::sync::Mutex<Option<Box<dyn AppendFile>>>,
    ingest: Arc<IngestRate>,
}

#[derive(Debug)]
struct Pending {
    chunk: ChunkBuffer,
    next_sequences: [u32; 3],
    /// With the chunk.
    written: Written,
    /// Before the chunk.
    written_before: Written,
    /// Of all that was added.
    figures: TakeFigures,
    /// Of what is on stable storage.
    committed: TakeFigures,
    /// Of what is on stable storage.
    n_bytes: u64,
    condition: Condition,
}

impl OpenTake {
    /// A take whose file exists with its head.
    fn new(
        id: TakeId,
        session: SessionHandle,
        file: Box<dyn AppendFile>,
        n_bytes: u64,
        ingest: Arc<IngestRate>,
    ) -> Self {
        Self {
            id,
            growth: Arc::new(Growth::new(session.run(), n_bytes)),
            session,
            ingest,
            pending: Mutex::new(Pending {
                chunk: ChunkBuffer::default(),
                next_sequences: [0; 3],
                written: Written::default(),
                written_before: Written::default(),
                figures: TakeFigures::default(),
                committed: TakeFigures::default(),
                n_bytes,
                condition: Condition::Sound,
            }),
            file: tokio::sync::Mutex::new(Some(file)),
        }
    }

    /// Makes the file of a new take, durably, with nothing but its head.
    pub(super) async fn create(
        id: TakeId,
        session: SessionHandle,
        fs: Arc<dyn Fs>,
        dir: PathBuf,
        workers: &Workers,
        ingest: Arc<IngestRate>,
    ) -> io::Result<Self> {
        let name = file_name(&id);
        let made = workers.run(move || {
            let begun = begin(&*fs, &dir, &name);
            let is_ours = |error: &io::Error| error.kind() != io::ErrorKind::AlreadyExists;
            if begun.as_ref().is_err_and(is_ours) {
                // What cannot be removed now is a take that never began, and is removed at the next start.
                drop(fs.remove(&dir.join(&name)));
            }
            begun
        });
        let (file, n_bytes) = made.await?;
        Ok(Self::new(id, session, file, n_bytes, ingest))
    }

    pub(super) fn add_frame(&self, frame: &RecordedFrame, time_nanos: u64) {
        let mut pending = self.pending();
        pending.written.add_frame(frame.number);
        pending.figures.count_frame(frame.number, frame.timecode);
        pending.add(Channel::Markers, &frame.sent, time_nanos);
    }

    pub(super) fn add_sample(&self, sample: &v1::CurveSample, time_nanos: u64) {
        let mut pending = self.pending();
        pending.figures.n_samples += 1;
        pending.written.add_sample(sample.sequence, sample.frame);
        pending.add(Channel::Curves, &sample.encode_to_vec(), time_nanos);
    }

    pub(super) fn add_event(&self, event: v1::take_event::Event, time_nanos: u64) {
        let event = v1::TakeEvent { event: Some(event) };
        let data = event.encode_to_vec();
        self.pending().add(Channel::Events, &data, time_nanos);
    }

    /// Of all that was added, on stable storage or not.
    pub(super) fn figures_added(&self) -> TakeFigures {
        self.pending().figures
    }

    /// What is on stable storage, the length of the file that far, and how it goes.
    pub(super) fn figures(&self) -> (TakeFigures, u64, Condition) {
        let pending = self.pending();
        (pending.committed, pending.n_bytes, pending.condition)
    }

    /// Whether there is something to commit, and a file that takes it.
    pub(super) fn has_pending(&self) -> bool {
        let pending = self.pending();
        pending.condition == Condition::Sound && !pending.chunk.is_empty()
    }

    /// Puts what waits on stable storage and tells the session. After a failure nothing is written any more.
    pub(super) async fn commit(&self, workers: &Workers) {
        let mut writing = self.file.lock().await;
        let Some(mut file) = writing.take() else {
            return;
        };
        let (chunk, before, through, figures) = {
            let mut pending = self.pending();
            if pending.chunk.is_empty() {
                drop(pending);
                *writing = Some(file);
                return;
            }
            let before = pending.written_before;
            pending.written_before = pending.written;
            (
                pending.chunk.take(),
                before,
                pending.written,
                pending.figures,
            )
        };
        let n_bytes = chunk.len() as u64;
        let written = workers.run(move || {
            file.append(&chunk)?;
            file.sync()?;
            Ok::<_, io::Error>(file)
        });
        match written.await {
            Ok(file) => {
                *writing = Some(file);
                {
                    let mut pending = self.pending();
                    pending.n_bytes += n_bytes;
                    pending.committed = figures;
                }
                self.ingest.count(n_bytes);
                self.growth.commit(n_bytes, before, through);
                self.session.set_durable_through(through.frames_through);
            }
            Err(error) => self.fail(&error),
        }
    }

    fn fail(&self, error: &io::Error) {
        let is_full = error.kind() == io::ErrorKind::StorageFull;
        tracing::error!(take = %self.id, %error, "a take could not be written, it ends here");
        self.pending().condition = if is_full {
            Condition::DiskFull
        } else {
            Condition::Degraded
        };
        self.session.stop_recording();
    }

    /// Nothing is written any more.
    pub(super) async fn close(&self) {
        self.file.lock().await.take();
        self.growth.end();
    }

    fn pending(&self) -> MutexGuard<'_, Pending> {
        self.pending.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A new file with its head, both on stable storage.
fn begin(fs: &dyn Fs, dir: &Path, name: &str) -> io::Result<(Box<dyn AppendFile>, u64)> {
    let head = growing_head().map_err(io::Error::other)?;
    let mut file = fs.create(&dir.join(name))?;
    file.append(head)?;
    file.sync()?;
    fs.sync_dir(dir)?;
    Ok((file, head.len() as u64))
}

impl Pending {
    fn add(&mut self, channel: Channel, data: &[u8], time_nanos: u64) {
        if self.condition != Condition::Sound {
            return;
        }
        let next = &mut self.next_sequences[usize::from(channel.id() - 1)];
        self.chunk.add(&Message {
            channel,
            sequence: *next,
            time_nanos,
            data,
        });
        *next = next.wrapping_add(1);
    }
}
