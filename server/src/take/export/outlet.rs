//! Where a format's writer puts its bytes: counted, summed, and taken away piece by piece.

use std::{
    io::{self, Write},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use bytes::BytesMut;
use sha2::{Digest as _, Sha256};

/// Clones share what waits: one is the writer's, one is read from.
#[derive(Clone, Default)]
pub(super) struct Outlet {
    shared: Arc<Mutex<Written>>,
    /// How far the reader's end has come.
    pub(super) frames_done: u64,
}

#[derive(Default)]
struct Written {
    waiting: BytesMut,
    n_bytes: u64,
    sum: Sha256,
}

impl Outlet {
    pub(super) fn n_waiting(&self) -> usize {
        self.written().waiting.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.n_waiting() == 0
    }

    /// The first of what waits, at most so much.
    pub(super) fn take(&mut self, most_bytes: usize) -> Vec<u8> {
        let waiting = &mut self.written().waiting;
        let n_bytes = waiting.len().min(most_bytes);
        waiting.split_to(n_bytes).to_vec()
    }

    /// How many bytes were written, and their SHA-256 in hexadecimal digits.
    pub(super) fn sum(&self) -> (u64, String) {
        let written = self.written();
        (
            written.n_bytes,
            format!("{:x}", written.sum.clone().finalize()),
        )
    }

    fn written(&self) -> MutexGuard<'_, Written> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Write for Outlet {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut written = self.written();
        written.waiting.extend_from_slice(bytes);
        written.sum.update(bytes);
        written.n_bytes += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
