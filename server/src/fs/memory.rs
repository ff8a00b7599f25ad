//! A file system in memory, which can be told to fail.

use std::{
    collections::{BTreeMap, BTreeSet},
    ffi::OsString,
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use super::{AppendFile, Fs, ReadFile};

/// Files of one process, gone with it; clones share the same files.
///
/// [`MemFs::fail_after`] makes it stop working after so many calls that change something, which is what a crash looks like
/// from above; [`MemFs::fail_call`] lets one call fail, or all from it on, which is what a bad or a full disk does.
#[derive(Clone, Debug, Default)]
pub struct MemFs(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    files: BTreeMap<PathBuf, File>,
    /// The names that are on the disk, whatever happens.
    durable: BTreeMap<PathBuf, File>,
    changes_left: Option<usize>,
    fault: Option<Fault>,
    n_calls: usize,
    free_bytes: Option<u64>,
    ignores_flushes: bool,
}

/// Calls that fail.
#[derive(Clone, Copy, Debug)]
struct Fault {
    /// Number of the first.
    call: usize,
    kind: io::ErrorKind,
    /// Whether all later ones fail too.
    lasts: bool,
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
    pub fn after_power_cut(&self, torn: impl FnMut(&Path, &[u8]) -> Vec<u8>) -> Self {
        self.after_power_cut_with(torn, |_| true)
    }

    /// The same where names may be lost too: of a name that was made, changed or removed since its directory was flushed,
    /// `reached` says whether that reached the disk all the same.
    #[must_use]
    pub fn after_power_cut_with(
        &self,
        mut torn: impl FnMut(&Path, &[u8]) -> Vec<u8>,
        mut reached: impl FnMut(&Path) -> bool,
    ) -> Self {
        let state = self.state();
        let mut files = BTreeMap::new();
        let names: BTreeSet<&PathBuf> = state.files.keys().chain(state.durable.keys()).collect();
        for name in names {
            let known = if reached(name) {
                state.files.get(name)
            } else {
                state.durable.get(name)
            };
            let Some(file) = known else {
                continue;
            };
            let content = file.content();
            let (synced, rest) = content.bytes.split_at(content.n_synced);
            let bytes = [synced, &torn(name, rest)].concat();
            files.insert(name.clone(), File::synced(&bytes));
        }
        let after = Self::default();
        after.state().durable.clone_from(&files);
        after.state().files = files;
        after
    }

    /// Lets `n_changes` more calls change something; all later ones fail, until `None` lifts it.
    pub fn fail_after(&self, n_changes: Option<usize>) {
        self.state().changes_left = n_changes;
    }

    /// Lets the call fail that comes after `n_calls` more, reading or writing, with an error of this kind; with `lasts` all
    /// that come after it too, until [`Self::repair`]. A write that fails is done by half.
    pub fn fail_call(&self, n_calls: usize, kind: io::ErrorKind, lasts: bool) {
        let mut state = self.state();
        let call = state.n_calls + n_calls;
        state.fault = Some(Fault { call, kind, lasts });
    }

    /// Nothing fails any more. True: something had failed.
    pub fn repair(&self) -> bool {
        let mut state = self.state();
        let n_calls = state.n_calls;
        let fault = state.fault.take();
        fault.is_some_and(|it| n_calls > it.call)
    }

    /// Says of every flush that it was done, and does none: what comes of acknowledging before the flush.
    pub fn ignore_flushes(&self) {
        self.state().ignores_flushes = true;
    }

    /// So much is free from now on; `None`: as much as there is.
    pub fn set_free_bytes(&self, free_bytes: Option<u64>) {
        self.state().free_bytes = free_bytes;
    }

    /// Counts a call, which may fail; on a full disk only one that needs room.
    fn call(&self, needs_room: bool) -> io::Result<MutexGuard<'_, State>> {
        let mut state = self.state();
        let call = state.n_calls;
        state.n_calls += 1;
        let hit = |it: &Fault| call == it.call || (it.lasts && call > it.call);
        let hurts = |it: &Fault| needs_room || it.kind != io::ErrorKind::StorageFull;
        match state.fault.filter(hit).filter(hurts) {
            Some(fault) => Err(fault.kind.into()),
            None => Ok(state),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self, needs_room: bool) -> io::Result<MutexGuard<'_, State>> {
        let mut state = self.call(needs_room)?;
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
        let state = self.call(false)?;
        let found = state.files.get(file).map(|it| it.content().bytes.clone());
        found.ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn write_and_sync(&self, file: &Path, content: &[u8]) -> io::Result<()> {
        self.change(true)?
            .files
            .insert(file.to_owned(), File::synced(content));
        Ok(())
    }

    fn create(&self, file: &Path) -> io::Result<Box<dyn AppendFile>> {
        let mut state = self.change(true)?;
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
        let state = self.call(false)?;
        let found = state.files.get(file).cloned();
        Ok(Box::new(Opened {
            fs: self.clone(),
            file: found.ok_or(io::ErrorKind::NotFound)?,
        }))
    }

    fn free_bytes(&self, _dir: &Path) -> io::Result<u64> {
        Ok(self.call(false)?.free_bytes.unwrap_or(u64::MAX))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut state = self.change(true)?;
        let content = state.files.remove(from).ok_or(io::ErrorKind::NotFound)?;
        state.files.insert(to.to_owned(), content);
        Ok(())
    }

    fn sync_dir(&self, dir: &Path) -> io::Result<()> {
        let mut state = self.change(true)?;
        let State { files, durable, .. } = &mut *state;
        let is_inside = |it: &Path| it.parent() == Some(dir);
        durable.retain(|name, _| !is_inside(name));
        let inside = files.iter().filter(|(name, _)| is_inside(name));
        durable.extend(inside.map(|(name, file)| (name.clone(), file.clone())));
        Ok(())
    }

    fn remove(&self, file: &Path) -> io::Result<()> {
        self.change(false)?.files.remove(file);
        Ok(())
    }

    fn list(&self, dir: &Path) -> io::Result<Vec<OsString>> {
        let state = self.call(false)?;
        let inside = state.files.keys().filter(|it| it.parent() == Some(dir));
        Ok(inside
            .filter_map(|it| it.file_name().map(OsString::from))
            .collect())
    }
}

/// A file of memory that is read.
#[derive(Debug)]
struct Opened {
    fs: MemFs,
    file: File,
}

impl ReadFile for Opened {
    fn read_at(&mut self, offset: u64, buffer: &mut [u8]) -> io::Result<usize> {
        drop(self.fs.call(false)?);
        let content = self.file.content();
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let rest = content.bytes.get(offset..).unwrap_or_default();
        let n_bytes = rest.len().min(buffer.len());
        buffer[..n_bytes].copy_from_slice(&rest[..n_bytes]);
        Ok(n_bytes)
    }

    fn size(&self) -> io::Result<u64> {
        Ok(self.file.content().bytes.len() as u64)
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
        let changing = self.fs.change(true);
        let n_bytes = if changing.is_ok() {
            bytes.len()
        } else {
            bytes.len() / 2
        };
        let mut content = self.file.content();
        content.bytes.extend_from_slice(&bytes[..n_bytes]);
        changing.map(drop)
    }

    fn sync(&mut self) -> io::Result<()> {
        let changing = self.fs.change(true)?;
        if changing.ignores_flushes {
            return Ok(());
        }
        let mut content = self.file.content();
        content.n_synced = content.bytes.len();
        Ok(())
    }
}
