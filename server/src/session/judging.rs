//! How often a performance is judged while its frames come: at most four times a second, and once more when they pause.

/// At most so often.
const PERIOD_NANOS: i64 = 250_000_000;

/// When the next look is due.
#[derive(Debug, Default)]
pub(super) struct JudgingPace {
    /// Samples came since the last look.
    is_old: bool,
    next_nanos: i64,
}

impl JudgingPace {
    /// Samples came.
    pub(super) fn sampled(&mut self) {
        self.is_old = true;
    }

    /// Whether there is anything new to look at.
    pub(super) fn is_old(&self) -> bool {
        self.is_old
    }

    /// When to look; `None` while there is nothing new.
    pub(super) fn due_nanos(&self) -> Option<i64> {
        self.is_old.then_some(self.next_nanos)
    }

    /// Everything was looked at.
    pub(super) fn judged(&mut self, now_nanos: i64) {
        self.is_old = false;
        self.next_nanos = now_nanos.saturating_add(PERIOD_NANOS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_looked_at_once_a_period_and_the_last_ones_too() {
        let mut pace = JudgingPace::default();
        assert_eq!(pace.due_nanos(), None);
        pace.sampled();
        assert_eq!(pace.due_nanos(), Some(0));
        pace.judged(1_000);
        assert_eq!(pace.due_nanos(), None);
        pace.sampled();
        assert_eq!(pace.due_nanos(), Some(250_001_000));
        assert!(pace.is_old());
    }
}
