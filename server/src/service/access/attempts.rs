//! How often somebody may try something in a minute (CONTRACTS S-10): one bucket a key, a bounded number of them.

use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
    time::Duration,
};

use tokio::time::Instant;

/// Keys that are told apart; beyond them strangers share one bucket.
const MAX_KEYS: usize = 4_096;

const MINUTE: Duration = Duration::from_mins(1);

/// Counts what each key did of late.
#[derive(Debug)]
pub(super) struct Attempts<K> {
    per_minute: u32,
    buckets: Mutex<Buckets<K>>,
}

#[derive(Debug)]
struct Buckets<K> {
    by_key: BTreeMap<K, Bucket>,
    strangers: Bucket,
}

/// When all of a key's attempts will be free again; later by one share of a minute with each.
#[derive(Clone, Copy, Debug)]
struct Bucket {
    free_at: Instant,
}

impl<K: Ord> Attempts<K> {
    pub(super) fn new(per_minute: u32) -> Self {
        let now = Instant::now();
        Self {
            per_minute: per_minute.max(1),
            buckets: Mutex::new(Buckets {
                by_key: BTreeMap::new(),
                strangers: Bucket { free_at: now },
            }),
        }
    }

    pub(super) fn per_minute(&self) -> u32 {
        self.per_minute
    }

    /// Counts one more.
    ///
    /// # Errors
    ///
    /// When the next may come, if this was too much; then it is not counted.
    pub(super) fn count(&self, key: K) -> Result<(), Duration> {
        let now = Instant::now();
        let mut buckets = self.buckets.lock().unwrap_or_else(PoisonError::into_inner);
        buckets.of(key, now).take(now, MINUTE / self.per_minute)
    }
}

impl<K: Ord> Buckets<K> {
    fn of(&mut self, key: K, now: Instant) -> &mut Bucket {
        let is_known = self.by_key.contains_key(&key);
        if !is_known && self.by_key.len() >= MAX_KEYS {
            // Whoever did nothing for a minute is as good as new.
            self.by_key.retain(|_, it| it.free_at > now);
        }
        if !is_known && self.by_key.len() >= MAX_KEYS {
            return &mut self.strangers;
        }
        self.by_key.entry(key).or_insert(Bucket { free_at: now })
    }
}

impl Bucket {
    fn take(&mut self, now: Instant, share: Duration) -> Result<(), Duration> {
        let free_at = self.free_at.max(now) + share;
        let over = free_at
            .saturating_duration_since(now)
            .saturating_sub(MINUTE);
        // Shares of a minute are rounded down, so that as many as allowed fit.
        if !over.is_zero() {
            return Err(over);
        }
        self.free_at = free_at;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test(start_paused = true)]
    async fn as_many_as_allowed_pass_and_the_next_is_told_when_to_come() {
        let attempts = Attempts::new(7);
        for _ in 0..7 {
            attempts.count("a").unwrap();
        }
        let wait = attempts.count("a").unwrap_err();
        attempts.count("b").unwrap();
        tokio::time::advance(wait).await;
        attempts.count("a").unwrap();
        attempts.count("a").unwrap_err();
    }

    #[tokio::test(start_paused = true)]
    async fn keys_that_nobody_told_apart_share_what_is_left_and_memory_is_bounded() {
        let attempts = Attempts::new(2);
        for key in 0..MAX_KEYS {
            attempts.count(key).unwrap();
        }
        attempts.count(MAX_KEYS).unwrap();
        attempts.count(MAX_KEYS + 1).unwrap();
        attempts.count(MAX_KEYS + 2).unwrap_err();
        // One who is known keeps what is its own.
        attempts.count(0).unwrap();
        assert_eq!(attempts.buckets.lock().unwrap().by_key.len(), MAX_KEYS);
        tokio::time::advance(MINUTE).await;
        attempts.count(MAX_KEYS + 2).unwrap();
        assert_eq!(attempts.buckets.lock().unwrap().by_key.len(), 1);
    }
}
