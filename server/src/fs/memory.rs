//! A file system in memory, which can be told to fail.

use std::{
    collections::BTreeMap,
    ffi::OsString,
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use super::Fs;

/// Files of one process, gone with it; clones share the same files.
///
/// [`MemFs::fail_after`] makes it stop working after so many calls that change something, which is what a crash or a
/// full disk looks like from above.
#[derive(Clone, Debug, Default)]
pub struct MemFs(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    files: BTreeMap<PathBuf, Vec<u8>>,
    changes_left: Option<usize>,
}

impl MemFs {
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
        let found = self.state().files.get(file).cloned();
        found.ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn write_and_sync(&self, file: &Path, content: &[u8]) -> io::Result<()> {
        self.change()?
            .files
            .insert(file.to_owned(), content.to_vec());
        Ok(())
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
