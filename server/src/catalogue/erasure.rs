//! Erasing a person: a durable tombstone first, then the data, then the rows, and no byte of them in the database's file
//! (CONTRACTS U-12, S-13).

use rusqlite::{TransactionBehavior, params};

use super::{
    Catalogue, CatalogueError,
    actors::check_unused,
    sessions::{remember_counters, session_id},
    takes::take_id,
};
use crate::name::{ActorId, SessionId, TakeId};

/// What of an actor is to be erased beside its revisions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Doomed {
    /// Its sessions, ended ones included.
    pub sessions: Vec<SessionId>,
    /// Its takes.
    pub takes: Vec<TakeId>,
}

/// What was erased with an actor's rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ErasedActor {
    /// Revisions of the actor.
    pub n_revisions: u64,
    /// Sessions.
    pub n_sessions: u64,
    /// Bytes of packages.
    pub n_bytes: u64,
}

impl Catalogue {
    /// Notes that an actor is to be erased with all its sessions and takes; none of them is seen from then on. What a crash
    /// leaves is erased at the next start.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoActor`], unless it is being erased already; [`CatalogueError::ActorInUse`].
    pub fn doom_actor(&self, id: &ActorId) -> Result<Doomed, CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        let is_known: bool = change.query_row(
            "SELECT EXISTS (SELECT 1 FROM actors WHERE id = ?1 UNION SELECT 1 FROM doomed_actors WHERE id = ?1)",
            [id.as_str()],
            |row| row.get(0),
        )?;
        if !is_known {
            return Err(CatalogueError::NoActor);
        }
        check_unused(&change, id)?;
        change.execute(
            "INSERT OR IGNORE INTO doomed_actors VALUES (?1)",
            [id.as_str()],
        )?;
        change.execute(
            "INSERT OR IGNORE INTO doomed_takes SELECT id FROM takes WHERE actor = ?1",
            [id.as_str()],
        )?;
        let ids = |statement: &str| -> rusqlite::Result<Vec<String>> {
            let mut statement = change.prepare(statement)?;
            let ids = statement.query_map([id.as_str()], |row| row.get(0))?;
            ids.collect()
        };
        let sessions = ids("SELECT id FROM sessions WHERE actor = ?1 ORDER BY id")?;
        let takes = ids("SELECT id FROM takes WHERE actor = ?1 ORDER BY id")?;
        change.commit()?;
        Ok(Doomed {
            sessions: sessions
                .iter()
                .map(|it| session_id(it))
                .collect::<Result<_, _>>()?,
            takes: takes
                .iter()
                .map(|it| take_id(it))
                .collect::<Result<_, _>>()?,
        })
    }

    /// Actors that are being erased.
    ///
    /// # Errors
    ///
    /// That the database failed or an id cannot be read.
    pub fn doomed_actors(&self) -> Result<Vec<ActorId>, CatalogueError> {
        let connection = self.connection();
        let mut statement = connection.prepare("SELECT id FROM doomed_actors ORDER BY id")?;
        let ids = statement.query_map([], |row| row.get::<_, String>(0))?;
        let parse = |id: String| {
            ActorId::parse(&id).map_err(|_| CatalogueError::Unreadable { what: "actor id" })
        };
        ids.map(|it| parse(it?)).collect()
    }

    /// Removes the rows and packages of a doomed actor whose takes are gone. Its tombstone stays until [`Self::forget_actor`].
    ///
    /// # Errors
    ///
    /// That the disk or the database failed; what is left is erased at the next start.
    pub fn erase_actor(&self, id: &ActorId) -> Result<ErasedActor, CatalogueError> {
        let (files, n_bytes) = self.package_files(id)?;
        for file in &files {
            self.fs.remove(&self.packages.join(file))?;
        }
        self.fs.sync_dir(&self.packages)?;
        let mut connection = self.connection();
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        remember_counters(&change, "actor = ?1", &[id.as_str()])?;
        let n_sessions = change.execute("DELETE FROM sessions WHERE actor = ?1", [id.as_str()])?;
        change.execute("DELETE FROM actors WHERE id = ?1", [id.as_str()])?;
        change.commit()?;
        Ok(ErasedActor {
            n_revisions: files.len() as u64,
            n_sessions: n_sessions as u64,
            n_bytes,
        })
    }

    /// Removes the tombstone of an actor of which nothing is left.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn forget_actor(&self, id: &ActorId) -> Result<(), CatalogueError> {
        let connection = self.connection();
        connection.execute("DELETE FROM doomed_actors WHERE id = ?1", [id.as_str()])?;
        empty_log(&connection)
    }

    fn package_files(&self, id: &ActorId) -> Result<(Vec<String>, u64), CatalogueError> {
        let connection = self.connection();
        let mut statement =
            connection.prepare("SELECT package, n_bytes FROM revisions WHERE actor = ?1")?;
        let rows = statement.query_map(params![id.as_str()], |row| {
            Ok((row.get::<_, String>(0)?, row.get::<_, i64>(1)?))
        })?;
        let rows = rows.collect::<Result<Vec<_>, _>>()?;
        let n_bytes = rows.iter().map(|it| it.1.unsigned_abs()).sum();
        Ok((rows.into_iter().map(|it| it.0).collect(), n_bytes))
    }

    /// Leaves nothing of deleted rows in the database's files: freed pages are given back and the log is emptied.
    ///
    /// Deleting overwrites what it deletes, but copies stay in pages that were rearranged, and in the log.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn scrub(&self) -> Result<(), CatalogueError> {
        let connection = self.connection();
        connection.execute_batch("VACUUM")?;
        empty_log(&connection)
    }

    /// Leaves nothing of deleted rows in the log.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn scrub_log(&self) -> Result<(), CatalogueError> {
        empty_log(&self.connection())
    }
}

fn empty_log(connection: &rusqlite::Connection) -> Result<(), CatalogueError> {
    connection.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(()))?;
    Ok(())
}

#[cfg(test)]
mod tests;
