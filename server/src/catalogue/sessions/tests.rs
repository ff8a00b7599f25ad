//! Sessions in the catalogue: epochs, alignments, and what a restart finds.

use std::time::Duration;

use frontalis_analysis::{
    analyzer::MarkerSettings,
    marker_analysis::alignment::Alignment,
    space::{LengthUnit, Similarity},
};
use nalgebra::{UnitQuaternion, Vector3};

use super::*;
use crate::{
    catalogue::{NewRevision, revision::tests::layout},
    fs::MemFs,
};

const DAY_NANOS: i64 = 86_400_000_000_000;

fn session(id: &str) -> NewSession {
    NewSession {
        id: SessionId::parse(id).unwrap(),
        display_name: "Stage 1".into(),
        actor: ActorId::parse("a").unwrap(),
        actor_revision: 1,
        settings: StoredSettings {
            marker: MarkerSettings::default(),
            stale_after: Some(Duration::from_millis(250)),
            publisher_timeout: Duration::from_secs(10),
            record: false,
            record_images: false,
        },
    }
}

fn revision() -> NewRevision {
    NewRevision {
        actor: ActorId::parse("a").unwrap(),
        layout: layout(),
        package: b"package".to_vec(),
    }
}

fn catalogue() -> Catalogue {
    let catalogue = Catalogue::in_memory(MemFs::default()).unwrap();
    catalogue.add_revision(&revision(), 0).unwrap();
    catalogue
}

fn alignment() -> StoredAlignment {
    StoredAlignment {
        alignment: Alignment {
            model_from_performance: Similarity {
                scale: 1.1,
                rotation: UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3),
                translation_cm: Vector3::new(0.1, 0.2, 0.3),
            },
            bindings: vec![None],
            rms_residual_cm: 0.01,
            iterations: 4,
        },
        unit: LengthUnit::Millimeter,
        marker_names: vec!["brow".into()],
        actor_revision: 1,
    }
}

#[test]
fn epochs_never_repeat_over_restarts_or_when_the_id_is_used_again() {
    let dir = tempfile::tempdir().unwrap();
    let new = session("s");
    let mut epochs = Vec::new();
    let mut runs = Vec::new();
    let first = Catalogue::open(dir.path()).unwrap();
    first.add_revision(&revision(), 0).unwrap();
    runs.push(first.create_session(&new, 0).unwrap().run);
    epochs.push(first.next_epoch(&new.id).unwrap());
    epochs.push(first.next_epoch(&new.id).unwrap());
    drop(first);

    let second = Catalogue::open(dir.path()).unwrap();
    runs.push(second.begin_runs().unwrap()[0].run);
    epochs.push(second.next_epoch(&new.id).unwrap());
    second.end_session(&new.id, runs[1], 5).unwrap();
    runs.push(second.create_session(&new, 6).unwrap().run);
    epochs.push(second.next_epoch(&new.id).unwrap());
    second.end_session(&new.id, runs[2], 7).unwrap();
    let collected = second.collect_sessions(8).unwrap();
    assert_eq!(collected, std::slice::from_ref(&new.id));
    drop(second);

    let third = Catalogue::open(dir.path()).unwrap();
    runs.push(third.create_session(&new, 9).unwrap().run);
    epochs.push(third.next_epoch(&new.id).unwrap());
    assert!(epochs.is_sorted_by(|a, b| a < b), "{epochs:?}");
    assert!(runs.is_sorted_by(|a, b| a < b), "{runs:?}");
}

#[test]
fn a_session_comes_back_as_it_was() {
    let dir = tempfile::tempdir().unwrap();
    let new = session("s");
    let catalogue = Catalogue::open(dir.path()).unwrap();
    catalogue.add_revision(&revision(), 0).unwrap();
    let created = catalogue.create_session(&new, 17).unwrap();
    catalogue
        .put_alignment(&new.id, created.run, &alignment())
        .unwrap();
    drop(catalogue);
    let again = Catalogue::open(dir.path()).unwrap();
    let rows = again.begin_runs().unwrap();
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].session, new);
    assert_eq!(rows[0].create_time_nanos, 17);
    assert_eq!(rows[0].alignment, Some(alignment()));
    assert_eq!(rows[0].run, created.run + 1);
}

#[test]
fn an_alignment_of_a_run_that_is_over_is_not_stored() {
    let catalogue = catalogue();
    let new = session("s");
    let first = catalogue.create_session(&new, 0).unwrap();
    catalogue.end_session(&new.id, first.run, 1).unwrap();
    let second = catalogue.create_session(&new, 2).unwrap();
    catalogue
        .put_alignment(&new.id, first.run, &alignment())
        .unwrap();
    assert_eq!(catalogue.session(&new.id).unwrap().alignment, None);
    catalogue
        .put_alignment(&new.id, second.run, &alignment())
        .unwrap();
    catalogue.forget_alignment(&new.id, first.run).unwrap();
    assert!(catalogue.session(&new.id).unwrap().alignment.is_some());
    catalogue.forget_alignment(&new.id, second.run).unwrap();
    assert_eq!(catalogue.session(&new.id).unwrap().alignment, None);
}

#[test]
fn an_id_is_free_again_only_when_its_session_ended() {
    let catalogue = catalogue();
    let new = session("s");
    let row = catalogue.create_session(&new, 0).unwrap();
    let refused = catalogue.create_session(&new, 0);
    assert!(matches!(refused, Err(CatalogueError::SessionExists)));
    catalogue.end_session(&new.id, row.run, 1).unwrap();
    assert!(matches!(
        catalogue.next_epoch(&new.id),
        Err(CatalogueError::NoSession)
    ));
    catalogue.create_session(&new, 2).unwrap();
}

#[test]
fn i7_only_old_ended_and_never_used_sessions_are_collected() {
    let catalogue = catalogue();
    for id in ["ended-old", "ended-new", "used", "unused-old"] {
        catalogue.create_session(&session(id), 0).unwrap();
    }
    catalogue
        .create_session(&session("unused-new"), 2 * DAY_NANOS)
        .unwrap();
    let id = |text: &str| SessionId::parse(text).unwrap();
    for used in ["ended-old", "ended-new", "used"] {
        catalogue.next_epoch(&id(used)).unwrap();
    }
    catalogue.end_session(&id("ended-old"), 1, 1).unwrap();
    catalogue
        .end_session(&id("ended-new"), 1, 2 * DAY_NANOS)
        .unwrap();
    let collected = catalogue.collect_sessions(DAY_NANOS).unwrap();
    assert_eq!(collected, [id("ended-old"), id("unused-old")]);
    let left: Vec<_> = catalogue
        .sessions("", 10)
        .unwrap()
        .into_iter()
        .map(|it| it.session.id)
        .collect();
    assert_eq!(left, [id("ended-new"), id("unused-new"), id("used")]);
}

#[test]
fn sessions_are_listed_in_pages_by_id() {
    let catalogue = catalogue();
    for id in ["c", "a", "b"] {
        catalogue.create_session(&session(id), 0).unwrap();
    }
    let page = |after: &str| -> Vec<String> {
        let rows = catalogue.sessions(after, 2).unwrap();
        rows.iter().map(|it| it.session.id.to_string()).collect()
    };
    assert_eq!(page(""), ["a", "b"]);
    assert_eq!(page("b"), ["c"]);
}

#[test]
fn a_session_of_a_missing_revision_is_refused() {
    let catalogue = catalogue();
    let missing = NewSession {
        actor_revision: 2,
        ..session("s")
    };
    assert!(matches!(
        catalogue.create_session(&missing, 0),
        Err(CatalogueError::NoActor)
    ));
    let row = catalogue.create_session(&session("s"), 0).unwrap();
    let settings = row.session.settings;
    let id = SessionId::parse("s").unwrap();
    assert!(matches!(
        catalogue.update_session(&id, &settings, 2),
        Err(CatalogueError::NoActor)
    ));
    catalogue.update_session(&id, &settings, 1).unwrap();
}

#[test]
fn a_row_that_cannot_be_read_costs_no_other_session() {
    let catalogue = catalogue();
    for id in ["aligned", "broken", "whole"] {
        catalogue.create_session(&session(id), 0).unwrap();
    }
    let damage = |statement: &str| catalogue.connection().execute(statement, []).unwrap();
    damage("UPDATE sessions SET settings = '{}' WHERE id = 'broken'");
    damage("UPDATE sessions SET alignment = 'x' WHERE id = 'aligned'");
    let rows = catalogue.begin_runs().unwrap();
    let left: Vec<_> = rows.iter().map(|it| it.session.id.as_str()).collect();
    assert_eq!(left, ["aligned", "whole"]);
    assert_eq!(rows[0].alignment, None);
}
