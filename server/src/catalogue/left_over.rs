//! Rows of takes whose files are looked at after a start: those that the last process left open, and those that could not be
//! read.

use std::collections::BTreeSet;

use super::{
    Catalogue, CatalogueError, TakeRow,
    takes::{select, take_id},
};
use crate::name::TakeId;

impl Catalogue {
    /// Marks what was being recorded when the last process stopped; returns how many takes wait to be recovered.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn begin_recovery(&self) -> Result<u64, CatalogueError> {
        let connection = self.connection();
        connection.execute(
            "UPDATE takes SET state = 'recovering' WHERE state = 'recording'",
            [],
        )?;
        let n_waiting: i64 = connection.query_row(
            "SELECT COUNT(*) FROM takes WHERE state = 'recovering'",
            [],
            |row| row.get(0),
        )?;
        Ok(n_waiting.unsigned_abs())
    }

    /// At most `limit` takes whose files are to be looked at and whose ids come after `after`, by id. Those in quarantine are
    /// among them: this server may be able to read what an older one could not.
    ///
    /// # Errors
    ///
    /// That the database failed or a row cannot be read.
    pub fn takes_to_recover(
        &self,
        after: &str,
        limit: usize,
    ) -> Result<Vec<TakeRow>, CatalogueError> {
        let limit = i64::try_from(limit).unwrap_or(i64::MAX);
        select(
            &self.connection(),
            "id > ?1 AND state IN ('recovering', 'quarantined') ORDER BY id LIMIT ?2",
            rusqlite::params![after, limit],
        )
    }

    /// Every take that has a row, or that is being erased.
    ///
    /// # Errors
    ///
    /// That the database failed or an id cannot be read.
    pub fn known_takes(&self) -> Result<BTreeSet<TakeId>, CatalogueError> {
        let connection = self.connection();
        let mut statement =
            connection.prepare("SELECT id FROM takes UNION SELECT id FROM doomed_takes")?;
        let ids = statement.query_map([], |row| row.get::<_, String>(0))?;
        ids.map(|it| take_id(&it?)).collect()
    }
}
