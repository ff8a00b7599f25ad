//! Memory that all sessions share for their windows and queues (CONTRACTS O-1).
//!
//! Each session has limits of its own; this one keeps their sum below what the machine was promised.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

/// A counter of bytes with a limit; clones share it.
#[derive(Clone, Debug)]
pub struct BufferBudget {
    used_bytes: Arc<AtomicUsize>,
    limit_bytes: usize,
}

impl BufferBudget {
    /// A budget of which nothing is used.
    pub fn new(limit_bytes: usize) -> Self {
        Self {
            used_bytes: Arc::default(),
            limit_bytes,
        }
    }

    /// Notes that `bytes` more are used. Whoever charges looks at [`Self::is_exceeded`] and gives up what is oldest.
    pub fn charge(&self, bytes: usize) {
        self.used_bytes.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Notes that `bytes` are used no more; they were charged before.
    pub fn release(&self, bytes: usize) {
        self.used_bytes.fetch_sub(bytes, Ordering::Relaxed);
    }

    /// Whether more is used than the limit.
    pub fn is_exceeded(&self) -> bool {
        self.used_bytes() > self.limit_bytes
    }

    /// Bytes in use, over all sessions.
    pub fn used_bytes(&self) -> usize {
        self.used_bytes.load(Ordering::Relaxed)
    }
}
