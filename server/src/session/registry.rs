//! All sessions of a server.

use std::sync::Arc;

use tokio::sync::mpsc;

use super::{
    error::SessionError,
    handle::SessionHandle,
    settings::{SessionEvent, SessionLimits, SessionSpec},
};
use crate::{clock::ServerClock, name::SessionId};

/// All sessions of a server. Cheap to clone; clones share them.
#[derive(Clone)]
pub struct SessionRegistry {
    _shared: Arc<()>,
}

#[expect(
    clippy::unused_async,
    clippy::missing_errors_doc,
    reason = "signatures first"
)]
impl SessionRegistry {
    /// A registry without sessions. What happens to them is told on `events`.
    pub fn new(
        _limits: SessionLimits,
        _clock: ServerClock,
        _events: mpsc::Sender<SessionEvent>,
    ) -> Self {
        unimplemented!()
    }
    /// Starts a session; an ended one of the same id gives way.
    pub fn open(&self, _spec: SessionSpec) -> Result<SessionHandle, SessionError> {
        unimplemented!()
    }
    /// The session of this id, ended ones included.
    pub fn get(&self, _id: &SessionId) -> Result<SessionHandle, SessionError> {
        unimplemented!()
    }
    /// All sessions, by id.
    pub fn list(&self) -> Vec<SessionHandle> {
        unimplemented!()
    }
    /// Forgets an ended session; one that is not ended stays.
    pub fn remove(&self, _id: &SessionId) {
        unimplemented!()
    }
    /// Refuses new sessions, publishers and subscribers, finishes what is queued, closes every stream; returns when
    /// every session's task is done.
    pub async fn drain(&self) {
        unimplemented!()
    }
}
