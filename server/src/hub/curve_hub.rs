//! The one place where a session's samples leave and its subscribers read.
//!
//! A std mutex suffices: it is held for a few pushes or a bounded read, never across an await.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicI64, Ordering},
    },
    time::Duration,
};

use tokio::sync::watch;

use super::{
    budget::BufferBudget,
    quota::{SubscriberQuota, SubscriberStatus, Tally},
    sample::{Gap, Outgoing, PublishedSample, SessionState, StreamState},
    subscription::{SubscribeError, SubscribeSpec, Subscription},
    times::{Latency, Times},
    window::{Cursor, Entry, RangeError, Window, WindowLimits},
};
use crate::clock::{ServerClock, nanos};

/// State changes that are kept for subscribers that have not heard them yet. A session changes its state a few times a
/// second at most, and a subscriber hears of it within one response.
const KEPT_TRANSITIONS: usize = 64;

/// What a hub may hold.
#[derive(Clone, Debug)]
pub struct HubLimits {
    /// Samples of at least this last span are kept, within `window_bytes`.
    pub window_span: Duration,
    /// At least this many samples are kept, within `window_bytes`.
    pub window_samples: usize,
    /// Most bytes kept.
    pub window_bytes: usize,
    /// Most subscribers of this session.
    pub subscribers: usize,
    /// Subscribers over all sessions.
    pub subscriber_quota: SubscriberQuota,
    /// Memory over all sessions.
    pub buffers: BufferBudget,
}

/// Why a hub closed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Closing {
    /// The session ended; subscribers get `end`.
    Ended {
        /// Why it ended.
        reason: String,
        /// The run's last frame number.
        last_frame: u64,
    },
    /// The server shuts down; subscribers come back later.
    Draining,
}

/// Part of the window, for readers without a stream.
#[derive(Clone, Debug)]
pub struct Page {
    /// The run that the sequences count in.
    pub run: u64,
    /// Samples in order.
    pub samples: Vec<Arc<PublishedSample>>,
    /// Gaps among them.
    pub gaps: Vec<Gap>,
    /// Sequence to continue after.
    pub read_through: u64,
    /// The newest sequence; 0 before the first.
    pub newest_sequence: u64,
    /// Of the session.
    pub state: StreamState,
}

/// Fan-out of one session's run. Owned by the session, written by its worker, read by its subscribers.
#[derive(Debug)]
pub struct CurveHub {
    run: u64,
    clock: ServerClock,
    limits: HubLimits,
    shared: Mutex<Shared>,
    /// Grows with every change of `shared`; subscribers wait on it.
    changes: watch::Sender<u64>,
    last_frame_nanos: AtomicI64,
    tallies: Mutex<Tallies>,
}

/// What publisher and subscribers share.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) window: Window,
    pub(super) newest: Option<Arc<PublishedSample>>,
    pub(super) state: SessionState,
    transitions: VecDeque<SessionState>,
    n_transitions: u64,
    pub(super) closing: Option<Closing>,
    /// From published to handed to a subscriber that keeps up.
    pub(super) sent: Times,
}

#[derive(Debug, Default)]
struct Tallies {
    next_id: u64,
    by_id: BTreeMap<u64, Arc<Tally>>,
}

/// Marks that no frame was received yet.
const NO_FRAME: i64 = i64::MIN;

impl CurveHub {
    /// A hub without samples, for one run of a session.
    pub fn new(run: u64, clock: ServerClock, limits: HubLimits) -> Self {
        let window_limits = WindowLimits {
            span_nanos: nanos(limits.window_span),
            entries: limits.window_samples,
            bytes: limits.window_bytes,
        };
        let shared = Shared {
            window: Window::new(window_limits, limits.buffers.clone()),
            newest: None,
            state: SessionState::Waiting,
            transitions: VecDeque::new(),
            n_transitions: 0,
            closing: None,
            sent: Times::default(),
        };
        Self {
            run,
            clock,
            limits,
            shared: Mutex::new(shared),
            changes: watch::Sender::new(0),
            last_frame_nanos: AtomicI64::new(NO_FRAME),
            tallies: Mutex::default(),
        }
    }

    /// The run that sequences count in.
    pub fn run(&self) -> u64 {
        self.run
    }

    /// The state last announced.
    pub fn state(&self) -> SessionState {
        self.shared().state
    }

    /// The newest sample.
    pub fn newest(&self) -> Option<Arc<PublishedSample>> {
        self.shared().newest.clone()
    }

    /// Sequence of the newest sample; 0 before the first.
    pub fn newest_sequence(&self) -> u64 {
        self.shared().window.newest_sequence()
    }

    /// The oldest sample that is kept; the next one to come when none is.
    pub fn oldest_sequence(&self) -> u64 {
        self.shared().window.first_sequence()
    }

    /// Hands entries to every subscriber, in order, and returns at once; `outgoing` is left empty.
    pub fn publish(&self, outgoing: &mut Vec<Outgoing>) {
        if outgoing.is_empty() {
            return;
        }
        let now_nanos = self.clock.now_nanos();
        let mut shared = self.shared();
        for entry in outgoing.drain(..) {
            match entry {
                Outgoing::Gap(gap) => shared.window.push_gap(gap, now_nanos),
                Outgoing::Sample(mut sample) => {
                    sample.sequence = shared.window.next_sequence();
                    let sample = Arc::from(sample);
                    shared.newest = Some(Arc::clone(&sample));
                    shared.window.push_sample(sample, now_nanos);
                }
            }
        }
        drop(shared);
        self.changed();
    }

    /// Notes when the newest frame was received.
    pub fn frame_received(&self, now_nanos: i64) {
        self.last_frame_nanos
            .fetch_max(now_nanos, Ordering::Relaxed);
    }

    /// Tells every subscriber of a new state; the same state again changes nothing.
    pub fn announce(&self, state: SessionState) {
        let mut shared = self.shared();
        if shared.state == state {
            return;
        }
        shared.state = state;
        shared.transitions.push_back(state);
        shared.n_transitions += 1;
        if shared.transitions.len() > KEPT_TRANSITIONS {
            shared.transitions.pop_front();
        }
        drop(shared);
        self.changed();
    }

    /// Ends every subscription once it has read what is kept. The first reason stands.
    pub fn close(&self, closing: Closing) {
        self.shared().closing.get_or_insert(closing);
        self.changed();
    }

    /// Starts a subscription.
    ///
    /// # Errors
    ///
    /// [`SubscribeError`] at a limit, or when the position cannot be read.
    pub fn subscribe(
        self: &Arc<Self>,
        spec: SubscribeSpec,
    ) -> Result<Subscription, SubscribeError> {
        Subscription::start(Arc::clone(self), spec)
    }

    /// Reads up to `limit` samples after sequence `after`, or from the oldest kept; `run` is of `after`.
    ///
    /// # Errors
    ///
    /// [`RangeError`] when the position is not kept.
    pub fn page(
        &self,
        run: Option<u64>,
        after: Option<u64>,
        limit: usize,
    ) -> Result<Page, RangeError> {
        self.check_run(run)?;
        let shared = self.shared();
        let mut cursor = match after {
            Some(after) => shared.window.seek(after.saturating_add(1))?,
            None => shared.window.oldest(),
        };
        let mut page = Page {
            run: self.run,
            samples: Vec::new(),
            gaps: Vec::new(),
            read_through: cursor.sequence - 1,
            newest_sequence: shared.window.newest_sequence(),
            state: self.stream_state(shared.state),
        };
        let Page { samples, gaps, .. } = &mut page;
        // The cursor was made under this lock, so nothing is lost between.
        let _kept = shared.read_batch(&mut cursor, limit, samples, gaps);
        page.read_through = cursor.sequence - 1;
        Ok(page)
    }

    /// How long samples waited for the subscribers that keep up.
    pub fn sent_latency(&self) -> Latency {
        self.shared().sent.latency()
    }

    /// What every subscriber was sent, in the order they came.
    pub fn subscribers(&self) -> Vec<SubscriberStatus> {
        let newest_sequence = self.newest_sequence();
        let tallies = self.tallies();
        let status = |it: &Arc<Tally>| it.status(newest_sequence);
        tallies.by_id.values().map(status).collect()
    }

    pub(super) fn check_run(&self, wanted: Option<u64>) -> Result<(), RangeError> {
        match wanted {
            Some(wanted) if wanted != self.run => Err(RangeError::NewRun {
                wanted,
                current: self.run,
            }),
            _ => Ok(()),
        }
    }

    /// The state and the age of the newest frame, now.
    pub fn present_state(&self) -> StreamState {
        self.stream_state(self.state())
    }

    pub(super) fn stream_state(&self, session_state: SessionState) -> StreamState {
        let last_frame_nanos = self.last_frame_nanos.load(Ordering::Relaxed);
        let age_nanos = match last_frame_nanos {
            NO_FRAME => 0,
            received => (self.clock.now_nanos() - received).max(0),
        };
        StreamState {
            session_state,
            last_frame_age_nanos: age_nanos,
        }
    }

    pub(super) fn watch(&self) -> watch::Receiver<u64> {
        self.changes.subscribe()
    }

    pub(super) fn enlist(&self, tally: Arc<Tally>) -> Result<u64, SubscribeError> {
        let mut tallies = self.tallies();
        if tallies.by_id.len() >= self.limits.subscribers {
            return Err(SubscribeError::SessionFull {
                limit: self.limits.subscribers,
            });
        }
        let id = tallies.next_id;
        tallies.next_id += 1;
        tallies.by_id.insert(id, tally);
        Ok(id)
    }

    pub(super) fn strike(&self, id: u64) {
        self.tallies().by_id.remove(&id);
    }

    pub(super) fn quota(&self) -> &SubscriberQuota {
        &self.limits.subscriber_quota
    }

    pub(super) fn now_nanos(&self) -> i64 {
        self.clock.now_nanos()
    }

    pub(super) fn shared(&self) -> MutexGuard<'_, Shared> {
        // No code under this lock can leave it half changed, so a poisoned lock is still a good one.
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tallies(&self) -> MutexGuard<'_, Tallies> {
        self.tallies.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn changed(&self) {
        self.changes.send_modify(|count| *count += 1);
    }
}

impl Shared {
    pub(super) fn n_transitions(&self) -> u64 {
        self.n_transitions
    }

    /// The next state that a subscriber has not heard, and how many it has heard then.
    pub(super) fn transition_after(&self, n_heard: u64) -> Option<(SessionState, u64)> {
        let oldest = self.n_transitions - self.transitions.len() as u64;
        let next = n_heard.max(oldest);
        let offset = usize::try_from(next - oldest).ok()?;
        let state = *self.transitions.get(offset)?;
        Some((state, next + 1))
    }

    /// Moves `cursor` over up to `limit` entries and collects them.
    pub(super) fn read_batch(
        &self,
        cursor: &mut Cursor,
        limit: usize,
        samples: &mut Vec<Arc<PublishedSample>>,
        gaps: &mut Vec<Gap>,
    ) -> Result<(), super::window::LostRange> {
        let mut after = *cursor;
        for entry in self.window.read(cursor)?.take(limit) {
            after.position += 1;
            after.last_frame = entry.last_frame();
            match entry {
                Entry::Gap(gap) => gaps.push(*gap),
                Entry::Sample(sample) => {
                    after.sequence = sample.sequence + 1;
                    samples.push(Arc::clone(sample));
                }
            }
        }
        *cursor = after;
        Ok(())
    }
}
