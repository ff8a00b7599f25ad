//! Actors in the catalogue: revisions, erasure, and what an interrupted import leaves behind.

use frontalis_analysis::face::{muscle::Muscle, region::FaceRegion};

use super::*;
use crate::{
    catalogue::revision::tests::layout,
    fs::{Fs as _, MemFs},
};

fn id() -> ActorId {
    ActorId::parse("actor-a").unwrap()
}

fn revision(package: &[u8]) -> NewRevision {
    NewRevision {
        actor: id(),
        layout: layout(),
        package: package.to_vec(),
    }
}

#[test]
fn a_package_comes_back_byte_for_byte_after_a_restart() {
    let dir = tempfile::tempdir().unwrap();
    let first = Catalogue::open(dir.path()).unwrap();
    assert_eq!(
        first.add_revision(&revision(b"one"), 3).unwrap().revision,
        1
    );
    assert_eq!(
        first.add_revision(&revision(b"two"), 4).unwrap().revision,
        2
    );
    drop(first);
    let again = Catalogue::open(dir.path()).unwrap();
    assert_eq!(again.package(&id(), 1).unwrap(), (b"one".to_vec(), true));
    assert_eq!(again.package(&id(), 2).unwrap().0, b"two");
    let newest = again.actor(&id()).unwrap();
    assert_eq!((newest.revision, newest.create_time_nanos), (2, 3));
    assert_eq!(newest.layout, layout());
}

#[test]
fn another_layout_under_the_same_id_is_refused_by_what_differs() {
    let catalogue = Catalogue::in_memory(MemFs::default()).unwrap();
    catalogue.add_revision(&revision(b"one"), 0).unwrap();
    let mut muscles = revision(b"two");
    muscles.layout.muscles.push(Muscle {
        name: "more".into(),
        region: FaceRegion::Lower,
    });
    let mut markers = revision(b"two");
    markers.layout.markers[0].head_fixed = false;
    for (new, expected) in [(muscles, "muscles"), (markers, "markers")] {
        match catalogue.add_revision(&new, 1) {
            Err(CatalogueError::LayoutChanged { what, revision: 1 }) => assert_eq!(what, expected),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn an_import_that_fails_at_any_write_changes_nothing_and_leaves_no_file() {
    for n_writes in 0..3 {
        let files = MemFs::default();
        let catalogue = Catalogue::in_memory(files.clone()).unwrap();
        catalogue.add_revision(&revision(b"one"), 0).unwrap();
        files.fail_after(Some(n_writes));
        let failed = catalogue.add_revision(&revision(b"two"), 0);
        assert!(
            matches!(failed, Err(CatalogueError::Storage(_))),
            "{n_writes}"
        );
        files.fail_after(None);
        assert_eq!(catalogue.actor(&id()).unwrap().revision, 1);
        assert_eq!(catalogue.package(&id(), 1).unwrap().0, b"one");
        catalogue.sweep_packages().unwrap();
        assert_eq!(files.list("/packages".as_ref()).unwrap().len(), 1);
        assert_eq!(
            catalogue
                .add_revision(&revision(b"two"), 0)
                .unwrap()
                .revision,
            2
        );
    }
}

#[test]
fn files_without_a_row_are_removed_at_the_start() {
    let dir = tempfile::tempdir().unwrap();
    let first = Catalogue::open(dir.path()).unwrap();
    first.add_revision(&revision(b"one"), 0).unwrap();
    drop(first);
    let packages = dir.path().join("packages");
    for left_over in ["000000000009.package", "000000000010.package.tmp"] {
        std::fs::write(packages.join(left_over), b"half").unwrap();
    }
    let again = Catalogue::open(dir.path()).unwrap();
    assert_eq!(std::fs::read_dir(&packages).unwrap().count(), 1);
    assert_eq!(again.package(&id(), 1).unwrap().0, b"one");
}

#[test]
fn a_package_that_changed_on_the_disk_is_not_handed_out() {
    let files = MemFs::default();
    let catalogue = Catalogue::in_memory(files.clone()).unwrap();
    catalogue.add_revision(&revision(b"one"), 0).unwrap();
    let name = files.list("/packages".as_ref()).unwrap().remove(0);
    let path = std::path::Path::new("/packages").join(name);
    files.write_and_sync(&path, b"onf").unwrap();
    assert!(matches!(
        catalogue.package(&id(), 1),
        Err(CatalogueError::Unreadable { .. })
    ));
}

#[test]
fn a_deleted_actor_leaves_neither_rows_nor_files() {
    let files = MemFs::default();
    let catalogue = Catalogue::in_memory(files.clone()).unwrap();
    catalogue.add_revision(&revision(b"one"), 0).unwrap();
    catalogue.add_revision(&revision(b"two"), 0).unwrap();
    catalogue.delete_actor(&id()).unwrap();
    assert!(files.list("/packages".as_ref()).unwrap().is_empty());
    assert!(matches!(
        catalogue.actor(&id()),
        Err(CatalogueError::NoActor)
    ));
    assert!(matches!(
        catalogue.delete_actor(&id()),
        Err(CatalogueError::NoActor)
    ));
    assert_eq!(
        catalogue
            .add_revision(&revision(b"one"), 0)
            .unwrap()
            .revision,
        1
    );
}

#[test]
fn actors_are_listed_in_pages_by_id_with_their_newest_revision() {
    let catalogue = Catalogue::in_memory(MemFs::default()).unwrap();
    for name in ["c", "a", "b", "a"] {
        let new = NewRevision {
            actor: ActorId::parse(name).unwrap(),
            ..revision(b"x")
        };
        catalogue.add_revision(&new, 0).unwrap();
    }
    let page = |after: &str| -> Vec<(String, u32)> {
        let found = catalogue.actors(after, 2).unwrap();
        found
            .iter()
            .map(|it| (it.actor.to_string(), it.revision))
            .collect()
    };
    assert_eq!(page(""), [("a".into(), 2), ("b".into(), 1)]);
    assert_eq!(page("b"), [("c".into(), 1)]);
}
