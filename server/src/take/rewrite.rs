//! A take that is over, in large compressed chunks with index and summary, in place of the file that grew (CONTRACTS U-3).

use std::{
    io::{self, Write},
    path::Path,
};

use frontalis_proto::v1::{TakeCut, TakeEvent, take_event::Event};
use mcap::{
    Compression,
    records::MessageHeader,
    write::{NoSeek, Writer},
};
use prost::Message as _;

use super::{
    channel::{self, Channel},
    chunk::Message,
    figures::TakeFigures,
    head::final_version,
    scan::{self, Piece, Scan, ScanError},
};
use crate::fs::{AppendFile, Fs, TEMPORARY_SUFFIX};

/// Records of one chunk before compression.
const CHUNK_BYTES: u64 = 4 << 20;

/// What a rewriting found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rewritten {
    /// Of what could be read.
    pub figures: TakeFigures,
    /// Length of the new file.
    pub n_bytes: u64,
    /// Bytes amid the file that could not be read.
    pub n_damaged_bytes: u64,
    /// Bytes at its end that were never acknowledged.
    pub n_tail_bytes: u64,
    /// When the last message was recorded, Unix nanoseconds; 0 without messages.
    pub last_time_nanos: u64,
}

/// Why a take's file cannot be read, or not be put into its final form; what is there stays.
#[derive(Debug, thiserror::Error)]
pub enum TakeFileError {
    /// It could not be read.
    #[error(transparent)]
    Scan(#[from] ScanError),
    /// The file system failed.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The writer refused.
    #[error(transparent)]
    Format(#[from] mcap::McapError),
}

/// Puts the compressed form of `name` in `dir` in its place. A crash at any moment leaves one of the two, and a failure no
/// temporary file, unless that cannot even be removed.
///
/// # Errors
///
/// [`TakeFileError`]; the file then has one of its two forms.
pub fn rewrite(fs: &dyn Fs, dir: &Path, name: &str) -> Result<Rewritten, TakeFileError> {
    let file = dir.join(name);
    let temporary = dir.join(format!("{name}{TEMPORARY_SUFFIX}"));
    fs.remove(&temporary)?;
    let copied = copy(fs, &file, &temporary);
    let replaced = copied.and_then(|it| Ok(fs.rename(&temporary, &file).map(|()| it)?));
    if replaced.is_err() {
        // On a full disk it would be in the way; what cannot be removed now is at the next start.
        drop(fs.remove(&temporary));
    }
    let rewritten = replaced?;
    fs.sync_dir(dir)?;
    Ok(rewritten)
}

fn copy(fs: &dyn Fs, from: &Path, to: &Path) -> Result<Rewritten, TakeFileError> {
    let grown = fs.open(from)?;
    let size = grown.size()?;
    let mut scan = Scan::start(grown, size)?;
    let sink = Sink {
        file: fs.create(to)?,
        n_bytes: 0,
        waiting: Vec::new(),
    };
    let mut copy = Copy::start(sink)?;
    while let Some(piece) = scan.next()? {
        match piece {
            Piece::Chunk(chunk) => copy.add_all(&scan::messages(&chunk))?,
            Piece::Damage { n_bytes } => copy.add_cut(n_bytes)?,
            Piece::Tail { n_bytes } => copy.rewritten.n_tail_bytes += n_bytes,
        }
    }
    copy.finish()
}

/// A file that is being written.
struct Copy {
    writer: Writer<NoSeek<Sink>>,
    rewritten: Rewritten,
    next_event: u32,
}

impl Copy {
    fn start(sink: Sink) -> Result<Self, TakeFileError> {
        let options = channel::options()
            .compression(Some(Compression::Zstd))
            .chunk_size(Some(CHUNK_BYTES));
        let mut writer = options.create(NoSeek::new(sink))?;
        writer.write_metadata(&final_version())?;
        channel::declare(&mut writer)?;
        Ok(Self {
            writer,
            rewritten: Rewritten::default(),
            next_event: 0,
        })
    }

    fn add_all(&mut self, messages: &[Message<'_>]) -> Result<(), TakeFileError> {
        for message in messages {
            self.rewritten.figures.count(message.channel, message.data);
            self.add(message)?;
        }
        Ok(())
    }

    fn add(&mut self, message: &Message<'_>) -> Result<(), TakeFileError> {
        self.rewritten.last_time_nanos = message.time_nanos;
        if message.channel == Channel::Events {
            self.next_event = message.sequence.saturating_add(1);
        }
        let header = MessageHeader {
            channel_id: message.channel.id(),
            sequence: message.sequence,
            log_time: message.time_nanos,
            publish_time: message.time_nanos,
        };
        Ok(self.writer.write_to_known_channel(&header, message.data)?)
    }

    /// Says where something is missing.
    fn add_cut(&mut self, n_bytes: u64) -> Result<(), TakeFileError> {
        self.rewritten.n_damaged_bytes += n_bytes;
        let event = TakeEvent {
            event: Some(Event::Cut(TakeCut { n_bytes })),
        };
        self.add(&Message {
            channel: Channel::Events,
            sequence: self.next_event,
            time_nanos: self.rewritten.last_time_nanos,
            data: &event.encode_to_vec(),
        })
    }

    fn finish(mut self) -> Result<Rewritten, TakeFileError> {
        self.writer.finish()?;
        let mut sink = self.writer.into_inner().into_inner();
        sink.write_waiting()?;
        sink.file.sync()?;
        self.rewritten.n_bytes = sink.n_bytes;
        Ok(self.rewritten)
    }
}

/// What is written to the file at once, bytes; the writer gives its records in many small parts.
const WRITE_BYTES: usize = 64 << 10;

/// A growing file as a writer sees it.
struct Sink {
    file: Box<dyn AppendFile>,
    n_bytes: u64,
    waiting: Vec<u8>,
}

impl Sink {
    fn write_waiting(&mut self) -> io::Result<()> {
        self.file.append(&self.waiting)?;
        self.waiting.clear();
        Ok(())
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.waiting.extend_from_slice(bytes);
        self.n_bytes += bytes.len() as u64;
        if self.waiting.len() >= WRITE_BYTES {
            self.write_waiting()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests;
