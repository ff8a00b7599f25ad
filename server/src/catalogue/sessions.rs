//! Rows of sessions: settings, run, epoch, alignment.
//!
//! A run never repeats under one id and an epoch never repeats at all for one id, also when the row was collected and
//! the id is used again: a new row starts above every run and epoch of the rows that are gone.

use rusqlite::{Connection, OptionalExtension as _, Params, Row, TransactionBehavior, params};

use super::{Catalogue, CatalogueError, StoredAlignment, StoredSettings};
use crate::name::{ActorId, SessionId};

/// A session to be created.
#[derive(Clone, Debug, PartialEq)]
pub struct NewSession {
    /// Chosen by the caller or made by the server.
    pub id: SessionId,
    /// A person's name for the session.
    pub display_name: String,
    /// The actor that is captured.
    pub actor: ActorId,
    /// The revision that the session begins with.
    pub actor_revision: u32,
    /// Effective settings.
    pub settings: StoredSettings,
}

/// A stored session.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionRow {
    /// What it was created with; `actor_revision` and `settings` as they are now.
    pub session: NewSession,
    /// Grows whenever the session starts over, from 1.
    pub run: u64,
    /// Number of the last lease that was granted, 0 before the first.
    pub epoch: u64,
    /// When this run's session was created, Unix nanoseconds.
    pub create_time_nanos: i64,
    /// When it ended, Unix nanoseconds.
    pub end_time_nanos: Option<i64>,
    /// The alignment in use.
    pub alignment: Option<StoredAlignment>,
}

const COLUMNS: &str = "id, display_name, actor, actor_revision, settings, run, epoch,
    create_time_nanos, end_time_nanos, alignment";

impl Catalogue {
    /// Adds a session, or starts an ended one over under its id, as a new run.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::SessionExists`] when one of that id has not ended,
    /// [`CatalogueError::NoActor`] when the actor or its revision is gone.
    pub fn create_session(
        &self,
        new: &NewSession,
        now_nanos: i64,
    ) -> Result<SessionRow, CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        let id = new.id.as_str();
        check_revision(&change, &new.actor, new.actor_revision)?;
        let before = change
            .query_row(
                "SELECT run, epoch, end_time_nanos IS NULL FROM sessions WHERE id = ?1",
                [id],
                |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)),
            )
            .optional()?;
        let (run, epoch): (i64, i64) = match before {
            Some((_, _, true)) => return Err(CatalogueError::SessionExists),
            Some((run, epoch, false)) => (run, epoch),
            None => collected_counters(&change)?,
        };
        change.execute(
            "INSERT OR REPLACE INTO sessions VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, 0, ?8, NULL, NULL)",
            params![
                id,
                new.display_name,
                new.actor.as_str(),
                new.actor_revision,
                new.settings.to_text()?,
                run + 1,
                epoch,
                now_nanos,
            ],
        )?;
        let created = find(&change, &new.id)?;
        change.commit()?;
        Ok(created)
    }

    /// One session, ended ones included.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoSession`].
    pub fn session(&self, id: &SessionId) -> Result<SessionRow, CatalogueError> {
        find(&self.connection(), id)
    }

    /// At most `limit` sessions whose ids come after `after`, ended ones included, by id.
    ///
    /// # Errors
    ///
    /// That the database failed or a row cannot be read.
    pub fn sessions(&self, after: &str, limit: usize) -> Result<Vec<SessionRow>, CatalogueError> {
        let limit = i64::try_from(limit).unwrap_or(i64::MAX);
        let connection = self.connection();
        select(
            &connection,
            "id > ?1 ORDER BY id LIMIT ?2",
            params![after, limit],
        )
    }

    /// Begins a new run of every session that has not ended, since the samples of the last one were lost with the
    /// process, and returns those sessions by id.
    ///
    /// # Errors
    ///
    /// That the database failed or a row cannot be read.
    pub fn begin_runs(&self) -> Result<Vec<SessionRow>, CatalogueError> {
        let connection = self.connection();
        connection.execute(
            "UPDATE sessions SET run = run + 1 WHERE end_time_nanos IS NULL",
            [],
        )?;
        select(&connection, "end_time_nanos IS NULL ORDER BY id", [])
    }

    /// Stores changed settings and the revision.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoSession`] when there is none or it has ended,
    /// [`CatalogueError::NoActor`] when the actor has no such revision.
    pub fn update_session(
        &self,
        id: &SessionId,
        settings: &StoredSettings,
        actor_revision: u32,
    ) -> Result<(), CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        check_revision(&change, &find(&change, id)?.session.actor, actor_revision)?;
        let n_changed = change.execute(
            "UPDATE sessions SET settings = ?2, actor_revision = ?3
             WHERE id = ?1 AND end_time_nanos IS NULL",
            params![id.as_str(), settings.to_text()?, actor_revision],
        )?;
        if n_changed == 0 {
            return Err(CatalogueError::NoSession);
        }
        change.commit()?;
        Ok(())
    }

    /// Marks a session's run as ended. One that is over already changes nothing.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn end_session(
        &self,
        id: &SessionId,
        run: u64,
        now_nanos: i64,
    ) -> Result<(), CatalogueError> {
        self.connection().execute(
            "UPDATE sessions SET end_time_nanos = COALESCE(end_time_nanos, ?3)
             WHERE id = ?1 AND run = ?2",
            params![id.as_str(), counter(run), now_nanos],
        )?;
        Ok(())
    }

    /// The number of the next lease. It is on the disk before this returns, and is never returned again.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoSession`] when there is none or it has ended.
    pub fn next_epoch(&self, id: &SessionId) -> Result<u64, CatalogueError> {
        let epoch: Option<i64> = self
            .connection()
            .query_row(
                "UPDATE sessions SET epoch = epoch + 1, had_publisher = 1
                 WHERE id = ?1 AND end_time_nanos IS NULL RETURNING epoch",
                [id.as_str()],
                |row| row.get(0),
            )
            .optional()?;
        epoch
            .map(i64::unsigned_abs)
            .ok_or(CatalogueError::NoSession)
    }

    /// Stores the alignment of a session's run, in place of an earlier one. A run that is over changes nothing.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn put_alignment(
        &self,
        id: &SessionId,
        run: u64,
        alignment: &StoredAlignment,
    ) -> Result<(), CatalogueError> {
        self.set_alignment(id, run, Some(&alignment.to_text()?))
    }

    /// Drops the alignment of a session's run, if it has one. A run that is over changes nothing.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn forget_alignment(&self, id: &SessionId, run: u64) -> Result<(), CatalogueError> {
        self.set_alignment(id, run, None)
    }

    fn set_alignment(
        &self,
        id: &SessionId,
        run: u64,
        text: Option<&str>,
    ) -> Result<(), CatalogueError> {
        self.connection().execute(
            "UPDATE sessions SET alignment = ?3 WHERE id = ?1 AND run = ?2",
            params![id.as_str(), counter(run), text],
        )?;
        Ok(())
    }

    /// Removes sessions that ended before `before_nanos`, those created before then that never had a publisher, and
    /// of the ended ones all but the last 4,096. Returns their ids, in order.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn collect_sessions(&self, before_nanos: i64) -> Result<Vec<SessionId>, CatalogueError> {
        const OLD: &str = "end_time_nanos < ?1
            OR (end_time_nanos IS NULL AND had_publisher = 0 AND create_time_nanos < ?1)
            OR id IN (SELECT id FROM sessions WHERE end_time_nanos IS NOT NULL
                      ORDER BY end_time_nanos DESC, id LIMIT -1 OFFSET ?2)";
        let values = [before_nanos, MAX_ENDED];
        let mut connection = self.connection();
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        remember_counters(&change, OLD, &values)?;
        let ids: Vec<String> = change
            .prepare(&format!("DELETE FROM sessions WHERE {OLD} RETURNING id"))?
            .query_map(values, |row| row.get(0))?
            .collect::<Result<_, _>>()?;
        change.commit()?;
        let ids = ids.iter().map(|it| session_id(it));
        let mut ids = ids.collect::<Result<Vec<_>, _>>()?;
        ids.sort();
        Ok(ids)
    }
}

/// Ended sessions that stay listed, however many end within a day.
const MAX_ENDED: i64 = 4_096;

/// Keeps the highest run and epoch of the rows that are about to be deleted.
pub(super) fn remember_counters(
    connection: &Connection,
    condition: &str,
    values: &(impl Params + Clone),
) -> Result<(), CatalogueError> {
    for counter in ["run", "epoch"] {
        connection.execute(
            &format!(
                "UPDATE counters SET value = MAX(value,
                     (SELECT COALESCE(MAX({counter}), 0) FROM sessions WHERE {condition}))
                 WHERE name = 'collected_{counter}'"
            ),
            values.clone(),
        )?;
    }
    Ok(())
}

fn collected_counters(connection: &Connection) -> Result<(i64, i64), CatalogueError> {
    let value = |name: &str| {
        connection.query_row(
            "SELECT value FROM counters WHERE name = ?1",
            [name],
            |row| row.get(0),
        )
    };
    Ok((value("collected_run")?, value("collected_epoch")?))
}

fn check_revision(
    connection: &Connection,
    actor: &ActorId,
    revision: u32,
) -> Result<(), CatalogueError> {
    let exists: bool = connection.query_row(
        "SELECT EXISTS (SELECT 1 FROM revisions WHERE actor = ?1 AND revision = ?2
            AND actor NOT IN (SELECT id FROM doomed_actors))",
        params![actor.as_str(), revision],
        |row| row.get(0),
    )?;
    if exists {
        Ok(())
    } else {
        Err(CatalogueError::NoActor)
    }
}

fn find(connection: &Connection, id: &SessionId) -> Result<SessionRow, CatalogueError> {
    let found = select(connection, "id = ?1", [id.as_str()])?;
    found.into_iter().next().ok_or(CatalogueError::NoSession)
}

fn select(
    connection: &Connection,
    condition: &str,
    values: impl Params,
) -> Result<Vec<SessionRow>, CatalogueError> {
    let mut statement =
        connection.prepare(&format!("SELECT {COLUMNS} FROM sessions WHERE {condition}"))?;
    let rows = statement.query_map(values, raw)?;
    // A row that cannot be read costs its session, never the server or the others.
    let readable = |raw: RawSession| {
        let id = raw.id.clone();
        let parsed = raw.parse();
        parsed
            .inspect_err(|error| tracing::error!(session = %id, %error, "left out"))
            .ok()
    };
    let found = rows.collect::<Result<Vec<_>, _>>()?;
    Ok(found.into_iter().filter_map(readable).collect())
}

struct RawSession {
    id: String,
    display_name: String,
    actor: String,
    actor_revision: u32,
    settings: String,
    run: i64,
    epoch: i64,
    create_time_nanos: i64,
    end_time_nanos: Option<i64>,
    alignment: Option<String>,
}

fn raw(row: &Row<'_>) -> rusqlite::Result<RawSession> {
    Ok(RawSession {
        id: row.get(0)?,
        display_name: row.get(1)?,
        actor: row.get(2)?,
        actor_revision: row.get(3)?,
        settings: row.get(4)?,
        run: row.get(5)?,
        epoch: row.get(6)?,
        create_time_nanos: row.get(7)?,
        end_time_nanos: row.get(8)?,
        alignment: row.get(9)?,
    })
}

impl RawSession {
    fn parse(self) -> Result<SessionRow, CatalogueError> {
        let actor = ActorId::parse(&self.actor)
            .map_err(|_| CatalogueError::Unreadable { what: "actor id" })?;
        // Without its alignment a session aligns again, which is better than no session.
        let alignment = self.alignment.as_deref().and_then(|text| {
            StoredAlignment::from_text(text)
                .inspect_err(|error| tracing::error!(session = %self.id, %error, "aligns again"))
                .ok()
        });
        Ok(SessionRow {
            session: NewSession {
                id: session_id(&self.id)?,
                display_name: self.display_name,
                actor,
                actor_revision: self.actor_revision,
                settings: StoredSettings::from_text(&self.settings)?,
            },
            run: self.run.unsigned_abs(),
            epoch: self.epoch.unsigned_abs(),
            create_time_nanos: self.create_time_nanos,
            end_time_nanos: self.end_time_nanos,
            alignment,
        })
    }
}

/// Counters grow by one at a time and never get near the end of i64.
fn counter(value: u64) -> i64 {
    i64::try_from(value).unwrap_or(i64::MAX)
}

pub(super) fn session_id(text: &str) -> Result<SessionId, CatalogueError> {
    SessionId::parse(text).map_err(|_| CatalogueError::Unreadable { what: "session id" })
}

#[cfg(test)]
mod tests;
