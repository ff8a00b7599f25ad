//! Erases takes that are older than the configuration lets them be (CONTRACTS S-13), and goes on with erasures that failed.
//!
//! A take's age is by the wall clock, which may be wrong: it is read once at the start and believed only after a look at when
//! it was last believed, so that a machine that wakes in 2099 erases nothing before a person had a day to notice.

use std::time::Duration;

use tokio_util::sync::CancellationToken;

use super::erasure::Erasure;
use crate::{catalogue::CatalogueError, clock::nanos};

/// Time between two rounds.
const ROUND_EVERY: Duration = Duration::from_hours(1);

/// A day; also how long a clock that seems to have jumped must run before it is believed.
const DAY: Duration = Duration::from_hours(24);

/// A clock that is further ahead of when it was last believed has jumped, or the server was off for long.
const MAX_AHEAD: Duration = Duration::from_hours(31 * 24);

/// 2020-01-01, Unix nanoseconds: whoever dates something before is a clock that was never set. Takes of that time are kept.
const EARLIEST_NANOS: i64 = 1_577_836_800_000_000_000;

/// The rounds of one server.
pub struct Retention {
    /// What erases.
    pub erasure: Erasure,
    /// How long takes are kept; `None`: until somebody erases them.
    pub takes: Option<Duration>,
}

impl Retention {
    /// A round an hour, until `drained`.
    pub async fn run(self, drained: CancellationToken) {
        if let Some(kept) = self.takes {
            tracing::info!(
                days = kept.as_secs() / DAY.as_secs(),
                "takes are erased when they are older"
            );
        } else {
            tracing::info!("takes are kept until somebody erases them");
        }
        let mut rounds = tokio::time::interval(ROUND_EVERY);
        loop {
            tokio::select! {
                _ = rounds.tick() => {}
                () = drained.cancelled() => return,
            }
            if let Err(error) = self.round().await {
                let error = &error as &dyn std::error::Error;
                tracing::error!(error, "old takes could not be erased");
            }
        }
    }

    /// Erases what is too old.
    ///
    /// # Errors
    ///
    /// That the storage failed; the next round goes on.
    pub async fn round(&self) -> Result<(), CatalogueError> {
        let erasure = &self.erasure;
        erasure.finish().await?;
        let running_nanos = erasure.clock.now_nanos();
        let now_nanos = running_nanos.saturating_add(erasure.clock.unix_offset_nanos());
        let noted_nanos = erasure.store.noted_time().await?;
        if !is_believed(now_nanos, noted_nanos, running_nanos) {
            tracing::warn!(
                now_nanos,
                noted_nanos,
                "the wall clock jumped, takes are not erased by age yet"
            );
            return Ok(());
        }
        erasure.store.note_time(now_nanos).await?;
        let Some(kept) = self.takes else {
            return Ok(());
        };
        let before_nanos = now_nanos.saturating_sub(nanos(kept));
        let old = erasure
            .store
            .takes_before(EARLIEST_NANOS..before_nanos)
            .await?;
        if !old.is_empty() {
            tracing::info!(
                n_takes = old.len(),
                "takes are older than they are kept for"
            );
            erasure.expired(&old).await?;
        }
        Ok(())
    }
}

/// Whether ages by this clock are to be trusted: it was set once, it did not go back, and it is not far ahead of when it was
/// last believed, unless it has run so for a day.
fn is_believed(now_nanos: i64, noted_nanos: i64, running_nanos: i64) -> bool {
    let is_plausible = now_nanos >= EARLIEST_NANOS;
    let ahead_nanos = now_nanos.saturating_sub(noted_nanos);
    let is_usual = (0..=nanos(MAX_AHEAD)).contains(&ahead_nanos);
    let is_new = noted_nanos == 0;
    is_plausible && (is_usual || is_new || running_nanos >= nanos(DAY))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW: i64 = 1_800_000_000_000_000_000;
    const DAY_NANOS: i64 = 86_400_000_000_000;

    #[test]
    fn h11_a_clock_that_was_never_set_or_jumped_erases_nothing_before_it_has_run_for_a_day() {
        assert!(is_believed(NOW, 0, 0));
        assert!(is_believed(NOW, NOW - 30 * DAY_NANOS, 0));
        // 1970, whatever else is known.
        assert!(!is_believed(5, 0, 2 * DAY_NANOS));
        assert!(!is_believed(5, NOW, 2 * DAY_NANOS));
        // A year ahead; an hour back.
        assert!(!is_believed(NOW + 365 * DAY_NANOS, NOW, 0));
        assert!(!is_believed(NOW - DAY_NANOS / 24, NOW, 0));
        assert!(is_believed(NOW + 365 * DAY_NANOS, NOW, DAY_NANOS));
    }
}
