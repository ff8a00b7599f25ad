//! One server a data directory: an advisory lock that the system releases with the process.

use std::{
    fs::{File, OpenOptions, TryLockError},
    io::{Read as _, Seek as _, Write as _},
    path::Path,
};

use super::CatalogueError;

/// Name of the lock file in the data directory.
const LOCK: &str = "lock";

/// Longest text that is read from a lock file, in bytes.
const HOLDER_BYTES: u64 = 64;

/// Held for as long as the value lives.
#[derive(Debug)]
pub(super) struct DirectoryLock(#[expect(dead_code, reason = "the open file is the lock")] File);

impl DirectoryLock {
    /// Locks `dir` and writes the process's id for whoever comes second.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::InUse`] with what the first one wrote, or that the file could not be used.
    pub(super) fn take(dir: &Path) -> Result<Self, CatalogueError> {
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(dir.join(LOCK))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(CatalogueError::InUse {
                    dir: dir.to_owned(),
                    holder: holder(&mut file),
                });
            }
            Err(TryLockError::Error(error)) => return Err(error.into()),
        }
        file.set_len(0)?;
        file.rewind()?;
        write!(file, "process {}", std::process::id())?;
        Ok(Self(file))
    }
}

fn holder(file: &mut File) -> String {
    let mut text = String::new();
    match file.take(HOLDER_BYTES).read_to_string(&mut text) {
        Ok(n) if n > 0 => text.trim().escape_default().to_string(),
        _ => "unknown".to_owned(),
    }
}
