//! Where a server keeps what it keeps: the data directory, memory, or what is left of a damaged directory.

use std::{
    io,
    path::{Path, PathBuf},
    sync::Arc,
};

use crate::{
    catalogue::{Catalogue, CatalogueError, Store},
    config::Config,
    executor::Workers,
    fs::{Fs, MemFs, StdFs},
};

/// The folder of takes in the data directory.
const TAKES: &str = "takes";

/// The files of takes, and where they are.
#[derive(Clone, Debug)]
pub struct TakeFiles {
    /// The file system that holds them.
    pub fs: Arc<dyn Fs>,
    /// Their directory.
    pub dir: PathBuf,
}

impl TakeFiles {
    /// Those of a configuration's data directory.
    pub fn of(config: &Config) -> Self {
        match config.directory() {
            Some(directory) => Self {
                fs: Arc::new(StdFs),
                dir: directory.join(TAKES),
            },
            None => Self::on(Arc::new(MemFs::default())),
        }
    }

    /// Those of a file system of its own.
    pub fn on(fs: Arc<dyn Fs>) -> Self {
        Self {
            fs,
            dir: Path::new("/").join(TAKES),
        }
    }

    pub(super) fn make_dir(&self) -> io::Result<()> {
        self.fs.create_dir_all(&self.dir)
    }
}

/// Rows and packages, opened.
pub(super) struct Opened {
    pub(super) store: Store,
    /// Why nothing may be changed: the database is damaged, and the store stands in for it.
    pub(super) rescue: Option<String>,
}

pub(super) async fn open(
    config: &Config,
    heavy: Workers,
    cached_actors: usize,
) -> Result<Opened, CatalogueError> {
    // One connection to the database, so one worker: commits come one after the other anyway.
    let commits = Workers::pool(1);
    let directory = config.directory();
    let opened = commits.run(move || match directory {
        Some(directory) => open_directory(&directory),
        None => Ok((Catalogue::in_memory(MemFs::default())?, None)),
    });
    let (catalogue, rescue) = opened.await?;
    let store = Store::new(catalogue, commits, heavy, cached_actors);
    Ok(Opened { store, rescue })
}

fn open_directory(directory: &Path) -> Result<(Catalogue, Option<String>), CatalogueError> {
    match Catalogue::open(directory) {
        Err(error) if error.is_damage() => {
            let why = with_cause(&error);
            Ok((Catalogue::stand_in(directory)?, Some(why)))
        }
        opened => Ok((opened?, None)),
    }
}

fn with_cause(error: &CatalogueError) -> String {
    use std::error::Error as _;
    match error.source() {
        Some(cause) => format!("{error}: {cause}"),
        None => error.to_string(),
    }
}
