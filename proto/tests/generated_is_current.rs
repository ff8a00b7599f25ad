//! Regenerates `src/generated` and fails when the committed copy is stale.
#![expect(clippy::unwrap_used, reason = "a failing test is its own report")]

use std::path::Path;

use prost::Message as _;

const PROTO_FILES: [&str; 7] = [
    "frontalis/v1/common.proto",
    "frontalis/v1/actor.proto",
    "frontalis/v1/session.proto",
    "frontalis/v1/capture.proto",
    "frontalis/v1/curve.proto",
    "frontalis/v1/take.proto",
    "frontalis/v1/server.proto",
];

/// Types of Google's that have a JSON form of their own, and where they are.
const WELL_KNOWN: (&str, &str) = (".google.protobuf", "::pbjson_types");

/// Those that `pbjson_types` lacks, or writes other than the mapping asks.
const OWN: [(&str, &str); 2] = [
    (".google.protobuf.FieldMask", "crate::FieldMask"),
    (".google.protobuf.Timestamp", "crate::Timestamp"),
];

#[test]
fn generated_code_is_current() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let fresh = tempfile::tempdir().unwrap();
    let descriptors = protox::compile(PROTO_FILES, [root]).unwrap();
    let binary = descriptors.encode_to_vec();
    pbjson_build::Builder::new()
        .register_descriptors(&binary)
        .unwrap()
        .extern_path(WELL_KNOWN.0, WELL_KNOWN.1)
        .extern_path(OWN[0].0, OWN[0].1)
        .extern_path(OWN[1].0, OWN[1].1)
        .out_dir(fresh.path())
        .build(&[".frontalis.v1"])
        .unwrap();
    std::fs::write(fresh.path().join("frontalis.v1.bin"), binary).unwrap();
    let mut config = tonic_prost_build::Config::new();
    config.enable_type_names();
    tonic_prost_build::configure()
        .emit_rerun_if_changed(false)
        .compile_well_known_types(true)
        .extern_path(WELL_KNOWN.0, WELL_KNOWN.1)
        .extern_path(OWN[0].0, OWN[0].1)
        .extern_path(OWN[1].0, OWN[1].1)
        .out_dir(fresh.path())
        .compile_fds_with_config(descriptors, config)
        .unwrap();
    for name in [
        "frontalis.v1.rs",
        "frontalis.v1.serde.rs",
        "frontalis.v1.bin",
    ] {
        check(
            &fresh.path().join(name),
            &root.join("src/generated").join(name),
        );
    }
}

fn check(fresh: &Path, committed: &Path) {
    let fresh = std::fs::read(fresh).unwrap();
    if std::env::var_os("UPDATE_GENERATED").is_some() {
        std::fs::write(committed, &fresh).unwrap();
    }
    let current = std::fs::read(committed).unwrap_or_default();
    assert!(
        fresh == current,
        "{} is stale: run UPDATE_GENERATED=1 cargo test -p frontalis-proto",
        committed.display()
    );
}
