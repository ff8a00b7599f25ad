//! The database's tables, and the pragmas that make its commits durable.
//!
//! `user_version` counts the schema's versions: an older one is moved up step by step, a newer one is refused.

use rusqlite::{Connection, TransactionBehavior};

use super::CatalogueError;

/// Step `i` leads from version `i` to version `i + 1`.
const STEPS: &[&str] = &[V1, V2, V3, V4];

/// `counters` holds what must not repeat when rows are gone: the highest run and epoch of any collected session, and
/// the number of the last package file.
const V1: &str = "
CREATE TABLE counters (
    name  TEXT PRIMARY KEY,
    value INTEGER NOT NULL
) STRICT;
INSERT INTO counters VALUES ('package', 0), ('collected_run', 0), ('collected_epoch', 0);

CREATE TABLE actors (
    id                TEXT PRIMARY KEY,
    create_time_nanos INTEGER NOT NULL
) STRICT;

CREATE TABLE revisions (
    actor    TEXT NOT NULL REFERENCES actors (id) ON DELETE CASCADE,
    revision INTEGER NOT NULL,
    package  TEXT NOT NULL UNIQUE,
    n_bytes  INTEGER NOT NULL,
    crc32c   INTEGER NOT NULL,
    summary  TEXT NOT NULL,
    PRIMARY KEY (actor, revision)
) STRICT;

CREATE TABLE sessions (
    id                TEXT PRIMARY KEY,
    display_name      TEXT NOT NULL,
    actor             TEXT NOT NULL,
    actor_revision    INTEGER NOT NULL,
    settings          TEXT NOT NULL,
    run               INTEGER NOT NULL,
    epoch             INTEGER NOT NULL,
    had_publisher     INTEGER NOT NULL,
    create_time_nanos INTEGER NOT NULL,
    end_time_nanos    INTEGER,
    alignment         TEXT
) STRICT;
CREATE INDEX sessions_by_actor ON sessions (actor);
";

/// Takes, and those that are being erased.
const V2: &str = "
CREATE TABLE takes (
    id               TEXT PRIMARY KEY,
    session          TEXT NOT NULL,
    actor            TEXT NOT NULL,
    actor_revision   INTEGER NOT NULL,
    slate            TEXT NOT NULL,
    number           INTEGER NOT NULL,
    gesture          TEXT NOT NULL,
    circled          INTEGER NOT NULL,
    notes            TEXT NOT NULL,
    start_time_nanos INTEGER NOT NULL,
    stop_time_nanos  INTEGER,
    first_frame      INTEGER NOT NULL,
    last_frame       INTEGER NOT NULL,
    n_frames         INTEGER NOT NULL,
    n_bytes          INTEGER NOT NULL,
    state            TEXT NOT NULL,
    recovered        INTEGER NOT NULL
) STRICT;
CREATE INDEX takes_by_session ON takes (session);
CREATE INDEX takes_by_actor ON takes (actor);
CREATE INDEX takes_by_slate ON takes (slate);

CREATE TABLE doomed_takes (
    id TEXT PRIMARY KEY
) STRICT;
";

/// Where takes come from, and where on the stage's clock they begin.
const V3: &str = "
ALTER TABLE takes ADD COLUMN resolved_from  TEXT;
ALTER TABLE takes ADD COLUMN start_timecode TEXT;
ALTER TABLE takes ADD COLUMN with_images    INTEGER NOT NULL DEFAULT 0;
";

/// Actors that are being erased, and takes that are being made of others.
const V4: &str = "
CREATE TABLE doomed_actors (
    id TEXT PRIMARY KEY
) STRICT;
CREATE TABLE claimed_takes (
    id TEXT PRIMARY KEY
) STRICT;
";

/// Looks through the whole database for damage, before anything is changed.
fn check(connection: &Connection) -> Result<(), CatalogueError> {
    let said: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if said == "ok" {
        return Ok(());
    }
    let corrupt = rusqlite::ffi::Error::new(rusqlite::ffi::SQLITE_CORRUPT);
    Err(rusqlite::Error::SqliteFailure(corrupt, Some(said)).into())
}

/// Sets the connection up and brings the schema to the newest version.
pub(super) fn prepare(connection: &mut Connection) -> Result<(), CatalogueError> {
    let found: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    let known = i64::try_from(STEPS.len()).expect("invariant: few versions");
    if found > known {
        return Err(CatalogueError::NewerVersion { found, known });
    }
    check(connection)?;
    // WAL with NORMAL would acknowledge before the flush.
    connection.pragma_update(None, "journal_mode", "wal")?;
    connection.pragma_update(None, "synchronous", "full")?;
    connection.pragma_update(None, "foreign_keys", true)?;
    // What is deleted is overwritten: rows are personal data too.
    connection.pragma_update(None, "secure_delete", true)?;
    let done = usize::try_from(found).map_err(|_| CatalogueError::Unreadable {
        what: "schema version",
    })?;
    for (version, step) in STEPS.iter().enumerate().skip(done) {
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        change.execute_batch(step)?;
        change.pragma_update(
            None,
            "user_version",
            i64::try_from(version + 1).expect("invariant: few versions"),
        )?;
        change.commit()?;
    }
    Ok(())
}
