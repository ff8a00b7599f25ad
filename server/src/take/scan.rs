//! Reading a take's file as it grew: chunk after chunk, past what was damaged (CONTRACTS U-5).

use std::io;

use super::{
    chunk::{self, CHUNK_START_BYTES, Message},
    head::{self, Form},
};
use crate::fs::ReadFile;

/// What stands next in a file.
#[derive(Debug, PartialEq, Eq)]
pub enum Piece {
    /// A whole chunk, to be read by [`chunk::messages`].
    Chunk(Vec<u8>),
    /// Bytes that are none of ours, with chunks behind them.
    Damage {
        /// How many.
        n_bytes: u64,
    },
    /// Bytes after the last chunk: a commit that was never acknowledged.
    Tail {
        /// How many.
        n_bytes: u64,
    },
}

/// Why a file is not read at all.
#[derive(Debug, thiserror::Error)]
pub enum ScanError {
    /// The file system failed.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It does not begin as a take does.
    #[error("the file does not begin as a take does, or its beginning is damaged")]
    Head,
    /// A newer server wrote it; it is left as it is.
    #[error(
        "the file has format {found} of takes, this server knows formats up to {}",
        head::FORMAT
    )]
    NewerFormat {
        /// The format of the file.
        found: u32,
    },
    /// It ends within its head: a crash came before the take had begun.
    #[error("the file ends before its take had begun")]
    NotBegun,
    /// It has its final form already.
    #[error("the file has its final form")]
    Final,
    /// The writer of heads failed.
    #[error("the head of a take cannot be made")]
    Format(#[from] mcap::McapError),
}

/// Bytes that are looked through at once for a chunk behind damage.
const SEARCH_BYTES: usize = 1 << 20;

/// The pieces of one file, in order.
#[derive(Debug)]
pub struct Scan {
    file: Box<dyn ReadFile>,
    offset: u64,
    size: u64,
}

impl Scan {
    /// Starts behind the head of `file`, of which `size` bytes are read.
    ///
    /// # Errors
    ///
    /// [`ScanError::Final`] when it does not grow any more, or that its head is none.
    pub fn start(mut file: Box<dyn ReadFile>, size: u64) -> Result<Self, ScanError> {
        let whole = file.size()?;
        let head = head::read(&mut *file, whole)?;
        if head.form == Form::Final {
            return Err(ScanError::Final);
        }
        Ok(Self {
            file,
            offset: head.n_bytes,
            size,
        })
    }

    /// The next piece; `None` at the end.
    ///
    /// # Errors
    ///
    /// That the file system failed.
    pub fn next(&mut self) -> io::Result<Option<Piece>> {
        if self.offset >= self.size {
            return Ok(None);
        }
        if let Some(chunk) = self.chunk_at(self.offset)? {
            self.offset += chunk.len() as u64;
            return Ok(Some(Piece::Chunk(chunk)));
        }
        let start = self.offset;
        let next = self.find_chunk(start + 1)?;
        self.offset = next.unwrap_or(self.size);
        let n_bytes = self.offset - start;
        Ok(Some(match next {
            Some(_) => Piece::Damage { n_bytes },
            None => Piece::Tail { n_bytes },
        }))
    }

    /// Reads on to `size`: the file grew.
    pub fn grow(&mut self, size: u64) {
        self.size = self.size.max(size);
    }

    /// Where the next piece starts.
    pub fn offset(&self) -> u64 {
        self.offset
    }

    /// Goes to a place at which a piece starts.
    pub fn go_to(&mut self, offset: u64) {
        self.offset = offset;
    }

    fn chunk_at(&mut self, offset: u64) -> io::Result<Option<Vec<u8>>> {
        let start = self.bytes_at(offset, CHUNK_START_BYTES)?;
        let Some(n_bytes) = chunk::announced_bytes(&start) else {
            return Ok(None);
        };
        if n_bytes as u64 > self.size - offset {
            return Ok(None);
        }
        let chunk = self.bytes_at(offset, n_bytes)?;
        Ok(chunk::messages(&chunk).is_some().then_some(chunk))
    }

    /// Where the first whole chunk at or behind `from` starts.
    fn find_chunk(&mut self, from: u64) -> io::Result<Option<u64>> {
        let mut block_start = from;
        while block_start < self.size {
            // Blocks overlap, so that no start of a chunk is cut.
            let block = self.bytes_at(block_start, SEARCH_BYTES + CHUNK_START_BYTES)?;
            let n_starts = block.len().min(SEARCH_BYTES);
            if n_starts == 0 {
                // The file is shorter than was said.
                break;
            }
            for place in 0..n_starts {
                let start = &block[place..];
                let offset = block_start + place as u64;
                if chunk::announced_bytes(start).is_some() && self.chunk_at(offset)?.is_some() {
                    return Ok(Some(offset));
                }
            }
            block_start += n_starts as u64;
        }
        Ok(None)
    }

    fn bytes_at(&mut self, offset: u64, n_bytes: usize) -> io::Result<Vec<u8>> {
        head::bytes_at(&mut *self.file, offset, n_bytes, self.size)
    }
}

/// The messages of a chunk that a scan gave.
pub fn messages(chunk: &[u8]) -> Vec<Message<'_>> {
    // A scan gives whole chunks only.
    chunk::messages(chunk).unwrap_or_default()
}

#[cfg(test)]
mod tests;
