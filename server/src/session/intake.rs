//! The door of a session: who may publish, which frames are taken, and what waits.
//!
//! A session has at most one publisher, by a lease that lives a while past its last message (CONTRACTS D-28 to D-30).
//! Every frame is checked against the epoch of the lease, so that a fenced publisher has no effect (D-29).
//! Kept under one std mutex by the session; pure, times are handed in.

use std::{
    sync::{Arc, Weak},
    time::Duration,
};

use super::{
    capture_order::CaptureOrder,
    clock_estimate::{ClockEstimate, ClockExchange},
    command::{Command, Source},
    error::SessionError,
    frame::{IncomingFrame, Rejection},
    mailbox::Mailbox,
    order::{FrameOrder, Verdict},
    passed::{Found, PassedFrames},
    pre_roll::PreRoll,
    publication::{Claim, Grant, Ingest, Offer, PublishEnd, Wait},
    queue::{MAX_WAITING_COMMANDS, WaitingFrame, Work, WorkQueue},
    rate::{Admission, RateLimit, RateMeter},
    recording::{Recorded, RecordedSource, RecordingFeed},
    settings::StreamShape,
    status::SessionStatus,
    tape::Tape,
};
use crate::{
    clock::{ServerClock, nanos},
    hub::{BufferBudget, Gap, GapCause},
    name::PublisherId,
};

/// Unusable frames in a row that end a publication (CONTRACTS D-10).
pub(super) const MAX_CONSECUTIVE_REJECTS: u32 = 100;

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

#[derive(Debug)]
struct Lease {
    owner: Owner,
    mailbox: Arc<Mailbox>,
    expires_nanos: i64,
    ingest: Ingest,
    n_rejects_in_a_row: u32,
    waits_for_space: bool,
}

/// A publisher, and whose it is.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Owner {
    publisher: PublisherId,
    principal: Arc<str>,
}

impl Owner {
    fn of(claim: &Claim) -> Self {
        Self {
            publisher: claim.publisher.clone(),
            principal: Arc::clone(&claim.principal),
        }
    }
}

/// A session changes hands by takeover at most this often (BAD_INPUT I10).
const TAKEOVER_EVERY: Duration = Duration::from_secs(1);

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

    /// Whether a publisher may start now: as [`Self::check_claim`] says, and whoever pushes another out in turn.
    pub(super) fn admit(&mut self, claim: &Claim, now_nanos: i64) -> Result<(), SessionError> {
        self.check_claim(claim, now_nanos)?;
        if self.lease_of_another(claim, now_nanos).is_none() {
            return Ok(());
        }
        let left_nanos = self.next_takeover_nanos.saturating_sub(now_nanos);
        if left_nanos > 0 {
            let retry_after = Duration::from_nanos(left_nanos.unsigned_abs());
            return Err(SessionError::TakeoverRate { retry_after });
        }
        self.next_takeover_nanos = now_nanos.saturating_add(nanos(TAKEOVER_EVERY));
        Ok(())
    }

    fn lease_of_another(&self, claim: &Claim, now_nanos: i64) -> Option<&Lease> {
        let lease = self.lease.as_ref()?;
        let is_in_force = now_nanos < lease.expires_nanos;
        (is_in_force && lease.owner != Owner::of(claim)).then_some(lease)
    }

    /// Whether a publisher may start.
    pub(super) fn check_claim(&self, claim: &Claim, now_nanos: i64) -> Result<(), SessionError> {
        self.check_open()?;
        let Some(lease) = self.lease_of_another(claim, now_nanos) else {
            return Ok(());
        };
        if !claim.takeover {
            let left_nanos = lease.expires_nanos - now_nanos;
            return Err(SessionError::Owned {
                owner: lease.owner.publisher.to_string(),
                free_after: Duration::from_nanos(left_nanos.unsigned_abs()),
            });
        }
        if lease.owner.principal != claim.principal && !claim.outranks {
            return Err(SessionError::OwnedByAnother);
        }
        Ok(())
    }

    /// Starts a lease; an older one is fenced. The queue learns of the source, so that frames are read as it declared.
    pub(super) fn grant(
        &mut self,
        grant: &Grant,
        shape: StreamShape,
        now_nanos: i64,
    ) -> Result<Arc<Mailbox>, SessionError> {
        self.check_claim(&grant.claim, now_nanos)?;
        if grant.epoch <= self.newest_epoch {
            return Err(SessionError::Fenced {
                epoch: grant.epoch,
                current: self.newest_epoch,
            });
        }
        self.check_room_for_a_command()?;
        self.fence(grant.epoch);
        self.newest_epoch = grant.epoch;
        let owner = Owner::of(&grant.claim);
        let is_other = self.note_owner(&owner);
        self.clock = ClockEstimate::default();
        let mailbox = Arc::new(Mailbox::new(grant.epoch));
        self.last_mailbox = Arc::downgrade(&mailbox);
        self.lease = Some(Lease {
            owner,
            mailbox: Arc::clone(&mailbox),
            expires_nanos: now_nanos.saturating_add(nanos(self.publisher_timeout)),
            ingest: grant.ingest,
            n_rejects_in_a_row: 0,
            waits_for_space: false,
        });
        self.tape.source(RecordedSource {
            publisher: grant.claim.publisher.clone(),
            epoch: grant.epoch,
            shape: shape.clone(),
            rate_hz: grant.rate_hz,
            is_continued: false,
            is_other,
        });
        self.queue.push_command(Command::Source(Source {
            shape,
            rate_hz: grant.rate_hz,
            mailbox: Arc::clone(&mailbox),
        }));
        Ok(mailbox)
    }

    fn fence(&mut self, current: u64) {
        if let Some(old) = self.lease.take() {
            old.mailbox.end(PublishEnd::Fenced {
                epoch: old.mailbox.epoch(),
                current,
            });
        }
    }

    /// Whether it is another one than before.
    fn note_owner(&mut self, owner: &Owner) -> bool {
        let is_other = self.last_owner.as_ref().is_some_and(|it| it != owner);
        if is_other {
            self.order.publisher_changed();
            self.capture_order.another_clock();
        }
        self.last_owner = Some(owner.clone());
        is_other
    }

    /// Judges a frame and takes it when it is new and there is room.
    pub(super) fn offer(
        &mut self,
        mailbox: &Mailbox,
        frame: IncomingFrame,
        clock: &ServerClock,
        now_nanos: i64,
    ) -> Result<Offer, PublishEnd> {
        self.renew(mailbox, now_nanos)?;
        let number = frame.number;
        match self.order.judge(number, frame.content_hash) {
            Verdict::New => self.offer_new(frame, clock, now_nanos),
            Verdict::Duplicate => Ok(self.duplicate()),
            Verdict::Late if self.tape.is_recording() => match self.passed.find(number) {
                Found::Unknown => Ok(Offer::Unsure(frame)),
                Found::Never => Ok(self.late(&frame, now_nanos)),
                Found::Late(hash) => self.again(mailbox, &frame, hash),
            },
            Verdict::Late => Ok(self.late(&frame, now_nanos)),
            Verdict::Conflict => self.conflict(mailbox, number),
            Verdict::Jump => {
                let last = self.order.accepted_through();
                let detail = format!("more than 2^32 beyond frame {last}");
                self.refuse(mailbox, rejection(number, "FRAME_JUMP", detail))
            }
        }
    }

    /// Judges a frame again that was [`Offer::Unsure`]: the take has this content under its number, or none.
    pub(super) fn offer_known(
        &mut self,
        mailbox: &Mailbox,
        frame: &IncomingFrame,
        in_take: Option<u64>,
        now_nanos: i64,
    ) -> Result<Offer, PublishEnd> {
        self.renew(mailbox, now_nanos)?;
        match in_take {
            Some(hash) => self.again(mailbox, frame, hash),
            None => Ok(self.late(frame, now_nanos)),
        }
    }

    /// A frame whose number was taken with content of this hash.
    fn again(
        &mut self,
        mailbox: &Mailbox,
        frame: &IncomingFrame,
        hash: u64,
    ) -> Result<Offer, PublishEnd> {
        if frame.content_hash == hash {
            Ok(self.duplicate())
        } else {
            self.conflict(mailbox, frame.number)
        }
    }

    fn duplicate(&mut self) -> Offer {
        self.counts.duplicate += 1;
        Offer::Taken
    }

    fn conflict(&mut self, mailbox: &Mailbox, number: u64) -> Result<Offer, PublishEnd> {
        let detail = "this number was taken with other content".to_owned();
        self.refuse(mailbox, rejection(number, "FRAME_CONFLICT", detail))
    }

    /// A late frame is no mistake of the publisher: it does not count towards the limit in a row.
    fn late(&mut self, frame: &IncomingFrame, now_nanos: i64) -> Offer {
        self.tape.frame(frame, now_nanos, true);
        self.passed.came_late(frame.number, frame.content_hash);
        self.counts.late += 1;
        self.counts.rejected += 1;
        let detail = format!("frame {} was already passed", self.order.accepted_through());
        Offer::Rejected(rejection(frame.number, "LATE", detail))
    }

    fn offer_new(
        &mut self,
        frame: IncomingFrame,
        clock: &ServerClock,
        now_nanos: i64,
    ) -> Result<Offer, PublishEnd> {
        let cost_bytes = frame.cost_bytes();
        let Some(lease) = &mut self.lease else {
            return Err(self.lost());
        };
        if !self.tape.has_room() {
            // What cannot be recorded is not taken, however live it is: an acknowledged frame is in the take.
            lease.waits_for_space = true;
            return Ok(Offer::Wait(frame, Wait::Space));
        }
        match lease.ingest {
            Ingest::Lossless if !self.queue.has_room(cost_bytes) => {
                lease.waits_for_space = true;
                return Ok(Offer::Wait(frame, Wait::Space));
            }
            Ingest::Lossless => {}
            Ingest::Live => match self.limit.admit(now_nanos) {
                Admission::Taken => self.make_room(cost_bytes),
                Admission::WaitUntil(until) => {
                    return Ok(Offer::Wait(frame, Wait::Until(clock.instant_at(until))));
                }
                Admission::Refused => return Ok(Offer::Rejected(self.refuse_excess(&frame))),
            },
        }
        self.take(frame, now_nanos);
        Ok(Offer::Taken)
    }

    fn make_room(&mut self, cost_bytes: usize) {
        while !self.queue.has_room(cost_bytes) && self.queue.shed_oldest() {
            self.counts.shed += 1;
        }
    }

    /// Too fast is not unusable: it does not count towards the limit in a row.
    fn refuse_excess(&mut self, frame: &IncomingFrame) -> Rejection {
        self.counts.rejected += 1;
        self.order.reject(frame.number);
        let rate_hz = self.limit.rate_hz();
        let detail = format!("the session takes {rate_hz} frames a second");
        rejection(frame.number, "RATE_LIMIT", detail)
    }

    fn take(&mut self, mut frame: IncomingFrame, now_nanos: i64) {
        let gaps_before = self
            .order
            .accept(frame.number, frame.content_hash, now_nanos);
        let skipped = gaps_before
            .iter()
            .filter(|it| it.cause != GapCause::Rejected);
        let n_missing = skipped.map(Gap::n_frames);
        self.counts.missing = n_missing.fold(self.counts.missing, u64::saturating_add);
        self.counts.received += 1;
        self.counts.partial_markers += frame.n_partial_markers as u64;
        self.meter.count(now_nanos);
        let clock = self.clock.report();
        frame.tag.capture_time_server_nanos =
            clock.map(|it| it.on_server_clock(frame.capture_time_nanos));
        frame.tag.time_non_monotonic = self.capture_order.is_broken_by(frame.capture_time_nanos);
        if let Some(lease) = &mut self.lease {
            lease.n_rejects_in_a_row = 0;
        }
        self.tape.frame(&frame, now_nanos, false);
        self.queue.push_frame(WaitingFrame {
            frame,
            gaps_before,
            received_nanos: now_nanos,
        });
    }

    /// Counts a frame that cannot be used; ends the publication after too many in a row.
    pub(super) fn refuse(
        &mut self,
        mailbox: &Mailbox,
        rejection: Rejection,
    ) -> Result<Offer, PublishEnd> {
        self.check_lease(mailbox)?;
        self.counts.rejected += 1;
        self.order.reject(rejection.number);
        let Some(lease) = &mut self.lease else {
            return Err(self.lost());
        };
        lease.n_rejects_in_a_row += 1;
        if lease.n_rejects_in_a_row >= MAX_CONSECUTIVE_REJECTS {
            mailbox.reject(rejection);
            mailbox.end(PublishEnd::TooManyRejects {
                n_rejects: MAX_CONSECUTIVE_REJECTS,
            });
            self.lease = None;
            return Err(ended(mailbox));
        }
        Ok(Offer::Rejected(rejection))
    }

    /// Takes in an exchange with the publisher's clock.
    pub(super) fn exchange(
        &mut self,
        mailbox: &Mailbox,
        exchange: ClockExchange,
    ) -> Result<(), PublishEnd> {
        self.check_lease(mailbox)?;
        if let Some(report) = self.clock.add(exchange) {
            self.tape.clock(report);
        }
        Ok(())
    }

    /// Lets the lease live on.
    pub(super) fn renew(&mut self, mailbox: &Mailbox, now_nanos: i64) -> Result<(), PublishEnd> {
        self.check_lease(mailbox)?;
        if let Some(lease) = &mut self.lease {
            lease.expires_nanos = now_nanos.saturating_add(nanos(self.publisher_timeout));
        }
        Ok(())
    }

    fn check_lease(&self, mailbox: &Mailbox) -> Result<(), PublishEnd> {
        #[cfg(test)]
        if self.forgets_epochs {
            return Ok(());
        }
        match &self.lease {
            Some(lease) if lease.mailbox.epoch() == mailbox.epoch() => Ok(()),
            _ => Err(mailbox.ended().unwrap_or_else(|| self.lost())),
        }
    }

    /// A lease that is gone without a reason of its own was given to another, or the session closed.
    fn lost(&self) -> PublishEnd {
        let closed = self.closed.as_ref().map(Closed::publish_end);
        closed.unwrap_or(PublishEnd::Fenced {
            epoch: 0,
            current: self.newest_epoch,
        })
    }

    /// Gives the lease back at once. The mailbox is told when the publication's frames are done; `false`: no one will.
    pub(super) fn release(&mut self, mailbox: &Arc<Mailbox>) -> bool {
        if self.check_lease(mailbox).is_err() {
            return false;
        }
        self.lease = None;
        let told = self.check_room_for_a_command().is_ok();
        if told {
            let finish = Command::Finish(Arc::clone(mailbox));
            self.queue.push_command(finish);
        }
        told
    }

    /// Ends the lease of a publication whose frames cannot be solved; those that wait are given up where they are solved.
    pub(super) fn give_up(&mut self, mailbox: &Mailbox, end: PublishEnd) {
        mailbox.end(end);
        if self.check_lease(mailbox).is_ok() {
            self.lease = None;
        }
    }

    /// Refuses a frame that was taken before it could be seen to be unusable.
    pub(super) fn reject_taken(&mut self, mailbox: &Mailbox, rejection: Rejection) {
        self.counts.rejected += 1;
        mailbox.reject(rejection);
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

fn ended(mailbox: &Mailbox) -> PublishEnd {
    mailbox.ended().unwrap_or(PublishEnd::Ended)
}

fn rejection(number: u64, reason: &'static str, detail: String) -> Rejection {
    Rejection {
        number,
        reason,
        detail,
    }
}

#[cfg(test)]
mod model;
