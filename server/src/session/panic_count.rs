//! How many panics of frames a session survives.

use std::collections::VecDeque;

/// Panics in this span that make a session fail (CONTRACTS O-8).
const MAX_PANICS: usize = 3;
/// See [`MAX_PANICS`].
const PANIC_SPAN_NANOS: i64 = 10_000_000_000;

/// When the last panics were.
#[derive(Debug, Default)]
pub(super) struct PanicCount {
    recent_nanos: VecDeque<i64>,
}

impl PanicCount {
    /// Counts one more; whether the session fails of it.
    pub(super) fn is_too_many(&mut self, now_nanos: i64) -> bool {
        self.recent_nanos.push_back(now_nanos);
        self.recent_nanos
            .retain(|it| now_nanos - it <= PANIC_SPAN_NANOS);
        self.recent_nanos.len() >= MAX_PANICS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_panics_in_ten_seconds_are_too_many() {
        let second = 1_000_000_000;
        let mut panics = PanicCount::default();
        assert!(!panics.is_too_many(0));
        assert!(!panics.is_too_many(5 * second));
        assert!(!panics.is_too_many(11 * second));
        assert!(!panics.is_too_many(16 * second));
        assert!(panics.is_too_many(17 * second));
    }
}
