//! Which actors a caller sees: an operator all of them, others those that the sessions in their scope use (CONTRACTS S-4).
//!
//! An actor that is not seen is answered like one that is not there.

use std::collections::BTreeSet;

use tonic::Status;

use super::ActorsGrpc;
use crate::{
    catalogue::{ActorRevision, CatalogueError},
    name::ActorId,
    service::access::{Action, Caller},
    wire::page::Page,
};

impl ActorsGrpc {
    /// Whether the caller may read this actor.
    pub(super) fn check_seen(&self, caller: &Caller, actor: &ActorId) -> Result<(), Status> {
        caller.may(Action::ReadActors)?;
        if caller.sees_all_actors() || self.seen(caller).contains(actor) {
            Ok(())
        } else {
            Err(CatalogueError::NoActor.into())
        }
    }

    /// As many actors as the page reads, of those that the caller sees.
    pub(super) async fn read_page(
        &self,
        caller: &Caller,
        page: &Page,
    ) -> Result<Vec<ActorRevision>, Status> {
        if caller.sees_all_actors() {
            let all = self.store.actors(page.after.clone(), page.n_to_read());
            return Ok(all.await?);
        }
        let seen = self.seen(caller).into_iter();
        let following = seen.filter(|it| it.as_str() > page.after.as_str());
        let mut found = Vec::new();
        for actor in following.take(page.n_to_read()) {
            found.push(self.store.actor(&actor).await?);
        }
        Ok(found)
    }

    /// The actors of the sessions in the caller's scope.
    fn seen(&self, caller: &Caller) -> BTreeSet<ActorId> {
        let sessions = self.registry.list().into_iter();
        sessions
            .filter(|it| caller.sees(it.id()))
            .map(|it| it.actor_id().clone())
            .collect()
    }
}
