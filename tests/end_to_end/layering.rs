//! The crates and the layers of the server depend on each other in one direction only.
//!
//! The rules are those of `ARCHITECTURE.md`, "Dependency rules".

pub mod sources;

use std::{
    collections::{BTreeMap, BTreeSet},
    process::Command,
};

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand};
use sources::SourceFile;

/// Which crates of the workspace a crate may name.
const CRATES: &[(&str, &[&str])] = &[
    ("frontalis-access", &[]),
    ("frontalis-analysis", &[]),
    ("frontalis-proto", &[]),
    (
        "frontalis-server",
        &["frontalis-access", "frontalis-analysis", "frontalis-proto"],
    ),
    (
        "frontalis-client",
        &["frontalis-access", "frontalis-analysis", "frontalis-proto"],
    ),
    (
        "frontalis-tests",
        &[
            "frontalis-access",
            "frontalis-analysis",
            "frontalis-client",
            "frontalis-proto",
            "frontalis-server",
        ],
    ),
];

/// The crates that are given bytes and times, and return values.
const PURE: &[&str] = &["frontalis-access", "frontalis-analysis"];

/// What must not appear anywhere below those: whatever waits, talks, or writes logs.
const FORBIDDEN_BELOW_PURE: &[&str] = &[
    "async-std",
    "axum",
    "futures",
    "hyper",
    "mio",
    "prost",
    "rusqlite",
    "smol",
    "socket2",
    "tokio",
    "tonic",
    "tracing",
];

/// What each layer of the server may name; a layer is a top-level module of `frontalis-server`.
const LAYERS: &[(&str, &[&str])] = &[
    (
        "service",
        &[
            "take",
            "wire",
            "session",
            "hub",
            "catalogue",
            "config",
            "shutdown",
        ],
    ),
    ("take", &["wire", "session", "hub", "catalogue"]),
    ("wire", &["session", "hub", "catalogue"]),
    ("session", &["hub"]),
    ("hub", &[]),
    ("catalogue", &[]),
];

/// Small modules at the root that every layer may name.
const GROUND: &[&str] = &["clock", "executor", "fs", "name", "reload", "telemetry"];

/// What stands above the layers and joins them.
const ROOF: &[&str] = &["config", "lib", "main", "server", "shutdown"];

/// A library, and the only layers of the server that may name it.
const LIBRARIES: &[(&str, &[&str])] = &[
    ("frontalis_access::", &["service"]),
    ("frontalis_proto::", &["service", "take", "wire"]),
    ("mcap::", &["take"]),
    ("tonic::", &["service"]),
    ("axum::", &["service"]),
    ("rusqlite::", &["catalogue"]),
];

/// A library, and the only module of the analysis that may name it.
const ANALYSIS_LIBRARIES: &[(&str, &str)] = &[
    ("gltf::", "format"),
    ("serde::", "format"),
    ("serde_json::", "format"),
    ("zip::", "format"),
];

#[test]
fn crates_depend_in_one_direction() {
    let metadata = metadata();
    let allowed: BTreeMap<_, _> = CRATES.iter().copied().collect();
    for package in metadata.workspace_packages() {
        let found: Vec<_> = package
            .dependencies
            .iter()
            .filter(|it| it.kind == DependencyKind::Normal && it.name.starts_with("frontalis-"))
            .map(|it| it.name.as_str())
            .collect::<BTreeSet<_>>()
            .into_iter()
            .collect();
        assert_eq!(found, allowed[package.name.as_str()], "{}", package.name);
    }
}

#[test]
fn pure_crates_have_no_network_and_no_async_below_them() {
    let metadata = metadata();
    for name in PURE {
        check_below(&metadata, name);
    }
}

fn check_below(metadata: &Metadata, pure: &str) {
    let resolve = metadata.resolve.as_ref().unwrap();
    let mut seen = BTreeSet::new();
    let mut open = vec![
        metadata
            .workspace_packages()
            .into_iter()
            .find(|it| it.name.as_str() == pure)
            .unwrap()
            .id
            .clone(),
    ];
    while let Some(id) = open.pop() {
        if !seen.insert(id.clone()) {
            continue;
        }
        let node = resolve.nodes.iter().find(|it| it.id == id).unwrap();
        open.extend(
            node.deps
                .iter()
                .filter(|it| {
                    it.dep_kinds
                        .iter()
                        .any(|kind| kind.kind == DependencyKind::Normal)
                })
                .map(|it| it.pkg.clone()),
        );
    }
    for id in &seen {
        let name = metadata[id].name.as_str();
        assert!(
            !FORBIDDEN_BELOW_PURE.contains(&name),
            "{pure} pulls in {name}"
        );
    }
}

#[test]
fn numeric_knows_no_faces() {
    for file in sources::of("analysis/src").filter(|it| it.room() == "numeric") {
        for named in file.crate_modules() {
            assert_eq!(named, "numeric", "{} names crate::{named}", file.path);
        }
    }
}

#[test]
fn only_the_formats_of_the_analysis_name_file_libraries() {
    for file in sources::of("analysis/src") {
        for (library, room) in ANALYSIS_LIBRARIES {
            assert!(
                file.room() == *room || !file.names_library(library),
                "{} names {library}",
                file.path
            );
        }
    }
}

#[test]
fn server_layers_name_only_the_layers_below() {
    let layers: BTreeMap<_, _> = LAYERS.iter().copied().collect();
    for file in sources::of("server/src") {
        let Some(allowed) = layers.get(file.room()) else {
            continue;
        };
        for named in file.crate_modules() {
            assert!(
                named == file.room()
                    || GROUND.contains(&named.as_str())
                    || allowed.contains(&named.as_str()),
                "{} names crate::{named}",
                file.path
            );
        }
    }
}

#[test]
fn ground_modules_of_the_server_name_only_each_other() {
    for file in sources::of("server/src").filter(|it| GROUND.contains(&it.room())) {
        for named in file.crate_modules() {
            assert!(
                GROUND.contains(&named.as_str()),
                "{} names crate::{named}",
                file.path
            );
        }
    }
}

#[test]
fn every_room_of_the_server_has_a_rule() {
    for file in sources::of("server/src") {
        let room = file.room();
        assert!(
            LAYERS.iter().any(|(layer, _)| *layer == room)
                || GROUND.contains(&room)
                || ROOF.contains(&room),
            "{} is in no layer of tests/end_to_end/layering.rs",
            file.path
        );
    }
}

#[test]
fn libraries_stay_in_their_layer() {
    for file in sources::of("server/src").filter(|it| !ROOF.contains(&it.room())) {
        for (library, layers) in LIBRARIES {
            assert!(
                layers.contains(&file.room()) || !file.names_library(library),
                "{} names {library}",
                file.path
            );
        }
    }
}

#[test]
fn no_queue_is_unbounded() {
    for file in every_crate() {
        for name in [
            "unbounded_channel",
            "UnboundedSender",
            "mpsc::unbounded",
            "sync::mpsc::channel()",
        ] {
            assert!(!file.code.contains(name), "{} names {name}", file.path);
        }
    }
}

#[test]
fn time_goes_through_the_injected_clock() {
    for file in every_crate() {
        assert!(
            !file.names_item(&["std", "time", "Instant"]),
            "{} names std::time::Instant",
            file.path
        );
        assert!(
            WALL_CLOCKS.contains(&file.path.as_str()) || !file.code.contains("SystemTime::now"),
            "{} reads the wall clock",
            file.path
        );
    }
}

/// The files that may read the wall clock: once at start, or for what people date.
const WALL_CLOCKS: &[&str] = &["client-cli/src/commands/token.rs", "server/src/clock.rs"];

/// Libraries whose macros make unsafe code where they are used, which the compiler's own rule does not see; and the one
/// file that names them, for a reason that a decision gives.
const UNSAFE_BY_MACRO: (&[&str], &str) = (
    &["nix::", "libc::"],
    "server/src/service/listener/watched/unanswered.rs",
);

#[test]
fn no_macro_makes_unsafe_code_but_in_one_file_that_a_decision_justifies() {
    let (libraries, exception) = UNSAFE_BY_MACRO;
    for file in every_crate().filter(|it| it.path != exception) {
        for library in libraries {
            assert!(
                !file.names_library(library),
                "{} names {library}",
                file.path
            );
        }
    }
    let decisions = sources::repository().join("docs/decisions");
    let pages = std::fs::read_dir(decisions).unwrap();
    let mut texts = pages.map(|it| std::fs::read_to_string(it.unwrap().path()).unwrap());
    assert!(
        texts.any(|it| it.contains(exception)),
        "no decision names {exception}"
    );
}

#[test]
fn every_file_says_what_it_is() {
    for file in every_crate() {
        assert!(
            file.text.starts_with("//!"),
            "{} opens without //!",
            file.path
        );
        assert!(
            !file.path.ends_with("/mod.rs"),
            "{}: foo.rs stands beside foo/",
            file.path
        );
    }
}

fn every_crate() -> impl Iterator<Item = SourceFile> {
    [
        "access/src",
        "analysis/src",
        "proto/src",
        "server/src",
        "client-cli/src",
        "tests/harness",
    ]
    .into_iter()
    .flat_map(sources::of)
    .filter(|it| !it.path.contains("/generated/"))
}

/// The dependency graph for this machine's platform: what other platforms need may not have been downloaded.
fn metadata() -> Metadata {
    let version = Command::new("rustc").arg("-vV").output().unwrap();
    let version = String::from_utf8(version.stdout).unwrap();
    let host = version
        .lines()
        .find_map(|it| it.strip_prefix("host: "))
        .unwrap();
    MetadataCommand::new()
        .manifest_path(sources::repository().join("Cargo.toml"))
        .other_options(vec![
            "--locked".to_owned(),
            format!("--filter-platform={host}"),
        ])
        .exec()
        .unwrap()
}
