//! How a publisher's capture clock stands to the server's (CONTRACTS D-31).
//!
//! An exchange is two messages: the server's, sent at T1 by its clock and received at T2 by the publisher's, and the answer,
//! sent at T3 and received at T4. Neither was under way for less than no time, so that the offset, server less capture clock,
//! lies between T1 − T2 and T4 − T3. The narrowest corridor that the exchanges of the last seconds leave, those with the
//! shortest ways, is where it is; how the middle of the corridor moves over a longer time is the drift.
//! Pure: times are handed in, and all of the server's are its monotonic clock's (D-33).

use std::collections::VecDeque;

/// Exchanges before anything is said.
const LEAST_EXCHANGES: usize = 8;

/// How often the report changes.
const REPORT_EVERY_NANOS: i64 = 5_000_000_000;

/// The corridor of the offset is that of exchanges so old at most.
const OFFSET_SPAN_NANOS: i64 = 10_000_000_000;

/// The drift is that of exchanges so old at most, and at least so far apart.
const DRIFT_SPAN_NANOS: i64 = 60_000_000_000;
const LEAST_DRIFT_SPAN_NANOS: i64 = 15_000_000_000;

/// Exchanges that are kept; of more that come within a span the oldest go.
const MAX_EXCHANGES: usize = 1_200;

/// Exchanges begin no closer to each other than this; what comes sooner is passed over.
const LEAST_APART_NANOS: i64 = 30_000_000;

/// No quartz drifts further.
const LARGEST_DRIFT: f64 = 5e-4;

/// Rounds in which the drift of the round before is taken out of the bounds that it is found from.
const DRIFT_ROUNDS: usize = 3;

/// One exchange, nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClockExchange {
    /// T1, server clock.
    pub server_send: i64,
    /// T2, capture clock.
    pub client_receive: i64,
    /// T3, capture clock.
    pub client_send: i64,
    /// T4, server clock.
    pub server_receive: i64,
}

/// How the clocks stand, until the next report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockReport {
    /// Server clock less capture clock, nanoseconds, at `server_time_nanos`.
    pub offset_nanos: i64,
    /// When that was so, server clock.
    pub server_time_nanos: i64,
    /// By how much the capture clock is slow: so many nanoseconds the offset grows in a millisecond of the server's, times 1e-6.
    pub drift_ppm: f64,
    /// Both ways of the fastest exchange, nanoseconds.
    pub round_trip_nanos: u64,
    /// The offset is known to so many nanoseconds.
    pub uncertainty_nanos: u64,
}

impl ClockReport {
    /// A capture time on the server's clock.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a thousandth of a span, and it saturates"
    )]
    pub fn on_server_clock(&self, capture_time_nanos: i64) -> i64 {
        let moved = capture_time_nanos.saturating_add(self.offset_nanos);
        let since = moved.saturating_sub(self.server_time_nanos);
        let drifted = (since as f64 * self.drift_ppm * 1e-6).round() as i64;
        moved.saturating_add(drifted)
    }
}

/// The exchanges with one publisher.
#[derive(Debug, Default)]
pub(super) struct ClockEstimate {
    exchanges: VecDeque<ClockExchange>,
    drift: f64,
    report: Option<ClockReport>,
}

/// Bounds of the offset at one moment, nanoseconds.
#[derive(Clone, Copy, Debug)]
struct Corridor {
    lower: f64,
    upper: f64,
}

impl ClockEstimate {
    /// What is known.
    pub(super) fn report(&self) -> Option<ClockReport> {
        self.report
    }

    /// Takes in an exchange; returns the report when it changes by it. What cannot have been so is passed over.
    pub(super) fn add(&mut self, exchange: ClockExchange) -> Option<ClockReport> {
        // By when they began: to go by when they ended would pass over the fast ones.
        let is_apart = self.exchanges.back().is_none_or(|it| {
            exchange.server_send.saturating_sub(it.server_send) >= LEAST_APART_NANOS
        });
        if !exchange.is_possible() || !is_apart {
            return None;
        }
        let now = exchange.server_receive;
        self.exchanges.push_back(exchange);
        let is_old = |it: &ClockExchange| now.saturating_sub(it.server_receive) > DRIFT_SPAN_NANOS;
        while self.exchanges.len() > MAX_EXCHANGES || self.exchanges.front().is_some_and(is_old) {
            self.exchanges.pop_front();
        }
        let is_due = match &self.report {
            None => self.exchanges.len() >= LEAST_EXCHANGES,
            Some(last) => now.saturating_sub(last.server_time_nanos) >= REPORT_EVERY_NANOS,
        };
        if is_due {
            self.report = self.find(now);
            return self.report;
        }
        None
    }

    fn find(&mut self, now: i64) -> Option<ClockReport> {
        self.find_drift();
        let newest = self.exchanges.back()?;
        // Offsets are told as differences from this one: they are then far below 2^53.
        let base = newest.server_send.saturating_sub(newest.client_receive);
        let recent = self
            .exchanges
            .iter()
            .rev()
            .enumerate()
            .take_while(|(index, it)| {
                *index < LEAST_EXCHANGES || span(it.server_receive, now) <= OFFSET_SPAN_NANOS as f64
            })
            .map(|(_, it)| it);
        let corridor = self.corridor(recent.clone(), base, now);
        let round_trip = recent.map(ClockExchange::round_trip).min()?;
        Some(ClockReport {
            offset_nanos: base.saturating_add(whole(corridor.middle())),
            server_time_nanos: now,
            drift_ppm: self.drift * 1e6,
            round_trip_nanos: round_trip.unsigned_abs(),
            uncertainty_nanos: whole(corridor.half_width()).unsigned_abs(),
        })
    }

    /// The drift by which the middles of the corridors of an older and a newer half lie apart.
    fn find_drift(&mut self) {
        let (Some(first), Some(last)) = (self.exchanges.front(), self.exchanges.back()) else {
            return;
        };
        let (first, last) = (first.server_receive, last.server_receive);
        if last.saturating_sub(first) < LEAST_DRIFT_SPAN_NANOS {
            return;
        }
        let middle = first + (last - first) / 2;
        let n_older = self
            .exchanges
            .partition_point(|it| it.server_receive < middle);
        let base = self
            .exchanges
            .back()
            .map_or(0, |it| it.server_send.saturating_sub(it.client_receive));
        // The middles of the halves.
        let (t_older, t_newer) = (first + (middle - first) / 2, middle + (last - middle) / 2);
        for _ in 0..DRIFT_ROUNDS {
            let older = self.corridor(self.exchanges.iter().take(n_older), base, t_older);
            let newer = self.corridor(self.exchanges.iter().skip(n_older), base, t_newer);
            let moved = newer.middle() - older.middle();
            let drift = moved / span(t_older, t_newer);
            if drift.is_finite() {
                self.drift = drift.clamp(-LARGEST_DRIFT, LARGEST_DRIFT);
            }
        }
    }

    /// Where the offset less `base` was at `at`, by these exchanges and the drift as it is known.
    fn corridor<'a>(
        &self,
        exchanges: impl Iterator<Item = &'a ClockExchange>,
        base: i64,
        at: i64,
    ) -> Corridor {
        let anywhere = Corridor {
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
        };
        exchanges.fold(anywhere, |corridor, it| {
            let lower = difference(it.server_send, it.client_receive, base)
                + self.drift * span(it.server_send, at);
            let upper = difference(it.server_receive, it.client_send, base)
                + self.drift * span(it.server_receive, at);
            Corridor {
                lower: corridor.lower.max(lower),
                upper: corridor.upper.min(upper),
            }
        })
    }
}

impl ClockExchange {
    /// Both ways together, nanoseconds.
    fn round_trip(&self) -> i64 {
        let whole = self.server_receive.saturating_sub(self.server_send);
        whole.saturating_sub(self.client_send.saturating_sub(self.client_receive))
    }

    /// Whether no answer came before its question, by either clock.
    fn is_possible(&self) -> bool {
        self.server_send <= self.server_receive
            && self.client_receive <= self.client_send
            && self.round_trip() >= 0
    }
}

impl Corridor {
    fn middle(self) -> f64 {
        0.5 * (self.lower + self.upper)
    }

    fn half_width(self) -> f64 {
        0.5 * (self.upper - self.lower).abs()
    }
}

/// a − b − base, nanoseconds.
fn difference(a: i64, b: i64, base: i64) -> f64 {
    a.saturating_sub(b).saturating_sub(base) as f64
}

/// From `from` to `to`, nanoseconds.
fn span(from: i64, to: i64) -> f64 {
    to.saturating_sub(from) as f64
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates; what is not a number is 0"
)]
fn whole(nanos: f64) -> i64 {
    nanos.round() as i64
}

#[cfg(test)]
mod tests;
