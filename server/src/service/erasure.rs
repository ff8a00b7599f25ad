//! Erases a person: every session, take, revision and package of an actor, with a receipt (CONTRACTS U-12, S-13).

use frontalis_proto::v1;
use tonic::Status;

use super::{
    audit::{Audit, Entry},
    takes::Takes,
};
use crate::{
    catalogue::{CatalogueError, Store},
    clock::ServerClock,
    name::{ActorId, TakeId},
    session::SessionRegistry,
    wire::actor::timestamp,
};

/// Erases actors with all that is held of them. Cheap to clone.
#[derive(Clone)]
pub struct Erasure {
    /// Rows and packages.
    pub store: Store,
    /// Sessions that ended and can still be read.
    pub registry: SessionRegistry,
    /// Recordings.
    pub takes: Takes,
    /// For the time of the receipt.
    pub clock: ServerClock,
    /// Where it is written down.
    pub audit: Audit,
}

impl Erasure {
    /// Erases an actor whose sessions have ended, with its takes; what is returned says how much that was.
    ///
    /// # Errors
    ///
    /// `ACTOR`, `ACTOR_IN_USE`, `TAKE_RECOVERING` while files are looked at that may be of this actor, or that the storage
    /// failed; what is left is then erased within the hour, or at the next start.
    pub async fn actor(&self, id: &ActorId) -> Result<v1::ErasureReceipt, Status> {
        self.takes.check_in_order()?;
        Ok(self.erase(id).await?)
    }

    /// Every step can be done again after a crash.
    async fn erase(&self, id: &ActorId) -> Result<v1::ErasureReceipt, CatalogueError> {
        let doomed = self.store.doom_actor(id).await?;
        for session in &doomed.sessions {
            self.registry.remove(session);
        }
        let mut n_bytes = 0;
        for take in &doomed.takes {
            n_bytes += self.take(take, "ok").await?;
        }
        let erased = self.store.erase_actor(id).await?;
        self.store.scrub().await?;
        self.store.forget_actor(id).await?;
        let now_nanos = self.clock.now_nanos();
        let unix_nanos = now_nanos.saturating_add(self.clock.unix_offset_nanos());
        Ok(v1::ErasureReceipt {
            actor: id.resource(),
            erase_time: Some(timestamp(unix_nanos)),
            n_revisions: erased.n_revisions,
            n_sessions: erased.n_sessions,
            n_takes: doomed.takes.len() as u64,
            n_bytes: n_bytes + erased.n_bytes,
        })
    }

    /// Erases a doomed take, which is written down with this result.
    async fn take(&self, id: &TakeId, result: &str) -> Result<u64, CatalogueError> {
        let n_bytes = self.takes.erase(id).await?;
        let entry = Entry::of_server("take_erase", &id.resource(), result);
        self.audit.note(entry);
        Ok(n_bytes)
    }

    /// Goes on with what a crash or a failing disk left half erased. What still cannot be is named in the log.
    ///
    /// # Errors
    ///
    /// That the catalogue cannot be read.
    pub async fn finish(&self) -> Result<(), CatalogueError> {
        for id in self.store.doomed_actors().await? {
            match self.erase(&id).await {
                Ok(receipt) => {
                    let result = format!("finished: {}", in_words(&receipt));
                    let entry = Entry::of_server("actor_delete", &id.resource(), &result);
                    self.audit.note(entry);
                }
                Err(error) => {
                    let error = &error as &dyn std::error::Error;
                    tracing::error!(actor = %id, error, "an actor could not be erased yet");
                }
            }
        }
        for id in self.store.doomed_takes().await? {
            if let Err(error) = self.take(&id, "finished").await {
                let error = &error as &dyn std::error::Error;
                tracing::error!(take = %id, error, "a take could not be erased yet");
            }
        }
        self.store.scrub_log().await
    }

    /// Erases takes that are too old; returns how many.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn expired(&self, takes: &[TakeId]) -> Result<(), CatalogueError> {
        for id in takes {
            self.store.doom_take(id).await?;
            self.take(id, "ok: retention").await?;
        }
        self.store.scrub_log().await
    }
}

/// What a receipt says, for the audit log.
pub fn in_words(receipt: &v1::ErasureReceipt) -> String {
    format!(
        "{} revisions, {} sessions, {} takes, {} bytes",
        receipt.n_revisions, receipt.n_sessions, receipt.n_takes, receipt.n_bytes
    )
}
