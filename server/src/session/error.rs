//! Why a session does not do what it was asked.

use std::time::Duration;

use frontalis_analysis::analyzer::QuietestError;

use crate::name::SessionId;

/// Refusals of sessions and of their registry.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SessionError {
    /// There is no such session.
    #[error("there is no session of this name")]
    NotFound,
    /// The id is in use.
    #[error("session {id} exists")]
    Exists {
        /// The id.
        id: SessionId,
    },
    /// The server has all the sessions it may have.
    #[error("the server has {limit} sessions, the most it may have")]
    RegistryFull {
        /// The limit.
        limit: usize,
    },
    /// Another publisher owns the session.
    #[error("publisher {owner} owns the session; it is free {} ms after the owner falls silent", free_after.as_millis())]
    Owned {
        /// The owner.
        owner: String,
        /// How much longer the lease lives if the owner stays silent.
        free_after: Duration,
    },
    /// Another principal's publisher owns the session.
    #[error("a publisher of another principal owns the session; an operator may take it over")]
    OwnedByAnother,
    /// The session was taken over a moment ago.
    #[error("the session was taken over less than a second ago; it may be again in {} ms", retry_after.as_millis())]
    TakeoverRate {
        /// When it may be again.
        retry_after: Duration,
    },
    /// Another grant came first.
    #[error("epoch {epoch} is older than the session's epoch {current}")]
    Fenced {
        /// The epoch that was to be granted.
        epoch: u64,
        /// The epoch in force.
        current: u64,
    },
    /// None of the publisher's markers is one of the actor's.
    #[error("none of the {n_streamed} streamed markers is one of the actor's {n_known}")]
    UnknownMarkers {
        /// How many were named.
        n_streamed: usize,
        /// How many the actor has.
        n_known: usize,
    },
    /// The quietest frames cannot be taken as the neutral face.
    #[error(transparent)]
    Quietest(#[from] QuietestError),
    /// Too many requests wait for the session.
    #[error("{limit} requests wait for the session, the most that may")]
    Busy {
        /// The limit.
        limit: usize,
    },
    /// The session ended.
    #[error("the session ended")]
    Ended,
    /// The session ended, and only the catalogue knows of it.
    #[error("the session ended; its samples are no longer kept")]
    Forgotten,
    /// The session is broken.
    #[error("the session failed: {reason}")]
    Failed {
        /// Why.
        reason: String,
    },
    /// The server shuts down.
    #[error("the server is shutting down")]
    Draining,
}
