//! Sessions as both doors see them: what runs in this process joined with what the catalogue keeps.
//!
//! What is acknowledged is in the catalogue first. Changes take turns, so that two of them never mix.

use std::{
    sync::Arc,
    time::{Duration, SystemTime},
};

use frontalis_analysis::analyzer::NeutralSource;
use frontalis_proto::v1;
use rand::{TryRng as _, rngs::SysRng};
use tokio::sync::Semaphore;
use tonic::Status;

use super::grpc::status::refuse;
use crate::{
    catalogue::{CatalogueError, NewSession, SessionRow, Store, StoredAlignment, StoredSettings},
    clock::ServerClock,
    name::{ActorId, SessionId},
    session::{
        RestoredAlignment, SessionError, SessionHandle, SessionRegistry, SessionSettings,
        SessionSpec, SessionUpdate, StreamShape,
    },
    wire::{
        page::Page,
        session::{CreateSession, check_objective, ended, from_stored, live, to_stored},
    },
};

/// Rows of the catalogue that are looked at together for a caller who sees few of them.
const ROWS_AT_ONCE: usize = 256;
/// Longest id (CONTRACTS S-6).
const MAX_MADE_ID_BYTES: usize = 63;

/// All sessions of a server. Cheap to clone.
#[derive(Clone)]
pub struct Sessions {
    store: Store,
    registry: SessionRegistry,
    clock: ServerClock,
    limit: usize,
    turn: Arc<Semaphore>,
}

/// Makes the settings that shall be of those in use.
pub type Settle = Box<dyn FnOnce(&SessionSettings) -> Result<SessionSettings, Status> + Send>;

/// What a session is changed to.
pub struct Change {
    /// Applied to the settings in use.
    pub settings: Settle,
    /// Another revision of its actor.
    pub actor_revision: Option<u32>,
}

impl Sessions {
    /// Joins `registry`, which takes at most `max_sessions`, with `store`.
    pub fn new(
        store: Store,
        registry: SessionRegistry,
        clock: ServerClock,
        max_sessions: usize,
    ) -> Self {
        Self {
            store,
            registry,
            clock,
            limit: max_sessions,
            turn: Arc::new(Semaphore::new(1)),
        }
    }

    /// Opens every session that had not ended when the last process did, each as a new run, with its alignment.
    ///
    /// A session that cannot be opened is logged and left in the catalogue; the others are not affected.
    ///
    /// # Errors
    ///
    /// That the catalogue failed.
    pub async fn restore(&self) -> Result<usize, CatalogueError> {
        let rows = self.store.begin_runs().await?;
        let mut n_restored = 0;
        for row in rows {
            let id = row.session.id.clone();
            match self.open(row).await {
                Ok(_) => n_restored += 1,
                Err(error) => {
                    tracing::error!(session = %id, %error, "a session could not be restored");
                }
            }
        }
        Ok(n_restored)
    }

    /// Creates a session of the newest revision of its actor.
    ///
    /// # Errors
    ///
    /// As it goes over the wire.
    pub async fn create(&self, request: CreateSession) -> Result<v1::Session, Status> {
        // Admission before work, and before a row is written that would have to go again.
        let n_open = self
            .registry
            .list()
            .iter()
            .filter(|it| !it.is_ended())
            .count();
        if n_open >= self.limit {
            let limit = self.limit;
            return Err(SessionError::RegistryFull { limit }.into());
        }
        let newest = self.store.actor(&request.actor).await?;
        let new = NewSession {
            id: request.id.map_or_else(|| made_id(""), Ok)?,
            display_name: request.display_name.into_string(),
            actor: request.actor,
            actor_revision: newest.revision,
            settings: to_stored(&request.settings),
        };
        // Before the turn: reading a package takes long, and nobody else should wait for it.
        let actor = self.store.load_actor(&new.actor, newest.revision).await?;
        check_objective(&request.settings, actor.muscle_set())?;
        let _turn = self.turn().await;
        let row = self
            .store
            .create_session(new, self.unix_now_nanos())
            .await?;
        let (id, run) = (row.session.id.clone(), row.run);
        match self.open(row).await {
            Ok(handle) => {
                tracing::info!(session = %id, run, actor = %handle.actor_id(), "session created");
                Ok(live(&handle))
            }
            Err(refused) => {
                self.store
                    .end_session(&id, run, self.unix_now_nanos())
                    .await?;
                Err(refused)
            }
        }
    }

    /// One session, ended ones included.
    ///
    /// # Errors
    ///
    /// `NOT_FOUND`, as it goes over the wire.
    pub async fn get(&self, id: &SessionId) -> Result<v1::Session, Status> {
        match self.registry.get(id) {
            Ok(handle) => Ok(live(&handle)),
            Err(_) => Ok(ended(&self.store.session(id).await?)),
        }
    }

    /// A page of the sessions that are seen, by id, and the token of the next.
    ///
    /// # Errors
    ///
    /// That the catalogue failed.
    pub async fn list(
        &self,
        page: &Page,
        is_seen: impl Fn(&SessionId) -> bool,
    ) -> Result<(Vec<v1::Session>, String), Status> {
        let mut rows = self.seen(page, is_seen).await?;
        let next = page.cut(&mut rows, |it| it.session.id.to_string());
        let view = |row: &SessionRow| match self.registry.get(&row.session.id) {
            Ok(handle) => live(&handle),
            Err(_) => ended(row),
        };
        Ok((rows.iter().map(view).collect(), next))
    }

    /// As many rows as the page reads, of those that are seen.
    async fn seen(
        &self,
        page: &Page,
        is_seen: impl Fn(&SessionId) -> bool,
    ) -> Result<Vec<SessionRow>, Status> {
        let n_wanted = page.n_to_read();
        let n_at_once = n_wanted.max(ROWS_AT_ONCE);
        let (mut seen, mut after) = (Vec::new(), page.after.clone());
        loop {
            let rows = self.store.sessions(after.clone(), n_at_once).await?;
            let is_last = rows.len() < n_at_once;
            if let Some(last) = rows.last() {
                after = last.session.id.to_string();
            }
            seen.extend(rows.into_iter().filter(|it| is_seen(&it.session.id)));
            if is_last || seen.len() >= n_wanted {
                seen.truncate(n_wanted);
                return Ok(seen);
            }
        }
    }

    /// Changes a session between two frames.
    ///
    /// # Errors
    ///
    /// As it goes over the wire; then nothing has changed.
    pub async fn update(&self, id: &SessionId, change: Change) -> Result<v1::Session, Status> {
        let _turn = self.turn().await;
        let handle = self.handle(id).await?;
        handle.check_open()?;
        let settings = (change.settings)(&handle.settings())?;
        let revision = change
            .actor_revision
            .unwrap_or_else(|| handle.actor_revision());
        let actor = match change.actor_revision {
            Some(_) => Some((
                self.store.load_actor(handle.actor_id(), revision).await?,
                revision,
            )),
            None => None,
        };
        match &actor {
            Some((actor, _)) => check_objective(&settings, actor.muscle_set())?,
            None => check_objective(&settings, handle.actor().muscle_set())?,
        }
        let before = (to_stored(&handle.settings()), handle.actor_revision());
        self.store
            .update_session(id, to_stored(&settings), revision)
            .await?;
        let update = SessionUpdate {
            settings: Some(settings),
            actor,
        };
        if let Err(refused) = handle.update(update).await {
            self.put_back(id, before).await;
            return Err(refused.into());
        }
        tracing::info!(session = %id, actor_revision = revision, "session updated");
        Ok(live(&handle))
    }

    /// The session did not change, so what the catalogue says of it must not either.
    async fn put_back(&self, id: &SessionId, (settings, revision): (StoredSettings, u32)) {
        let put_back = self.store.update_session(id, settings, revision).await;
        if let Err(error) = put_back {
            let error = &error as &dyn std::error::Error;
            tracing::error!(session = %id, error, "the settings of a session could not be put back");
        }
    }

    /// Takes another neutral face: the next usable frames, or the quietest that were seen.
    ///
    /// # Errors
    ///
    /// As it goes over the wire.
    pub async fn recenter(
        &self,
        id: &SessionId,
        source: NeutralSource,
    ) -> Result<v1::Session, Status> {
        let handle = self.handle(id).await?;
        handle.recenter(source).await?;
        tracing::info!(session = %id, "session recentered");
        Ok(live(&handle))
    }

    /// Ends a session once its queue is done. One that has ended stays so.
    ///
    /// # Errors
    ///
    /// As it goes over the wire.
    pub async fn end(&self, id: &SessionId) -> Result<v1::Session, Status> {
        let _turn = self.turn().await;
        let Ok(handle) = self.registry.get(id) else {
            let row = self.store.session(id).await?;
            self.store
                .end_session(id, row.run, self.unix_now_nanos())
                .await?;
            return Ok(ended(&row));
        };
        handle.end().await;
        self.store
            .end_session(id, handle.run(), self.unix_now_nanos())
            .await?;
        tracing::info!(session = %id, run = handle.run(), "session ended");
        Ok(live(&handle))
    }

    /// Removes what ended longer than `retention` ago and what was never used for so long.
    ///
    /// # Errors
    ///
    /// That the catalogue failed.
    pub async fn collect(&self, retention: Duration) -> Result<usize, CatalogueError> {
        let _turn = self.turn().await;
        let before = self
            .unix_now_nanos()
            .saturating_sub(crate::clock::nanos(retention));
        let ids = self.store.collect_sessions(before).await?;
        for id in &ids {
            if let Ok(handle) = self.registry.get(id) {
                handle.end().await;
                self.registry.remove(id);
            }
        }
        Ok(ids.len())
    }

    /// The session in this process; one that is only in the catalogue has ended.
    ///
    /// # Errors
    ///
    /// `NOT_FOUND`, or `FAILED_PRECONDITION SESSION_ENDED`, as it goes over the wire.
    pub async fn handle(&self, id: &SessionId) -> Result<SessionHandle, Status> {
        in_process(&self.registry, &self.store, id).await
    }

    /// Every session of this process.
    pub fn handles(&self) -> Vec<SessionHandle> {
        self.registry.list()
    }

    async fn turn(&self) -> tokio::sync::SemaphorePermit<'_> {
        self.turn
            .acquire()
            .await
            .expect("invariant: the semaphore is never closed")
    }

    fn unix_now_nanos(&self) -> i64 {
        self.clock
            .now_nanos()
            .saturating_add(self.clock.unix_offset_nanos())
    }

    /// Starts a session from its row.
    ///
    /// An alignment that was found with another revision starts with that one and moves, as it would have done.
    async fn open(&self, row: SessionRow) -> Result<SessionHandle, Status> {
        let wanted = row.session.actor_revision;
        let aligned = row
            .alignment
            .as_ref()
            .map_or(wanted, |it| it.actor_revision);
        let actor_id = row.session.actor.clone();
        let actor = self.store.load_actor(&actor_id, aligned).await?;
        let spec = spec(row, actor, aligned);
        let handle = self.registry.open(spec)?;
        if aligned != wanted {
            self.move_to(&handle, &actor_id, wanted).await?;
        }
        Ok(handle)
    }

    async fn move_to(
        &self,
        handle: &SessionHandle,
        actor: &ActorId,
        revision: u32,
    ) -> Result<(), Status> {
        let actor = self.store.load_actor(actor, revision).await?;
        let update = SessionUpdate {
            settings: None,
            actor: Some((actor, revision)),
        };
        Ok(handle.update(update).await?)
    }
}

/// What [`Sessions::handle`] does, for the services that hold registry and store themselves.
pub(super) async fn in_process(
    registry: &SessionRegistry,
    store: &Store,
    id: &SessionId,
) -> Result<SessionHandle, Status> {
    if let Ok(handle) = registry.get(id) {
        return Ok(handle);
    }
    store.session(id).await?;
    Err(SessionError::Forgotten.into())
}

fn spec(
    row: SessionRow,
    actor: Arc<frontalis_analysis::face::actor::Actor>,
    actor_revision: u32,
) -> SessionSpec {
    let since_epoch = Duration::from_nanos(u64::try_from(row.create_time_nanos).unwrap_or(0));
    SessionSpec {
        id: row.session.id,
        display_name: row.session.display_name,
        actor_id: row.session.actor,
        actor,
        actor_revision,
        settings: from_stored(&row.session.settings),
        run: row.run,
        create_time: SystemTime::UNIX_EPOCH + since_epoch,
        restored: row.alignment.map(restored),
    }
}

fn restored(stored: StoredAlignment) -> RestoredAlignment {
    RestoredAlignment {
        alignment: stored.alignment,
        shape: StreamShape {
            unit: stored.unit,
            marker_names: stored.marker_names,
        },
    }
}

/// An id that nobody chose: 64 random bits after the prefix, as many of them as fit.
pub(super) fn made_id(prefix: &str) -> Result<SessionId, Status> {
    let unavailable = || {
        refuse(
            tonic::Code::Internal,
            "ENTROPY",
            "no random number could be had",
        )
    };
    let number = SysRng.try_next_u64().map_err(|_| unavailable())?;
    let prefix = if prefix.is_empty() { "s-" } else { prefix };
    let mut id = format!("{prefix}{number:016x}");
    id.truncate(MAX_MADE_ID_BYTES);
    SessionId::parse(&id).map_err(|_| unavailable())
}
