//! The stored file as it is.

use std::io::Write as _;

use super::{ExportError, ExportSource, Outlet, PIECE_BYTES};
use crate::{
    fs::ReadFile,
    take::{StoredFile, open_stored},
};

pub(super) struct WholeFile {
    file: Box<dyn ReadFile>,
    n_bytes: u64,
    n_copied: u64,
}

impl WholeFile {
    pub(super) fn open(source: &ExportSource) -> Result<Self, ExportError> {
        let StoredFile { file, n_bytes, .. } =
            open_stored(&*source.fs, &source.file, source.n_bytes)?;
        Ok(Self {
            file,
            n_bytes,
            n_copied: 0,
        })
    }

    pub(super) fn n_bytes(&self) -> u64 {
        self.n_bytes
    }

    pub(super) fn n_copied(&self) -> u64 {
        self.n_copied
    }

    /// Copies a piece; whether it was the last.
    pub(super) fn copy(&mut self, to: &mut Outlet) -> Result<bool, ExportError> {
        let n_left = usize::try_from(self.n_bytes - self.n_copied).unwrap_or(usize::MAX);
        let mut piece = vec![0; n_left.min(PIECE_BYTES)];
        let n_read = self.file.read_at(self.n_copied, &mut piece)?;
        to.write_all(&piece[..n_read])?;
        self.n_copied += n_read as u64;
        Ok(n_read == 0 || self.n_copied == self.n_bytes)
    }
}
