//! A publisher's hold on a session: frames in, watermarks out.

use std::sync::Arc;

use frontalis_analysis::{marker_analysis::alignment::AlignmentError, space::LengthUnit};

use super::{
    clock_estimate::ClockExchange,
    frame::{IncomingFrame, Rejection},
    mailbox::Mailbox,
    settings::StreamShape,
    shared::Shared,
};
use crate::name::{PublisherId, SessionId};

/// What happens when frames come faster than they are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ingest {
    /// Newest matters: the oldest waiting frame is shed.
    Live,
    /// Every frame matters: the publisher waits.
    Lossless,
}

/// Who wants to publish (CONTRACTS D-28).
#[derive(Clone, Debug)]
pub struct Claim {
    /// What it calls itself; the same name of another principal is another publisher.
    pub publisher: PublisherId,
    /// Tells principals apart.
    pub principal: Arc<str>,
    /// Whether it wants to push another publisher out.
    pub takeover: bool,
    /// Whether it may push out one of another principal.
    pub outranks: bool,
}

/// What a publisher asks for.
#[derive(Clone, Debug)]
pub struct Grant {
    /// Who asks.
    pub claim: Claim,
    /// The grant's number, durable before it is used here.
    pub epoch: u64,
    /// Unit of the coordinates.
    pub unit: LengthUnit,
    /// Markers in the order of the coordinates; empty: the actor's own order.
    pub marker_names: Vec<String>,
    /// What happens when the session cannot keep up.
    pub ingest: Ingest,
    /// Declared rate: finite, positive.
    pub rate_hz: f64,
}

/// What a publisher was given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Granted {
    /// Number of the grant.
    pub epoch: u64,
    /// First number that the session does not have; 0 in a run without frames.
    pub next_expected: u64,
    /// The run.
    pub run: u64,
    /// Shape of the stream, with the names filled in.
    pub shape: StreamShape,
}

/// What became of a frame that was offered.
#[derive(Debug)]
pub enum Offer {
    /// Taken, now or in an earlier send of the same frame.
    Taken,
    /// Not used.
    Rejected(Rejection),
    /// Not taken yet: wait, then offer it again.
    Wait(IncomingFrame, Wait),
    /// Its number was passed too long ago to know of it here: it is to be [settled](Publication::settle) by what the take has
    /// under that number.
    Unsure(IncomingFrame),
}

/// What an offer waits for.
#[derive(Clone, Copy, Debug)]
pub enum Wait {
    /// Room in the queue.
    Space,
    /// The session's rate limit.
    Until(tokio::time::Instant),
}

/// Why a publication ended before its publisher ended it.
#[derive(Clone, Debug, PartialEq)]
pub enum PublishEnd {
    /// A newer grant took the session.
    Fenced {
        /// The grant that was lost.
        epoch: u64,
        /// The grant in force.
        current: u64,
    },
    /// The neutral face could not be aligned.
    NotAligned(AlignmentError),
    /// Too many frames in a row could not be used.
    TooManyRejects {
        /// How many.
        n_rejects: u32,
    },
    /// The session ended.
    Ended,
    /// The session broke.
    Failed {
        /// Why.
        reason: String,
    },
    /// The server shuts down.
    Draining,
}

/// How far a publisher's frames got. Neither number falls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Watermarks {
    /// Every usable frame up to here was taken.
    pub accepted_through: u64,
    /// Every usable frame up to here is on stable storage; 0 while nothing is recorded.
    pub durable_through: u64,
    /// Frames taken but not solved.
    pub shed_frames: u64,
    /// Whether frames are recorded now.
    pub is_recorded: bool,
}

/// A publisher's hold on a session. Dropping it keeps the lease until it times out; [`Self::release`] gives it back.
#[derive(Debug)]
pub struct Publication {
    pub(super) session: Arc<Shared>,
    pub(super) mailbox: Arc<Mailbox>,
    pub(super) granted: Granted,
}

impl Publication {
    /// What the publisher was given.
    pub fn granted(&self) -> &Granted {
        &self.granted
    }

    /// Offers a valid frame.
    ///
    /// # Errors
    ///
    /// [`PublishEnd`] when the publication is over.
    pub fn offer(&self, frame: IncomingFrame) -> Result<Offer, PublishEnd> {
        self.check()?;
        let session = &self.session;
        let now_nanos = session.clock.now_nanos();
        let mut intake = session.intake();
        let offer = intake.offer(&self.mailbox, frame, &session.clock, now_nanos)?;
        drop(intake);
        if matches!(offer, Offer::Taken) {
            session.hub.frame_received(now_nanos);
            session.work.notify_one();
        }
        Ok(offer)
    }

    /// Judges a frame again that was [`Offer::Unsure`]; `in_take` is the hash of the content that the session's take has under
    /// its number, if it has any (CONTRACTS D-6a).
    ///
    /// # Errors
    ///
    /// [`PublishEnd`] when the publication is over, by this frame or before.
    pub fn settle(&self, frame: &IncomingFrame, in_take: Option<u64>) -> Result<Offer, PublishEnd> {
        self.check()?;
        let now_nanos = self.session.clock.now_nanos();
        let mut intake = self.session.intake();
        intake.offer_known(&self.mailbox, frame, in_take, now_nanos)
    }

    /// The session that is published into.
    pub fn session(&self) -> &SessionId {
        &self.session.id
    }

    /// Counts a frame that is not valid in itself.
    ///
    /// # Errors
    ///
    /// [`PublishEnd`] when the publication is over, by this frame or before.
    pub fn refuse(&self, rejection: Rejection) -> Result<Offer, PublishEnd> {
        self.check()?;
        self.session.intake().refuse(&self.mailbox, rejection)
    }

    /// Notes a sign of life.
    ///
    /// # Errors
    ///
    /// [`PublishEnd`] when the publication is over.
    pub fn keep_alive(&self) -> Result<(), PublishEnd> {
        self.check()?;
        let now_nanos = self.session.clock.now_nanos();
        self.session.intake().renew(&self.mailbox, now_nanos)
    }

    /// Takes in an exchange with the publisher's clock.
    ///
    /// # Errors
    ///
    /// [`PublishEnd`] when the publication is over.
    pub fn exchange(&self, exchange: ClockExchange) -> Result<(), PublishEnd> {
        self.check()?;
        self.session.intake().exchange(&self.mailbox, exchange)
    }

    /// Whether the publication is still in force.
    ///
    /// # Errors
    ///
    /// [`PublishEnd`] when it is over.
    pub fn check(&self) -> Result<(), PublishEnd> {
        self.mailbox.ended().map_or(Ok(()), Err)
    }

    /// How far the session got.
    pub fn watermarks(&self) -> Watermarks {
        let intake = self.session.intake();
        Watermarks {
            accepted_through: intake.accepted_through(),
            durable_through: intake.durable_through(),
            is_recorded: intake.is_recorded(),
            shed_frames: intake.counts().shed,
        }
    }

    /// Frames of this publication that turned out unusable after they were taken.
    pub fn take_rejections(&self) -> Vec<Rejection> {
        self.mailbox.take_rejections()
    }

    /// Gives the session back at once, for another publisher. The frames taken so far are still solved;
    /// [`Self::is_finished`] says when.
    pub fn release(&self) {
        if !self.session.intake().release(&self.mailbox) {
            self.mailbox.finish();
        }
        self.session.work.notify_one();
    }

    /// Whether all frames of a released publication are done, and on stable storage where they are recorded.
    pub fn is_finished(&self) -> bool {
        let is_safe = |it: Watermarks| !it.is_recorded || it.durable_through >= it.accepted_through;
        self.mailbox.is_finished() && is_safe(self.watermarks())
    }

    /// Waits until there may be news: room, a rejection, the end. Nothing is lost when the future is dropped.
    pub async fn woken(&self) {
        self.mailbox.woken().await;
    }
}
