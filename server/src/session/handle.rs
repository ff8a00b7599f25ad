//! What the rest of the server holds of a session.

use std::{sync::Arc, time::SystemTime};

use frontalis_analysis::face::actor::Actor;

use super::{
    error::SessionError,
    publication::{Grant, Publication},
    settings::{SessionSettings, SessionUpdate},
    status::SessionStatus,
};
use crate::{
    hub::CurveHub,
    name::{ActorId, PublisherId, SessionId},
};

/// A session, to be asked and told. Cheap to clone.
#[derive(Clone)]
pub struct SessionHandle {
    _shared: Arc<()>,
}

#[expect(
    clippy::unused_async,
    clippy::missing_errors_doc,
    reason = "signatures first"
)]
impl SessionHandle {
    /// Its id.
    pub fn id(&self) -> &SessionId {
        unimplemented!()
    }
    /// A person's name for it.
    pub fn display_name(&self) -> &str {
        unimplemented!()
    }
    /// The actor's id.
    pub fn actor_id(&self) -> &ActorId {
        unimplemented!()
    }
    /// The actor in use.
    pub fn actor(&self) -> Arc<Actor> {
        unimplemented!()
    }
    /// Revision of the actor in use.
    pub fn actor_revision(&self) -> u32 {
        unimplemented!()
    }
    /// The settings in use.
    pub fn settings(&self) -> SessionSettings {
        unimplemented!()
    }
    /// When it was created.
    pub fn create_time(&self) -> SystemTime {
        unimplemented!()
    }
    /// The run.
    pub fn run(&self) -> u64 {
        unimplemented!()
    }
    /// The declared rate of the last publisher; 0 before the first.
    pub fn nominal_rate_hz(&self) -> f64 {
        unimplemented!()
    }
    /// Whether it ended.
    pub fn is_ended(&self) -> bool {
        unimplemented!()
    }
    /// Its figures.
    pub fn status(&self) -> SessionStatus {
        unimplemented!()
    }
    /// Where its samples leave.
    pub fn hub(&self) -> &Arc<CurveHub> {
        unimplemented!()
    }
    /// Changes settings or moves to another revision of the actor, between two frames; returns when it is done.
    pub async fn update(&self, _update: SessionUpdate) -> Result<(), SessionError> {
        unimplemented!()
    }
    /// Takes the next usable frames as the neutral face again.
    pub async fn recenter(&self) -> Result<(), SessionError> {
        unimplemented!()
    }
    /// Finishes the queue and ends the session; returns when it is done. Idempotent.
    pub async fn end(&self) -> Result<(), SessionError> {
        unimplemented!()
    }
    /// Whether a publisher may start now; asked before an epoch is made durable.
    pub fn check_claim(
        &self,
        _publisher: &PublisherId,
        _takeover: bool,
    ) -> Result<(), SessionError> {
        unimplemented!()
    }
    /// Gives the session to a publisher; an older publication ends.
    pub fn grant(&self, _grant: Grant) -> Result<Publication, SessionError> {
        unimplemented!()
    }
}
