//! A small file that only its owner reads, changed by one process at a time and never half.
//!
//! The new text is written beside the old, flushed, and renamed over it; the folder is locked meanwhile, so that two
//! edits at once do not lose one of them.

use std::{
    fs::{self, File, OpenOptions, Permissions},
    io::{self, ErrorKind, Write as _},
    os::unix::fs::{
        DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _, fchown,
    },
    path::{Path, PathBuf},
    time::Duration,
};

use anyhow::{Context as _, bail};
use rustix::fs::{FlockOperation, flock};
use tokio::time::{Instant, sleep};

/// Larger than any file of this kind; an upper bound for a wrong path.
const MAX_BYTES: u64 = 4 << 20;
/// An edit takes milliseconds; who holds the lock longer hangs.
const LOCK_TIMEOUT: Duration = Duration::from_secs(5);
const LOCK_POLL: Duration = Duration::from_millis(20);
/// Read and written by its owner.
const OWNER_ONLY: u32 = 0o600;
/// What an existing file may keep beyond that: its group reads.
const KEPT_MODE: u32 = 0o040;

/// The text of the file; `None` when there is no such file.
pub fn read(path: &Path) -> anyhow::Result<Option<String>> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error).with_context(|| format!("cannot read {}", path.display())),
    };
    if metadata.len() > MAX_BYTES {
        bail!(
            "{} has {} bytes; a file of this kind has at most {MAX_BYTES}",
            path.display(),
            metadata.len()
        );
    }
    let text = fs::read_to_string(path);
    text.map(Some)
        .with_context(|| format!("cannot read {}", path.display()))
}

/// Replaces the text of the file by what `change` makes of it; nothing changes when it fails.
pub async fn update<T>(
    path: &Path,
    change: impl FnOnce(Option<String>) -> anyhow::Result<(String, T)>,
) -> anyhow::Result<T> {
    // A link stays a link: what it points to is replaced.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = folder_of(&path);
    let locked = lock(&folder).await?;
    let (text, result) = change(read(&path)?)?;
    replace(&path, &folder, &text).with_context(|| format!("cannot write {}", path.display()))?;
    locked
        .sync_all()
        .with_context(|| format!("cannot flush {}", folder.display()))?;
    Ok(result)
}

/// Makes a folder, and those above it, that only its owner enters.
pub fn create_folder(folder: &Path) -> anyhow::Result<()> {
    fs::DirBuilder::new()
        .recursive(true)
        .mode(0o700)
        .create(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// The folder, locked until it is dropped.
async fn lock(folder: &Path) -> anyhow::Result<File> {
    let opened = File::open(folder)
        .with_context(|| format!("cannot open the folder {}", folder.display()))?;
    let begun = Instant::now();
    loop {
        match flock(&opened, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => return Ok(opened),
            Err(rustix::io::Errno::WOULDBLOCK) if begun.elapsed() < LOCK_TIMEOUT => {
                sleep(LOCK_POLL).await;
            }
            Err(rustix::io::Errno::WOULDBLOCK) => bail!(
                "another program has locked {} for {} s",
                folder.display(),
                LOCK_TIMEOUT.as_secs()
            ),
            Err(error) => {
                return Err(io::Error::from(error))
                    .with_context(|| format!("cannot lock {}", folder.display()));
            }
        }
    }
}

/// The lock keeps the temporary name free of others; one that a crash left behind is removed.
fn replace(path: &Path, folder: &Path, text: &str) -> io::Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = folder.join(format!(".{name}.new"));
    match fs::remove_file(&temporary) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut file = OpenOptions::new()
        .write(true)
        .create_new(true)
        .mode(OWNER_ONLY)
        .open(&temporary)?;
    let written = keep_owner(path, &file)
        .and_then(|()| file.write_all(text.as_bytes()))
        .and_then(|()| file.sync_all())
        .and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        drop(fs::remove_file(&temporary));
    }
    written
}

/// A server that reads the file as another user or by its group still can after the change.
fn keep_owner(path: &Path, file: &File) -> io::Result<()> {
    let Ok(before) = fs::metadata(path) else {
        return Ok(());
    };
    let now = file.metadata()?;
    if (before.uid(), before.gid()) != (now.uid(), now.gid()) {
        fchown(file, Some(before.uid()), Some(before.gid()))?;
    }
    let mode = OWNER_ONLY | (before.mode() & KEPT_MODE);
    file.set_permissions(Permissions::from_mode(mode))
}

#[cfg(test)]
mod tests {
    use super::*;

    async fn append(path: &Path, line: &str) -> anyhow::Result<()> {
        update(path, |before| {
            Ok((format!("{}{line}\n", before.unwrap_or_default()), ()))
        })
        .await
    }

    #[tokio::test]
    async fn only_the_owner_reads_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("secret");
        assert_eq!(read(&path).unwrap(), None);
        append(&path, "a").await.unwrap();
        assert_eq!(read(&path).unwrap().unwrap(), "a\n");
        let mode = |path: &Path| fs::metadata(path).unwrap().mode() & 0o777;
        assert_eq!(mode(&path), 0o600);
        // A group that was let in stays, everybody else leaves.
        fs::set_permissions(&path, Permissions::from_mode(0o664)).unwrap();
        append(&path, "b").await.unwrap();
        assert_eq!(mode(&path), 0o640);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[tokio::test]
    async fn a_change_that_fails_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("secret");
        append(&path, "a").await.unwrap();
        let failed: anyhow::Result<()> = update(&path, |_| bail!("no")).await;
        assert!(failed.is_err());
        assert_eq!(read(&path).unwrap().unwrap(), "a\n");
    }

    #[tokio::test]
    async fn what_a_crash_left_behind_is_no_obstacle() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("secret");
        fs::write(folder.path().join(".secret.new"), "half").unwrap();
        append(&path, "a").await.unwrap();
        assert_eq!(read(&path).unwrap().unwrap(), "a\n");
    }

    #[tokio::test]
    async fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (link, path) = (folder.path().join("link"), folder.path().join("secret"));
        append(&path, "a").await.unwrap();
        std::os::unix::fs::symlink(&path, &link).unwrap();
        append(&link, "b").await.unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(read(&path).unwrap().unwrap(), "a\nb\n");
    }

    #[tokio::test(flavor = "multi_thread", worker_threads = 4)]
    async fn of_many_changes_at_once_none_is_lost() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("secret");
        let mut editors = tokio::task::JoinSet::new();
        for number in 0..8 {
            let path = path.clone();
            editors.spawn(async move {
                for _ in 0..5 {
                    append(&path, &number.to_string()).await.unwrap();
                }
            });
        }
        editors.join_all().await;
        assert_eq!(read(&path).unwrap().unwrap().lines().count(), 40);
    }
}
