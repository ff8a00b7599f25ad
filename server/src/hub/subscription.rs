//! One subscriber's way through a session's samples.
//!
//! `LATEST`: the newest unsent sample, against credits or at a pace; what is passed over is counted (CONTRACTS D-14 to
//! D-16), as soon as it can no longer be sent. `EVERY_FRAME`: everything from a position on, in bounded batches; falling out of the window ends it with the
//! exact lost range (D-17, D-18), unless whoever holds it has that range from elsewhere. Both hear every state, and a heartbeat when nothing else comes (D-22, D-23).

mod elsewhere;

use std::{
    sync::{Arc, atomic::Ordering},
    time::Duration,
};

use tokio::{
    sync::watch,
    time::{Instant, sleep_until},
};

pub use super::credit::MAX_CREDITS;
use super::{
    credit::{Credits, Pace},
    curve_hub::{Closing, CurveHub, Shared},
    quota::{Seat, Tally},
    sample::{Gap, PublishedSample, StreamState},
    window::{Cursor, LostRange, RangeError},
};

/// A subscriber hears at least this often from the session.
const HEARTBEAT: Duration = Duration::from_millis(500);
/// Most entries in one update of an `EVERY_FRAME` subscriber; bounds its memory (CONTRACTS D-20).
const BATCH_ENTRIES: usize = 64;
/// Rate of a `LATEST` subscriber without credits that names none (CONTRACTS D-14a).
const UNCONTROLLED_RATE_HZ: f64 = 30.0;

/// What a subscriber asks for.
#[derive(Clone, Debug)]
pub struct SubscribeSpec {
    /// For status and logs.
    pub name: String,
    /// `grpc`, `sse`, ...
    pub protocol: &'static str,
    /// What it gets.
    pub delivery: Delivery,
    /// The run of its position; `None`: the current one.
    pub run: Option<u64>,
}

/// Which samples a subscriber gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Delivery {
    /// The newest.
    Latest {
        /// Samples in flight, at most [`MAX_CREDITS`]; `None` sends without waiting.
        credits: Option<u32>,
        /// Finite and positive; `None`: every frame with credits, 30 Hz without.
        max_rate_hz: Option<f64>,
    },
    /// All of them.
    EveryFrame(StartAt),
}

/// Where an `EVERY_FRAME` subscriber starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartAt {
    /// With the newest sample.
    Now,
    /// With this one, and the gaps just before it.
    Sequence(u64),
    /// With the oldest that is kept.
    Oldest,
    /// With this one, which is no longer kept here: the first thing that is told is what is lost, for somebody who has it from
    /// elsewhere.
    Behind(u64),
}

/// Why a subscription does not start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubscribeError {
    /// The session has all the subscribers it may have.
    #[error("the session has {limit} subscribers, the most it may have")]
    SessionFull {
        /// The limit.
        limit: usize,
    },
    /// The server has all the subscribers it may have.
    #[error("the server has {limit} subscribers, the most it may have")]
    ServerFull {
        /// The limit.
        limit: usize,
    },
    /// The position cannot be read.
    #[error(transparent)]
    Range(#[from] RangeError),
}

/// What a subscriber is told next.
#[derive(Clone, Debug)]
pub enum Delivered {
    /// Samples, gaps, a state, or several of these.
    Update(Update),
    /// It fell out of the window. Nothing follows, unless it [rejoins](Subscription::rejoin).
    Lagged(LostRange),
    /// The hub closed. Nothing follows.
    Closed(Closing),
}

/// Samples, gaps and state in one message.
#[derive(Clone, Debug, Default)]
pub struct Update {
    /// In order; at most one for `LATEST`.
    pub samples: Vec<Arc<PublishedSample>>,
    /// In order; `EVERY_FRAME` only.
    pub gaps: Vec<Gap>,
    /// Samples that were passed over since the subscription began.
    pub skipped_samples: u64,
    /// A new state, or the present one as a heartbeat.
    pub state: Option<StreamState>,
}

impl Update {
    fn is_empty(&self) -> bool {
        self.samples.is_empty() && self.gaps.is_empty() && self.state.is_none()
    }
}

enum Reading {
    Latest {
        credits: Option<Credits>,
        pace: Option<Pace>,
        /// Sequence up to which samples were sent or passed over; the newest at the start is still to be sent.
        sent_through: u64,
    },
    Every(Cursor),
}

/// A live subscription. Owned by its stream; dropping it frees the place.
pub struct Subscription {
    hub: Arc<CurveHub>,
    id: u64,
    tally: Arc<Tally>,
    _seat: Seat,
    changes: watch::Receiver<u64>,
    reading: Reading,
    max_entries: usize,
    n_states_heard: u64,
    announced: bool,
    skipped_samples: u64,
    last_delivery: Instant,
}

impl Subscription {
    pub(super) fn start(hub: Arc<CurveHub>, spec: SubscribeSpec) -> Result<Self, SubscribeError> {
        hub.check_run(spec.run)?;
        let server_full = SubscribeError::ServerFull {
            limit: hub.quota().limit(),
        };
        let seat = hub.quota().take().ok_or(server_full)?;
        let (reading, n_states_heard) = {
            let mut shared = hub.shared();
            (
                Reading::start(&mut shared, spec.delivery)?,
                shared.n_transitions(),
            )
        };
        let tally = Arc::new(Tally {
            name: spec.name,
            protocol: spec.protocol,
            ..Tally::default()
        });
        let served_through = match &reading {
            Reading::Every(cursor) => cursor.sequence - 1,
            Reading::Latest { .. } => hub.newest_sequence(),
        };
        tally
            .served_through
            .store(served_through, Ordering::Relaxed);
        if let Reading::Latest { sent_through, .. } = &reading {
            tally
                .counted_through
                .store(*sent_through, Ordering::Relaxed);
        }
        let id = hub.enlist(Arc::clone(&tally))?;
        Ok(Self {
            id,
            tally,
            _seat: seat,
            changes: hub.watch(),
            reading,
            max_entries: BATCH_ENTRIES,
            n_states_heard,
            announced: false,
            skipped_samples: 0,
            last_delivery: Instant::now(),
            hub,
        })
    }

    /// Lets `LATEST` send this many samples more; without effect on other subscriptions.
    pub fn grant(&mut self, credits: u32) {
        if let Reading::Latest {
            credits: Some(held),
            ..
        } = &mut self.reading
        {
            held.grant(credits);
        }
    }

    /// At most so many entries in an update from now on, where samples are large; one at least.
    pub fn limit_entries(&mut self, n_entries: usize) {
        self.max_entries = n_entries.clamp(1, BATCH_ENTRIES);
    }

    /// Whether it is to get all samples, not the newest.
    pub fn is_of_every_frame(&self) -> bool {
        matches!(self.reading, Reading::Every(_))
    }

    /// What a subscription of every frame was not given yet; none when it has all there is.
    pub fn unsent(&self) -> Option<LostRange> {
        match &self.reading {
            Reading::Every(cursor) => self.hub.shared().window.behind(cursor),
            Reading::Latest { .. } => None,
        }
    }

    /// Samples that were passed over since the subscription began. The newest may still be sent, until the hub closes.
    pub fn skipped_samples(&self) -> u64 {
        self.skipped_so_far(&self.hub.shared())
    }

    fn skipped_so_far(&self, shared: &Shared) -> u64 {
        let Reading::Latest { sent_through, .. } = &self.reading else {
            return self.skipped_samples;
        };
        let unsent = shared
            .window
            .newest_sequence()
            .saturating_sub(*sent_through);
        let still_to_be_sent = u64::from(shared.closing.is_none());
        self.skipped_samples + unsent.saturating_sub(still_to_be_sent)
    }

    /// Waits for what comes next. Nothing is lost when the future is dropped.
    pub async fn next(&mut self) -> Delivered {
        loop {
            // Marked as seen before reading, so that a change in between wakes the wait below.
            self.changes.borrow_and_update();
            let now = Instant::now();
            if let Some(delivered) = self.take_ready(now) {
                self.last_delivery = now;
                return delivered;
            }
            let heartbeat = self.last_delivery + HEARTBEAT;
            if now >= heartbeat {
                self.last_delivery = now;
                return Delivered::Update(self.heartbeat());
            }
            let wake = self.sample_due(now).unwrap_or(heartbeat).min(heartbeat);
            tokio::select! {
                // The hub lives as long as this subscription, so its sender does too.
                _ = self.changes.changed() => {}
                () = sleep_until(wake) => {}
            }
        }
    }

    fn heartbeat(&self) -> Update {
        Update {
            skipped_samples: self.skipped_samples(),
            state: Some(self.hub.stream_state(self.hub.state())),
            ..Update::default()
        }
    }

    /// When the pace allows the next sample, if that is still to come.
    fn sample_due(&self, now: Instant) -> Option<Instant> {
        match &self.reading {
            Reading::Latest {
                pace: Some(pace), ..
            } if pace.due() > now => Some(pace.due()),
            _ => None,
        }
    }

    fn take_ready(&mut self, now: Instant) -> Option<Delivered> {
        let hub = Arc::clone(&self.hub);
        let mut shared = hub.shared();
        let mut update = Update::default();
        if let Err(lost) = self.take_samples(&mut shared, now, &mut update) {
            return Some(Delivered::Lagged(lost));
        }
        // One that is still catching up would tell how far it was behind, not how long a sample takes.
        if let Some(newest) = update.samples.last()
            && newest.sequence == shared.window.newest_sequence()
        {
            let nanos = hub.now_nanos() - newest.solved_time_nanos;
            shared.sent.add(nanos);
        }
        update.state = self.unheard_state(&shared);
        update.skipped_samples = self.skipped_so_far(&shared);
        if !update.is_empty() {
            return Some(Delivered::Update(update));
        }
        shared.closing.clone().map(Delivered::Closed)
    }

    /// The next state that it has not heard; at first, the present one.
    fn unheard_state(&mut self, shared: &Shared) -> Option<StreamState> {
        let transition = shared.transition_after(self.n_states_heard);
        let is_first = !std::mem::replace(&mut self.announced, true);
        if let Some((state, n_heard)) = transition {
            self.n_states_heard = n_heard;
            return Some(self.hub.stream_state(state));
        }
        is_first.then(|| self.hub.stream_state(shared.state))
    }

    fn take_samples(
        &mut self,
        shared: &mut Shared,
        now: Instant,
        update: &mut Update,
    ) -> Result<(), LostRange> {
        match &mut self.reading {
            Reading::Every(cursor) => {
                shared.read_batch(
                    cursor,
                    self.max_entries,
                    &mut update.samples,
                    &mut update.gaps,
                )?;
                shared.window.reader_at(cursor);
                let served_through = cursor.sequence - 1;
                self.tally
                    .served_through
                    .store(served_through, Ordering::Relaxed);
            }
            Reading::Latest {
                credits,
                pace,
                sent_through,
            } => {
                let may_send = credits.is_none_or(Credits::any)
                    && pace.is_none_or(|it| it.due() <= now || shared.closing.is_some());
                let newest = shared.newest.as_ref().filter(|_| may_send);
                let unsent = newest.filter(|it| it.sequence > *sent_through);
                if let Some(sample) = unsent {
                    self.skipped_samples += sample.sequence - *sent_through - 1;
                    *sent_through = sample.sequence;
                    if let Some(credits) = credits {
                        credits.spend();
                    }
                    if let Some(pace) = pace {
                        pace.sent(now);
                    }
                    self.tally
                        .skipped_samples
                        .store(self.skipped_samples, Ordering::Relaxed);
                    for through in [&self.tally.served_through, &self.tally.counted_through] {
                        through.store(sample.sequence, Ordering::Relaxed);
                    }
                    update.samples.push(Arc::clone(sample));
                }
            }
        }
        self.tally
            .sent_samples
            .fetch_add(update.samples.len() as u64, Ordering::Relaxed);
        Ok(())
    }
}

impl Reading {
    fn start(shared: &mut Shared, delivery: Delivery) -> Result<Self, RangeError> {
        match delivery {
            Delivery::EveryFrame(start) => {
                let cursor = match start {
                    StartAt::Now => shared.window.newest(),
                    StartAt::Oldest => shared.window.oldest(),
                    StartAt::Sequence(sequence) => shared.window.seek(sequence)?,
                    StartAt::Behind(sequence) => Cursor::before_all(sequence, 0),
                };
                shared.window.reader_at(&cursor);
                Ok(Self::Every(cursor))
            }
            Delivery::Latest {
                credits,
                max_rate_hz,
            } => {
                let uncontrolled = credits.is_none().then_some(UNCONTROLLED_RATE_HZ);
                let rate_hz = max_rate_hz.or(uncontrolled);
                Ok(Self::Latest {
                    credits: credits.map(Credits::new),
                    pace: rate_hz.map(|rate_hz| Pace::new(rate_hz, Instant::now())),
                    sent_through: shared.window.newest_sequence().saturating_sub(1),
                })
            }
        }
    }
}

impl Drop for Subscription {
    fn drop(&mut self) {
        self.hub.strike(self.id);
    }
}

#[cfg(test)]
mod tests;
