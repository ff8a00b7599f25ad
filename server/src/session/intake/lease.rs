//! Who may publish into a session (CONTRACTS D-28 to D-30).

use std::{sync::Arc, time::Duration};

use super::{
    super::{
        clock_estimate::ClockEstimate,
        command::{Command, Source},
        error::SessionError,
        mailbox::Mailbox,
        publication::{Claim, Grant, Ingest, PublishEnd},
        recording::RecordedSource,
        settings::StreamShape,
    },
    Closed, Intake,
};
use crate::{clock::nanos, name::PublisherId};

/// A session changes hands by takeover at most this often (BAD_INPUT I10).
const TAKEOVER_EVERY: Duration = Duration::from_secs(1);

#[derive(Debug)]
pub(super) struct Lease {
    pub(super) owner: Owner,
    pub(super) mailbox: Arc<Mailbox>,
    pub(super) expires_nanos: i64,
    pub(super) ingest: Ingest,
    pub(super) n_rejects_in_a_row: u32,
    pub(super) waits_for_space: bool,
}

/// A publisher, and whose it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Owner {
    pub(super) publisher: PublisherId,
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

impl Intake {
    /// Whether a publisher may start now: as [`Self::check_claim`] says, and whoever pushes another out in turn.
    pub(in crate::session) fn admit(
        &mut self,
        claim: &Claim,
        now_nanos: i64,
    ) -> Result<(), SessionError> {
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
    pub(in crate::session) fn check_claim(
        &self,
        claim: &Claim,
        now_nanos: i64,
    ) -> Result<(), SessionError> {
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
    pub(in crate::session) fn grant(
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

    /// Lets the lease live on.
    pub(in crate::session) fn renew(
        &mut self,
        mailbox: &Mailbox,
        now_nanos: i64,
    ) -> Result<(), PublishEnd> {
        self.check_lease(mailbox)?;
        if let Some(lease) = &mut self.lease {
            lease.expires_nanos = now_nanos.saturating_add(nanos(self.publisher_timeout));
        }
        Ok(())
    }

    pub(super) fn check_lease(&self, mailbox: &Mailbox) -> Result<(), PublishEnd> {
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
    pub(super) fn lost(&self) -> PublishEnd {
        let closed = self.closed.as_ref().map(Closed::publish_end);
        closed.unwrap_or(PublishEnd::Fenced {
            epoch: 0,
            current: self.newest_epoch,
        })
    }

    /// Gives the lease back at once. The mailbox is told when the publication's frames are done; `false`: no one will.
    pub(in crate::session) fn release(&mut self, mailbox: &Arc<Mailbox>) -> bool {
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
    pub(in crate::session) fn give_up(&mut self, mailbox: &Mailbox, end: PublishEnd) {
        mailbox.end(end);
        if self.check_lease(mailbox).is_ok() {
            self.lease = None;
        }
    }
}
