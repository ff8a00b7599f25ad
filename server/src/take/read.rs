//! Reading a take from its first message on, whether its file grows or has its final form.

use std::{io, path::Path};

use frontalis_proto::v1::{TakeCut, TakeEvent, take_event::Event};
use prost::Message as _;

use super::{
    channel::Channel,
    chunk::Message,
    finished::FinishedFile,
    rewrite::TakeFileError,
    scan::{self, Piece, Scan, ScanError},
};
use crate::fs::Fs;

/// Messages of a batch out of a file of the final form.
const MAX_BATCH: usize = 256;

/// A message of a take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TakeRecord {
    /// Where it belongs.
    pub channel: Channel,
    /// Its number in its channel, from 0.
    pub sequence: u32,
    /// Unix time at which it was recorded, nanoseconds.
    pub time_nanos: u64,
    /// The protobuf message.
    pub data: Vec<u8>,
}

impl From<&Message<'_>> for TakeRecord {
    fn from(message: &Message<'_>) -> Self {
        Self {
            channel: message.channel,
            sequence: message.sequence,
            time_nanos: message.time_nanos,
            data: message.data.to_vec(),
        }
    }
}

/// Reads one take's file, batch after batch. It goes on with the file that it began with: a take that ends meanwhile, and
/// whose file is then replaced, is read to its end.
pub struct TakeReader(Form);

enum Form {
    Growing { scan: Scan, next_event: u32 },
    Finished(Box<FinishedFile>),
}

impl TakeReader {
    /// Opens `file`. Of one that grows, the first `n_bytes` are read: those that are on stable storage.
    ///
    /// # Errors
    ///
    /// That the file system failed; a file of another form is found out by [`Self::next_batch`].
    pub fn open(fs: &dyn Fs, file: &Path, n_bytes: u64) -> Result<Self, TakeFileError> {
        let open = fs.open(file)?;
        let size = open.size()?.min(n_bytes);
        match Scan::start(open, size) {
            Ok(scan) => Ok(Self(Form::Growing {
                scan,
                next_event: 0,
            })),
            Err(ScanError::Final) => {
                let finished = FinishedFile::start(fs.open(file)?);
                Ok(Self(Form::Finished(Box::new(finished))))
            }
            Err(other) => Err(other.into()),
        }
    }

    /// Reads on to `n_bytes` of a file that grew. One of the final form does not grow.
    pub fn grow(&mut self, n_bytes: u64) {
        if let Form::Growing { scan, .. } = &mut self.0 {
            scan.grow(n_bytes);
        }
    }

    /// The next messages, at least one; `None` where the file ends, or is not on stable storage yet.
    ///
    /// Bytes that cannot be read are an event of their own, as in the final form.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`] when the file is none of ours, or cannot be read.
    pub fn next_batch(&mut self) -> Result<Option<Vec<TakeRecord>>, TakeFileError> {
        match &mut self.0 {
            Form::Growing { scan, next_event } => Ok(next_of_growing(scan, next_event)?),
            Form::Finished(file) => next_of_finished(file),
        }
    }
}

fn next_of_growing(scan: &mut Scan, next_event: &mut u32) -> io::Result<Option<Vec<TakeRecord>>> {
    match scan.next()? {
        Some(Piece::Chunk(chunk)) => {
            let messages = scan::messages(&chunk);
            let records: Vec<_> = messages.iter().map(TakeRecord::from).collect();
            let last = records.iter().rfind(|it| it.channel == Channel::Events);
            if let Some(last) = last {
                *next_event = last.sequence.saturating_add(1);
            }
            Ok(Some(records))
        }
        Some(Piece::Damage { n_bytes }) => Ok(Some(vec![cut(n_bytes, *next_event)])),
        Some(Piece::Tail { .. }) | None => Ok(None),
    }
}

/// Where something is missing.
fn cut(n_bytes: u64, sequence: u32) -> TakeRecord {
    let event = TakeEvent {
        event: Some(Event::Cut(TakeCut { n_bytes })),
    };
    TakeRecord {
        channel: Channel::Events,
        sequence,
        time_nanos: 0,
        data: event.encode_to_vec(),
    }
}

fn next_of_finished(file: &mut FinishedFile) -> Result<Option<Vec<TakeRecord>>, TakeFileError> {
    let mut batch = Vec::new();
    while batch.len() < MAX_BATCH
        && let Some(record) = file.next()?
    {
        batch.push(record);
    }
    Ok((!batch.is_empty()).then_some(batch))
}

#[cfg(test)]
mod tests;
