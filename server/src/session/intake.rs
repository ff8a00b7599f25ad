//! The door of a session: who may publish, which frames are taken, and what waits.
//!
//! A session has at most one publisher, by a lease that lives a while past its last message (CONTRACTS D-28 to D-30).
//! Every frame is checked against the epoch of the lease, so that a fenced publisher has no effect (D-29).
//! Kept under one std mutex by the session; pure, times are handed in.

mod frames;
mod lease;

use std::{sync::Weak, time::Duration};

pub(super) use self::frames::MAX_CONSECUTIVE_REJECTS;
use self::lease::{Lease, Owner};
use super::{
    capture_order::CaptureOrder,
    clock_estimate::ClockEstimate,
    command::Command,
    error::SessionError,
    mailbox::Mailbox,
    order::FrameOrder,
    passed::PassedFrames,
    pre_roll::PreRoll,
    publication::PublishEnd,
    queue::{MAX_WAITING_COMMANDS, Work, WorkQueue},
    rate::{RateLimit, RateMeter},
    recording::{Recorded, RecordingFeed},
    status::SessionStatus,
    tape::Tape,
};
use crate::{clock::nanos, hub::BufferBudget};

/// Why nothing more comes in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Closed {
    Ended,
    Failed { reason: String },
    Draining,
}

impl Closed {
    pub(super) fn error(&self) -> SessionError {
        match self.clone() {
            Self::Ended => SessionError::Ended,
            Self::Failed { reason } => SessionError::Failed { reason },
            Self::Draining => SessionError::Draining,
        }
    }

    fn publish_end(&self) -> PublishEnd {
        match self.clone() {
            Self::Ended => PublishEnd::Ended,
            Self::Failed { reason } => PublishEnd::Failed { reason },
            Self::Draining => PublishEnd::Draining,
        }
    }
}

/// Counts since the run began.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct IntakeCounts {
    pub(super) received: u64,
    pub(super) rejected: u64,
    pub(super) late: u64,
    pub(super) duplicate: u64,
    pub(super) shed: u64,
    pub(super) missing: u64,
    pub(super) partial_markers: u64,
}

/// How much may wait, and how fast it may come.
#[derive(Clone, Debug)]
pub(super) struct IntakeLimits {
    pub(super) waiting_frames: usize,
    pub(super) waiting_bytes: usize,
    pub(super) live_rate_hz: f64,
    pub(super) resend_span: Duration,
    pub(super) budget: BufferBudget,
}

/// A session's publisher, frame order and queue.
#[derive(Debug)]
pub(super) struct Intake {
    lease: Option<Lease>,
    newest_epoch: u64,
    last_owner: Option<Owner>,
    capture_order: CaptureOrder,
    order: FrameOrder,
    queue: WorkQueue,
    limit: RateLimit,
    meter: RateMeter,
    counts: IntakeCounts,
    closed: Option<Closed>,
    tape: Tape,
    passed: PassedFrames,
    clock: ClockEstimate,
    /// Of whoever published last.
    last_mailbox: Weak<Mailbox>,
    /// No earlier may somebody take over again.
    next_takeover_nanos: i64,
    pub(super) publisher_timeout: Duration,
    /// A door that is broken on purpose: the search for violations has to find it out.
    #[cfg(test)]
    forgets_epochs: bool,
}

impl Intake {
    pub(super) fn new(limits: IntakeLimits, publisher_timeout: Duration, now_nanos: i64) -> Self {
        let pre_roll = PreRoll::new(nanos(limits.resend_span), limits.budget.clone());
        Self {
            lease: None,
            newest_epoch: 0,
            last_owner: None,
            capture_order: CaptureOrder::default(),
            order: FrameOrder::new(nanos(limits.resend_span)),
            queue: WorkQueue::new(limits.waiting_frames, limits.waiting_bytes, limits.budget),
            limit: RateLimit::new(limits.live_rate_hz, now_nanos),
            meter: RateMeter::default(),
            counts: IntakeCounts::default(),
            closed: None,
            passed: PassedFrames::default(),
            tape: Tape::new(pre_roll),
            clock: ClockEstimate::default(),
            last_mailbox: Weak::new(),
            next_takeover_nanos: i64::MIN,
            publisher_timeout,
            #[cfg(test)]
            forgets_epochs: false,
        }
    }

    /// Hands on all that comes in from now on, after what came since `pre_roll_since_nanos`; an earlier recording ends.
    pub(super) fn record(
        &mut self,
        pre_roll_since_nanos: Option<i64>,
    ) -> Result<RecordingFeed, SessionError> {
        self.check_open()?;
        self.check_room_for_a_command()?;
        let next_frame = self.order.next_expected().max(1);
        self.passed = PassedFrames::from(next_frame);
        let last_capture_nanos = self.capture_order.last_nanos();
        let accepted_through = self.accepted_through();
        let (tap, feed) = self.tape.start(
            next_frame,
            accepted_through,
            last_capture_nanos,
            pre_roll_since_nanos,
        );
        self.queue.push_command(Command::Record(tap));
        Ok(feed)
    }

    /// Hands on nothing more. Until [`Self::recording_settled`] the publisher still waits for stable storage.
    pub(super) fn stop_recording(&mut self) {
        self.tape.stop();
        self.wake_publisher();
    }

    /// What was handed on is on stable storage, or never will be.
    pub(super) fn recording_settled(&mut self) {
        self.tape.settled();
        self.wake_publisher();
    }

    pub(super) fn is_recorded(&self) -> bool {
        self.tape.is_recorded()
    }

    /// Every frame up to this one is on stable storage.
    pub(super) fn set_durable_through(&mut self, number: u64) {
        self.tape.set_durable_through(number);
        self.wake_publisher();
    }

    pub(super) fn durable_through(&self) -> u64 {
        self.tape.durable_through()
    }

    /// Whoever published last may wait for room, or, its frames given, for stable storage.
    fn wake_publisher(&mut self) {
        if let Some(lease) = &mut self.lease {
            lease.waits_for_space = false;
        }
        if let Some(mailbox) = self.last_mailbox.upgrade() {
            mailbox.wake();
        }
    }

    /// Hands on what stands among the frames where it takes effect.
    pub(super) fn note(&self, recorded: Recorded) {
        self.tape.note(recorded);
    }

    pub(super) fn command(&mut self, command: Command) -> Result<(), SessionError> {
        self.check_open()?;
        self.check_room_for_a_command()?;
        if let Some(recorded) = command.recorded() {
            self.note(recorded);
        }
        self.queue.push_command(command);
        Ok(())
    }

    fn check_room_for_a_command(&self) -> Result<(), SessionError> {
        if self.queue.has_room_for_a_command() {
            Ok(())
        } else {
            Err(SessionError::Busy {
                limit: MAX_WAITING_COMMANDS,
            })
        }
    }

    pub(super) fn check_open(&self) -> Result<(), SessionError> {
        self.closed.as_ref().map_or(Ok(()), |it| Err(it.error()))
    }

    /// Takes nothing more; what waits is still done. The first reason stands, except that a failed session may end.
    pub(super) fn close(&mut self, closed: Closed) {
        let may_replace = matches!(
            (&self.closed, &closed),
            (None, _) | (Some(Closed::Failed { .. }), Closed::Ended)
        );
        if !may_replace {
            return;
        }
        if let Some(lease) = self.lease.take() {
            lease.mailbox.end(closed.publish_end());
        }
        self.stop_recording();
        if closed == Closed::Ended {
            let trailing = self.order.finish();
            self.queue.push_gaps(trailing);
            self.queue.push_command(Command::End);
        }
        self.closed = Some(closed);
    }

    /// The next thing to do.
    pub(super) fn pop(&mut self) -> Option<Work> {
        let work = self.queue.pop()?;
        if let Some(lease) = self.lease.as_mut().filter(|it| it.waits_for_space) {
            lease.waits_for_space = false;
            lease.mailbox.wake();
        }
        Some(work)
    }

    pub(super) fn closed(&self) -> Option<&Closed> {
        self.closed.as_ref()
    }

    pub(super) fn counts(&self) -> IntakeCounts {
        self.counts
    }

    pub(super) fn fill(&mut self, status: &mut SessionStatus, now_nanos: i64) {
        let counts = self.counts;
        status.last_frame = self.accepted_through();
        status.frame_rate_hz = self.meter.rate_hz(now_nanos);
        status.frames_received = counts.received;
        status.frames_rejected = counts.rejected;
        status.frames_late = counts.late;
        status.frames_duplicate = counts.duplicate;
        status.frames_shed = counts.shed;
        status.frames_missing = counts.missing;
        status.markers_partial = counts.partial_markers;
        status.clock = self.clock.report();
        status.publisher = self.lease.as_ref().map(|it| it.owner.publisher.to_string());
        if let Some(Closed::Failed { reason }) = &self.closed {
            status.failure = Some(reason.clone());
        }
    }

    pub(super) fn accepted_through(&self) -> u64 {
        self.order.accepted_through()
    }

    pub(super) fn next_expected(&self) -> u64 {
        self.order.next_expected()
    }
}

#[cfg(test)]
mod model;
