//! Whether the disk has room for another take (CONTRACTS U-9).

use std::{
    io,
    sync::atomic::{AtomicU64, Ordering},
    time::Duration,
};

use tokio::time::Instant;

/// Least room on the disk for a new take, bytes.
const LEAST_FREE_BYTES: u64 = 1 << 30;

/// As long as this what comes in now must find room.
const RESERVE: Duration = Duration::from_mins(1);

/// Time between two looks.
pub const LOOK_EVERY: Duration = Duration::from_secs(5);

/// What a look at the disk found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DiskRoom {
    /// Bytes that may still be written.
    pub free_bytes: u64,
    /// Bytes that must be free for a new take.
    pub needed_bytes: u64,
}

impl DiskRoom {
    /// Whether new takes may start.
    pub fn is_enough(self) -> bool {
        self.free_bytes >= self.needed_bytes
    }
}

/// A disk that nobody has looked at yet.
impl Default for DiskRoom {
    fn default() -> Self {
        Self {
            free_bytes: u64::MAX,
            needed_bytes: LEAST_FREE_BYTES,
        }
    }
}

/// How much is written a second, and so how much room a new take needs.
#[derive(Debug, Default)]
pub(super) struct IngestRate {
    n_bytes: AtomicU64,
    /// Of the last look, bytes a second.
    rate: AtomicU64,
}

impl IngestRate {
    /// So much was written.
    pub(super) fn count(&self, n_bytes: u64) {
        self.n_bytes.fetch_add(n_bytes, Ordering::Relaxed);
    }

    /// Takes the rate since `last`, which becomes now.
    pub(super) fn look(&self, last: &mut Instant) {
        let now = Instant::now();
        let millis = now.duration_since(*last).as_millis().max(1);
        *last = now;
        let n_bytes = u128::from(self.n_bytes.swap(0, Ordering::Relaxed));
        let rate = u64::try_from(n_bytes * 1_000 / millis).unwrap_or(u64::MAX);
        self.rate.store(rate, Ordering::Relaxed);
    }

    /// The room that there is, and that a new take needs.
    pub(super) fn room(&self, free_bytes: io::Result<u64>) -> DiskRoom {
        let rate = self.rate.load(Ordering::Relaxed);
        let reserve = rate.saturating_mul(RESERVE.as_secs());
        DiskRoom {
            // A disk that does not even answer has no room.
            free_bytes: free_bytes.unwrap_or(0),
            needed_bytes: reserve.max(LEAST_FREE_BYTES),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test(start_paused = true)]
    async fn a_minute_of_what_comes_in_now_must_find_room() {
        let ingest = IngestRate::default();
        let mut last = Instant::now();
        assert_eq!(ingest.room(Ok(0)).needed_bytes, LEAST_FREE_BYTES);
        ingest.count(500_000_000);
        tokio::time::advance(Duration::from_secs(5)).await;
        ingest.look(&mut last);
        let room = ingest.room(Ok(5_999_999_999));
        assert_eq!(room.needed_bytes, 6_000_000_000);
        assert!(!room.is_enough());
        assert!(ingest.room(Ok(6_000_000_000)).is_enough());
        // Nothing came in since.
        tokio::time::advance(Duration::from_secs(5)).await;
        ingest.look(&mut last);
        assert_eq!(ingest.room(Ok(0)).needed_bytes, LEAST_FREE_BYTES);
        assert!(!ingest.room(Err(io::ErrorKind::Other.into())).is_enough());
    }
}
