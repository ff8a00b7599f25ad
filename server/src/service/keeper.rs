//! Writes what happens to sessions into the catalogue, and clears away what is no longer needed.
//!
//! The sessions' events come on a bounded channel: while the disk is slow, sessions wait with their next alignment, not
//! with their frames.

use std::{collections::VecDeque, time::Duration};

use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

use super::sessions::Sessions;
use crate::{
    catalogue::{CatalogueError, Store, StoredAlignment},
    clock::ServerClock,
    name::SessionId,
    session::{SessionEvent, SessionRegistry},
};

/// Events that may wait for the disk.
pub const EVENT_CAPACITY: usize = 256;

/// Ended sessions whose last samples can still be read; older ones are only listed.
const ENDED_IN_MEMORY: usize = 64;

/// Time between two collections.
const COLLECT_EVERY: Duration = Duration::from_mins(10);

/// The one task that writes the sessions' events.
pub struct Keeper {
    /// Where events are written.
    pub store: Store,
    /// From which ended sessions are removed.
    pub registry: SessionRegistry,
    /// For the time of an end.
    pub clock: ServerClock,
}

impl Keeper {
    /// Runs until `drained`, then writes what is left in the channel.
    pub async fn run(self, mut events: mpsc::Receiver<SessionEvent>, drained: CancellationToken) {
        let mut ended = VecDeque::new();
        loop {
            tokio::select! {
                biased;
                event = events.recv() => match event {
                    Some(event) => self.keep(event, &mut ended).await,
                    None => return,
                },
                () = drained.cancelled() => break,
            }
        }
        while let Ok(event) = events.try_recv() {
            self.keep(event, &mut ended).await;
        }
    }

    async fn keep(&self, event: SessionEvent, ended: &mut VecDeque<SessionId>) {
        let id = id_of(&event).clone();
        if let SessionEvent::Ended { .. } = event {
            ended.push_back(id.clone());
            if ended.len() > ENDED_IN_MEMORY {
                let oldest = ended.pop_front();
                // One that was created again under its id has not ended, and stays.
                if let Some(oldest) = oldest {
                    self.registry.remove(&oldest);
                }
            }
        }
        if let Err(error) = self.write(event).await {
            let error = &error as &dyn std::error::Error;
            tracing::error!(session = %id, error, "what happened to a session could not be stored");
        }
    }

    async fn write(&self, event: SessionEvent) -> Result<(), CatalogueError> {
        match event {
            SessionEvent::Aligned {
                id,
                run,
                alignment,
                shape,
                actor_revision,
            } => {
                let stored = StoredAlignment {
                    alignment: *alignment,
                    unit: shape.unit,
                    marker_names: shape.marker_names,
                    actor_revision,
                };
                self.store.put_alignment(&id, run, stored).await
            }
            SessionEvent::AlignmentForgotten { id, run } => {
                self.store.forget_alignment(&id, run).await
            }
            SessionEvent::Ended { id, run } => {
                let now = self
                    .clock
                    .now_nanos()
                    .saturating_add(self.clock.unix_offset_nanos());
                self.store.end_session(&id, run, now).await
            }
            SessionEvent::Failed { id, run, reason } => {
                tracing::error!(session = %id, run, %reason, "a session failed");
                Ok(())
            }
        }
    }
}

/// Collects old sessions now and then, until `drained`.
///
/// A task of its own: it waits for sessions to end, and they may wait for the [`Keeper`].
pub async fn collect(sessions: Sessions, retention: Duration, drained: CancellationToken) {
    let mut round = tokio::time::interval(COLLECT_EVERY);
    loop {
        tokio::select! {
            _ = round.tick() => {}
            () = drained.cancelled() => return,
        }
        match sessions.collect(retention).await {
            Ok(0) => {}
            Ok(n_sessions) => tracing::info!(n_sessions, "old sessions collected"),
            Err(error) => tracing::error!(
                error = &error as &dyn std::error::Error,
                "old sessions could not be collected"
            ),
        }
    }
}

fn id_of(event: &SessionEvent) -> &SessionId {
    match event {
        SessionEvent::Aligned { id, .. }
        | SessionEvent::AlignmentForgotten { id, .. }
        | SessionEvent::Ended { id, .. }
        | SessionEvent::Failed { id, .. } => id,
    }
}
