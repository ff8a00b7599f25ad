//! The catalogue for async callers: each call runs on a worker, so that no commit holds up the runtime.

mod erasure;

use std::sync::{Arc, Mutex, PoisonError};

use frontalis_analysis::{
    face::actor::{Actor, RankPolicy},
    format::actor_package,
};

use super::{
    ActorRevision, Catalogue, CatalogueError, NewRevision, NewSession, SessionRow, StoredAlignment,
    StoredSettings, TakeFilter, TakeLabels, TakeRow,
};
use crate::{
    executor::Workers,
    name::{ActorId, SessionId, TakeId},
};

/// Catalogue, workers and the actors that were loaded last. Cheap to clone; clones share all of it.
#[derive(Clone, Debug)]
pub struct Store {
    catalogue: Arc<Catalogue>,
    /// Commits; apart from `heavy`, so that a long import does not hold up a lease.
    commits: Workers,
    /// Reading whole packages.
    heavy: Workers,
    cache: Arc<ActorCache>,
}

/// Why an actor could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum ActorLoadError {
    /// The catalogue could not give the package.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The stored package is no longer accepted.
    #[error("the stored package of actor {actor} revision {revision} is refused: {reason}")]
    Package {
        /// The actor.
        actor: ActorId,
        /// The revision.
        revision: u32,
        /// What the reader says.
        reason: String,
    },
}

impl Store {
    /// A store over `catalogue` that keeps at most `max_cached_actors` actors loaded besides those in use.
    pub fn new(
        catalogue: Catalogue,
        commits: Workers,
        heavy: Workers,
        max_cached_actors: usize,
    ) -> Self {
        Self {
            catalogue: Arc::new(catalogue),
            commits,
            heavy,
            cache: Arc::new(ActorCache::new(max_cached_actors)),
        }
    }

    /// As [`Catalogue::next_epoch`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn next_epoch(&self, session: &SessionId) -> Result<u64, CatalogueError> {
        let id = session.clone();
        self.commit(move |it| it.next_epoch(&id)).await
    }

    /// As [`Catalogue::put_alignment`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn put_alignment(
        &self,
        session: &SessionId,
        run: u64,
        alignment: StoredAlignment,
    ) -> Result<(), CatalogueError> {
        let id = session.clone();
        self.commit(move |it| it.put_alignment(&id, run, &alignment))
            .await
    }

    /// As [`Catalogue::forget_alignment`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn forget_alignment(
        &self,
        session: &SessionId,
        run: u64,
    ) -> Result<(), CatalogueError> {
        let id = session.clone();
        self.commit(move |it| it.forget_alignment(&id, run)).await
    }

    /// As [`Catalogue::create_session`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn create_session(
        &self,
        new: NewSession,
        now_nanos: i64,
    ) -> Result<SessionRow, CatalogueError> {
        self.commit(move |it| it.create_session(&new, now_nanos))
            .await
    }

    /// As [`Catalogue::session`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn session(&self, session: &SessionId) -> Result<SessionRow, CatalogueError> {
        let id = session.clone();
        self.commit(move |it| it.session(&id)).await
    }

    /// As [`Catalogue::sessions`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn sessions(
        &self,
        after: String,
        limit: usize,
    ) -> Result<Vec<SessionRow>, CatalogueError> {
        self.commit(move |it| it.sessions(&after, limit)).await
    }

    /// As [`Catalogue::begin_runs`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn begin_runs(&self) -> Result<Vec<SessionRow>, CatalogueError> {
        self.commit(Catalogue::begin_runs).await
    }

    /// As [`Catalogue::update_session`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn update_session(
        &self,
        session: &SessionId,
        settings: StoredSettings,
        actor_revision: u32,
    ) -> Result<(), CatalogueError> {
        let id = session.clone();
        self.commit(move |it| it.update_session(&id, &settings, actor_revision))
            .await
    }

    /// As [`Catalogue::end_session`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn end_session(
        &self,
        session: &SessionId,
        run: u64,
        now_nanos: i64,
    ) -> Result<(), CatalogueError> {
        let id = session.clone();
        self.commit(move |it| it.end_session(&id, run, now_nanos))
            .await
    }

    /// As [`Catalogue::collect_sessions`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn collect_sessions(
        &self,
        before_nanos: i64,
    ) -> Result<Vec<SessionId>, CatalogueError> {
        self.commit(move |it| it.collect_sessions(before_nanos))
            .await
    }

    /// As [`Catalogue::add_revision`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn add_revision(
        &self,
        new: NewRevision,
        now_nanos: i64,
    ) -> Result<ActorRevision, CatalogueError> {
        self.commit(move |it| it.add_revision(&new, now_nanos))
            .await
    }

    /// As [`Catalogue::actor`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn actor(&self, actor: &ActorId) -> Result<ActorRevision, CatalogueError> {
        let id = actor.clone();
        self.commit(move |it| it.actor(&id)).await
    }

    /// As [`Catalogue::actors`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn actors(
        &self,
        after: String,
        limit: usize,
    ) -> Result<Vec<ActorRevision>, CatalogueError> {
        self.commit(move |it| it.actors(&after, limit)).await
    }

    /// The bytes of [`Catalogue::package`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn package(&self, actor: &ActorId, revision: u32) -> Result<Vec<u8>, CatalogueError> {
        let (id, catalogue) = (actor.clone(), Arc::clone(&self.catalogue));
        let package = self
            .heavy
            .run(move || catalogue.package(&id, revision))
            .await?;
        Ok(package.0)
    }

    /// As [`Catalogue::delete_actor`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn delete_actor(&self, actor: &ActorId) -> Result<(), CatalogueError> {
        let id = actor.clone();
        self.commit(move |it| it.delete_actor(&id)).await?;
        self.cache.forget(actor);
        Ok(())
    }

    /// The actor of a revision, ready for the analysis: from the cache, or read from its package.
    ///
    /// # Errors
    ///
    /// [`ActorLoadError`].
    pub async fn load_actor(
        &self,
        actor: &ActorId,
        revision: u32,
    ) -> Result<Arc<Actor>, ActorLoadError> {
        if let Some(cached) = self.cache.get(actor, revision) {
            return Ok(cached);
        }
        let (id, catalogue) = (actor.clone(), Arc::clone(&self.catalogue));
        let loaded = self
            .heavy
            .run(move || load(&catalogue, &id, revision))
            .await?;
        self.cache.put(actor, revision, &loaded);
        Ok(loaded)
    }

    /// Keeps an actor that was just imported, so that it need not be read again.
    pub fn keep_loaded(&self, actor: &ActorId, revision: u32, loaded: &Arc<Actor>) {
        self.cache.put(actor, revision, loaded);
    }

    /// As [`Catalogue::add_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn add_take(&self, new: TakeRow) -> Result<TakeRow, CatalogueError> {
        self.commit(move |it| it.add_take(&new)).await
    }

    /// As [`Catalogue::claim_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn claim_take(&self, id: &TakeId) -> Result<(), CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.claim_take(&id)).await
    }

    /// As [`Catalogue::add_claimed_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn add_claimed_take(&self, new: TakeRow) -> Result<TakeRow, CatalogueError> {
        self.commit(move |it| it.add_claimed_take(&new)).await
    }

    /// As [`Catalogue::take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn take(&self, id: &TakeId) -> Result<TakeRow, CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.take(&id)).await
    }

    /// As [`Catalogue::takes`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn takes(
        &self,
        filter: TakeFilter,
        after: String,
        limit: usize,
    ) -> Result<Vec<TakeRow>, CatalogueError> {
        self.commit(move |it| it.takes(&filter, &after, limit))
            .await
    }

    /// As [`Catalogue::label_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn label_take(
        &self,
        id: &TakeId,
        labels: TakeLabels,
    ) -> Result<TakeRow, CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.label_take(&id, &labels)).await
    }

    /// As [`Catalogue::end_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn end_take(&self, ended: TakeRow) -> Result<TakeRow, CatalogueError> {
        self.commit(move |it| it.end_take(&ended)).await
    }

    /// As [`Catalogue::doom_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn doom_take(&self, id: &TakeId) -> Result<(), CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.doom_take(&id)).await
    }

    /// As [`Catalogue::doomed_takes`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn doomed_takes(&self) -> Result<Vec<TakeId>, CatalogueError> {
        self.commit(Catalogue::doomed_takes).await
    }

    /// As [`Catalogue::forget_take`].
    ///
    /// # Errors
    ///
    /// As there.
    pub async fn forget_take(&self, id: &TakeId) -> Result<(), CatalogueError> {
        let id = id.clone();
        self.commit(move |it| it.forget_take(&id)).await
    }

    async fn commit<T, F>(&self, call: F) -> Result<T, CatalogueError>
    where
        T: Send + 'static,
        F: FnOnce(&Catalogue) -> Result<T, CatalogueError> + Send + 'static,
    {
        let catalogue = Arc::clone(&self.catalogue);
        self.commits.run(move || call(&catalogue)).await
    }
}

fn load(catalogue: &Catalogue, id: &ActorId, revision: u32) -> Result<Arc<Actor>, ActorLoadError> {
    let (package, regularized) = catalogue.package(id, revision)?;
    let rank = if regularized {
        RankPolicy::Regularize
    } else {
        RankPolicy::Refuse
    };
    let read = actor_package::read(&package, rank).map_err(|error| ActorLoadError::Package {
        actor: id.clone(),
        revision,
        reason: error.to_string(),
    })?;
    Ok(Arc::new(read.actor))
}

/// The actors that were asked for last, newest at the end.
#[derive(Debug)]
struct ActorCache {
    capacity: usize,
    entries: Mutex<Vec<(ActorId, u32, Arc<Actor>)>>,
}

impl ActorCache {
    fn new(capacity: usize) -> Self {
        Self {
            capacity: capacity.max(1),
            entries: Mutex::new(Vec::new()),
        }
    }

    fn get(&self, actor: &ActorId, revision: u32) -> Option<Arc<Actor>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let place = entries
            .iter()
            .position(|it| it.0 == *actor && it.1 == revision)?;
        let entry = entries.remove(place);
        let found = Arc::clone(&entry.2);
        entries.push(entry);
        Some(found)
    }

    fn put(&self, actor: &ActorId, revision: u32, loaded: &Arc<Actor>) {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        entries.retain(|it| it.0 != *actor || it.1 != revision);
        if entries.len() == self.capacity {
            entries.remove(0);
        }
        entries.push((actor.clone(), revision, Arc::clone(loaded)));
    }

    fn forget(&self, actor: &ActorId) {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        entries.retain(|it| it.0 != *actor);
    }
}
