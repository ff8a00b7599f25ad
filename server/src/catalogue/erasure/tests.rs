//! An erased actor leaves no row and no byte, whatever step a crash comes between.

use super::*;
use crate::{
    catalogue::{NewRevision, TakeContent, TakeFilter, TakeLabels, TakeRow, TakeState, revision},
    fs::MemFs,
};

const PLANTED: &str = "PLANTED-NOTE-7f3a";

fn anna() -> ActorId {
    ActorId::parse("anna").unwrap()
}

fn take(id: &str, actor: &str, notes: &str) -> TakeRow {
    TakeRow {
        id: TakeId::parse(id).unwrap(),
        session: SessionId::parse("stage").unwrap(),
        actor: ActorId::parse(actor).unwrap(),
        actor_revision: 1,
        labels: TakeLabels {
            notes: notes.to_owned(),
            ..TakeLabels::default()
        },
        start_time_nanos: 1,
        stop_time_nanos: Some(2),
        content: TakeContent::default(),
        state: TakeState::Closed,
        recovered: false,
        resolved_from: None,
        start_timecode: None,
        with_images: false,
    }
}

fn stored(catalogue: &Catalogue) {
    let new = NewRevision {
        actor: anna(),
        layout: revision::tests::layout(),
        package: b"package".to_vec(),
    };
    catalogue.add_revision(&new, 0).unwrap();
    let rows: Vec<_> = (0..200)
        .flat_map(|it| {
            let of_anna = take(&format!("a{it}"), "anna", PLANTED);
            let of_other = take(&format!("b{it}"), "berta", "kept");
            [of_anna, of_other]
        })
        .collect();
    catalogue.add_takes(&rows).unwrap();
}

fn n_takes(catalogue: &Catalogue) -> usize {
    let all = TakeFilter::default();
    catalogue.takes(&all, "", 1_000).unwrap().len()
}

#[test]
fn what_is_doomed_is_not_seen_and_the_rest_stays() {
    let catalogue = Catalogue::in_memory(MemFs::default()).unwrap();
    stored(&catalogue);
    let doomed = catalogue.doom_actor(&anna()).unwrap();
    assert_eq!(doomed.takes.len(), 200);
    assert_eq!(n_takes(&catalogue), 200);
    let unseen = catalogue.actor(&anna()).unwrap_err();
    assert!(matches!(unseen, CatalogueError::NoActor));
    let new = NewRevision {
        actor: anna(),
        layout: revision::tests::layout(),
        package: b"again".to_vec(),
    };
    let refused = catalogue.add_revision(&new, 0).unwrap_err();
    assert!(matches!(refused, CatalogueError::BeingErased));
    // The same again, as after a crash.
    assert_eq!(catalogue.doom_actor(&anna()).unwrap(), doomed);
    for id in &doomed.takes {
        catalogue.forget_take(id).unwrap();
    }
    let erased = catalogue.erase_actor(&anna()).unwrap();
    assert_eq!((erased.n_revisions, erased.n_bytes), (1, 7));
    assert_eq!(catalogue.doomed_actors().unwrap(), [anna()]);
    catalogue.forget_actor(&anna()).unwrap();
    assert_eq!(catalogue.doomed_actors().unwrap(), []);
    catalogue.add_revision(&new, 0).unwrap();
}

#[test]
fn no_byte_of_an_erased_row_is_left_in_the_files() {
    let dir = tempfile::tempdir().unwrap();
    let catalogue = Catalogue::open(dir.path()).unwrap();
    stored(&catalogue);
    for id in catalogue.doom_actor(&anna()).unwrap().takes {
        catalogue.forget_take(&id).unwrap();
    }
    catalogue.erase_actor(&anna()).unwrap();
    catalogue.scrub().unwrap();
    catalogue.forget_actor(&anna()).unwrap();
    for entry in std::fs::read_dir(dir.path()).unwrap() {
        let file = entry.unwrap().path();
        if file.is_file() {
            let bytes = std::fs::read(&file).unwrap();
            let found = bytes
                .windows(PLANTED.len())
                .any(|it| it == PLANTED.as_bytes());
            assert!(!found, "{}", file.display());
        }
    }
    assert_eq!(n_takes(&catalogue), 200);
}
