//! Erases takes: the tombstone first, then the bytes, then the row (CONTRACTS U-12).

use std::{io, sync::Arc};

use tonic::Status;

use super::Takes;
use crate::{catalogue::CatalogueError, fs::TEMPORARY_SUFFIX, name::TakeId, take::file_name};

impl Takes {
    /// Erases a take.
    ///
    /// # Errors
    ///
    /// `TAKE`, or that the storage failed; what is left is erased within the hour, or at the next start.
    pub async fn delete(&self, id: &TakeId) -> Result<(), Status> {
        self.store.take(id).await?;
        self.store.doom_take(id).await?;
        self.erase(id).await?;
        Ok(self.store.scrub_log().await?)
    }

    /// Erases a doomed take; returns the length of its file.
    ///
    /// # Errors
    ///
    /// That the storage failed; its tombstone is then still there.
    pub async fn erase(&self, id: &TakeId) -> Result<u64, CatalogueError> {
        self.recorder.stop(id).await;
        let n_bytes = self.remove_file(id).await?;
        self.store.forget_take(id).await?;
        Ok(n_bytes)
    }

    /// Removes the file of a take, whichever form it has; returns its length.
    pub(super) async fn remove_file(&self, id: &TakeId) -> Result<u64, CatalogueError> {
        let (fs, dir, name) = (Arc::clone(&self.fs), self.dir.clone(), file_name(id));
        let removed = self.recorder.run(move || {
            let file = dir.join(&name);
            // What cannot be opened, as a link in the file's place, is removed all the same.
            let n_bytes = match fs.open(&file) {
                Ok(open) => open.size()?,
                Err(_) => 0,
            };
            fs.remove(&dir.join(format!("{name}{TEMPORARY_SUFFIX}")))?;
            fs.remove(&file)?;
            fs.sync_dir(&dir)?;
            Ok::<_, io::Error>(n_bytes)
        });
        Ok(removed.await?)
    }
}
