//! What a session's task, its handles and its publications share.
//!
//! Two std mutexes, each held for a few lines and never across an await: the intake, and the figures.

use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::SystemTime,
};

use tokio::sync::{Notify, mpsc, watch};

use super::{
    figures::Figures,
    intake::{Closed, Intake, IntakeLimits},
    settings::{SessionEvent, SessionLimits, SessionSpec},
};
use crate::{
    clock::{ServerClock, nanos},
    hub::{BufferBudget, CurveHub, HubLimits, SubscriberQuota},
    name::{ActorId, SessionId},
};

/// One session.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) id: SessionId,
    pub(super) display_name: String,
    pub(super) actor_id: ActorId,
    pub(super) create_time: SystemTime,
    pub(super) run: u64,
    pub(super) clock: ServerClock,
    pub(super) hub: Arc<CurveHub>,
    pub(super) events: mpsc::Sender<SessionEvent>,
    /// Wakes the session's task.
    pub(super) work: Notify,
    /// Turns true when the session's task has done all that it will do.
    pub(super) is_over: watch::Sender<bool>,
    intake: Mutex<Intake>,
    figures: Mutex<Figures>,
}

/// What all sessions of a server draw from.
#[derive(Clone, Debug)]
pub(super) struct Commons {
    pub(super) limits: SessionLimits,
    pub(super) clock: ServerClock,
    pub(super) events: mpsc::Sender<SessionEvent>,
    pub(super) budget: BufferBudget,
    pub(super) quota: SubscriberQuota,
}

impl Shared {
    pub(super) fn new(spec: &SessionSpec, commons: &Commons) -> Self {
        let Commons { limits, clock, .. } = commons;
        let hub_limits = HubLimits {
            window_span: limits.window_span,
            window_samples: limits.window_samples,
            window_bytes: limits.window_bytes,
            subscribers: limits.subscribers_per_session,
            subscriber_quota: commons.quota.clone(),
            buffers: commons.budget.clone(),
        };
        let intake_limits = IntakeLimits {
            waiting_frames: limits.waiting_frames,
            waiting_bytes: limits.waiting_bytes,
            live_rate_hz: limits.live_rate_hz,
            resend_span: limits.window_span,
            budget: commons.budget.clone(),
        };
        let publisher_timeout = spec.settings.publisher_timeout;
        Self {
            id: spec.id.clone(),
            display_name: spec.display_name.clone(),
            actor_id: spec.actor_id.clone(),
            create_time: spec.create_time,
            run: spec.run,
            clock: *clock,
            hub: Arc::new(CurveHub::new(spec.run, *clock, hub_limits)),
            events: commons.events.clone(),
            work: Notify::new(),
            is_over: watch::Sender::new(false),
            intake: Mutex::new(Intake::new(
                intake_limits,
                publisher_timeout,
                clock.now_nanos(),
            )),
            figures: Mutex::new(Figures::new(spec)),
        }
    }

    pub(super) fn intake(&self) -> MutexGuard<'_, Intake> {
        // A panic is caught per frame and never under this lock.
        self.intake.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn figures(&self) -> MutexGuard<'_, Figures> {
        self.figures.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn is_draining(&self) -> bool {
        matches!(self.intake().closed(), Some(Closed::Draining))
    }

    /// Waits until the rest of the server has room for the event.
    pub(super) async fn tell(&self, event: SessionEvent) {
        if self.events.send(event).await.is_err() {
            // The reader is gone only when the server shuts down.
            tracing::warn!(session = %self.id, "an event of the session was not kept");
        }
    }

    /// Silence after which a live session is stale (CONTRACTS D-23).
    pub(super) fn stale_after_nanos(&self, rate_hz: f64) -> i64 {
        let settings = &self.figures().settings;
        settings
            .stale_after
            .map_or_else(|| default_stale_after_nanos(rate_hz), nanos)
    }
}

fn default_stale_after_nanos(rate_hz: f64) -> i64 {
    let periods_nanos = 3.0e9 / rate_hz;
    // The rate is positive and finite, so this is a number; a rate below one frame a year saturates.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "saturates, which is what is wanted"
    )]
    let periods_nanos = periods_nanos as i64;
    periods_nanos.max(100_000_000)
}
