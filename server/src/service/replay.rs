//! Samples that a session no longer keeps, out of its takes (CONTRACTS D-17, D-18).
//!
//! Takes and the live window of a session are joined here: the hub knows no take, and a take no subscriber.

mod reading;

use std::{
    collections::BTreeMap,
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use tonic::{Code, Status};

pub use self::reading::{Replay, Step};
use super::grpc::status::refuse;
use crate::{
    catalogue::{CatalogueError, Store, TakeFilter, TakeRow, TakeState},
    fs::Fs,
    name::{SessionId, TakeId},
    take::{Growth, Recorder, SampleReader, SampleSpan, TakeFileError, file_name, header},
};

/// Takes of a session that are looked at together.
const ROWS_AT_ONCE: usize = 256;

/// Takes that are over and of which it stays known what they hold, 100 bytes each.
const MAX_KNOWN_SPANS: usize = 4_096;

/// What the takes of all sessions hold. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Replays {
    store: Store,
    recorder: Recorder,
    fs: Arc<dyn Fs>,
    dir: PathBuf,
    spans: Arc<Mutex<BTreeMap<TakeId, Option<SampleSpan>>>>,
}

/// What one take holds of a run.
#[derive(Clone, Debug)]
pub struct Held {
    id: TakeId,
    /// Its first sample.
    pub first: u64,
    /// The frame of that.
    pub first_frame: u64,
    /// Its last sample; none while it grows.
    last: Option<u64>,
    growth: Option<Arc<Growth>>,
}

impl Held {
    fn is_empty(&self) -> bool {
        self.last.is_some_and(|last| last < self.first)
    }

    fn has(&self, sequence: u64) -> bool {
        self.first <= sequence && self.last.is_none_or(|last| sequence <= last)
    }
}

impl Replays {
    /// Reads the takes that `recorder` writes into `dir`.
    pub fn new(store: Store, recorder: Recorder, fs: Arc<dyn Fs>, dir: PathBuf) -> Self {
        Self {
            store,
            recorder,
            fs,
            dir,
            spans: Arc::default(),
        }
    }

    /// What takes hold of a run of a session, in order.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn held(&self, session: &SessionId, run: u64) -> Result<Vec<Held>, Status> {
        let filter = TakeFilter {
            session: Some(session.clone()),
            ..TakeFilter::default()
        };
        let (mut held, mut after) = (Vec::new(), String::new());
        loop {
            let rows = self
                .store
                .takes(filter.clone(), after.clone(), ROWS_AT_ONCE)
                .await?;
            // What was solved again was never sent to anybody.
            for row in rows.iter().filter(|it| it.resolved_from.is_none()) {
                held.extend(self.held_by(row, run).await);
            }
            match rows.last() {
                Some(last) if rows.len() == ROWS_AT_ONCE => after = last.id.to_string(),
                _ => break,
            }
        }
        held.sort_by_key(|it| it.first);
        Ok(held)
    }

    async fn held_by(&self, row: &TakeRow, run: u64) -> Option<Held> {
        let id = row.id.clone();
        if let Some(growth) = self.recorder.growth(&id) {
            let (first, first_frame) = growth.first_sample().filter(|_| growth.run() == run)?;
            return Some(Held {
                id,
                first,
                first_frame,
                last: None,
                growth: Some(growth),
            });
        }
        let span = self.span(row).await.filter(|it| it.run == run)?;
        Some(Held {
            id,
            first: span.first,
            first_frame: span.first_frame,
            last: Some(span.last),
            growth: None,
        })
    }

    /// What a take that is over holds. One that cannot be read holds nothing, and says so in the log.
    async fn span(&self, row: &TakeRow) -> Option<SampleSpan> {
        if row.state == TakeState::Quarantined {
            return None;
        }
        if let Some(known) = self.spans().get(&row.id) {
            return *known;
        }
        let (fs, file) = (Arc::clone(&self.fs), self.dir.join(file_name(&row.id)));
        let name = row.id.resource();
        let read = move || {
            // A file of another take is not replayed under this one's name.
            let is_own = header(&*fs, &file)?.is_some_and(|it| it.take == name);
            if is_own {
                SampleReader::span(&*fs, &file)
            } else {
                Ok(None)
            }
        };
        match self.recorder.read(read).await {
            // One that is just about to begin, or over and not yet said to be, may change.
            Ok(span) if row.state == TakeState::Recording => span,
            Ok(span) => {
                self.know_span(row.id.clone(), span);
                span
            }
            Err(error) => {
                let error = &error as &dyn std::error::Error;
                tracing::warn!(take = %row.id, error, "a take cannot be replayed");
                None
            }
        }
    }

    fn spans(&self) -> MutexGuard<'_, BTreeMap<TakeId, Option<SampleSpan>>> {
        self.spans.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn know_span(&self, id: TakeId, span: Option<SampleSpan>) {
        let mut spans = self.spans();
        if spans.len() >= MAX_KNOWN_SPANS {
            spans.pop_first();
        }
        spans.insert(id, span);
    }

    /// A replay from sample `sequence` on, for somebody who knows of all frames through `last_frame`; none when no take has it.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn find(
        &self,
        session: &SessionId,
        run: u64,
        sequence: u64,
        last_frame: u64,
    ) -> Result<Option<Replay>, Status> {
        let held = self.held(session, run).await?;
        let take = held.into_iter().find(|it| it.has(sequence));
        Ok(take.map(|it| self.replay(it, sequence, last_frame)))
    }

    /// The end of a run that is over: a replay from sample `sequence` on, which may come after the last, for somebody who knows
    /// of all frames through `last_frame`. Whoever was served live may have had samples that a crash kept from the take; what the
    /// take says of the frames behind them is still news.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn find_at_end(
        &self,
        session: &SessionId,
        run: u64,
        sequence: u64,
        last_frame: u64,
    ) -> Result<Option<Replay>, Status> {
        let mut held = self.held(session, run).await?;
        let is_before = |it: &Held| it.last.is_some_and(|last| last < sequence);
        let idx = held.iter().position(|it| it.has(sequence));
        let idx = idx.or_else(|| held.iter().rposition(is_before));
        Ok(idx.map(|idx| self.replay(held.swap_remove(idx), sequence, last_frame)))
    }

    fn replay(&self, held: Held, sequence: u64, last_frame: u64) -> Replay {
        Replay::new(self.clone(), held, sequence, last_frame)
    }

    /// The first sample from which on nothing is missing up to sample `kept_from`, the oldest that the session keeps.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn oldest(
        &self,
        session: &SessionId,
        run: u64,
        kept_from: u64,
    ) -> Result<u64, Status> {
        let held = self.held(session, run).await?;
        let reaches = |it: &Held, sequence: u64| it.last.is_none_or(|last| last + 1 >= sequence);
        let takes = held.iter().rev();
        Ok(takes.fold(kept_from, |oldest, take| {
            if take.first < oldest && reaches(take, oldest) {
                take.first
            } else {
                oldest
            }
        }))
    }

    /// The first sample that a take has after `sequence`, and its frame.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn first_after(
        &self,
        session: &SessionId,
        run: u64,
        sequence: u64,
    ) -> Result<Option<(u64, u64)>, Status> {
        let held = self.held(session, run).await?;
        let mut samples = held.iter().filter(|it| !it.is_empty());
        let later = samples.find(|it| it.first > sequence);
        Ok(later.map(|it| (it.first, it.first_frame)))
    }
}

fn unreadable(id: &TakeId, error: &TakeFileError) -> Status {
    let cause = error as &dyn std::error::Error;
    tracing::error!(take = %id, error = cause, "a take cannot be read");
    match error {
        TakeFileError::Io(_) => {
            CatalogueError::Storage(std::io::Error::other("a take cannot be read")).into()
        }
        TakeFileError::Scan(_) | TakeFileError::Format(_) => refuse(
            Code::Internal,
            "STORAGE",
            format!("the file of {} cannot be read", id.resource()),
        ),
    }
}
