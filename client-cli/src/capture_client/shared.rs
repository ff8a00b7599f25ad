//! What the caller's side and the connection's side of a publication share.

use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use super::{
    report::PublishReport,
    ring::{RingLimits, UnackedRing},
};
use crate::{
    error::ClientError,
    proto::{PublishResponse, PublishStarted},
};

/// A std mutex suffices: it is never held across a wait.
#[derive(Debug)]
pub(super) struct Shared {
    state: Mutex<State>,
    /// There is something to send, or the caller is done.
    pub work: Notify,
    /// The ring has room again, or the publication failed.
    pub room: Notify,
}

#[derive(Debug)]
pub(super) struct State {
    pub ring: UnackedRing,
    pub report: PublishReport,
    pub is_closing: bool,
    pub failure: Option<ClientError>,
    /// What the session expected next when the publication began.
    known_below: u64,
    /// Frames shed on earlier connections; the wire counts from the start of each.
    shed_before: u64,
}

impl Shared {
    pub fn new(limits: RingLimits) -> Self {
        Self {
            state: Mutex::new(State {
                ring: UnackedRing::new(limits),
                report: PublishReport::default(),
                is_closing: false,
                failure: None,
                known_below: 0,
                shed_before: 0,
            }),
            work: Notify::new(),
            room: Notify::new(),
        }
    }

    pub fn lock(&self) -> MutexGuard<'_, State> {
        // Every change is complete before anything that could panic.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn report(&self) -> PublishReport {
        let state = self.lock();
        let mut report = state.report.clone();
        report.lost = state.ring.lost().clone();
        report.unacknowledged_frames = state.ring.len() as u64;
        report
    }

    /// The caller is done, and nothing is left to send.
    pub fn is_over(&self) -> bool {
        let state = self.lock();
        state.is_closing && state.ring.is_empty()
    }

    pub fn fail(&self, failure: ClientError) {
        self.lock().failure = Some(failure);
        self.room.notify_waiters();
    }

    /// The first response of a connection says where the server stands (CONTRACTS D-8).
    pub fn begin_connection(&self, first: &PublishResponse) -> PublishStarted {
        let started = first.started.unwrap_or_default();
        let mut state = self.lock();
        let had_run = state.report.run;
        if had_run == 0 {
            state.known_below = started.next_expected;
        } else if started.run != had_run {
            state.known_below = 0;
            if started.recorded_run == had_run {
                // They are in that run's take, whether or not it could still say so.
                state.settle_through(started.recorded_through);
            }
            state.report.new_runs += 1;
            state.report.accepted_through = 0;
            state.report.durable_through = 0;
        }
        state.report.run = started.run;
        state.report.epoch = started.epoch;
        state.report.recording = first.recording;
        state.shed_before = state.report.shed_frames;
        let has_through = if first.recording {
            started.durable_through
        } else {
            started.next_expected.saturating_sub(1)
        };
        state.settle_through(has_through);
        state.ring.start_connection();
        drop(state);
        self.room.notify_waiters();
        started
    }

    /// Rejections first: a frame that was refused is below the watermark of the same response.
    pub fn take_response(&self, response: PublishResponse) {
        let mut state = self.lock();
        for rejected in response.rejected {
            if !state.ring.settle_rejected(rejected.number) {
                // A watermark had covered it: its number was known, or its solve failed after it was taken.
                let counted = if rejected.number < state.known_below {
                    &mut state.report.known_frames
                } else {
                    &mut state.report.accepted_frames
                };
                *counted = counted.saturating_sub(1);
            }
            state.report.reject(rejected);
        }
        state.report.shed_frames = state.shed_before + response.shed_frames;
        let report = &mut state.report;
        if report.recording && !response.recording {
            report.recorded_through = Some(report.durable_through);
        } else if response.recording {
            report.recorded_through = None;
        }
        report.recording = response.recording;
        report.accepted_through = report.accepted_through.max(response.accepted_through);
        report.durable_through = report.durable_through.max(response.durable_through);
        let safe_through = if response.recording {
            response.durable_through
        } else {
            response.accepted_through
        };
        state.settle_through(safe_through);
        drop(state);
        self.room.notify_waiters();
    }
}

impl State {
    fn settle_through(&mut self, number: u64) {
        let settled = self.ring.settle_through(number, self.known_below);
        self.report.accepted_frames += settled.accepted;
        self.report.known_frames += settled.known;
    }
}
