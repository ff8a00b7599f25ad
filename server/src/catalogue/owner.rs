//! Whose a directory is, for an operator who has to find out why it cannot be used.

use std::{fs, os::unix::fs::MetadataExt as _, path::Path};

/// ` (it belongs to user 0, mode 0755; this server runs as user 1000)`, or nothing where that cannot be told.
pub(super) fn of(dir: &Path) -> String {
    let Ok(found) = fs::metadata(dir) else {
        return String::new();
    };
    let (owner, mode) = (found.uid(), found.mode() & 0o7777);
    let user = rustix::process::geteuid().as_raw();
    format!(" (it belongs to user {owner}, mode {mode:04o}; this server runs as user {user})")
}
