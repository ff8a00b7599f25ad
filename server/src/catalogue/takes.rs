//! Rows of takes: what was recorded of whom, and what the set says of it.
//!
//! A take's file is what counts; a row is written before the file begins, and brought up to date when it is over.

use frontalis_analysis::timecode::Timecode;
use rusqlite::{Connection, OptionalExtension as _, Params, Row, params};

use super::{Catalogue, CatalogueError, timecode};
use crate::name::{ActorId, SessionId, TakeId};

/// Where a take stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TakeState {
    /// Its session is being recorded.
    Recording,
    /// Its session was being recorded when the last process stopped; its file is being brought into order.
    Recovering,
    /// Whole.
    Closed,
    /// Part of it could not be written.
    Degraded,
    /// The disk was full.
    TruncatedDiskFull,
    /// Its file cannot be read; it is kept for a person to look at.
    Quarantined,
}

impl TakeState {
    const NAMES: [(Self, &str); 6] = [
        (Self::Recording, "recording"),
        (Self::Recovering, "recovering"),
        (Self::Closed, "closed"),
        (Self::Degraded, "degraded"),
        (Self::TruncatedDiskFull, "truncated-disk-full"),
        (Self::Quarantined, "quarantined"),
    ];

    fn name(self) -> &'static str {
        let known = Self::NAMES.iter().find(|(it, _)| *it == self);
        known.map_or("quarantined", |(_, name)| name)
    }

    fn of(name: &str) -> Option<Self> {
        let known = Self::NAMES.iter().find(|(_, it)| *it == name);
        known.map(|(it, _)| *it)
    }
}

/// What people say of a take; it may be corrected later.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TakeLabels {
    /// The slate.
    pub slate: String,
    /// The take's number on its slate, from 1.
    pub number: u32,
    /// Label of a training take; empty: none.
    pub gesture: String,
    /// The director's choice.
    pub circled: bool,
    /// Anything else.
    pub notes: String,
}

/// What a take holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TakeContent {
    /// Number of the first frame; 0 without frames.
    pub first_frame: u64,
    /// Number of the last frame.
    pub last_frame: u64,
    /// Frames.
    pub n_frames: u64,
    /// Length of the file.
    pub n_bytes: u64,
}

/// A stored take.
#[derive(Clone, Debug, PartialEq)]
pub struct TakeRow {
    /// Its id.
    pub id: TakeId,
    /// The session that was recorded.
    pub session: SessionId,
    /// Whose performance it is.
    pub actor: ActorId,
    /// Revision of the actor at the start.
    pub actor_revision: u32,
    /// What people say of it.
    pub labels: TakeLabels,
    /// When it began, Unix nanoseconds.
    pub start_time_nanos: i64,
    /// When it ended, Unix nanoseconds.
    pub stop_time_nanos: Option<i64>,
    /// What it holds, as far as it is known.
    pub content: TakeContent,
    /// Where it stands.
    pub state: TakeState,
    /// Closed by recovery after a crash.
    pub recovered: bool,
    /// The take that it was solved from again; `None`: captured.
    pub resolved_from: Option<TakeId>,
    /// Of its first frame that has one.
    pub start_timecode: Option<Timecode>,
    /// Raw images were asked for too.
    pub with_images: bool,
}

/// Which takes are listed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TakeFilter {
    /// Of this session.
    pub session: Option<SessionId>,
    /// Of this actor.
    pub actor: Option<ActorId>,
    /// Of this slate.
    pub slate: Option<String>,
}

const COLUMNS: &str = "id, session, actor, actor_revision, slate, number, gesture, circled, notes,
    start_time_nanos, stop_time_nanos, first_frame, last_frame, n_frames, n_bytes, state, recovered,
    resolved_from, start_timecode, with_images";

/// What is being erased is not seen any more.
const SEEN: &str = "id NOT IN (SELECT id FROM doomed_takes)";

impl Catalogue {
    /// Adds a take that begins. A number of 0 becomes the next of its slate.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::TakeExists`] when there is one of that id.
    pub fn add_take(&self, new: &TakeRow) -> Result<TakeRow, CatalogueError> {
        insert(&self.connection(), new)
    }

    /// Claims the id of a take that is yet to be made: what a crash leaves of it is erased at the next start.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::TakeExists`] when the id is used, or claimed already.
    pub fn claim_take(&self, id: &TakeId) -> Result<(), CatalogueError> {
        let connection = self.connection();
        if find(&connection, id)?.is_some() {
            return Err(CatalogueError::TakeExists);
        }
        let statement = "INSERT OR IGNORE INTO claimed_takes VALUES (?1)";
        match connection.execute(statement, [id.as_str()])? {
            0 => Err(CatalogueError::TakeExists),
            _ => Ok(()),
        }
    }

    /// Adds a take whose id was claimed and whose file is whole; its claim is over.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoTake`] when the take that it was made from is gone, or about to be: then nothing may be left of this
    /// one either.
    pub fn add_claimed_take(&self, new: &TakeRow) -> Result<TakeRow, CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction()?;
        if let Some(from) = &new.resolved_from {
            let is_doomed = "SELECT EXISTS (SELECT 1 FROM doomed_takes WHERE id = ?1)";
            let is_doomed = change.query_row(is_doomed, [from.as_str()], |row| row.get(0))?;
            if is_doomed || find(&change, from)?.is_none() {
                return Err(CatalogueError::NoTake);
            }
        }
        insert(&change, new)?;
        change.execute("DELETE FROM claimed_takes WHERE id = ?1", [new.id.as_str()])?;
        change.commit()?;
        found(&connection, &new.id)
    }

    /// Adds takes whose files are there, all or none of them.
    ///
    /// # Errors
    ///
    /// As [`Self::add_take`].
    pub fn add_takes(&self, new: &[TakeRow]) -> Result<(), CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction()?;
        for row in new {
            insert(&change, row)?;
        }
        Ok(change.commit()?)
    }

    /// One take.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoTake`].
    pub fn take(&self, id: &TakeId) -> Result<TakeRow, CatalogueError> {
        find(&self.connection(), id)?.ok_or(CatalogueError::NoTake)
    }

    /// At most `limit` takes whose ids come after `after`, by id.
    ///
    /// # Errors
    ///
    /// That the database failed or a row cannot be read.
    pub fn takes(
        &self,
        filter: &TakeFilter,
        after: &str,
        limit: usize,
    ) -> Result<Vec<TakeRow>, CatalogueError> {
        let limit = i64::try_from(limit).unwrap_or(i64::MAX);
        let values = params![
            after,
            filter.session.as_ref().map(SessionId::as_str),
            filter.actor.as_ref().map(ActorId::as_str),
            filter.slate,
            limit,
        ];
        let condition = "id > ?1 AND (?2 IS NULL OR session = ?2) AND (?3 IS NULL OR actor = ?3)
            AND (?4 IS NULL OR slate = ?4) ORDER BY id LIMIT ?5";
        select(&self.connection(), condition, values)
    }

    /// Stores what people say of a take.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoTake`].
    pub fn label_take(&self, id: &TakeId, labels: &TakeLabels) -> Result<TakeRow, CatalogueError> {
        let connection = self.connection();
        connection.execute(
            "UPDATE takes SET slate = ?2, number = ?3, gesture = ?4, circled = ?5, notes = ?6 WHERE id = ?1",
            params![
                id.as_str(),
                labels.slate,
                labels.number,
                labels.gesture,
                labels.circled,
                labels.notes,
            ],
        )?;
        found(&connection, id)
    }

    /// Stores how a take ended.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::NoTake`].
    pub fn end_take(&self, ended: &TakeRow) -> Result<TakeRow, CatalogueError> {
        let connection = self.connection();
        let start_timecode = ended.start_timecode.as_ref().map(timecode::to_text);
        let start_timecode = start_timecode.transpose()?;
        connection.execute(
            "UPDATE takes SET stop_time_nanos = ?2, first_frame = ?3, last_frame = ?4, n_frames = ?5,
                n_bytes = ?6, state = ?7, recovered = ?8, start_timecode = ?9 WHERE id = ?1",
            params![
                ended.id.as_str(),
                ended.stop_time_nanos,
                integer(ended.content.first_frame),
                integer(ended.content.last_frame),
                integer(ended.content.n_frames),
                integer(ended.content.n_bytes),
                ended.state.name(),
                ended.recovered,
                start_timecode,
            ],
        )?;
        found(&connection, &ended.id)
    }

    /// Notes that a take is to be erased; what a crash leaves of it is erased at the next start (CONTRACTS U-12).
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn doom_take(&self, id: &TakeId) -> Result<(), CatalogueError> {
        let statement = "INSERT OR IGNORE INTO doomed_takes VALUES (?1)";
        self.connection().execute(statement, [id.as_str()])?;
        Ok(())
    }

    /// Takes that are to be erased.
    ///
    /// # Errors
    ///
    /// That the database failed or a row cannot be read.
    pub fn doomed_takes(&self) -> Result<Vec<TakeId>, CatalogueError> {
        let connection = self.connection();
        let mut statement = connection.prepare("SELECT id FROM doomed_takes ORDER BY id")?;
        let ids = statement.query_map([], |row| row.get::<_, String>(0))?;
        let ids = ids.collect::<Result<Vec<_>, _>>()?;
        ids.iter().map(|it| take_id(it)).collect()
    }

    /// Forgets a take whose file is gone.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn forget_take(&self, id: &TakeId) -> Result<(), CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction()?;
        change.execute("DELETE FROM takes WHERE id = ?1", [id.as_str()])?;
        change.execute("DELETE FROM doomed_takes WHERE id = ?1", [id.as_str()])?;
        change.execute("DELETE FROM claimed_takes WHERE id = ?1", [id.as_str()])?;
        change.commit()?;
        Ok(())
    }

    /// At a start nothing is being made any more: what was claimed is to be erased.
    pub(super) fn doom_claimed_takes(&self) -> Result<(), CatalogueError> {
        let mut connection = self.connection();
        let change = connection.transaction()?;
        change.execute(
            "INSERT OR IGNORE INTO doomed_takes SELECT id FROM claimed_takes",
            [],
        )?;
        change.execute("DELETE FROM claimed_takes", [])?;
        Ok(change.commit()?)
    }
}

fn insert(connection: &Connection, new: &TakeRow) -> Result<TakeRow, CatalogueError> {
    let id = new.id.as_str();
    if find(connection, &new.id)?.is_some() {
        return Err(CatalogueError::TakeExists);
    }
    let number = match new.labels.number {
        0 => next_number(connection, &new.labels.slate)?,
        chosen => chosen,
    };
    let start_timecode = new
        .start_timecode
        .as_ref()
        .map(timecode::to_text)
        .transpose()?;
    connection.execute(
        "INSERT INTO takes VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, ?19, ?20)",
        params![
            id,
            new.session.as_str(),
            new.actor.as_str(),
            new.actor_revision,
            new.labels.slate,
            number,
            new.labels.gesture,
            new.labels.circled,
            new.labels.notes,
            new.start_time_nanos,
            new.stop_time_nanos,
            integer(new.content.first_frame),
            integer(new.content.last_frame),
            integer(new.content.n_frames),
            integer(new.content.n_bytes),
            new.state.name(),
            new.recovered,
            new.resolved_from.as_ref().map(TakeId::as_str),
            start_timecode,
            new.with_images,
        ],
    )?;
    found(connection, &new.id)
}

fn found(connection: &Connection, id: &TakeId) -> Result<TakeRow, CatalogueError> {
    find(connection, id)?.ok_or(CatalogueError::NoTake)
}

fn next_number(connection: &Connection, slate: &str) -> Result<u32, CatalogueError> {
    let last: Option<u32> = connection.query_row(
        "SELECT MAX(number) FROM takes WHERE slate = ?1",
        [slate],
        |row| row.get(0),
    )?;
    Ok(last.unwrap_or(0).saturating_add(1))
}

fn find(connection: &Connection, id: &TakeId) -> Result<Option<TakeRow>, CatalogueError> {
    let statement = format!("SELECT {COLUMNS} FROM takes WHERE {SEEN} AND id = ?1");
    let found = connection
        .query_row(&statement, [id.as_str()], raw)
        .optional()?;
    found.map(RawTake::parse).transpose()
}

/// Of the takes that are not being erased.
pub(super) fn select(
    connection: &Connection,
    condition: &str,
    values: impl Params,
) -> Result<Vec<TakeRow>, CatalogueError> {
    let mut statement = connection.prepare(&format!(
        "SELECT {COLUMNS} FROM takes WHERE {SEEN} AND {condition}"
    ))?;
    let rows = statement.query_map(values, raw)?;
    rows.map(|it| it?.parse()).collect()
}

struct RawTake {
    id: String,
    session: String,
    actor: String,
    state: String,
    actor_revision: u32,
    labels: TakeLabels,
    start_time_nanos: i64,
    stop_time_nanos: Option<i64>,
    content: [i64; 4],
    recovered: bool,
    resolved_from: Option<String>,
    start_timecode: Option<String>,
    with_images: bool,
}

fn raw(row: &Row<'_>) -> rusqlite::Result<RawTake> {
    Ok(RawTake {
        id: row.get(0)?,
        session: row.get(1)?,
        actor: row.get(2)?,
        actor_revision: row.get(3)?,
        labels: TakeLabels {
            slate: row.get(4)?,
            number: row.get(5)?,
            gesture: row.get(6)?,
            circled: row.get(7)?,
            notes: row.get(8)?,
        },
        start_time_nanos: row.get(9)?,
        stop_time_nanos: row.get(10)?,
        content: [row.get(11)?, row.get(12)?, row.get(13)?, row.get(14)?],
        state: row.get(15)?,
        recovered: row.get(16)?,
        resolved_from: row.get(17)?,
        start_timecode: row.get(18)?,
        with_images: row.get(19)?,
    })
}

impl RawTake {
    fn parse(self) -> Result<TakeRow, CatalogueError> {
        const SESSION: CatalogueError = CatalogueError::Unreadable { what: "session id" };
        const ACTOR: CatalogueError = CatalogueError::Unreadable { what: "actor id" };
        const STATE: CatalogueError = CatalogueError::Unreadable {
            what: "take's state",
        };
        let [first_frame, last_frame, n_frames, n_bytes] = self.content.map(i64::unsigned_abs);
        Ok(TakeRow {
            id: take_id(&self.id)?,
            session: SessionId::parse(&self.session).map_err(|_| SESSION)?,
            actor: ActorId::parse(&self.actor).map_err(|_| ACTOR)?,
            actor_revision: self.actor_revision,
            labels: self.labels,
            start_time_nanos: self.start_time_nanos,
            stop_time_nanos: self.stop_time_nanos,
            content: TakeContent {
                first_frame,
                last_frame,
                n_frames,
                n_bytes,
            },
            state: TakeState::of(&self.state).ok_or(STATE)?,
            recovered: self.recovered,
            resolved_from: self.resolved_from.map(|it| take_id(&it)).transpose()?,
            start_timecode: self
                .start_timecode
                .map(|it| timecode::from_text(&it))
                .transpose()?,
            with_images: self.with_images,
        })
    }
}

pub(super) fn take_id(text: &str) -> Result<TakeId, CatalogueError> {
    TakeId::parse(text).map_err(|_| CatalogueError::Unreadable { what: "take id" })
}

/// Counts and frame numbers as the database has them; those beyond its integers are held at the last.
fn integer(value: u64) -> i64 {
    i64::try_from(value).unwrap_or(i64::MAX)
}
