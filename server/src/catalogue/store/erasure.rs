//! Recovery and erasure for async callers.

use std::collections::BTreeSet;

use super::{
    super::{Catalogue, CatalogueError, Doomed, ErasedActor, TakeRow},
    Store,
};
use crate::name::{ActorId, TakeId};

impl Store {
    /// As [`Catalogue::begin_recovery`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn begin_recovery(&self) -> Result<u64, CatalogueError> {
        self.commit(Catalogue::begin_recovery).await
    }

    /// As [`Catalogue::takes_to_recover`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn takes_to_recover(
        &self,
        after: String,
        limit: usize,
    ) -> Result<Vec<TakeRow>, CatalogueError> {
        self.commit(move |it| it.takes_to_recover(&after, limit))
            .await
    }

    /// As [`Catalogue::add_takes`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn add_takes(&self, new: Vec<TakeRow>) -> Result<(), CatalogueError> {
        self.commit(move |it| it.add_takes(&new)).await
    }

    /// As [`Catalogue::known_takes`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn known_takes(&self) -> Result<BTreeSet<TakeId>, CatalogueError> {
        self.commit(Catalogue::known_takes).await
    }

    /// As [`Catalogue::doom_actor`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn doom_actor(&self, id: &ActorId) -> Result<Doomed, CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.doom_actor(&id)).await
    }

    /// As [`Catalogue::doomed_actors`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn doomed_actors(&self) -> Result<Vec<ActorId>, CatalogueError> {
        self.commit(Catalogue::doomed_actors).await
    }

    /// As [`Catalogue::erase_actor`]; the actor is no longer kept loaded either.
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn erase_actor(&self, id: &ActorId) -> Result<ErasedActor, CatalogueError> {
        let doomed = id.clone();
        let erased = self.commit(move |it| it.erase_actor(&doomed)).await;
        self.cache.forget(id);
        erased
    }

    /// As [`Catalogue::forget_actor`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn forget_actor(&self, id: &ActorId) -> Result<(), CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.forget_actor(&id)).await
    }

    /// As [`Catalogue::scrub`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn scrub(&self) -> Result<(), CatalogueError> {
        self.commit(Catalogue::scrub).await
    }

    /// As [`Catalogue::scrub_log`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn scrub_log(&self) -> Result<(), CatalogueError> {
        self.commit(Catalogue::scrub_log).await
    }

    /// As [`Catalogue::takes_before`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn takes_before(
        &self,
        bounds: std::ops::Range<i64>,
    ) -> Result<Vec<TakeId>, CatalogueError> {
        self.commit(move |it| it.takes_before(&bounds)).await
    }

    /// As [`Catalogue::note_time`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn note_time(&self, now_nanos: i64) -> Result<(), CatalogueError> {
        self.commit(move |it| it.note_time(now_nanos)).await
    }

    /// As [`Catalogue::noted_time`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn noted_time(&self) -> Result<i64, CatalogueError> {
        self.commit(Catalogue::noted_time).await
    }
}
