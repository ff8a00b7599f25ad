//! How long the last samples took on one stage of their way.

/// Times kept a stage.
const KEPT_TIMES: usize = 1_024;

/// A distribution in three figures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Latency {
    /// Median, microseconds.
    pub p50_micros: f64,
    /// 99th percentile, microseconds.
    pub p99_micros: f64,
    /// Largest, microseconds.
    pub max_micros: f64,
}

/// The last times of one stage, in a ring.
#[derive(Debug, Default)]
pub(crate) struct Times {
    micros: Vec<f32>,
    next: usize,
}

impl Times {
    pub(crate) fn add(&mut self, nanos: i64) {
        // Three figures for a person: f32 is more than enough.
        #[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
        let micros = (nanos.max(0) as f64 * 1e-3) as f32;
        match self.micros.get_mut(self.next) {
            Some(oldest) => *oldest = micros,
            None => self.micros.push(micros),
        }
        self.next = (self.next + 1) % KEPT_TIMES;
    }

    pub(crate) fn latency(&self) -> Latency {
        let mut sorted = self.micros.clone();
        sorted.sort_unstable_by(f32::total_cmp);
        let at = |percent: usize| {
            let idx = (sorted.len() * percent / 100).min(sorted.len().saturating_sub(1));
            sorted.get(idx).copied().map_or(0.0, f64::from)
        };
        Latency {
            p50_micros: at(50),
            p99_micros: at(99),
            max_micros: at(100),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_of_the_last_thousand() {
        let mut times = Times::default();
        for _ in 0..10 {
            times.add(5_000_000_000);
        }
        for micros in 0..1_024 {
            times.add(micros * 1_000);
        }
        let latency = times.latency();
        assert!((latency.p50_micros - 512.0).abs() < 1e-3);
        assert!((latency.p99_micros - 1_013.0).abs() < 1e-3);
        assert!((latency.max_micros - 1_023.0).abs() < 1e-3);
    }

    #[test]
    fn no_times_are_zero() {
        assert_eq!(Times::default().latency(), Latency::default());
    }
}
