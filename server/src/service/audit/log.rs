//! The file of the audit log: opened once, only ever appended to, each batch flushed to the disk.

use std::{
    fs::{File, OpenOptions},
    io::{self, Read as _, Seek as _, SeekFrom, Write as _},
    os::unix::fs::OpenOptionsExt as _,
    path::Path,
};

use frontalis_access::{AuditLine, ChainEnd, UnixTime};
use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

use super::Entry;
use crate::clock::wall_now;

/// Name of the log in the data directory.
pub const FILE_NAME: &str = "audit.log";

/// The end of a log that is read to go on after it, bytes; many times the longest line.
const MAX_TAIL_BYTES: u64 = 64 * 1024;
/// Entries that are written with one flush.
const BATCH: usize = 64;

/// Writes entries; there is one in a server.
#[derive(Debug)]
pub struct AuditLog {
    /// None: the server keeps everything in memory, and entries go to the log of the process alone.
    file: Option<File>,
    end: ChainEnd,
    /// The file ends in a line that was not written whole.
    is_torn: bool,
}

impl AuditLog {
    /// Keeps nothing.
    pub fn in_memory() -> Self {
        Self {
            file: None,
            end: ChainEnd::default(),
            is_torn: false,
        }
    }

    /// Goes on after what `directory` has.
    ///
    /// # Errors
    ///
    /// As the system says.
    pub fn open(directory: &Path) -> io::Result<Self> {
        let mut file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .mode(0o600)
            .open(directory.join(FILE_NAME))?;
        let text = read_end(&mut file)?;
        let (end, is_torn) = joint(&text, &ChainEnd::default());
        tracing::info!(
            sequence = end.sequence,
            hash = end.hash,
            "the audit log goes on"
        );
        Ok(Self {
            file: Some(file),
            end,
            is_torn,
        })
    }

    /// Runs until `drained`, then writes what is left in the channel.
    pub async fn run(mut self, mut entries: mpsc::Receiver<Entry>, drained: CancellationToken) {
        let mut batch = Vec::with_capacity(BATCH);
        loop {
            tokio::select! {
                biased;
                n = entries.recv_many(&mut batch, BATCH) => if n == 0 { return },
                () = drained.cancelled() => break,
            }
            self = self.write(std::mem::take(&mut batch)).await;
        }
        while let Ok(entry) = entries.try_recv() {
            self = self.write(vec![entry]).await;
        }
    }

    async fn write(mut self, batch: Vec<Entry>) -> Self {
        let write = move || {
            if let Err(error) = self.append(batch) {
                tracing::error!(%error, "the audit log cannot be written");
                self.look_again();
            }
            self
        };
        match tokio::task::spawn_blocking(write).await {
            Ok(log) => log,
            Err(error) => {
                tracing::error!(%error, "the audit log was lost");
                Self::in_memory()
            }
        }
    }

    /// After a failure: what came of the batch may be all, nothing, or half a line.
    fn look_again(&mut self) {
        let text = self.file.as_mut().map(read_end);
        match text {
            Some(Ok(text)) => (self.end, self.is_torn) = joint(&text, &self.end),
            _ => self.is_torn = true,
        }
    }

    fn append(&mut self, batch: Vec<Entry>) -> io::Result<()> {
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        let time = UnixTime::from(wall_now()).to_string();
        let mut end = self.end.clone();
        let mut text = String::new();
        if self.is_torn {
            text.push('\n');
            let torn = Entry::of_server(AuditLine::TORN, "", "go on");
            text.push_str(&end.append(line(torn, &time)));
        }
        for entry in batch {
            text.push_str(&end.append(line(entry, &time)));
        }
        file.write_all(text.as_bytes())?;
        file.sync_data()?;
        self.end = end;
        self.is_torn = false;
        Ok(())
    }
}

/// The newest line that is whole, and whether something that is none comes after it.
fn joint(text: &str, before: &ChainEnd) -> (ChainEnd, bool) {
    let newest = text.lines().rev().find_map(ChainEnd::of_line);
    let last = text.lines().next_back().and_then(ChainEnd::of_line);
    let is_whole = text.is_empty() || text.ends_with('\n') && last.is_some();
    (newest.unwrap_or_else(|| before.clone()), !is_whole)
}

fn read_end(file: &mut File) -> io::Result<String> {
    let length = file.metadata()?.len();
    let start = length.saturating_sub(MAX_TAIL_BYTES);
    file.seek(SeekFrom::Start(start))?;
    let mut bytes = Vec::new();
    file.take(MAX_TAIL_BYTES).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn line(entry: Entry, time: &str) -> AuditLine {
    AuditLine {
        sequence: 0,
        time: time.to_owned(),
        event: entry.event.to_owned(),
        who: entry.who,
        from: entry.from,
        object: entry.object,
        result: entry.result,
        left_out: entry.n_left_out,
        previous: String::new(),
    }
}

#[cfg(test)]
mod tests {
    use frontalis_access::verify_chain;

    use super::*;

    fn note(log: &mut AuditLog, event: &'static str) {
        log.append(vec![Entry::of_server(event, "", "ok")]).unwrap();
    }

    #[test]
    fn a_log_goes_on_after_a_restart_and_after_a_line_that_was_cut() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE_NAME);
        let entries = || {
            let report = verify_chain(&std::fs::read(&path).unwrap()[..]).unwrap();
            report.first_broken.map_or(Ok(report.end.sequence), Err)
        };
        let mut log = AuditLog::open(folder.path()).unwrap();
        note(&mut log, "a");
        note(&mut log, "b");
        drop(log);
        note(&mut AuditLog::open(folder.path()).unwrap(), "c");
        assert_eq!(entries(), Ok(3));
        let whole = std::fs::read_to_string(&path).unwrap();
        for at in whole.rfind("{\"sequence\":3").unwrap() + 1..whole.len() {
            std::fs::write(&path, &whole[..at]).unwrap();
            note(&mut AuditLog::open(folder.path()).unwrap(), "d");
            // Two whole lines, what says that one was cut, and the new one. A whole line without its end counts as cut.
            let n_entries = entries().unwrap_or_else(|line| panic!("cut at {at}: line {line}"));
            assert!((4..=5).contains(&n_entries), "cut at {at}: {n_entries}");
        }
    }
}
