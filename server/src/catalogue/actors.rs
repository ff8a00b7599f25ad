//! Rows of actors and their revisions. A revision never changes.

use rusqlite::{Connection, OptionalExtension as _, Row, TransactionBehavior, params};

use super::{ActorRevision, Catalogue, CatalogueError, Layout, NewRevision};
use crate::name::ActorId;

const NEWEST: &str = "SELECT a.id, r.revision, a.create_time_nanos, r.summary
    FROM actors a JOIN revisions r ON r.actor = a.id
    WHERE r.revision = (SELECT MAX(revision) FROM revisions WHERE actor = a.id)
    AND a.id NOT IN (SELECT id FROM doomed_actors)";

impl Catalogue {
    /// Adds a revision: the first of a new actor, or the next of an existing one with the same muscles and markers.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::LayoutChanged`], [`CatalogueError::BeingErased`], or that the disk failed; then nothing has changed.
    pub fn add_revision(
        &self,
        new: &NewRevision,
        now_nanos: i64,
    ) -> Result<ActorRevision, CatalogueError> {
        let mut connection = self.connection();
        let is_doomed: bool = connection.query_row(
            "SELECT EXISTS (SELECT 1 FROM doomed_actors WHERE id = ?1)",
            [new.actor.as_str()],
            |row| row.get(0),
        )?;
        if is_doomed {
            return Err(CatalogueError::BeingErased);
        }
        if let Some(newest) = newest(&connection, &new.actor)? {
            new.layout.check_same(&newest.layout, newest.revision)?;
        }
        let package = self.write_package(&connection, &new.package)?;
        let added = insert(&mut connection, new, &package, now_nanos);
        drop(connection);
        if added.is_err() {
            self.remove_packages(&[package]);
        }
        added
    }

    /// The newest revision of one actor.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoActor`], or that the database failed.
    pub fn actor(&self, id: &ActorId) -> Result<ActorRevision, CatalogueError> {
        newest(&self.connection(), id)?.ok_or(CatalogueError::NoActor)
    }

    /// The newest revisions of at most `limit` actors whose ids come after `after`, by id.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn actors(&self, after: &str, limit: usize) -> Result<Vec<ActorRevision>, CatalogueError> {
        let connection = self.connection();
        let mut rows =
            connection.prepare(&format!("{NEWEST} AND a.id > ?1 ORDER BY a.id LIMIT ?2"))?;
        let found = rows.query_map(
            params![after, i64::try_from(limit).unwrap_or(i64::MAX)],
            raw,
        )?;
        found.map(|it| it?.parse()).collect()
    }

    /// The package of a revision as it was uploaded, and whether it was imported with a rank-deficient basis.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoActor`], [`CatalogueError::Unreadable`] when the file is not what was stored,
    /// or that the disk failed.
    pub fn package(&self, id: &ActorId, revision: u32) -> Result<(Vec<u8>, bool), CatalogueError> {
        let stored = self
            .connection()
            .query_row(
                "SELECT package, crc32c, summary FROM revisions WHERE actor = ?1 AND revision = ?2",
                params![id.as_str(), revision],
                |row| {
                    Ok((
                        row.get::<_, String>(0)?,
                        row.get::<_, u32>(1)?,
                        row.get::<_, String>(2)?,
                    ))
                },
            )
            .optional()?;
        let (file, checksum, summary) = stored.ok_or(CatalogueError::NoActor)?;
        let bytes = self.read_package(&file)?;
        if crc32c::crc32c(&bytes) != checksum {
            return Err(CatalogueError::Unreadable {
                what: "actor package",
            });
        }
        Ok((bytes, Layout::from_text(&summary)?.regularized))
    }

    /// Erases an actor, its revisions and its packages; what was recorded of it stays.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoActor`], [`CatalogueError::ActorInUse`], or that the disk failed.
    pub fn delete_actor(&self, id: &ActorId) -> Result<(), CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        check_unused(&change, id)?;
        let files: Vec<String> = change
            .prepare("SELECT package FROM revisions WHERE actor = ?1")?
            .query_map([id.as_str()], |row| row.get(0))?
            .collect::<Result<_, _>>()?;
        if change.execute("DELETE FROM actors WHERE id = ?1", [id.as_str()])? == 0 {
            return Err(CatalogueError::NoActor);
        }
        change.commit()?;
        drop(connection);
        self.remove_packages(&files);
        Ok(())
    }
}

/// Whether every session of an actor has ended.
pub(super) fn check_unused(connection: &Connection, id: &ActorId) -> Result<(), CatalogueError> {
    let n_sessions: i64 = connection.query_row(
        "SELECT COUNT(*) FROM sessions WHERE actor = ?1 AND end_time_nanos IS NULL",
        [id.as_str()],
        |row| row.get(0),
    )?;
    if n_sessions > 0 {
        return Err(CatalogueError::ActorInUse {
            n_sessions: n_sessions.unsigned_abs(),
        });
    }
    Ok(())
}

fn newest(connection: &Connection, id: &ActorId) -> Result<Option<ActorRevision>, CatalogueError> {
    let found = connection
        .query_row(&format!("{NEWEST} AND a.id = ?1"), [id.as_str()], raw)
        .optional()?;
    found.map(RawRevision::parse).transpose()
}

fn insert(
    connection: &mut Connection,
    new: &NewRevision,
    package: &str,
    now_nanos: i64,
) -> Result<ActorRevision, CatalogueError> {
    let id = new.actor.as_str();
    let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    change.execute(
        "INSERT OR IGNORE INTO actors VALUES (?1, ?2)",
        params![id, now_nanos],
    )?;
    change.execute(
        "INSERT INTO revisions SELECT ?1, COALESCE(MAX(revision), 0) + 1, ?2, ?3, ?4, ?5
         FROM revisions WHERE actor = ?1",
        params![
            id,
            package,
            i64::try_from(new.package.len()).unwrap_or(i64::MAX),
            crc32c::crc32c(&new.package),
            new.layout.to_text()?,
        ],
    )?;
    let added = newest(&change, &new.actor)?.ok_or(CatalogueError::NoActor)?;
    change.commit()?;
    Ok(added)
}

struct RawRevision {
    actor: String,
    revision: u32,
    create_time_nanos: i64,
    summary: String,
}

fn raw(row: &Row<'_>) -> rusqlite::Result<RawRevision> {
    Ok(RawRevision {
        actor: row.get(0)?,
        revision: row.get(1)?,
        create_time_nanos: row.get(2)?,
        summary: row.get(3)?,
    })
}

impl RawRevision {
    fn parse(self) -> Result<ActorRevision, CatalogueError> {
        Ok(ActorRevision {
            actor: ActorId::parse(&self.actor)
                .map_err(|_| CatalogueError::Unreadable { what: "actor id" })?,
            revision: self.revision,
            create_time_nanos: self.create_time_nanos,
            layout: Layout::from_text(&self.summary)?,
        })
    }
}

#[cfg(test)]
mod tests;
