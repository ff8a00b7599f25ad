//! Where the bundle of recorded performances and advisories is, when it is there at all.

use std::path::{Path, PathBuf};

/// The bundle's folder: `FRONTALIS_DATA`, or `shared/data` beside the repository.
///
/// Without it, says that `test` was left out and returns `None`: the test then ends at once.
pub fn data_dir(test: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("FRONTALIS_DATA").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
        PathBuf::from,
    );
    if folder.is_dir() {
        return Some(folder);
    }
    println!(
        "left out: {test}: no FRONTALIS_DATA at {}",
        folder.display()
    );
    None
}
