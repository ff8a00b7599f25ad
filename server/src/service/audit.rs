//! The audit log: who did what, from where, with which result (CONTRACTS S-12).
//!
//! One line of JSON an entry, each with the hash of the one before ([`frontalis_access::ChainEnd`]); written by one task in
//! the order of the entries.
//! Nobody waits for it: when too many wait for the disk, entries are counted instead of kept, and the next line says how
//! many.

mod log;

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicU64, Ordering},
};

use tokio::{sync::mpsc, time::Instant};

use super::peer::Peer;

pub use log::{AuditLog, FILE_NAME};

/// Entries that may wait for the disk.
const CAPACITY: usize = 1_024;
/// Failures to authenticate that are written in a minute, of all addresses together; others are counted, so that
/// nobody can fill the disk from outside.
const FAILURES_PER_MINUTE: u32 = 30;
/// Longest text of one field, characters.
pub(super) const MAX_FIELD: usize = 256;

/// Where entries go; cheap to clone.
#[derive(Clone, Debug)]
pub struct Audit(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    entries: mpsc::Sender<Entry>,
    /// Entries that were not kept since the last that was.
    n_left_out: AtomicU64,
    failures: Mutex<Failures>,
}

/// How many failures were written in this minute.
#[derive(Debug)]
struct Failures {
    since: Instant,
    n_written: u32,
}

/// One thing that happened. Texts are cut at 256 characters; none of them may be a token or a coordinate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    event: &'static str,
    who: String,
    from: String,
    object: String,
    result: String,
    n_left_out: u64,
}

impl Entry {
    /// What `peer` did to `object`.
    pub fn new(event: &'static str, peer: &Peer, object: &str, result: &str) -> Self {
        let caller = &peer.caller;
        let address = peer.address.map_or_else(String::new, |it| it.to_string());
        Self {
            event,
            who: cut(&format!("{} ({})", caller.key(), caller.name())),
            from: format!("{} {}", peer.door.name(), address),
            object: cut(object),
            result: cut(result),
            n_left_out: 0,
        }
    }

    /// What the server did to `object` of itself.
    pub fn of_server(event: &'static str, object: &str, result: &str) -> Self {
        Self {
            event,
            who: "server".to_owned(),
            from: String::new(),
            object: cut(object),
            result: cut(result),
            n_left_out: 0,
        }
    }
}

fn cut(text: &str) -> String {
    text.chars().take(MAX_FIELD).collect()
}

impl Audit {
    /// Entries, and where [`AuditLog::run`] reads them.
    pub fn new() -> (Self, mpsc::Receiver<Entry>) {
        let (entries, kept) = mpsc::channel(CAPACITY);
        let failures = Failures {
            since: Instant::now(),
            n_written: 0,
        };
        let inner = Inner {
            entries,
            n_left_out: AtomicU64::new(0),
            failures: Mutex::new(failures),
        };
        (Self(Arc::new(inner)), kept)
    }

    /// Keeps nothing; for tests.
    pub fn none() -> Self {
        Self::new().0
    }

    /// Writes an entry down.
    pub fn note(&self, mut entry: Entry) {
        tracing::info!(
            target: "audit",
            event = entry.event,
            who = ?entry.who,
            from = %entry.from,
            object = ?entry.object,
            result = ?entry.result,
        );
        entry.n_left_out = self.0.n_left_out.swap(0, Ordering::Relaxed);
        if let Err(refused) = self.0.entries.try_send(entry) {
            let (mpsc::error::TrySendError::Full(entry) | mpsc::error::TrySendError::Closed(entry)) =
                refused;
            let n_lost = entry.n_left_out + 1;
            self.0.n_left_out.fetch_add(n_lost, Ordering::Relaxed);
        }
    }

    /// Writes a call's outcome down, and passes it on.
    ///
    /// # Errors
    ///
    /// The call's own.
    pub fn outcome<T>(
        &self,
        event: &'static str,
        peer: &Peer,
        object: &str,
        outcome: Result<T, tonic::Status>,
    ) -> Result<T, tonic::Status> {
        let result = match &outcome {
            Ok(_) => "ok".to_owned(),
            Err(status) => super::grpc::status::reason_of(status).unwrap_or_default(),
        };
        self.note(Entry::new(event, peer, object, &result));
        outcome
    }

    /// Writes a failure to authenticate down, unless there were many in this minute.
    pub(super) fn failure(&self, entry: Entry) {
        if self.may_write_failure() {
            self.note(entry);
        } else {
            self.suppressed();
        }
    }

    /// Counts what is not written down.
    pub(super) fn suppressed(&self) {
        self.0.n_left_out.fetch_add(1, Ordering::Relaxed);
    }

    fn may_write_failure(&self) -> bool {
        let now = Instant::now();
        let failures = self.0.failures.lock();
        let mut failures = failures.unwrap_or_else(PoisonError::into_inner);
        if now.duration_since(failures.since).as_secs() >= 60 {
            *failures = Failures {
                since: now,
                n_written: 0,
            };
        }
        failures.n_written += 1;
        failures.n_written <= FAILURES_PER_MINUTE
    }
}
