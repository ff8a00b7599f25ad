//! A take's file from any place on, chunk after chunk, in either of its forms.

use std::{io, path::Path};

use frontalis_proto::MAX_TAKE_RECORD_BYTES;
use mcap::records::op;

use super::{
    finished::chunk_messages,
    read::TakeRecord,
    rewrite::TakeFileError,
    scan::{self, Piece, Scan, ScanError},
};
use crate::fs::{Fs, ReadFile};

/// Opcode and length of a record.
const PREFIX_BYTES: usize = 9;

/// What stands before the first record of the final form.
const MAGIC_BYTES: u64 = 8;

/// The chunks of one file, from a place on.
pub(super) enum Places {
    /// One commit after the other.
    Growing(Scan),
    /// Large compressed chunks.
    Finished(FinishedPlaces),
}

impl Places {
    /// Opens a file; of one that grows, `n_bytes` are read.
    pub(super) fn open(fs: &dyn Fs, file: &Path, n_bytes: u64) -> Result<Self, TakeFileError> {
        let open = fs.open(file)?;
        let size = open.size()?;
        match Scan::start(open, size.min(n_bytes)) {
            Ok(scan) => Ok(Self::Growing(scan)),
            Err(ScanError::Final) => Ok(Self::Finished(FinishedPlaces {
                file: fs.open(file)?,
                offset: MAGIC_BYTES,
                size,
            })),
            Err(other) => Err(other.into()),
        }
    }

    /// Reads on to `n_bytes` of a file that grew.
    pub(super) fn grow(&mut self, n_bytes: u64) {
        if let Self::Growing(scan) = self {
            scan.grow(n_bytes);
        }
    }

    /// Where the next chunk starts, or something before it.
    pub(super) fn offset(&self) -> u64 {
        match self {
            Self::Growing(scan) => scan.offset(),
            Self::Finished(places) => places.offset,
        }
    }

    /// Goes to a place that [`Self::offset`] gave.
    pub(super) fn go_to(&mut self, offset: u64) {
        match self {
            Self::Growing(scan) => scan.go_to(offset),
            Self::Finished(places) => places.offset = offset,
        }
    }

    /// The messages of the next chunk; `None` where the file ends. Of damage there is nothing but a chunk without messages.
    pub(super) fn next(&mut self) -> Result<Option<Vec<TakeRecord>>, TakeFileError> {
        match self {
            Self::Growing(scan) => Ok(match scan.next()? {
                Some(Piece::Chunk(chunk)) => {
                    let messages = scan::messages(&chunk);
                    Some(messages.iter().map(TakeRecord::from).collect())
                }
                Some(Piece::Damage { .. }) => Some(Vec::new()),
                Some(Piece::Tail { .. }) | None => None,
            }),
            Self::Finished(places) => places.next(),
        }
    }
}

/// A file of the final form: records whose lengths lead from one to the next.
pub(super) struct FinishedPlaces {
    file: Box<dyn ReadFile>,
    offset: u64,
    size: u64,
}

impl FinishedPlaces {
    /// Where every chunk starts. Only the lengths of records are read.
    pub(super) fn chunks(&mut self) -> io::Result<Vec<u64>> {
        self.offset = MAGIC_BYTES;
        let mut starts = Vec::new();
        while let Some((opcode, n_bytes)) = self.record_at(self.offset)? {
            if opcode == op::CHUNK {
                starts.push(self.offset);
            }
            self.offset += n_bytes;
        }
        Ok(starts)
    }

    fn next(&mut self) -> Result<Option<Vec<TakeRecord>>, TakeFileError> {
        while let Some((opcode, n_bytes)) = self.record_at(self.offset)? {
            let start = self.offset;
            self.offset += n_bytes;
            if opcode == op::CHUNK {
                return Ok(Some(self.chunk(start, n_bytes)?));
            }
        }
        Ok(None)
    }

    /// Opcode and length, its prefix included, of the record at `offset`; `None` behind the data.
    fn record_at(&mut self, offset: u64) -> io::Result<Option<(u8, u64)>> {
        let mut prefix = [0; PREFIX_BYTES];
        if offset >= self.size || !read_exactly(&mut *self.file, offset, &mut prefix)? {
            return Ok(None);
        }
        let [opcode, length @ ..] = prefix;
        let n_bytes = u64::from_le_bytes(length).saturating_add(PREFIX_BYTES as u64);
        let is_data = opcode != op::DATA_END && opcode != op::FOOTER;
        let fits = n_bytes <= self.size - offset && n_bytes <= MAX_TAKE_RECORD_BYTES as u64;
        Ok((is_data && fits).then_some((opcode, n_bytes)))
    }

    fn chunk(&mut self, start: u64, n_bytes: u64) -> Result<Vec<TakeRecord>, TakeFileError> {
        let body_bytes = usize::try_from(n_bytes).unwrap_or(usize::MAX) - PREFIX_BYTES;
        let mut body = vec![0; body_bytes];
        if !read_exactly(&mut *self.file, start + PREFIX_BYTES as u64, &mut body)? {
            return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
        }
        chunk_messages(&body)
    }
}

/// Whether `buffer` could be filled.
fn read_exactly(file: &mut dyn ReadFile, offset: u64, buffer: &mut [u8]) -> io::Result<bool> {
    let mut n_read = 0;
    while n_read < buffer.len() {
        match file.read_at(offset + n_read as u64, &mut buffer[n_read..])? {
            0 => return Ok(false),
            n => n_read += n,
        }
    }
    Ok(true)
}
