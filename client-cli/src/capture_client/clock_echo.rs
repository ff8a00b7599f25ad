//! The client's half of the clock exchanges by which the server learns how the capture clock stands (CONTRACTS D-31).

use std::{fmt, sync::Arc};

use crate::proto::{ClockEcho, PublishResponse};

/// Reads the clock that capture times are on, nanoseconds; `None` while it does not run.
#[derive(Clone)]
pub struct CaptureClock(Arc<dyn Fn() -> Option<i64> + Send + Sync>);

impl CaptureClock {
    /// The clock that `now_nanos` reads: monotonic, and the one of the frames' capture times.
    pub fn new(now_nanos: impl Fn() -> Option<i64> + Send + Sync + 'static) -> Self {
        Self(Arc::new(now_nanos))
    }
}

impl fmt::Debug for CaptureClock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("CaptureClock")
    }
}

/// What the next message echoes.
#[derive(Debug, Default)]
pub(super) struct Echoes {
    clock: Option<CaptureClock>,
    /// When the newest response left the server, and when it came.
    newest: Option<(i64, i64)>,
}

impl Echoes {
    pub(super) fn of(clock: Option<CaptureClock>) -> Self {
        Self {
            clock,
            newest: None,
        }
    }

    fn now(&self) -> Option<i64> {
        self.clock.as_ref().and_then(|it| (it.0)())
    }

    /// A response has come.
    pub(super) fn received(&mut self, response: &PublishResponse) {
        self.newest = self.now().map(|now| (response.server_send_nanos, now));
    }

    /// For the message that leaves now; each response is echoed once.
    pub(super) fn take(&mut self) -> Option<ClockEcho> {
        let (server_send_nanos, client_receive_nanos) = self.newest.take()?;
        Some(ClockEcho {
            server_send_nanos,
            client_receive_nanos,
            client_send_nanos: self.now()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicI64, Ordering};

    use super::*;

    #[test]
    fn each_response_is_echoed_once_with_the_times_between() {
        let ticks = AtomicI64::new(0);
        let clock = CaptureClock::new(move || Some(ticks.fetch_add(10, Ordering::Relaxed)));
        let mut echoes = Echoes::of(Some(clock));
        assert_eq!(echoes.take(), None);
        echoes.received(&PublishResponse {
            server_send_nanos: 7,
            ..PublishResponse::default()
        });
        let expected = ClockEcho {
            server_send_nanos: 7,
            client_receive_nanos: 0,
            client_send_nanos: 10,
        };
        assert_eq!(echoes.take(), Some(expected));
        assert_eq!(echoes.take(), None);
    }

    #[test]
    fn without_a_clock_nothing_is_echoed() {
        let mut echoes = Echoes::default();
        echoes.received(&PublishResponse::default());
        assert_eq!(echoes.take(), None);
    }
}
