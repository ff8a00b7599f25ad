//! What one server stands on: its catalogue, its files, its audit log, and the threads that work for it.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{RunError, count};
use crate::{
    catalogue::{Catalogue, CatalogueError, Store},
    config::Config,
    executor::{Threads, Workers},
    fs::{Fs, MemFs, StdFs},
    service::audit::AuditLog,
};

/// The folder of takes in the data directory.
const TAKES: &str = "takes";

/// What a server keeps things in, and who does its long work.
pub struct Ground {
    pub(super) store: Store,
    pub(super) heavy: Workers,
    pub(super) threads: Threads,
    pub(super) files: Arc<dyn Fs>,
    /// Where in `files` takes are.
    pub(super) takes: PathBuf,
    pub(super) audit_log: AuditLog,
    /// Why nothing may be changed: the catalogue is damaged, and one in memory stands in for it.
    pub(super) rescue: Option<String>,
}

impl Ground {
    /// The data directory of `config`, or memory; see [`crate::config::IN_MEMORY`].
    ///
    /// # Errors
    ///
    /// That the directory cannot be used.
    pub(super) async fn of(config: &Config) -> Result<Self, RunError> {
        let threads = Threads::Pools;
        // One connection to the database, so one worker: commits come one after the other anyway.
        let commits = threads.workers(1);
        let directory = config.directory();
        let opened = commits.run(move || match directory {
            Some(directory) => open(&directory),
            None => Ok((Catalogue::in_memory(MemFs::default())?, None)),
        });
        let (catalogue, rescue) = opened.await?;
        let heavy = threads.workers(count(config.workers));
        let cached = count(config.limits.cached_actors);
        let store = Store::new(catalogue, commits, heavy.clone(), cached);
        let (files, root): (Arc<dyn Fs>, _) = match config.directory() {
            Some(directory) => (Arc::new(StdFs), directory),
            None => (Arc::new(MemFs::default()), PathBuf::from("/")),
        };
        let audit_log = match config.directory() {
            Some(directory) => AuditLog::open(&directory).map_err(RunError::Audit)?,
            None => AuditLog::in_memory(),
        };
        Ok(Self {
            store,
            heavy,
            threads,
            files,
            takes: root.join(TAKES),
            audit_log,
            rescue,
        })
    }

    /// Memory, but for takes, which are kept in `files`: a disk that a test may let fail.
    ///
    /// # Errors
    ///
    /// That the database cannot be used.
    pub fn with_takes_in(config: &Config, files: Arc<dyn Fs>) -> Result<Self, CatalogueError> {
        let threads = Threads::Pools;
        let catalogue = Catalogue::in_memory(MemFs::default())?;
        let heavy = threads.workers(count(config.workers));
        let cached = count(config.limits.cached_actors);
        Ok(Self {
            store: Store::new(catalogue, threads.workers(1), heavy.clone(), cached),
            heavy,
            threads,
            files,
            takes: PathBuf::from("/").join(TAKES),
            audit_log: AuditLog::in_memory(),
            rescue: None,
        })
    }

    /// Memory that outlives the server, and no thread but the caller's: for simulations.
    ///
    /// `database` is the name of a database in memory that lives while any connection to it does
    /// ([`Catalogue::shared_memory`]); `files` holds packages and takes.
    ///
    /// # Errors
    ///
    /// That the database cannot be used.
    pub fn simulated(
        config: &Config,
        database: &str,
        files: MemFs,
    ) -> Result<Self, CatalogueError> {
        let threads = Threads::Inline;
        let catalogue = Catalogue::shared_memory(database, files.clone())?;
        let heavy = threads.workers(1);
        let cached = count(config.limits.cached_actors);
        Ok(Self {
            store: Store::new(catalogue, threads.workers(1), heavy.clone(), cached),
            heavy,
            threads,
            files: Arc::new(files),
            takes: PathBuf::from("/").join(TAKES),
            audit_log: AuditLog::in_memory(),
            rescue: None,
        })
    }
}

/// The catalogue of a directory, or one in memory beside it and why.
fn open(directory: &Path) -> Result<(Catalogue, Option<String>), CatalogueError> {
    use std::error::Error as _;
    match Catalogue::open(directory) {
        Err(error) if error.is_damage() => {
            let cause = error.source().map(|it| format!(": {it}"));
            let why = format!("{error}{}", cause.unwrap_or_default());
            Ok((Catalogue::stand_in(directory)?, Some(why)))
        }
        opened => Ok((opened?, None)),
    }
}
