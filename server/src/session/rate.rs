//! How fast frames come: a limit for live ingest, and a measure for the status.

use crate::clock::nanos;
use std::time::Duration;

/// How long a publisher above the limit is slowed down before its excess frames are refused (bad input A26).
const FLOW_CONTROL: Duration = Duration::from_secs(1);

/// What the limit says to one more frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Admission {
    /// Within the limit.
    Taken,
    /// Above it; may be asked again at this reading of the clock.
    WaitUntil(i64),
    /// Above it for too long.
    Refused,
}

/// A token bucket of one second's frames. A publisher that resumes may send what it kept in a burst; one that stays
/// above the limit is first slowed down, then refused.
#[derive(Debug)]
pub(super) struct RateLimit {
    rate_hz: f64,
    tokens: f64,
    filled_nanos: i64,
    above_since_nanos: Option<i64>,
}

impl RateLimit {
    /// A full bucket; `rate_hz` is positive.
    pub(super) fn new(rate_hz: f64, now_nanos: i64) -> Self {
        Self {
            rate_hz,
            tokens: rate_hz,
            filled_nanos: now_nanos,
            above_since_nanos: None,
        }
    }

    pub(super) fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    pub(super) fn admit(&mut self, now_nanos: i64) -> Admission {
        self.fill(now_nanos);
        if self.tokens >= 1.0 {
            self.tokens -= 1.0;
            return Admission::Taken;
        }
        let since = *self.above_since_nanos.get_or_insert(now_nanos);
        if now_nanos - since >= nanos(FLOW_CONTROL) {
            return Admission::Refused;
        }
        let wait = Duration::from_secs_f64((1.0 - self.tokens) / self.rate_hz);
        // One nanosecond more, so that rounding cannot make the caller come back too early.
        Admission::WaitUntil(now_nanos.saturating_add(nanos(wait) + 1))
    }

    fn fill(&mut self, now_nanos: i64) {
        let elapsed_secs = (now_nanos - self.filled_nanos) as f64 * 1e-9;
        self.filled_nanos = now_nanos;
        self.tokens = (self.tokens + elapsed_secs * self.rate_hz).min(self.rate_hz);
        if self.tokens >= self.rate_hz / 2.0 {
            self.above_since_nanos = None;
        }
    }
}

/// Events a second over the last two seconds, from counts of quarter seconds.
#[derive(Debug, Default)]
pub(super) struct RateMeter {
    counts: [u32; 9],
    newest_slot: i64,
    first_slot: Option<i64>,
}

const SLOT_NANOS: i64 = 250_000_000;
/// The slot that fills, and the full ones of two seconds.
const N_SLOTS: i64 = 9;

impl RateMeter {
    pub(super) fn count(&mut self, now_nanos: i64) {
        let slot = self.advance(now_nanos);
        self.first_slot.get_or_insert(slot);
        self.counts[slot_idx(slot)] += 1;
    }

    /// The rate over the full slots of the last two seconds.
    pub(super) fn rate_hz(&mut self, now_nanos: i64) -> f64 {
        let slot = self.advance(now_nanos);
        let Some(first) = self.first_slot else {
            return 0.0;
        };
        let n_full = (slot - first).min(N_SLOTS - 1);
        let full = (1..=n_full).map(|back| f64::from(self.counts[slot_idx(slot - back)]));
        let total: f64 = full.sum();
        total / (n_full.max(1) as f64 * SLOT_NANOS as f64 * 1e-9)
    }

    fn advance(&mut self, now_nanos: i64) -> i64 {
        let slot = now_nanos / SLOT_NANOS;
        let n_passed = (slot - self.newest_slot).min(N_SLOTS);
        for back in 0..n_passed {
            self.counts[slot_idx(slot - back)] = 0;
        }
        self.newest_slot = self.newest_slot.max(slot);
        slot
    }
}

fn slot_idx(slot: i64) -> usize {
    usize::try_from(slot.rem_euclid(N_SLOTS)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLI: i64 = 1_000_000;

    #[test]
    fn a_publisher_below_the_limit_is_never_held() {
        let mut limit = RateLimit::new(250.0, 0);
        for frame in 0..5_000 {
            assert_eq!(limit.admit(frame * 1_000 * MILLI / 240), Admission::Taken);
        }
    }

    #[test]
    fn excess_is_slowed_then_refused_then_forgiven() {
        let mut limit = RateLimit::new(250.0, 0);
        let mut now = 0;
        let mut n_taken = 0;
        loop {
            match limit.admit(now) {
                Admission::Taken => n_taken += 1,
                Admission::WaitUntil(until) => {
                    assert!(until > now);
                    now = until;
                }
                Admission::Refused => break,
            }
        }
        assert!((495..=502).contains(&n_taken), "{n_taken}");
        assert_eq!(limit.admit(now + 4 * MILLI), Admission::Taken);
        assert_eq!(limit.admit(now + 4 * MILLI), Admission::Refused);
        assert_eq!(limit.admit(now + 2_000 * MILLI), Admission::Taken);
        assert!(limit.above_since_nanos.is_none());
    }

    #[test]
    fn measures_the_rate_of_the_last_seconds() {
        let mut meter = RateMeter::default();
        assert!(meter.rate_hz(0).abs() < 1e-9);
        for frame in 0..600 {
            meter.count(frame * 1_000 * MILLI / 120);
        }
        assert!((meter.rate_hz(5_000 * MILLI) - 120.0).abs() < 1.0);
        assert!(meter.rate_hz(60_000 * MILLI).abs() < 1e-9);
    }
}
