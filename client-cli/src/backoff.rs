//! How long to wait before the next attempt to reach a server.
//!
//! CONTRACTS O-14: 100 ms, growing by 1.6 up to 5 s, each ±20 % at random so that many clients do not return as one.

use std::{
    hash::{BuildHasher as _, RandomState},
    time::Duration,
};

use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

/// The first wait.
const FIRST: Duration = Duration::from_millis(100);
/// Growth from one wait to the next.
const GROWTH: f64 = 1.6;
/// The longest wait before jitter.
const LONGEST: Duration = Duration::from_secs(5);
/// Half width of the random factor about 1.
const JITTER: f64 = 0.2;

/// A growing wait; one a connection, started over when the connection works again.
#[derive(Debug)]
pub struct Backoff {
    next: Duration,
    random: Pcg64Mcg,
}

impl Backoff {
    /// Starts at 100 ms. Clients with different `seed`s wait differently.
    pub fn new(seed: u64) -> Self {
        Self {
            next: FIRST,
            random: Pcg64Mcg::seed_from_u64(seed),
        }
    }

    /// A seed that differs between processes.
    pub fn process_seed() -> u64 {
        RandomState::new().hash_one(0)
    }

    /// The wait before the next attempt, never below what the server asked for.
    pub fn next_wait(&mut self, asked_for: Option<Duration>) -> Duration {
        let factor = self.random.random_range(1.0 - JITTER..1.0 + JITTER);
        let wait = self.next.mul_f64(factor);
        self.next = self.next.mul_f64(GROWTH).min(LONGEST);
        wait.max(asked_for.unwrap_or_default())
    }

    /// The connection works: the next failure waits 100 ms again.
    pub fn reset(&mut self) {
        self.next = FIRST;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waits_grow_from_100_ms_to_5_s_within_a_fifth() {
        let mut backoff = Backoff::new(1);
        let mut expected = 0.1;
        for _ in 0..20 {
            let wait = backoff.next_wait(None).as_secs_f64();
            assert!((wait / expected - 1.0).abs() <= JITTER + 1e-9, "{wait} s");
            expected = (expected * GROWTH).min(5.0);
        }
        backoff.reset();
        assert!(backoff.next_wait(None) <= Duration::from_millis(120));
    }

    #[test]
    fn a_longer_wait_that_the_server_asked_for_is_kept() {
        let mut backoff = Backoff::new(1);
        let asked_for = Duration::from_secs(7);
        assert_eq!(backoff.next_wait(Some(asked_for)), asked_for);
    }

    #[test]
    fn two_clients_wait_differently() {
        assert_ne!(
            Backoff::new(1).next_wait(None),
            Backoff::new(2).next_wait(None)
        );
    }
}
