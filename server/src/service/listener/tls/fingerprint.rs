//! What tells one state of the port's files from another, file by file.

use std::{
    hash::{BuildHasher as _, RandomState},
    sync::LazyLock,
};

use super::files::{Content, Files};

/// The files by the names of their settings.
const SETTINGS: [&str; 4] = ["tls.cert", "tls.key", "tls.client_ca", "tls.client_crl"];

/// A number for the content of each file, 0 where there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fingerprint([u64; SETTINGS.len()]);

impl Fingerprint {
    /// In place of one: the files could not be read. No files have it, since there is always a certificate.
    pub(super) const NONE: Self = Self([0; SETTINGS.len()]);

    pub(super) fn of(files: &Files) -> Self {
        let optional = |it: &Option<Content>| it.as_ref().map_or(0, number);
        Self([
            number(&files.cert),
            number(&files.key),
            optional(&files.client_ca),
            optional(&files.client_crl),
        ])
    }

    /// The settings whose files are others than `before`, with spaces between them.
    pub(super) fn changed_since(self, before: Self) -> String {
        let both = self.0.iter().zip(before.0).zip(SETTINGS);
        let changed = both.filter(|((after, before), _)| **after != *before);
        let changed: Vec<&str> = changed.map(|it| it.1).collect();
        changed.join(" ")
    }
}

/// Never 0.
fn number(content: &Content) -> u64 {
    static STATE: LazyLock<RandomState> = LazyLock::new(RandomState::new);
    STATE.hash_one(&content.bytes).max(1)
}
