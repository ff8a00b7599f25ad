//! Takes as every door sees them: what is being recorded joined with what the catalogue keeps.

mod erasing;
mod previous;
mod recovery;
mod resolve;

use std::{io, path::PathBuf, sync::Arc, time::Duration};

use frontalis_proto::v1;
use sha2::{Digest as _, Sha256};
use tokio::sync::{Semaphore, watch};
use tonic::Status;

use self::recovery::RecoveryProgress;
pub use self::{previous::RecordedRun, recovery::LeftOver};
use super::{grpc::status::refuse, readiness::disk_low, replay::Replays};
use crate::{
    catalogue::{CatalogueError, Store, TakeContent, TakeFilter, TakeLabels, TakeRow, TakeState},
    clock::ServerClock,
    config::RESOLVES,
    executor::{Threads, Workers},
    fs::Fs,
    name::{SessionId, TakeId},
    session::{SessionHandle, SessionRegistry},
    take::{Condition, EndedTake, ExportSource, Recorder, StartError, TakeUnderWay, file_name},
    wire::{self, page::Page, session::effective, take::NewTake},
};

pub use resolve::ResolveOrder;

/// Rows that are looked at together for a caller who sees few of them.
const ROWS_AT_ONCE: usize = 256;

/// All takes of a server. Cheap to clone.
#[derive(Clone)]
pub struct Takes {
    store: Store,
    registry: SessionRegistry,
    recorder: Recorder,
    clock: ServerClock,
    fs: Arc<dyn Fs>,
    dir: PathBuf,
    /// One permit a re-solve.
    resolves: Arc<Semaphore>,
    resolvers: Workers,
    recovery: RecoveryProgress,
}

impl Takes {
    /// Joins the recorder into `dir`, which is made unless it exists, with the catalogue.
    ///
    /// # Errors
    ///
    /// That there can be no such directory.
    pub fn new(
        threads: Threads,
        store: Store,
        registry: SessionRegistry,
        clock: ServerClock,
        fs: Arc<dyn Fs>,
        dir: PathBuf,
    ) -> io::Result<Self> {
        fs.create_dir_all(&dir)?;
        Ok(Self {
            recorder: Recorder::new(threads, Arc::clone(&fs), dir.clone(), clock),
            store,
            registry,
            clock,
            fs,
            dir,
            resolves: Arc::new(Semaphore::new(RESOLVES)),
            resolvers: threads.workers(RESOLVES),
            recovery: RecoveryProgress::default(),
        })
    }

    /// What replays them to subscribers.
    pub fn replays(&self) -> Replays {
        Replays::new(
            self.store.clone(),
            self.recorder.clone(),
            Arc::clone(&self.fs),
            self.dir.clone(),
        )
    }

    /// What records.
    pub fn recorder(&self) -> &Recorder {
        &self.recorder
    }

    /// Starts to record a session. What it acknowledges from then on is in the take.
    ///
    /// # Errors
    ///
    /// `SESSION`, `TAKE_RECORDING`, `DISK_LOW`, or that the storage failed.
    pub async fn start(&self, session: &SessionId, new: NewTake) -> Result<TakeRow, Status> {
        let handle = self.registry.get(session)?;
        handle.check_open()?;
        let start_time_nanos = self.unix_now();
        let row = TakeRow {
            id: take_id(session, start_time_nanos),
            session: session.clone(),
            actor: handle.actor_id().clone(),
            actor_revision: handle.actor_revision(),
            labels: new.labels,
            start_time_nanos,
            stop_time_nanos: None,
            content: TakeContent::default(),
            state: TakeState::Recording,
            recovered: false,
            resolved_from: None,
            start_timecode: None,
            with_images: new.with_images,
        };
        let row = self.store.add_take(row).await?;
        let begun = self.begin(&row, handle, new.pre_roll).await;
        if begun.is_err() {
            self.store.forget_take(&row.id).await?;
        }
        begun.map(|()| row)
    }

    async fn begin(
        &self,
        row: &TakeRow,
        handle: SessionHandle,
        pre_roll: Duration,
    ) -> Result<(), Status> {
        let header = self.header(row, &handle).await?;
        let started = self
            .recorder
            .start(row.id.clone(), handle, header, pre_roll)
            .await;
        let ended = started.map_err(|error| start_status(&error))?;
        let this = self.clone();
        self.recorder
            .spawn(async move { this.keep_end(ended).await });
        Ok(())
    }

    async fn header(
        &self,
        row: &TakeRow,
        handle: &SessionHandle,
    ) -> Result<v1::TakeHeader, Status> {
        let actor = handle.actor();
        let package = self.store.package(&row.actor, row.actor_revision).await?;
        let muscles = actor.muscle_set().muscles().iter();
        Ok(v1::TakeHeader {
            take: row.id.resource(),
            session: row.session.resource(),
            run: handle.run(),
            actor: row.actor.resource(),
            actor_revision: row.actor_revision,
            package_sha256: self.recorder.run(move || sha256(&package)).await,
            settings: Some(effective(&handle.settings())),
            slate: row.labels.slate.clone(),
            number: row.labels.number,
            gesture: row.labels.gesture.clone(),
            start_time: Some(crate::wire::actor::timestamp(row.start_time_nanos)),
            controls: muscles.map(|it| it.name.clone()).collect(),
            markers: actor.markers().iter().map(|it| it.name.clone()).collect(),
            server_version: env!("CARGO_PKG_VERSION").to_owned(),
            with_images: row.with_images,
            ..v1::TakeHeader::default()
        })
    }

    /// Records a session that is to be recorded from its first frame on, when that one is about to come.
    ///
    /// # Errors
    ///
    /// As of [`Self::start`]: what cannot be recorded is not to be taken either.
    pub async fn start_with_first_frame(&self, handle: &SessionHandle) -> Result<(), Status> {
        let settings = handle.settings();
        if !settings.record || !handle.has_no_frames() || handle.is_recorded() {
            return Ok(());
        }
        let new = NewTake {
            labels: self.labels_as_before(handle).await?,
            with_images: settings.record_images,
            ..NewTake::default()
        };
        match self.start(handle.id(), new).await {
            Ok(row) => {
                tracing::info!(take = %row.id, session = %row.session, "recorded from its first frame on");
                Ok(())
            }
            // Somebody else started one meanwhile.
            Err(_) if handle.is_recorded() => Ok(()),
            Err(refused) => Err(refused),
        }
    }

    /// Waits for the end of a take and writes it into the catalogue.
    async fn keep_end(&self, mut ended: watch::Receiver<Option<EndedTake>>) {
        let Ok(ended) = ended.wait_for(Option::is_some).await.map(|it| it.clone()) else {
            return;
        };
        let Some(ended) = ended else {
            return;
        };
        // One that was erased meanwhile has no row.
        if let Err(error) = self.store_end(&ended).await
            && !matches!(error, CatalogueError::NoTake)
        {
            let error = &error as &dyn std::error::Error;
            tracing::error!(take = %ended.id, error, "how a take ended could not be stored");
        }
    }

    async fn store_end(&self, ended: &EndedTake) -> Result<TakeRow, CatalogueError> {
        let row = self.store.take(&ended.id).await?;
        let state = match ended.condition {
            Condition::Sound => TakeState::Closed,
            Condition::Degraded => TakeState::Degraded,
            Condition::DiskFull => TakeState::TruncatedDiskFull,
        };
        let ended = TakeRow {
            stop_time_nanos: Some(ended.stop_time_nanos),
            content: TakeContent {
                first_frame: ended.figures.first_frame,
                last_frame: ended.figures.last_frame,
                n_frames: ended.figures.n_frames,
                n_bytes: ended.n_bytes,
            },
            state,
            start_timecode: ended.figures.start_timecode,
            ..row
        };
        self.store.end_take(ended).await
    }

    /// Ends a take; returns when all of it is on stable storage. One that is over already stays as it is.
    ///
    /// # Errors
    ///
    /// `TAKE`, or that the storage failed.
    pub async fn stop(&self, id: &TakeId) -> Result<TakeRow, Status> {
        let row = self.store.take(id).await?;
        match self.recorder.stop(id).await {
            Some(ended) => Ok(self.store_end(&ended).await?),
            None => Ok(self.store.take(id).await.unwrap_or(row)),
        }
    }

    /// One take, as far as it has been recorded.
    ///
    /// # Errors
    ///
    /// `TAKE`, or that the storage failed.
    pub async fn get(&self, id: &TakeId) -> Result<TakeRow, Status> {
        Ok(self.with_progress(self.store.take(id).await?))
    }

    fn with_progress(&self, row: TakeRow) -> TakeRow {
        let Some(TakeUnderWay {
            figures, n_bytes, ..
        }) = self.recorder.under_way(&row.id)
        else {
            return row;
        };
        let content = TakeContent {
            first_frame: figures.first_frame,
            last_frame: figures.last_frame,
            n_frames: figures.n_frames,
            n_bytes,
        };
        TakeRow {
            content,
            start_timecode: figures.start_timecode,
            ..row
        }
    }

    /// A page of the takes that are seen.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn list(
        &self,
        filter: &TakeFilter,
        page: &Page,
        is_seen: impl Fn(&SessionId) -> bool,
    ) -> Result<(Vec<TakeRow>, String), Status> {
        let n_wanted = page.n_to_read();
        let n_at_once = n_wanted.max(ROWS_AT_ONCE);
        let (mut seen, mut after) = (Vec::new(), page.after.clone());
        loop {
            let rows = self
                .store
                .takes(filter.clone(), after.clone(), n_at_once)
                .await?;
            let is_last = rows.len() < n_at_once;
            if let Some(last) = rows.last() {
                after = last.id.to_string();
            }
            seen.extend(rows.into_iter().filter(|it| is_seen(&it.session)));
            if is_last || seen.len() >= n_wanted {
                break;
            }
        }
        let next = page.cut(&mut seen, |it| it.id.to_string());
        let rows = seen.into_iter().map(|it| self.with_progress(it));
        Ok((rows.collect(), next))
    }

    /// What an export of this take reads. Nobody reads more of a take under way than is on stable storage, nor of one whose end
    /// could not be written.
    pub(super) fn source(&self, row: &TakeRow) -> ExportSource {
        let under_way = self.recorder.under_way(&row.id);
        let of_whole = match row.state {
            TakeState::Degraded | TakeState::TruncatedDiskFull => row.content.n_bytes,
            _ => u64::MAX,
        };
        ExportSource {
            fs: Arc::clone(&self.fs),
            file: self.dir.join(file_name(&row.id)),
            n_bytes: under_way.map_or(of_whole, |it| it.n_bytes),
            take: wire::take::take(row),
            actor: None,
        }
    }

    /// Changes what is said of a take.
    ///
    /// # Errors
    ///
    /// `TAKE`, or that the storage failed.
    pub async fn label(&self, id: &TakeId, labels: TakeLabels) -> Result<TakeRow, Status> {
        Ok(self.with_progress(self.store.label_take(id, labels).await?))
    }

    fn unix_now(&self) -> i64 {
        let clock = &self.clock;
        clock.now_nanos().saturating_add(clock.unix_offset_nanos())
    }
}

/// In hexadecimal digits.
fn sha256(bytes: &[u8]) -> String {
    use std::fmt::Write as _;
    let digits = Sha256::digest(bytes);
    digits.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string does not fail.
        let _ok = write!(text, "{byte:02x}");
        text
    })
}

/// The session and the second: takes of one session sort by time.
fn take_id(session: &SessionId, unix_nanos: i64) -> TakeId {
    /// Of an id; the time takes twelve digits in base 36 at most, with a dash before it.
    const SESSION_BYTES: usize = 48;
    let session: String = session.as_str().chars().take(SESSION_BYTES).collect();
    let millis = unix_nanos.unsigned_abs() / 1_000_000;
    TakeId::parse(&format!("{session}-{millis:x}"))
        .expect("invariant: the parts are those of an id")
}

fn start_status(error: &StartError) -> Status {
    let message = error.to_string();
    match error {
        StartError::Recorded(_) => {
            refuse(tonic::Code::FailedPrecondition, "TAKE_RECORDING", message)
        }
        StartError::DiskLow(room) => disk_low(*room),
        StartError::Io(error) if error.kind() == io::ErrorKind::StorageFull => {
            refuse(tonic::Code::ResourceExhausted, "DISK_LOW", message)
        }
        StartError::Io(_) => refuse(tonic::Code::Internal, "STORAGE", message),
        StartError::Session(error) => error.clone().into(),
        StartError::Subscribe(error) => (*error).into(),
    }
}
