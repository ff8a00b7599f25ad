//! The file of a take as bytes, as far as they are on stable storage.

use std::{io, path::Path};

use super::channel;
use crate::fs::{Fs, ReadFile};

/// An open file, which stays what it was when it was opened.
#[derive(Debug)]
pub struct StoredFile {
    /// The file.
    pub file: Box<dyn ReadFile>,
    /// Bytes of it that are on stable storage.
    pub n_bytes: u64,
    /// Whether it is that of a take under way, which will grow and then give way to its final form.
    pub is_growing: bool,
}

/// Opens `file`. Of one that grows, the first `n_bytes` are on stable storage; one of another form is so as a whole.
///
/// # Errors
///
/// That the file system failed.
pub fn open_stored(fs: &dyn Fs, file: &Path, n_bytes: u64) -> io::Result<StoredFile> {
    let mut file = fs.open(file)?;
    let size = file.size()?;
    let head = channel::head().map_err(io::Error::other)?;
    let is_growing = starts_with(&mut *file, &head)?;
    let n_bytes = if is_growing { size.min(n_bytes) } else { size };
    Ok(StoredFile {
        file,
        n_bytes,
        is_growing,
    })
}

fn starts_with(file: &mut dyn ReadFile, head: &[u8]) -> io::Result<bool> {
    let mut start = vec![0; head.len()];
    let mut n_read = 0;
    while n_read < start.len() {
        match file.read_at(n_read as u64, &mut start[n_read..])? {
            0 => return Ok(false),
            n => n_read += n,
        }
    }
    Ok(start == head)
}
