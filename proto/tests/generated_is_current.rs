//! Regenerates `src/generated` and fails when the committed copy is stale.
#![expect(clippy::unwrap_used, reason = "a failing test is its own report")]

use std::path::Path;

use prost::Message as _;

const PROTO_FILES: [&str; 6] = [
    "frontalis/v1/common.proto",
    "frontalis/v1/actor.proto",
    "frontalis/v1/session.proto",
    "frontalis/v1/capture.proto",
    "frontalis/v1/curve.proto",
    "frontalis/v1/take.proto",
];

#[test]
fn generated_code_is_current() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let fresh = tempfile::tempdir().unwrap();
    let descriptors = protox::compile(PROTO_FILES, [root]).unwrap();
    std::fs::write(
        fresh.path().join("frontalis.v1.bin"),
        descriptors.encode_to_vec(),
    )
    .unwrap();
    tonic_prost_build::configure()
        .emit_rerun_if_changed(false)
        .out_dir(fresh.path())
        .compile_fds(descriptors)
        .unwrap();
    for name in ["frontalis.v1.rs", "frontalis.v1.bin"] {
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
