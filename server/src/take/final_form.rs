//! Writing a take in its final form: large compressed chunks with index and summary.

use std::{
    io::{self, Write},
    path::Path,
};

use mcap::{
    Compression,
    records::MessageHeader,
    write::{NoSeek, Writer},
};

use super::{channel, chunk::Message, head::final_version, rewrite::TakeFileError};
use crate::fs::{AppendFile, Fs};

/// Records of one chunk before compression.
const CHUNK_BYTES: u64 = 4 << 20;

/// A file that is being written.
pub(super) struct FinalForm(Writer<NoSeek<Sink>>);

impl FinalForm {
    /// Makes `file`, which must not exist.
    pub(super) fn create(fs: &dyn Fs, file: &Path) -> Result<Self, TakeFileError> {
        let sink = Sink {
            file: fs.create(file)?,
            n_bytes: 0,
            waiting: Vec::new(),
        };
        let options = channel::options()
            .compression(Some(Compression::Zstd))
            .chunk_size(Some(CHUNK_BYTES));
        let mut writer = options.create(NoSeek::new(sink))?;
        writer.write_metadata(&final_version())?;
        channel::declare(&mut writer)?;
        Ok(Self(writer))
    }

    pub(super) fn add(&mut self, message: &Message<'_>) -> Result<(), TakeFileError> {
        let header = MessageHeader {
            channel_id: message.channel.id(),
            sequence: message.sequence,
            log_time: message.time_nanos,
            publish_time: message.time_nanos,
        };
        Ok(self.0.write_to_known_channel(&header, message.data)?)
    }

    /// Flushes everything to the disk; returns the length of the file.
    pub(super) fn finish(mut self) -> Result<u64, TakeFileError> {
        self.0.finish()?;
        let mut sink = self.0.into_inner().into_inner();
        sink.write_waiting()?;
        sink.file.sync()?;
        Ok(sink.n_bytes)
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
