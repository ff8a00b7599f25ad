//! All sessions of a server.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use tokio::sync::mpsc;
use tokio_util::{sync::CancellationToken, task::TaskTracker};
use tracing::Instrument as _;

use super::{
    error::SessionError,
    handle::SessionHandle,
    settings::{SessionEvent, SessionLimits, SessionSpec},
    shared::{Commons, Shared},
    worker,
};
use crate::{
    clock::ServerClock,
    hub::{BufferBudget, SubscriberQuota},
    name::SessionId,
};

/// All sessions of a server. Cheap to clone; clones share them.
#[derive(Clone, Debug)]
pub struct SessionRegistry {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    commons: Commons,
    tasks: TaskTracker,
    draining: CancellationToken,
    sessions: Mutex<Sessions>,
}

#[derive(Debug, Default)]
struct Sessions {
    by_id: BTreeMap<SessionId, SessionHandle>,
    is_draining: bool,
}

impl SessionRegistry {
    /// A registry without sessions. What happens to them is told on `events`, whose reader they may wait for.
    pub fn new(
        limits: SessionLimits,
        clock: ServerClock,
        events: mpsc::Sender<SessionEvent>,
    ) -> Self {
        let commons = Commons {
            budget: BufferBudget::new(limits.buffer_bytes),
            quota: SubscriberQuota::new(limits.subscribers),
            limits,
            clock,
            events,
        };
        Self {
            inner: Arc::new(Inner {
                commons,
                tasks: TaskTracker::new(),
                draining: CancellationToken::new(),
                sessions: Mutex::default(),
            }),
        }
    }

    /// Starts a session; an ended one of the same id gives way. Must be called on the runtime.
    ///
    /// # Errors
    ///
    /// [`SessionError::Exists`], [`SessionError::RegistryFull`], [`SessionError::Draining`].
    pub fn open(&self, spec: SessionSpec) -> Result<SessionHandle, SessionError> {
        let Inner { commons, tasks, .. } = &*self.inner;
        let mut sessions = self.sessions();
        sessions.check_room(&spec.id, commons.limits.sessions)?;
        let shared = Arc::new(Shared::new(&spec, commons));
        let handle = SessionHandle {
            shared: Arc::clone(&shared),
        };
        sessions.by_id.insert(spec.id.clone(), handle.clone());
        drop(sessions);
        let span = tracing::info_span!("session", id = %spec.id, actor = %spec.actor_id);
        tasks.spawn(worker::run(shared, spec).instrument(span));
        Ok(handle)
    }

    /// The session of this id, ended ones included.
    ///
    /// # Errors
    ///
    /// [`SessionError::NotFound`].
    pub fn get(&self, id: &SessionId) -> Result<SessionHandle, SessionError> {
        let sessions = self.sessions();
        sessions
            .by_id
            .get(id)
            .cloned()
            .ok_or(SessionError::NotFound)
    }

    /// All sessions, by id.
    pub fn list(&self) -> Vec<SessionHandle> {
        self.sessions().by_id.values().cloned().collect()
    }

    /// Forgets an ended session; one that is not ended stays.
    pub fn remove(&self, id: &SessionId) {
        let mut sessions = self.sessions();
        if sessions.by_id.get(id).is_some_and(SessionHandle::is_ended) {
            sessions.by_id.remove(id);
        }
    }

    /// Memory that waiting frames and kept samples of all sessions use now.
    pub fn buffered_bytes(&self) -> usize {
        self.inner.commons.budget.used_bytes()
    }

    /// Subscribers of all sessions now.
    pub fn n_subscribers(&self) -> usize {
        self.inner.commons.quota.n_subscribers()
    }

    /// Refuses new sessions and publishers, finishes what is queued, and closes every stream with `DRAINING`
    /// (CONTRACTS O-13); returns when every session's task is done.
    pub async fn drain(&self) {
        let handles: Vec<SessionHandle> = {
            let mut sessions = self.sessions();
            sessions.is_draining = true;
            sessions.by_id.values().cloned().collect()
        };
        self.inner.draining.cancel();
        handles.iter().for_each(SessionHandle::drain);
        self.inner.tasks.close();
        self.inner.tasks.wait().await;
    }

    /// Waits until [`Self::drain`] is called.
    pub async fn draining(&self) {
        self.inner.draining.cancelled().await;
    }

    fn sessions(&self) -> MutexGuard<'_, Sessions> {
        self.inner
            .sessions
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

impl Sessions {
    fn check_room(&self, id: &SessionId, limit: usize) -> Result<(), SessionError> {
        if self.is_draining {
            return Err(SessionError::Draining);
        }
        if self.by_id.get(id).is_some_and(|it| !it.is_ended()) {
            return Err(SessionError::Exists { id: id.clone() });
        }
        let n_open = self.by_id.values().filter(|it| !it.is_ended()).count();
        if n_open >= limit {
            return Err(SessionError::RegistryFull { limit });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
