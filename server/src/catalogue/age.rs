//! Which takes are old, and when the clock was last believed.

use std::ops::Range;

use super::{Catalogue, CatalogueError, takes::take_id};
use crate::name::TakeId;

/// Takes that one round of retention erases.
const MAX_TAKES: i64 = 1_024;

impl Catalogue {
    /// Takes that are over and ended within `bounds`, Unix nanoseconds; of many, the 1,024 that ended first.
    ///
    /// # Errors
    ///
    /// That the database failed or an id cannot be read.
    pub fn takes_before(&self, bounds: &Range<i64>) -> Result<Vec<TakeId>, CatalogueError> {
        let connection = self.connection();
        let mut statement = connection.prepare(
            "SELECT id FROM takes WHERE stop_time_nanos >= ?1 AND stop_time_nanos < ?2
             AND state NOT IN ('recording', 'recovering') AND id NOT IN (SELECT id FROM doomed_takes)
             ORDER BY stop_time_nanos LIMIT ?3",
        )?;
        let values = [bounds.start, bounds.end, MAX_TAKES];
        let ids = statement.query_map(values, |row| row.get::<_, String>(0))?;
        ids.map(|it| take_id(&it?)).collect()
    }

    /// Keeps the wall clock's reading at a moment when it was believed.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn note_time(&self, now_nanos: i64) -> Result<(), CatalogueError> {
        self.connection().execute(
            "INSERT INTO counters VALUES ('noted_time', ?1)
             ON CONFLICT (name) DO UPDATE SET value = MAX(value, ?1)",
            [now_nanos],
        )?;
        Ok(())
    }

    /// The newest reading that was kept, Unix nanoseconds; 0 before the first.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn noted_time(&self) -> Result<i64, CatalogueError> {
        let statement = "SELECT COALESCE(MAX(value), 0) FROM counters WHERE name = 'noted_time'";
        Ok(self
            .connection()
            .query_row(statement, [], |row| row.get(0))?)
    }
}
