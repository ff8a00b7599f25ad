//! What a `LATEST` subscriber may be sent, and when (CONTRACTS D-14, D-14a).

use std::time::Duration;

use tokio::time::Instant;

/// Most samples that may be in flight to one subscriber.
pub const MAX_CREDITS: u32 = 32;

/// Samples that may still be sent. Grants beyond [`MAX_CREDITS`] are lost, however they are split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Credits(u32);

impl Credits {
    pub(super) fn new(granted: u32) -> Self {
        Self(granted.min(MAX_CREDITS))
    }

    pub(super) fn grant(&mut self, more: u32) {
        self.0 = self.0.saturating_add(more).min(MAX_CREDITS);
    }

    pub(super) fn any(self) -> bool {
        self.0 > 0
    }

    pub(super) fn spend(&mut self) {
        self.0 = self.0.saturating_sub(1);
    }
}

/// The least time between two samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    period: Duration,
    due: Instant,
}

impl Pace {
    /// A pace of at most `rate_hz`, whose first sample is due at once. `rate_hz` is finite and positive.
    pub(super) fn new(rate_hz: f64, now: Instant) -> Self {
        // A subscriber that asks for less than one sample a day gets one a day.
        let period_secs = rate_hz.recip().min(86_400.0);
        Self {
            period: Duration::from_secs_f64(period_secs),
            due: now,
        }
    }

    pub(super) fn due(&self) -> Instant {
        self.due
    }

    /// Notes that a sample went out. A sample that came late by less than a period does not slow the next one,
    /// so that frames which arrive with jitter still give the full rate.
    pub(super) fn sent(&mut self, now: Instant) {
        let next = self.due + self.period;
        self.due = if next > now { next } else { now + self.period };
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn huge_grants_clamp() {
        let mut credits = Credits::new(u32::MAX);
        credits.grant(u32::MAX);
        for _ in 0..MAX_CREDITS {
            assert!(credits.any());
            credits.spend();
        }
        assert!(!credits.any());
    }

    proptest! {
        #[test]
        fn never_more_than_the_limit_in_a_row(grants in prop::collection::vec(0u32..100, 0..200)) {
            let mut credits = Credits::new(0);
            for grant in grants {
                credits.grant(grant);
                prop_assert!(credits.0 <= MAX_CREDITS);
            }
        }

        #[test]
        fn a_pace_is_kept_over_any_span(jitter_millis in prop::collection::vec(0u64..40, 1..200)) {
            let start = Instant::now();
            let mut pace = Pace::new(30.0, start);
            let mut now = start;
            let mut n_sent = 0u32;
            for wait in jitter_millis {
                now += Duration::from_millis(wait);
                if now >= pace.due() {
                    pace.sent(now);
                    n_sent += 1;
                }
            }
            let allowed = now.duration_since(start).as_secs_f64() * 30.0 + 2.0;
            prop_assert!(f64::from(n_sent) <= allowed);
        }
    }
}
