//! Reading a take whose file has its final form.

use std::{collections::VecDeque, path::Path};

use frontalis_proto::{MAX_TAKE_RECORD_BYTES, chunk_records};
use mcap::{
    records::{Record, op},
    sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions},
};

use super::{
    channel::Channel,
    read::TakeRecord,
    rewrite::{Rewritten, TakeFileError},
};
use crate::fs::{Fs, ReadFile};

/// The messages of a file of the final form, in order; every checksum is looked at, that of a chunk before the first of its
/// messages is given.
pub(super) struct FinishedFile {
    file: Box<dyn ReadFile>,
    offset: u64,
    reader: LinearReader,
    chunk: VecDeque<TakeRecord>,
}

impl FinishedFile {
    /// Starts at the beginning of `file`.
    pub(super) fn start(file: Box<dyn ReadFile>) -> Self {
        let options = LinearReaderOptions::default()
            .with_emit_chunks(true)
            .with_validate_data_section_crc(true)
            .with_record_length_limit(MAX_TAKE_RECORD_BYTES);
        Self {
            file,
            offset: 0,
            reader: LinearReader::new_with_options(options),
            chunk: VecDeque::new(),
        }
    }

    /// The next message of a channel of ours; `None` at the end.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`] when the file has another form, or is damaged.
    pub(super) fn next(&mut self) -> Result<Option<TakeRecord>, TakeFileError> {
        loop {
            if let Some(record) = self.chunk.pop_front() {
                return Ok(Some(record));
            }
            let Some(event) = self.reader.next_event() else {
                return Ok(None);
            };
            match event? {
                LinearReadEvent::ReadRequest(n_bytes) => {
                    let place = self.reader.insert(n_bytes);
                    let n_read = self.file.read_at(self.offset, place)?;
                    self.offset += n_read as u64;
                    self.reader.notify_read(n_read);
                }
                // Messages stand in chunks only; what looks like one elsewhere is damage.
                LinearReadEvent::Record { data, opcode } if opcode == op::CHUNK => {
                    self.chunk = chunk_messages(data)?.into();
                }
                LinearReadEvent::Record { .. } => {}
            }
        }
    }
}

/// The messages of a chunk's record, of channels of ours.
pub(super) fn chunk_messages(record: &[u8]) -> Result<Vec<TakeRecord>, TakeFileError> {
    let records = chunk_records(record)?.into_iter();
    Ok(records.filter_map(message).collect())
}

fn message(record: Record<'_>) -> Option<TakeRecord> {
    let Record::Message { header, data } = record else {
        return None;
    };
    Some(TakeRecord {
        channel: Channel::of(header.channel_id)?,
        sequence: header.sequence,
        time_nanos: header.log_time,
        data: data.into_owned(),
    })
}

/// What a file of the final form holds.
///
/// # Errors
///
/// [`TakeFileError`] when it has another form, or is damaged.
pub fn finished(fs: &dyn Fs, file: &Path) -> Result<Rewritten, TakeFileError> {
    let mut messages = FinishedFile::start(fs.open(file)?);
    let mut found = Rewritten::default();
    while let Some(message) = messages.next()? {
        found.figures.count(message.channel, &message.data);
        found.last_time_nanos = message.time_nanos;
    }
    found.n_bytes = messages.offset;
    Ok(found)
}
