//! How many subscribers there are, and what each was sent (CONTRACTS O-1, D-16).

use std::sync::{
    Arc,
    atomic::{AtomicU64, AtomicUsize, Ordering},
};

/// Subscribers over all sessions of the server, with their limit; clones share the count.
#[derive(Clone, Debug)]
pub struct SubscriberQuota {
    n_subscribers: Arc<AtomicUsize>,
    limit: usize,
}

impl SubscriberQuota {
    /// A quota of which nothing is taken.
    pub fn new(limit: usize) -> Self {
        Self {
            n_subscribers: Arc::default(),
            limit,
        }
    }

    /// The most subscribers there may be.
    pub fn limit(&self) -> usize {
        self.limit
    }

    /// Subscribers at this moment.
    pub fn n_subscribers(&self) -> usize {
        self.n_subscribers.load(Ordering::Relaxed)
    }

    /// Takes one place, given back when the seat is dropped.
    pub(super) fn take(&self) -> Option<Seat> {
        let taken = self.n_subscribers.fetch_add(1, Ordering::Relaxed);
        let seat = Seat(Arc::clone(&self.n_subscribers));
        (taken < self.limit).then_some(seat)
    }
}

/// One subscriber's place.
#[derive(Debug)]
pub(super) struct Seat(Arc<AtomicUsize>);

impl Drop for Seat {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// What one subscriber was sent; written by it, read by the session's status.
#[derive(Debug)]
pub(super) struct Tally {
    pub(super) name: String,
    pub(super) protocol: &'static str,
    pub(super) sent_samples: AtomicU64,
    pub(super) skipped_samples: AtomicU64,
    /// Sequence up to which it was served.
    pub(super) served_through: AtomicU64,
    /// `LATEST`: sequence up to which samples were sent or counted as skipped. Others skip nothing: the last there is.
    pub(super) counted_through: AtomicU64,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            name: String::new(),
            protocol: "",
            sent_samples: AtomicU64::new(0),
            skipped_samples: AtomicU64::new(0),
            served_through: AtomicU64::new(0),
            counted_through: AtomicU64::new(u64::MAX),
        }
    }
}

impl Tally {
    pub(super) fn status(&self, newest_sequence: u64) -> SubscriberStatus {
        let served_through = self.served_through.load(Ordering::Relaxed);
        let counted_through = self.counted_through.load(Ordering::Relaxed);
        // The newest may still be sent.
        let passed_over = newest_sequence
            .saturating_sub(counted_through)
            .saturating_sub(1);
        SubscriberStatus {
            subscriber: self.name.clone(),
            protocol: self.protocol,
            sent_samples: self.sent_samples.load(Ordering::Relaxed),
            skipped_samples: self.skipped_samples.load(Ordering::Relaxed) + passed_over,
            lag_frames: newest_sequence.saturating_sub(served_through),
        }
    }
}

/// One subscriber, as the session's status shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubscriberStatus {
    /// The subscriber's own name, or its peer's address.
    pub subscriber: String,
    /// `grpc`, `sse`, ...
    pub protocol: &'static str,
    /// Samples sent to it.
    pub sent_samples: u64,
    /// Samples it did not get.
    pub skipped_samples: u64,
    /// Samples published that it was not yet sent.
    pub lag_frames: u64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dropped_seat_is_free_again() {
        let quota = SubscriberQuota::new(2);
        let first = quota.take().unwrap();
        let second = quota.take().unwrap();
        assert!(quota.take().is_none());
        drop(first);
        assert!(quota.take().is_some());
        drop(second);
        assert_eq!(quota.n_subscribers(), 0);
    }
}
