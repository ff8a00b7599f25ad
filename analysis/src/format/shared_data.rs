//! Real packages and takes for tests. They lie beside the repository, never in it, and may be absent.

use std::path::PathBuf;

/// The directory that `FRONTALIS_DATA` names, or the one beside the repository.
fn root() -> PathBuf {
    let beside = || concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data").into();
    std::env::var_os("FRONTALIS_DATA").map_or_else(beside, PathBuf::from)
}

/// A file of the shared data; says so, by name, when `test` is left out because it is not there.
pub(crate) fn read(path: &str, test: &str) -> Option<Vec<u8>> {
    #[expect(
        clippy::disallowed_methods,
        reason = "only tests read files, and only these"
    )]
    let bytes = std::fs::read(root().join(path)).ok();
    if bytes.is_none() {
        println!(
            "LEFT OUT: {test}: {path} is not in FRONTALIS_DATA ({})",
            root().display()
        );
    }
    bytes
}
