//! What survives a restart: actors with their revisions and packages, sessions with their epochs and alignments.
//!
//! SQLite with full synchronous commits (CONTRACTS U-11), package bytes as files beside it.
//! A call that returned without an error has reached the disk.
//! The methods of [`Catalogue`] block; [`Store`] is the same for async callers.

mod actors;
mod age;
mod alignment;
mod erasure;
mod left_over;
mod lock;
mod owner;
mod packages;
mod revision;
mod schema;
mod sessions;
mod settings;
mod store;
mod takes;
mod timecode;

use std::{
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use rusqlite::Connection;

use crate::fs::{Fs, MemFs, StdFs};

pub use alignment::StoredAlignment;
pub use erasure::{Doomed, ErasedActor};
pub use revision::{ActorRevision, Layout, NewRevision};
pub use sessions::{NewSession, SessionRow};
pub use settings::StoredSettings;
pub use store::{ActorLoadError, Store};
pub use takes::{TakeContent, TakeFilter, TakeLabels, TakeRow, TakeState};

/// Name of the database in the data directory.
const DATABASE: &str = "catalogue.sqlite";

/// Why the catalogue could not do what it was asked to.
#[derive(Debug, thiserror::Error)]
pub enum CatalogueError {
    /// The database failed.
    #[error("the catalogue's database failed")]
    Database(#[from] rusqlite::Error),
    /// A call to the file system failed.
    #[error("the data directory could not be used")]
    Storage(#[from] io::Error),
    /// The data directory cannot be used at the start.
    #[error("the data directory {} could not be used{owner}", dir.display())]
    Directory {
        /// The data directory.
        dir: PathBuf,
        /// Whose it is and who wants to use it, in words; empty where that cannot be told.
        owner: String,
        /// What the system says.
        source: io::Error,
    },
    /// The database cannot be opened: it is damaged, or none.
    #[error("the database {} could not be opened", file.display())]
    Damaged {
        /// The database.
        file: PathBuf,
        /// What the database says.
        source: rusqlite::Error,
    },
    /// Written by a newer server; left untouched.
    #[error("the catalogue has version {found}, this server knows versions up to {known}")]
    NewerVersion {
        /// Version of the catalogue.
        found: i64,
        /// Newest version that this server knows.
        known: i64,
    },
    /// Another server uses the data directory.
    #[error("the data directory {} is in use by another server ({holder})", dir.display())]
    InUse {
        /// The data directory.
        dir: PathBuf,
        /// What the lock file says of the other server.
        holder: String,
    },
    /// No session of that id.
    #[error("there is no session of this name")]
    NoSession,
    /// A session of that id exists and has not ended.
    #[error("a session of this id exists and has not ended")]
    SessionExists,
    /// No take of that id.
    #[error("there is no take of this name")]
    NoTake,
    /// A take of that id exists.
    #[error("a take of this id exists")]
    TakeExists,
    /// No actor of that id, or no such revision of it.
    #[error("no such actor or revision")]
    NoActor,
    /// The actor is being erased.
    #[error("the actor is being erased")]
    BeingErased,
    /// The actor is used by sessions that have not ended.
    #[error("{n_sessions} sessions use this actor")]
    ActorInUse {
        /// How many sessions use it.
        n_sessions: u64,
    },
    /// An import under an existing id has other muscles or markers.
    #[error("the {what} differ from those of the actor's revision {revision}")]
    LayoutChanged {
        /// `muscles` or `markers`.
        what: &'static str,
        /// The newest revision.
        revision: u32,
    },
    /// A stored value cannot be read.
    #[error("the stored {what} cannot be read")]
    Unreadable {
        /// What was stored.
        what: &'static str,
    },
}

impl CatalogueError {
    /// Whether the database itself is broken, so that opening it again will not help.
    pub fn is_damage(&self) -> bool {
        use rusqlite::ErrorCode::{DatabaseCorrupt, NotADatabase};
        let Self::Damaged { source, .. } = self else {
            return false;
        };
        matches!(
            source.sqlite_error_code(),
            Some(DatabaseCorrupt | NotADatabase)
        )
    }

    /// Names the path, for the operator who has to look there.
    fn at(self, dir: &Path) -> Self {
        match self {
            Self::Storage(source) => Self::Directory {
                dir: dir.to_owned(),
                owner: owner::of(dir),
                source,
            },
            Self::Database(source) => Self::Damaged {
                file: dir.join(DATABASE),
                source,
            },
            named => named,
        }
    }
}

/// Actors and sessions of one data directory.
///
/// One process at a time uses a directory; a lock file sees to that, and the system releases it with the process.
#[derive(Debug)]
pub struct Catalogue {
    connection: Mutex<Connection>,
    fs: Arc<dyn Fs>,
    packages: PathBuf,
    /// Held for as long as the catalogue lives.
    _lock: Option<lock::DirectoryLock>,
}

impl Catalogue {
    /// Opens the catalogue in `dir`, making both unless they exist, and removes what a crash left half done.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::InUse`], [`CatalogueError::NewerVersion`], or that the disk or the database failed, with its path.
    pub fn open(dir: &Path) -> Result<Self, CatalogueError> {
        Self::open_in(dir).map_err(|error| error.at(dir))
    }

    fn open_in(dir: &Path) -> Result<Self, CatalogueError> {
        StdFs.create_dir_all(dir)?;
        let lock = lock::DirectoryLock::take(dir)?;
        let connection = Connection::open(dir.join(DATABASE))?;
        StdFs.sync_dir(dir)?;
        Self::start(connection, Arc::new(StdFs), dir, Some(lock))
    }

    /// A catalogue in memory beside a directory whose database is damaged: the directory is locked, and left as it is.
    ///
    /// # Errors
    ///
    /// [`CatalogueError::InUse`], or that the directory cannot be used.
    pub fn stand_in(dir: &Path) -> Result<Self, CatalogueError> {
        let lock = lock::DirectoryLock::take(dir).map_err(|error| error.at(dir))?;
        let connection = Connection::open_in_memory()?;
        let files = Arc::new(MemFs::default());
        Self::start(connection, files, Path::new("/"), Some(lock))
    }

    /// A catalogue that lives in memory and is gone with this value; package bytes go to `files`.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn in_memory(files: MemFs) -> Result<Self, CatalogueError> {
        let connection = Connection::open_in_memory()?;
        Self::start(connection, Arc::new(files), Path::new("/"), None)
    }

    /// A catalogue in the memory database of this name, which lives on while any connection to it is open: a process that
    /// crashes and its successor, in one process. Package bytes go to `files`.
    ///
    /// # Errors
    ///
    /// That the database failed.
    pub fn shared_memory(name: &str, files: MemFs) -> Result<Self, CatalogueError> {
        let connection = Connection::open(format!("file:{name}?mode=memory&cache=shared"))?;
        Self::start(connection, Arc::new(files), Path::new("/"), None)
    }

    fn start(
        mut connection: Connection,
        fs: Arc<dyn Fs>,
        dir: &Path,
        lock: Option<lock::DirectoryLock>,
    ) -> Result<Self, CatalogueError> {
        schema::prepare(&mut connection)?;
        let catalogue = Self {
            connection: Mutex::new(connection),
            fs,
            packages: dir.join("packages"),
            _lock: lock,
        };
        catalogue.fs.create_dir_all(&catalogue.packages)?;
        catalogue.sweep_packages()?;
        catalogue.doom_claimed_takes()?;
        // What was deleted before a crash is not left in the log either.
        catalogue.scrub_log()?;
        Ok(catalogue)
    }

    /// A panic while the lock was held cannot leave the connection in a half state: an open transaction rolls back.
    fn connection(&self) -> MutexGuard<'_, Connection> {
        self.connection
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn h10_a_second_server_on_the_same_directory_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let first = Catalogue::open(dir.path()).unwrap();
        let second = Catalogue::open(dir.path());
        assert!(matches!(second, Err(CatalogueError::InUse { .. })));
        drop(first);
        Catalogue::open(dir.path()).unwrap();
    }

    #[test]
    fn a_catalogue_of_a_newer_server_is_refused_and_left_untouched() {
        let dir = tempfile::tempdir().unwrap();
        drop(Catalogue::open(dir.path()).unwrap());
        let raw = Connection::open(dir.path().join(DATABASE)).unwrap();
        raw.pragma_update(None, "user_version", 99).unwrap();
        drop(raw);
        let refused = Catalogue::open(dir.path());
        assert!(matches!(
            refused,
            Err(CatalogueError::NewerVersion { found: 99, .. })
        ));
    }

    #[test]
    fn a_damaged_database_and_an_unusable_directory_are_named_by_their_path() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join(DATABASE);
        std::fs::write(&file, vec![b'x'; 8_192]).unwrap();
        let damaged = Catalogue::open(dir.path()).unwrap_err();
        assert!(matches!(damaged, CatalogueError::Damaged { .. }));
        assert!(damaged.to_string().contains(file.to_str().unwrap()));
        let unusable = Catalogue::open(&file).unwrap_err();
        assert!(matches!(unusable, CatalogueError::Directory { .. }));
        assert!(unusable.to_string().contains(file.to_str().unwrap()));
    }

    #[test]
    fn commits_are_full_and_synchronous() {
        let dir = tempfile::tempdir().unwrap();
        let catalogue = Catalogue::open(dir.path()).unwrap();
        let ask = |pragma: &str| -> String {
            catalogue
                .connection()
                .pragma_query_value(None, pragma, |row| {
                    row.get::<_, rusqlite::types::Value>(0)
                        .map(|it| format!("{it:?}"))
                })
                .unwrap()
        };
        assert_eq!(ask("journal_mode"), "Text(\"wal\")");
        assert_eq!(ask("synchronous"), "Integer(2)");
    }
}
