//! A file system in memory, which can be told to fail.

use std::{
    collections::BTreeMap,
    ffi::OsString,
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use super::{AppendFile, Fs, ReadFile};

/// Files of one process, gone with it; clones share the same files.
///
/// [`MemFs::fail_after`] makes it stop working after so many calls that change something, which is what a crash or a
/// full disk looks like from above.
#[derive(Clone, Debug, Default)]
pub struct MemFs(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    files: BTreeMap<PathBuf, File>,
    changes_left: Option<usize>,
}

/// A file, which those who opened it go on seeing when its name is given to another.
#[derive(Clone, Debug, Default)]
struct File(Arc<Mutex<Content>>);

impl File {
    fn synced(bytes: &[u8]) -> Self {
        Self(Arc::new(Mutex::new(Content {
            n_synced: bytes.len(),
            bytes: bytes.to_vec(),
        })))
    }

    fn content(&self) -> MutexGuard<'_, Content> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a file holds, and how much of it is known to have reached the disk.
#[derive(Debug, Default)]
struct Content {
    bytes: Vec<u8>,
    n_synced: usize,
}

impl MemFs {
    /// The files as they are after the power went: of every file what was flushed, and of the rest what `torn` lets stand.
    ///
    /// `torn` gets the name and the bytes that were not flushed, and returns those that are found in their place.
    #[must_use]
    pub fn after_power_cut(&self, mut torn: impl FnMut(&Path, &[u8]) -> Vec<u8>) -> Self {
        let after = Self::default();
        for (name, file) in &self.state().files {
            let content = file.content();
            let (synced, rest) = content.bytes.split_at(content.n_synced);
            let bytes = [synced, &torn(name, rest)].concat();
            after
                .state()
                .files
                .insert(name.clone(), File::synced(&bytes));
        }
        after
    }

    /// Lets `n_changes` more calls change something; all later ones fail, until `None` lifts it.
    pub fn fail_after(&self, n_changes: Option<usize>) {
        self.state().changes_left = n_changes;
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self) -> io::Result<MutexGuard<'_, State>> {
        let mut state = self.state();
        match &mut state.changes_left {
            Some(0) => return Err(io::Error::other("the storage was told to fail")),
            Some(left) => *left -= 1,
            None => {}
        }
        Ok(state)
    }
}

impl Fs for MemFs {
    fn create_dir_all(&self, _dir: &Path) -> io::Result<()> {
        Ok(())
    }

    fn read(&self, file: &Path) -> io::Result<Vec<u8>> {
        let state = self.state();
        let found = state.files.get(file).map(|it| it.content().bytes.clone());
        found.ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn write_and_sync(&self, file: &Path, content: &[u8]) -> io::Result<()> {
        self.change()?
            .files
            .insert(file.to_owned(), File::synced(content));
        Ok(())
    }

    fn create(&self, file: &Path) -> io::Result<Box<dyn AppendFile>> {
        let mut state = self.change()?;
        if state.files.contains_key(file) {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        let new = File::default();
        state.files.insert(file.to_owned(), new.clone());
        Ok(Box::new(Growing {
            fs: self.clone(),
            file: new,
        }))
    }

    fn open(&self, file: &Path) -> io::Result<Box<dyn ReadFile>> {
        let state = self.state();
        let found = state.files.get(file).cloned();
        Ok(Box::new(found.ok_or(io::ErrorKind::NotFound)?))
    }

    fn free_bytes(&self, _dir: &Path) -> io::Result<u64> {
        Ok(u64::MAX)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut state = self.change()?;
        let content = state.files.remove(from).ok_or(io::ErrorKind::NotFound)?;
        state.files.insert(to.to_owned(), content);
        Ok(())
    }

    fn sync_dir(&self, _dir: &Path) -> io::Result<()> {
        self.change().map(drop)
    }

    fn remove(&self, file: &Path) -> io::Result<()> {
        self.change()?.files.remove(file);
        Ok(())
    }

    fn list(&self, dir: &Path) -> io::Result<Vec<OsString>> {
        let state = self.state();
        let inside = state.files.keys().filter(|it| it.parent() == Some(dir));
        Ok(inside
            .filter_map(|it| it.file_name().map(OsString::from))
            .collect())
    }
}

impl ReadFile for File {
    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        let content = self.content();
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let rest = content.bytes.get(offset..).unwrap_or_default();
        let n_bytes = rest.len().min(buffer.len());
        buffer[..n_bytes].copy_from_slice(&rest[..n_bytes]);
        Ok(n_bytes)
    }

    fn size(&self) -> io::Result<u64> {
        Ok(self.content().bytes.len() as u64)
    }
}

/// A file of memory that is appended to.
#[derive(Debug)]
struct Growing {
    fs: MemFs,
    file: File,
}

impl AppendFile for Growing {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let _changing = self.fs.change()?;
        self.file.content().bytes.extend_from_slice(bytes);
        Ok(())
    }

    fn sync(&mut self) -> io::Result<()> {
        let _changing = self.fs.change()?;
        let mut content = self.file.content();
        content.n_synced = content.bytes.len();
        Ok(())
    }
}
