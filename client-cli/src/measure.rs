//! Figures of a run: rate, latency, error against the truth.

use std::{collections::VecDeque, time::Duration};

use tokio::time::Instant;

/// Ratio of neighbouring buckets: figures are exact to one percent.
const BUCKET_RATIO: f64 = 1.01;
/// Up to 1.01^2400 µs, about six hours.
const N_BUCKETS: usize = 2_400;
/// Arrivals kept for the rate: two seconds at 240 Hz and a burst.
const MAX_ARRIVALS: usize = 1_024;
/// The rate is that of the last two seconds.
const RATE_SPAN: Duration = Duration::from_secs(2);

/// Latencies in logarithmic buckets: bounded memory for a run of any length.
#[derive(Clone, Debug)]
pub struct Latencies {
    buckets: Vec<u64>,
    count: u64,
}

impl Default for Latencies {
    fn default() -> Self {
        Self {
            buckets: vec![0; N_BUCKETS],
            count: 0,
        }
    }
}

impl Latencies {
    pub fn add(&mut self, latency: Duration) {
        let micros = (latency.as_secs_f64() * 1e6).max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the logarithm of a number of at least 1, capped below"
        )]
        let bucket = (micros.ln() / BUCKET_RATIO.ln()) as usize;
        self.buckets[bucket.min(N_BUCKETS - 1)] += 1;
        self.count += 1;
    }

    /// The latency that `fraction` of all do not exceed; `None` before the first.
    pub fn quantile_micros(&self, fraction: f64) -> Option<f64> {
        let wanted = (self.count as f64 * fraction).ceil().max(1.0);
        let mut seen = 0.0;
        for (bucket, count) in self.buckets.iter().enumerate() {
            seen += *count as f64;
            if self.count > 0 && seen >= wanted {
                return Some(BUCKET_RATIO.powf(bucket as f64 + 0.5));
            }
        }
        None
    }
}

/// How many things a second arrived lately.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    arrivals: VecDeque<Instant>,
}

impl Rate {
    pub fn add(&mut self, now: Instant) {
        if self.arrivals.len() == MAX_ARRIVALS {
            self.arrivals.pop_front();
        }
        self.arrivals.push_back(now);
    }

    /// Per second, over the last two seconds; 0 before two arrivals.
    pub fn per_second(&mut self, now: Instant) -> f64 {
        while self
            .arrivals
            .front()
            .is_some_and(|it| now - *it > RATE_SPAN)
        {
            self.arrivals.pop_front();
        }
        match (self.arrivals.front(), self.arrivals.back()) {
            (Some(first), Some(last)) if last > first => {
                (self.arrivals.len() - 1) as f64 / (*last - *first).as_secs_f64()
            }
            _ => 0.0,
        }
    }
}

/// Root mean square of differences.
#[derive(Clone, Copy, Debug, Default)]
pub struct RootMeanSquare {
    sum_of_squares: f64,
    count: u64,
}

impl RootMeanSquare {
    /// Adds the difference of two vectors, entry by entry.
    pub fn add(&mut self, values: &[f32], truth: &[f64]) {
        for (value, truth) in values.iter().zip(truth) {
            self.sum_of_squares += (f64::from(*value) - truth).powi(2);
            self.count += 1;
        }
    }

    /// `None` before the first.
    pub fn value(&self) -> Option<f64> {
        (self.count > 0).then(|| (self.sum_of_squares / self.count as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_exact_to_a_percent() {
        let mut latencies = Latencies::default();
        assert_eq!(latencies.quantile_micros(0.5), None);
        for micros in 1..=10_000 {
            latencies.add(Duration::from_micros(micros));
        }
        let check = |fraction: f64, expected: f64| {
            let found = latencies.quantile_micros(fraction).unwrap();
            assert!((found / expected - 1.0).abs() < 0.011, "{found} µs");
        };
        check(0.5, 5_000.0);
        check(0.99, 9_900.0);
    }

    #[tokio::test(start_paused = true)]
    async fn the_rate_is_that_of_the_last_two_seconds() {
        let mut rate = Rate::default();
        for _ in 0..300 {
            rate.add(Instant::now());
            tokio::time::advance(Duration::from_millis(10)).await;
        }
        assert!((rate.per_second(Instant::now()) - 100.0).abs() < 1e-6);
        tokio::time::advance(Duration::from_secs(3)).await;
        assert!(rate.per_second(Instant::now()).abs() < 1e-12);
    }

    #[test]
    fn the_error_is_the_root_of_the_mean_square() {
        let mut error = RootMeanSquare::default();
        assert_eq!(error.value(), None);
        error.add(&[1.0, 0.0], &[0.0, 0.0]);
        assert!((error.value().unwrap() - 0.5_f64.sqrt()).abs() < 1e-12);
    }
}
