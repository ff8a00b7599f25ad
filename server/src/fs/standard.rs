//! The disk itself.

use std::{
    ffi::OsString,
    fs::{self, DirBuilder, File, OpenOptions},
    io::{self, Read as _, Seek as _, SeekFrom, Write as _},
    path::Path,
};

use super::{AppendFile, Fs, ReadFile};

/// The operating system's file system.
#[derive(Clone, Copy, Debug, Default)]
pub struct StdFs;

impl Fs for StdFs {
    fn create_dir_all(&self, dir: &Path) -> io::Result<()> {
        private_directories().create(dir)?;
        refuse_link(dir)
    }

    fn read(&self, file: &Path) -> io::Result<Vec<u8>> {
        refuse_link(file)?;
        fs::read(file)
    }

    fn write_and_sync(&self, file: &Path, content: &[u8]) -> io::Result<()> {
        // A temporary file of the same name can only be left over from a crash.
        self.remove(file)?;
        let mut new = private_files().write(true).create_new(true).open(file)?;
        new.write_all(content)?;
        new.sync_all()
    }

    fn create(&self, file: &Path) -> io::Result<Box<dyn AppendFile>> {
        let new = private_files().append(true).create_new(true).open(file)?;
        Ok(Box::new(Growing(new)))
    }

    fn open(&self, file: &Path) -> io::Result<Box<dyn ReadFile>> {
        refuse_link(file)?;
        Ok(Box::new(Opened(File::open(file)?)))
    }

    fn free_bytes(&self, dir: &Path) -> io::Result<u64> {
        let found = rustix::fs::statvfs(dir)?;
        Ok(found.f_bavail.saturating_mul(found.f_frsize))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn sync_dir(&self, dir: &Path) -> io::Result<()> {
        File::open(dir)?.sync_all()
    }

    fn remove(&self, file: &Path) -> io::Result<()> {
        match fs::remove_file(file) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }

    fn list(&self, dir: &Path) -> io::Result<Vec<OsString>> {
        let mut names = fs::read_dir(dir)?
            .map(|entry| entry.map(|it| it.file_name()))
            .collect::<io::Result<Vec<_>>>()?;
        names.sort();
        Ok(names)
    }
}

/// A file that is open for appending.
#[derive(Debug)]
struct Growing(File);

impl AppendFile for Growing {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.write_all(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        self.0.sync_data()
    }
}

/// A file that is open for reading.
#[derive(Debug)]
struct Opened(File);

impl ReadFile for Opened {
    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.seek(SeekFrom::Start(offset))?;
        self.0.read(buffer)
    }

    fn size(&self) -> io::Result<u64> {
        Ok(self.0.metadata()?.len())
    }
}

/// Faces are personal data: what the server makes is its own account's alone. A directory that exists stays as it is.
fn private_directories() -> DirBuilder {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder
}

/// Likewise: a new file is the server's own account's alone.
fn private_files() -> OpenOptions {
    let mut options = OpenOptions::new();
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options
}

/// A link planted in the data directory must not lead out of it (CONTRACTS S-6).
fn refuse_link(path: &Path) -> io::Result<()> {
    if fs::symlink_metadata(path)?.is_symlink() {
        return Err(io::Error::other(
            "a symbolic link where the server expects its own data",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fs::write_durably;

    #[test]
    fn a_file_is_replaced_as_a_whole_and_leaves_no_temporary_one() {
        let dir = tempfile::tempdir().unwrap();
        write_durably(&StdFs, dir.path(), "a", b"first").unwrap();
        write_durably(&StdFs, dir.path(), "a", b"second").unwrap();
        assert_eq!(StdFs.read(&dir.path().join("a")).unwrap(), b"second");
        assert_eq!(StdFs.list(dir.path()).unwrap(), ["a"]);
    }

    #[test]
    fn a_new_directory_is_the_servers_alone_and_an_old_one_stays_as_it_is() {
        use std::os::unix::fs::PermissionsExt as _;
        let dir = tempfile::tempdir().unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        let new = dir.path().join("new");
        StdFs.create_dir_all(&new).unwrap();
        assert_eq!(mode(&new), 0o700);
        fs::set_permissions(&new, fs::Permissions::from_mode(0o750)).unwrap();
        StdFs.create_dir_all(&new).unwrap();
        assert_eq!(mode(&new), 0o750);
    }

    #[test]
    fn a_new_file_is_the_servers_alone() {
        use std::os::unix::fs::PermissionsExt as _;
        let dir = tempfile::tempdir().unwrap();
        let (written, grown) = (dir.path().join("written"), dir.path().join("grown"));
        StdFs.write_and_sync(&written, b"face").unwrap();
        StdFs.create(&grown).unwrap();
        for file in [written, grown] {
            let mode = fs::metadata(&file).unwrap().permissions().mode() & 0o777;
            assert_eq!(mode, 0o600, "{}", file.display());
        }
    }

    #[test]
    fn a_symbolic_link_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let link = dir.path().join("link");
        std::os::unix::fs::symlink("/etc/hostname", &link).unwrap();
        assert!(StdFs.read(&link).is_err());
    }

    #[test]
    fn removing_what_is_not_there_is_no_error() {
        let dir = tempfile::tempdir().unwrap();
        StdFs.remove(&dir.path().join("nothing")).unwrap();
    }
}
