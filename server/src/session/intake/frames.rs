//! Which frames a session takes, and what becomes of the others (CONTRACTS D-5 to D-11).

use super::{
    super::{
        clock_estimate::ClockExchange,
        frame::{IncomingFrame, Rejection},
        mailbox::Mailbox,
        order::Verdict,
        passed::Found,
        publication::{Ingest, Offer, PublishEnd, Wait},
        queue::WaitingFrame,
        rate::Admission,
    },
    Intake,
};
use crate::{
    clock::ServerClock,
    hub::{Gap, GapCause},
};

/// Unusable frames in a row that end a publication (CONTRACTS D-10).
pub(in crate::session) const MAX_CONSECUTIVE_REJECTS: u32 = 100;

impl Intake {
    /// Judges a frame and takes it when it is new and there is room.
    pub(in crate::session) fn offer(
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
    pub(in crate::session) fn offer_known(
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
    pub(in crate::session) fn refuse(
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

    /// Refuses a frame that was taken before it could be seen to be unusable.
    pub(in crate::session) fn reject_taken(&mut self, mailbox: &Mailbox, rejection: Rejection) {
        self.counts.rejected += 1;
        mailbox.reject(rejection);
    }

    /// Takes in an exchange with the publisher's clock.
    pub(in crate::session) fn exchange(
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
