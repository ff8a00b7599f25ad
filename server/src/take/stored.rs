//! The file of a take as bytes, as far as they are on stable storage.

use std::{io, path::Path};

use super::{head, head::Form, scan::ScanError};
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
    let is_growing = match head::read(&mut *file, size) {
        Ok(head) => head.form == Form::Growing,
        Err(ScanError::Io(error)) => return Err(error),
        // Whatever it is, it does not grow.
        Err(_) => false,
    };
    let n_bytes = if is_growing { size.min(n_bytes) } else { size };
    Ok(StoredFile {
        file,
        n_bytes,
        is_growing,
    })
}
