//! Package bytes as files, one a revision, named by a number of the server's own.
//!
//! A file is complete and flushed before its row is committed, and a row is gone before its file is.
//! What a crash leaves between the two is a file without a row; the next start removes it.

use std::{collections::BTreeSet, path::PathBuf};

use rusqlite::Connection;

use super::{Catalogue, CatalogueError};
use crate::fs::write_durably;

impl Catalogue {
    /// Writes a new package file and returns its name.
    pub(super) fn write_package(
        &self,
        connection: &Connection,
        bytes: &[u8],
    ) -> Result<String, CatalogueError> {
        // Committed on its own: a name is never used twice, even when the import fails afterwards.
        let number: i64 = connection.query_row(
            "UPDATE counters SET value = value + 1 WHERE name = 'package' RETURNING value",
            [],
            |row| row.get(0),
        )?;
        let name = format!("{number:012}.package");
        write_durably(&*self.fs, &self.packages, &name, bytes)?;
        Ok(name)
    }

    pub(super) fn read_package(&self, name: &str) -> Result<Vec<u8>, CatalogueError> {
        Ok(self.fs.read(&self.package_path(name))?)
    }

    /// Removes files whose rows are gone already. A failure is no error: the next start tries again.
    pub(super) fn remove_packages(&self, names: &[String]) {
        for name in names {
            if let Err(error) = self.fs.remove(&self.package_path(name)) {
                tracing::warn!(package = %name, %error, "a package could not be removed yet");
            }
        }
    }

    /// Removes every file in the package directory that no row names.
    pub(super) fn sweep_packages(&self) -> Result<(), CatalogueError> {
        let kept: BTreeSet<String> = {
            let connection = self.connection();
            let mut rows = connection.prepare("SELECT package FROM revisions")?;
            let names = rows.query_map([], |row| row.get(0))?;
            names.collect::<Result<_, _>>()?
        };
        let found = self.fs.list(&self.packages)?;
        let left_over: Vec<String> = found
            .into_iter()
            .filter_map(|it| it.into_string().ok())
            .filter(|it| !kept.contains(it))
            .collect();
        self.remove_packages(&left_over);
        Ok(())
    }

    fn package_path(&self, name: &str) -> PathBuf {
        self.packages.join(name)
    }
}
