//! The server's monotonic clock, in nanoseconds since the server started.
//!
//! Every time on the wire that is not the publisher's is from this clock; a step of the wall clock cannot reach it
//! (CONTRACTS D-33). The offset to Unix time is taken once, at the start.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use tokio::time::Instant;

/// Monotonic time of one server, on tokio's clock, so that tests can pause it. Cheap to copy.
#[derive(Clone, Copy, Debug)]
pub struct ServerClock {
    started: Instant,
    unix_offset_nanos: i64,
}

impl ServerClock {
    /// Starts the clock by the machine's wall clock, which is read this once.
    pub fn start_now() -> Self {
        Self::start(SystemTime::now())
    }

    /// Starts the clock; `unix_now` is the wall clock's reading at this moment.
    pub fn start(unix_now: SystemTime) -> Self {
        let since_epoch = unix_now.duration_since(UNIX_EPOCH).unwrap_or_default();
        Self {
            started: Instant::now(),
            unix_offset_nanos: nanos(since_epoch),
        }
    }

    /// Nanoseconds since the start.
    pub fn now_nanos(&self) -> i64 {
        nanos(self.started.elapsed())
    }

    /// Unix time minus this clock, nanoseconds, as it was at the start.
    pub fn unix_offset_nanos(&self) -> i64 {
        self.unix_offset_nanos
    }

    /// The moment of a reading, for timers.
    pub fn instant_at(&self, reading_nanos: i64) -> Instant {
        self.started + Duration::from_nanos(u64::try_from(reading_nanos).unwrap_or(0))
    }
}

/// The machine's wall clock, for what people date: when a token expires, when a line of a log was written.
///
/// It may step; order, leases and timeouts never look at it.
pub fn wall_now() -> SystemTime {
    SystemTime::now()
}

/// A duration in whole nanoseconds, saturating after 292 years.
pub fn nanos(duration: Duration) -> i64 {
    i64::try_from(duration.as_nanos()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test(start_paused = true)]
    async fn follows_the_paused_clock() {
        let clock = ServerClock::start(UNIX_EPOCH + Duration::from_secs(5));
        assert_eq!(clock.now_nanos(), 0);
        tokio::time::advance(Duration::from_millis(3)).await;
        assert_eq!(clock.now_nanos(), 3_000_000);
        assert_eq!(clock.unix_offset_nanos(), 5_000_000_000);
        assert_eq!(clock.instant_at(3_000_000), Instant::now());
    }
}
