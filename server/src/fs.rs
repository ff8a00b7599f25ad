//! The server's view of a file system: the few calls it makes, so that a test may stand in for the disk.
//!
//! A file is replaced by writing a temporary one, flushing it, renaming it and flushing its directory
//! (CONTRACTS U-4); [`write_durably`] is that sequence.

mod memory;
mod standard;

use std::{ffi::OsString, fmt::Debug, io, path::Path};

pub use memory::MemFs;
pub use standard::StdFs;

/// Suffix of a file that is not yet complete; whatever carries it after a crash is removed.
pub const TEMPORARY_SUFFIX: &str = ".tmp";

/// A file that only grows.
pub trait AppendFile: Debug + Send {
    /// Adds to the end.
    ///
    /// # Errors
    ///
    /// As the system says; part of `bytes` may have been added.
    fn append(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Flushes what was added to the disk. After an error nothing is known of what was not flushed before: the file is not
    /// to be used again (CONTRACTS U-8).
    ///
    /// # Errors
    ///
    /// As the system says.
    fn sync(&mut self) -> io::Result<()>;
}

/// A file that is read piece by piece. It stays what it was when it was opened, whatever takes its name meanwhile.
pub trait ReadFile: Debug + Send {
    /// Reads from `offset` on into `buffer`; returns how many bytes, 0 at the end.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize>;

    /// Its length, bytes.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn size(&self) -> io::Result<u64>;
}

/// File system calls, each of which may fail by itself.
pub trait Fs: Debug + Send + Sync {
    /// Makes `dir` and its parents, unless they exist. A symbolic link in its place is refused.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn create_dir_all(&self, dir: &Path) -> io::Result<()>;

    /// The whole content of a plain file. A symbolic link is refused.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn read(&self, file: &Path) -> io::Result<Vec<u8>>;

    /// Writes a new file and flushes its content to the disk.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn write_and_sync(&self, file: &Path, content: &[u8]) -> io::Result<()>;

    /// Makes a new, empty file to append to; one of that name that exists is an error.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn create(&self, file: &Path) -> io::Result<Box<dyn AppendFile>>;

    /// Opens a plain file for reading. A symbolic link is refused.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn open(&self, file: &Path) -> io::Result<Box<dyn ReadFile>>;

    /// Bytes that may still be written under `dir`.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn free_bytes(&self, dir: &Path) -> io::Result<u64>;

    /// Gives `from` the name `to`, in place of a file of that name.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;

    /// Flushes the names in `dir` to the disk.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn sync_dir(&self, dir: &Path) -> io::Result<()>;

    /// Removes a file; one that is not there is no error.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn remove(&self, file: &Path) -> io::Result<()>;

    /// The names in `dir`, in order.
    ///
    /// # Errors
    ///
    /// As the system says.
    fn list(&self, dir: &Path) -> io::Result<Vec<OsString>>;
}

/// Writes `content` under `name` in `dir`: after it returns, the file survives power loss as a whole.
/// After an error or a crash there is either nothing, or a temporary file, or the whole file.
///
/// # Errors
///
/// The first call that failed.
pub fn write_durably(fs: &dyn Fs, dir: &Path, name: &str, content: &[u8]) -> io::Result<()> {
    let temporary = dir.join(format!("{name}{TEMPORARY_SUFFIX}"));
    fs.write_and_sync(&temporary, content)?;
    fs.rename(&temporary, &dir.join(name))?;
    fs.sync_dir(dir)
}
