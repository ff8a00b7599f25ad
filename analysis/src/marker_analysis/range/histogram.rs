//! Counts of one value in narrow bins: percentiles of a whole performance in little, bounded memory.

/// Range of the bins; what lies beyond counts at the ends.
const FROM: f64 = -1.0;
const TO: f64 = 2.5;

/// Width of a bin: percentiles are right to half of it.
const WIDTH: f64 = 0.02;

const N_BINS: usize = 175;

/// How often each value was seen.
#[derive(Clone, Debug)]
pub(super) struct Histogram {
    counts: Box<[u32; N_BINS]>,
    total: u64,
}

impl Default for Histogram {
    fn default() -> Self {
        Self {
            counts: Box::new([0; N_BINS]),
            total: 0,
        }
    }
}

impl Histogram {
    /// Counts a finite value.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the bins"
    )]
    pub fn add(&mut self, value: f64) {
        let value = value.clamp(FROM, TO - WIDTH / 2.0);
        let bin = ((value - FROM) / WIDTH).round() as usize;
        let count = &mut self.counts[bin.min(N_BINS - 1)];
        *count = count.saturating_add(1);
        self.total += 1;
    }

    pub fn total(&self) -> u64 {
        self.total
    }

    /// The value below which `share` of all lie; 0 when nothing was seen.
    ///
    /// Bins are centered on multiples of their width, so that 0 and 1, where contractions pile up, are exact.
    pub fn quantile(&self, share: f64) -> f64 {
        let wanted = share * self.total as f64;
        let mut below = 0.0;
        for (bin, &count) in self.counts.iter().enumerate() {
            below += f64::from(count);
            if count > 0 && below >= wanted {
                return FROM + bin as f64 * WIDTH;
            }
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_right_to_half_a_bin() {
        let mut histogram = Histogram::default();
        for k in 0..=1_000 {
            histogram.add(f64::from(k) * 1e-3);
        }
        assert!((histogram.quantile(0.01) - 0.01).abs() <= 0.011);
        assert!((histogram.quantile(0.5) - 0.5).abs() <= 0.011);
        assert!((histogram.quantile(0.99) - 0.99).abs() <= 0.011);
    }

    #[test]
    fn values_beyond_the_bins_count_at_their_ends_and_nothing_seen_is_zero() {
        let mut histogram = Histogram::default();
        assert!(histogram.quantile(0.5).abs() <= 0.0);
        histogram.add(-1e9);
        histogram.add(1e9);
        assert!((histogram.quantile(0.01) - FROM).abs() < 1e-9);
        assert!(histogram.quantile(1.0) > 2.4);
        assert_eq!(histogram.total(), 2);
    }
}
