//! Sessions coming, going, and failing.

use std::time::SystemTime;

use frontalis_analysis::{analyzer::NeutralSource, space::LengthUnit, synthesis::reference_face};

use super::*;
use crate::{
    hub::SessionState,
    name::{ActorId, PublisherId},
    session::{Claim, Grant, Ingest, PublishEnd, SessionSettings, SessionUpdate},
};

fn registry(sessions: usize) -> (SessionRegistry, mpsc::Receiver<SessionEvent>) {
    let (sender, events) = mpsc::channel(16);
    let limits = SessionLimits {
        sessions,
        ..SessionLimits::default()
    };
    let clock = ServerClock::start(SystemTime::UNIX_EPOCH);
    (SessionRegistry::new(limits, clock, sender), events)
}

fn spec(id: &str, run: u64) -> SessionSpec {
    SessionSpec {
        id: SessionId::parse(id).unwrap(),
        display_name: String::new(),
        actor_id: ActorId::parse("reference").unwrap(),
        actor: Arc::new(reference_face::actor()),
        actor_revision: 1,
        settings: SessionSettings::default(),
        run,
        create_time: SystemTime::UNIX_EPOCH,
        restored: None,
    }
}

fn grant(epoch: u64) -> Grant {
    Grant {
        claim: Claim {
            publisher: PublisherId::parse("stage").unwrap(),
            principal: "anyone".into(),
            takeover: false,
            outranks: true,
        },
        epoch,
        unit: LengthUnit::Millimeter,
        marker_names: Vec::new(),
        ingest: Ingest::Live,
        rate_hz: 60.0,
    }
}

#[tokio::test(start_paused = true)]
async fn sessions_are_limited_and_an_ended_id_is_free() {
    let (registry, _events) = registry(2);
    let first = registry.open(spec("b", 1)).unwrap();
    registry.open(spec("a", 1)).unwrap();
    let again = registry.open(spec("a", 2)).err();
    assert!(matches!(again, Some(SessionError::Exists { .. })));
    let full = registry.open(spec("c", 1)).err();
    assert_eq!(full, Some(SessionError::RegistryFull { limit: 2 }));
    let ids: Vec<_> = registry
        .list()
        .iter()
        .map(|it| it.id().to_string())
        .collect();
    assert_eq!(ids, ["a", "b"]);
    registry.remove(first.id());
    assert!(registry.get(first.id()).is_ok());
    first.end().await;
    let second_run = registry.open(spec("b", 2)).unwrap();
    assert_eq!(second_run.run(), 2);
    assert_eq!(second_run.hub().newest_sequence(), 0);
}

#[tokio::test(start_paused = true)]
async fn nothing_opens_after_a_drain() {
    let (registry, _events) = registry(2);
    let session = registry.open(spec("a", 1)).unwrap();
    registry.drain().await;
    assert_eq!(
        registry.open(spec("b", 1)).err(),
        Some(SessionError::Draining)
    );
    assert_eq!(session.grant(grant(1)).err(), Some(SessionError::Draining));
    // Asked in vain, but answered.
    session.end().await;
}

#[tokio::test(start_paused = true)]
async fn an_older_epoch_is_fenced_before_it_begins() {
    let (registry, _events) = registry(2);
    let session = registry.open(spec("a", 1)).unwrap();
    let newer = session.grant(grant(6)).unwrap();
    let fenced = SessionError::Fenced {
        epoch: 5,
        current: 6,
    };
    assert_eq!(session.grant(grant(5)).err(), Some(fenced));
    assert!(newer.keep_alive().is_ok());
}

#[tokio::test(start_paused = true)]
async fn a_failed_session_answers_and_can_only_end() {
    let (registry, mut events) = registry(2);
    let commons = &registry.inner.commons;
    let shared = Arc::new(Shared::new(&spec("a", 1), commons));
    let session = SessionHandle {
        shared: Arc::clone(&shared),
    };
    let publication = session.grant(grant(1)).unwrap();
    worker::fail(&shared, "PANIC").await;
    let failed = Arc::clone(&shared);
    tokio::spawn(async move {
        worker::wait_for_the_end(&failed).await;
        failed.is_over.send_replace(true);
    });
    let reason = "PANIC".to_owned();
    let failure = SessionError::Failed {
        reason: reason.clone(),
    };
    assert_eq!(publication.check(), Err(PublishEnd::Failed { reason }));
    assert_eq!(
        session.recenter(NeutralSource::NextFrames).await,
        Err(failure.clone())
    );
    assert_eq!(session.update(SessionUpdate::default()).await, Err(failure));
    let status = session.status();
    assert_eq!(status.state, SessionState::Failed);
    assert_eq!(status.failure.as_deref(), Some("PANIC"));
    session.end().await;
    assert_eq!(session.status().state, SessionState::Ended);
    let told = [events.recv().await, events.recv().await];
    assert!(matches!(
        told,
        [
            Some(SessionEvent::Failed { .. }),
            Some(SessionEvent::Ended { .. })
        ]
    ));
}
