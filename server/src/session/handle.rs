//! What the rest of the server holds of a session.

use std::{
    collections::BTreeSet,
    sync::Arc,
    time::{Duration, SystemTime},
};

use frontalis_analysis::{analyzer::NeutralSource, face::actor::Actor};
use tokio::sync::oneshot;

use super::{
    command::Command,
    error::SessionError,
    intake::Closed,
    publication::{Claim, Grant, Granted, Publication},
    recording::RecordingFeed,
    settings::{SessionSettings, SessionUpdate, StreamShape},
    shared::Shared,
    status::{SessionStatus, StageLatency},
};
use crate::{
    hub::CurveHub,
    name::{ActorId, SessionId},
};

/// A session, to be asked and told. Cheap to clone.
#[derive(Clone, Debug)]
pub struct SessionHandle {
    pub(super) shared: Arc<Shared>,
}

impl SessionHandle {
    /// Its id.
    pub fn id(&self) -> &SessionId {
        &self.shared.id
    }

    /// A person's name for it.
    pub fn display_name(&self) -> &str {
        &self.shared.display_name
    }

    /// The actor's id.
    pub fn actor_id(&self) -> &ActorId {
        &self.shared.actor_id
    }

    /// The actor in use.
    pub fn actor(&self) -> Arc<Actor> {
        Arc::clone(&self.shared.figures().actor)
    }

    /// Revision of the actor in use.
    pub fn actor_revision(&self) -> u32 {
        self.shared.figures().actor_revision
    }

    /// The settings in use.
    pub fn settings(&self) -> SessionSettings {
        self.shared.figures().settings.clone()
    }

    /// When it was created.
    pub fn create_time(&self) -> SystemTime {
        self.shared.create_time
    }

    /// The run.
    pub fn run(&self) -> u64 {
        self.shared.run
    }

    /// The rate that the last publisher declared; 0 before the first.
    pub fn nominal_rate_hz(&self) -> f64 {
        self.shared.figures().nominal_rate_hz
    }

    /// Whether it ended, or is about to.
    pub fn is_ended(&self) -> bool {
        matches!(self.shared.intake().closed(), Some(Closed::Ended))
    }

    /// Where its samples leave.
    pub fn hub(&self) -> &Arc<CurveHub> {
        &self.shared.hub
    }

    /// Its figures at this moment.
    pub fn status(&self) -> SessionStatus {
        let shared = &self.shared;
        let mut status = SessionStatus {
            state: shared.hub.state(),
            run: shared.run,
            last_sequence: shared.hub.newest_sequence(),
            subscribers: shared.hub.subscribers(),
            ..SessionStatus::default()
        };
        shared.figures().fill(&mut status);
        status.latencies.push(StageLatency {
            stage: "sent",
            latency: shared.hub.sent_latency(),
        });
        let now_nanos = shared.clock.now_nanos();
        shared.intake().fill(&mut status, now_nanos);
        status
    }

    /// Whether it takes requests.
    ///
    /// # Errors
    ///
    /// Why it does not: it ended, failed, or the server drains.
    pub fn check_open(&self) -> Result<(), SessionError> {
        self.shared.intake().check_open()
    }

    /// Changes settings or moves to another revision of the actor, between two frames; returns when it is done.
    ///
    /// # Errors
    ///
    /// [`SessionError`] when the session takes no requests any more, or too many wait.
    pub async fn update(&self, update: SessionUpdate) -> Result<(), SessionError> {
        let (done, is_done) = oneshot::channel();
        let (settings, actor, actor_revision) = {
            let figures = self.shared.figures();
            let settings = update.settings.unwrap_or_else(|| figures.settings.clone());
            let present = (Arc::clone(&figures.actor), figures.actor_revision);
            let (actor, actor_revision) = update.actor.unwrap_or(present);
            (settings, actor, actor_revision)
        };
        let publisher_timeout = settings.publisher_timeout;
        self.ask(Command::Update {
            settings,
            actor,
            actor_revision,
            done,
        })?;
        self.shared.intake().publisher_timeout = publisher_timeout;
        self.answered(is_done).await
    }

    /// Takes another neutral face; returns when its frames are waited for, or when the quietest are in use.
    ///
    /// An alignment stays in use until the new one is known.
    ///
    /// # Errors
    ///
    /// [`SessionError::Quietest`] when the quietest frames cannot be taken; else when the session takes no requests any
    /// more, or too many wait.
    pub async fn recenter(&self, source: NeutralSource) -> Result<(), SessionError> {
        let (done, is_done) = oneshot::channel();
        self.ask(Command::Recenter { source, done })?;
        Ok(self.answered(is_done).await??)
    }

    /// Hands everything on that comes in from now on, before it is acknowledged; an earlier recording ends. `pre_roll` of what
    /// came before goes first, as far as it is kept: ten seconds at most.
    ///
    /// # Errors
    ///
    /// [`SessionError`] when the session takes no requests any more.
    pub fn record(&self, pre_roll: Duration) -> Result<RecordingFeed, SessionError> {
        let now_nanos = self.shared.clock.now_nanos();
        let since_nanos = now_nanos.saturating_sub(crate::clock::nanos(pre_roll));
        let since_nanos = (!pre_roll.is_zero()).then_some(since_nanos);
        let feed = self.shared.intake().record(since_nanos)?;
        self.shared.work.notify_one();
        Ok(feed)
    }

    /// Hands on nothing more.
    pub fn stop_recording(&self) {
        self.shared.intake().stop_recording();
    }

    /// All that was handed on is on stable storage, or never will be: publishers wait for it no longer.
    pub fn recording_settled(&self) {
        self.shared.intake().recording_settled();
    }

    /// Whether it took no frame yet in this run.
    pub fn has_no_frames(&self) -> bool {
        self.shared.intake().next_expected() == 0
    }

    /// Whether somebody records it.
    pub fn is_recorded(&self) -> bool {
        self.shared.intake().is_recorded()
    }

    /// Every frame up to `number` is on stable storage: publishers are told.
    pub fn set_durable_through(&self, number: u64) {
        self.shared.intake().set_durable_through(number);
    }

    fn ask(&self, command: Command) -> Result<(), SessionError> {
        self.shared.intake().command(command)?;
        self.shared.work.notify_one();
        Ok(())
    }

    async fn answered<T>(&self, is_done: oneshot::Receiver<T>) -> Result<T, SessionError> {
        match is_done.await {
            Ok(answer) => Ok(answer),
            Err(_gone) => {
                let closed = self.shared.intake().closed().map(Closed::error);
                Err(closed.unwrap_or(SessionError::Ended))
            }
        }
    }

    /// Takes no more frames, finishes those that wait, and ends the session; returns when it is done. Idempotent.
    pub async fn end(&self) {
        self.shared.intake().close(Closed::Ended);
        self.shared.work.notify_one();
        self.over().await;
    }

    /// Waits until the session's task is done.
    pub(super) async fn over(&self) {
        let mut is_over = self.shared.is_over.subscribe();
        // The sender is in `shared`, which lives as long as this handle.
        let _over = is_over.wait_for(|it| *it).await;
    }

    /// Takes no more frames and finishes those that wait; subscribers are told to come back later.
    pub(super) fn drain(&self) {
        self.shared.intake().close(Closed::Draining);
        self.shared.work.notify_one();
    }

    /// Whether a publisher may start now; to be asked before an epoch is made durable.
    ///
    /// # Errors
    ///
    /// [`SessionError::Owned`] when another publisher holds the lease, [`SessionError::OwnedByAnother`] when it may not be
    /// pushed out, [`SessionError::TakeoverRate`] when somebody was a moment ago, or why the session takes no publisher.
    pub fn check_claim(&self, claim: &Claim) -> Result<(), SessionError> {
        let now_nanos = self.shared.clock.now_nanos();
        self.shared.intake().admit(claim, now_nanos)
    }

    /// Gives the session to a publisher; an older publication is fenced.
    ///
    /// # Errors
    ///
    /// [`SessionError`] as for [`Self::check_claim`], and when the epoch is not the newest or no marker is known.
    pub fn grant(&self, mut grant: Grant) -> Result<Publication, SessionError> {
        let shared = &self.shared;
        let actor = self.actor();
        let known: Vec<&str> = actor.markers().iter().map(|it| it.name.as_str()).collect();
        if grant.marker_names.is_empty() {
            grant.marker_names = known.iter().map(|it| (*it).to_owned()).collect();
        }
        let known: BTreeSet<&str> = known.into_iter().collect();
        let is_unknown = |it: &&String| !known.contains(it.as_str());
        let unknown: Vec<String> = grant
            .marker_names
            .iter()
            .filter(is_unknown)
            .cloned()
            .collect();
        if unknown.len() == grant.marker_names.len() {
            return Err(SessionError::UnknownMarkers {
                n_streamed: unknown.len(),
                n_known: known.len(),
            });
        }
        let shape = StreamShape {
            unit: grant.unit,
            marker_names: std::mem::take(&mut grant.marker_names),
        };
        let now_nanos = shared.clock.now_nanos();
        let mut intake = shared.intake();
        let mailbox = intake.grant(&grant, shape.clone(), now_nanos)?;
        let next_expected = intake.next_expected();
        drop(intake);
        shared.figures().granted(grant.rate_hz, unknown);
        shared.work.notify_one();
        Ok(Publication {
            session: Arc::clone(shared),
            mailbox,
            granted: Granted {
                epoch: grant.epoch,
                next_expected,
                run: shared.run,
                shape,
            },
        })
    }
}
