//! Records takes: one scribe a take, and one committer that puts what all of them wrote on stable storage together.
//!
//! Commits of several files run side by side, since a disk flushes them in one go (CONTRACTS U-2).

use std::{
    collections::BTreeMap,
    io,
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use frontalis_proto::v1::{self, take_event::Event};
use futures::StreamExt as _;
use tokio::sync::{Notify, watch};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use super::{
    disk_room::{DiskRoom, IngestRate, LOOK_EVERY},
    figures::TakeFigures,
    finished::finished,
    frame_lookup::{FrameLookup, Known},
    growth::Growth,
    open_take::{Condition, OpenTake, file_name},
    recovery::final_form,
    rewrite::{Rewritten, TakeFileError},
    scribe::{Progress, Scribe, unix_nanos},
};
use crate::{
    clock::ServerClock,
    executor::{Threads, Workers},
    fs::Fs,
    hub::{Delivery, StartAt, SubscribeError, SubscribeSpec},
    name::{SessionId, TakeId},
    session::{SessionError, SessionHandle},
    wire::actor::timestamp,
};

/// What waits is committed so long after the first of it (CONTRACTS U-2 asks for at most 20 ms). Shorter would be no sooner: each
/// flush of a file costs processor time, and at 64 sessions that is what runs out first.
const COMMIT_AFTER: Duration = Duration::from_millis(12);

/// Files that are flushed at once.
const FLUSHES_AT_ONCE: usize = 16;

/// Takes that are rewritten at once.
const REWRITES_AT_ONCE: usize = 8;

/// Pieces of takes that are read at once, for subscribers and publishers: each holds a chunk of a file meanwhile.
const READS_AT_ONCE: usize = 4;

/// Why a take does not start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// The session is recorded already.
    #[error("the session is being recorded as take {0}")]
    Recorded(TakeId),
    /// The session takes no requests.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// The session has no room for a reader.
    #[error(transparent)]
    Subscribe(#[from] SubscribeError),
    /// The disk is almost full.
    #[error("{} bytes are free, a take needs {}", .0.free_bytes, .0.needed_bytes)]
    DiskLow(DiskRoom),
    /// The file could not be made.
    #[error("the file of the take could not be made")]
    Io(#[from] io::Error),
}

/// A recording that is over.
#[derive(Clone, Debug, PartialEq)]
pub struct EndedTake {
    /// Which take.
    pub id: TakeId,
    /// What it holds.
    pub figures: TakeFigures,
    /// Length of its file.
    pub n_bytes: u64,
    /// How it went.
    pub condition: Condition,
    /// When it ended, Unix nanoseconds.
    pub stop_time_nanos: i64,
}

/// A recording under way, for its status.
#[derive(Clone, Debug, PartialEq)]
pub struct TakeUnderWay {
    /// Which session.
    pub session: SessionId,
    /// What was recorded so far.
    pub figures: TakeFigures,
    /// Length of its file.
    pub n_bytes: u64,
}

/// Records takes. Cheap to clone; clones share them.
#[derive(Clone, Debug)]
pub struct Recorder {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    fs: Arc<dyn Fs>,
    dir: PathBuf,
    clock: ServerClock,
    flushes: Workers,
    rewrites: Workers,
    reads: Workers,
    dirty: Arc<Notify>,
    tasks: TaskTracker,
    ingest: Arc<IngestRate>,
    room: watch::Sender<DiskRoom>,
    takes: Mutex<BTreeMap<TakeId, Recording>>,
}

#[derive(Clone, Debug)]
struct Recording {
    take: Arc<OpenTake>,
    ended: watch::Receiver<Option<EndedTake>>,
}

impl Recorder {
    /// Records into `dir`, which exists.
    pub fn new(threads: Threads, fs: Arc<dyn Fs>, dir: PathBuf, clock: ServerClock) -> Self {
        let inner = Inner {
            fs,
            dir,
            clock,
            flushes: threads.workers(FLUSHES_AT_ONCE),
            rewrites: threads.workers(REWRITES_AT_ONCE),
            reads: threads.workers(READS_AT_ONCE),
            dirty: Arc::default(),
            tasks: TaskTracker::new(),
            ingest: Arc::default(),
            room: watch::Sender::default(),
            takes: Mutex::default(),
        };
        Self {
            inner: Arc::new(inner),
        }
    }

    /// The room on the disk, as [`Self::watch_disk`] finds it.
    pub fn room(&self) -> watch::Receiver<DiskRoom> {
        self.inner.room.subscribe()
    }

    /// Looks at the disk now.
    pub async fn look_at_disk(&self) -> DiskRoom {
        let (fs, dir) = (Arc::clone(&self.inner.fs), self.inner.dir.clone());
        let free_bytes = self.run(move || fs.free_bytes(&dir)).await;
        let room = self.inner.ingest.room(free_bytes);
        let change = |known: &mut DiskRoom| std::mem::replace(known, room) != room;
        self.inner.room.send_if_modified(change);
        room
    }

    /// Looks at the disk now and then, until `stopped`.
    pub async fn watch_disk(self, stopped: CancellationToken) {
        let mut looks = tokio::time::interval(LOOK_EVERY);
        let mut last = tokio::time::Instant::now();
        loop {
            tokio::select! {
                _ = looks.tick() => {}
                () = stopped.cancelled() => return,
            }
            self.inner.ingest.look(&mut last);
            self.look_at_disk().await;
        }
    }

    /// Commits what scribes write, until `stopped`.
    pub async fn commit(self, stopped: CancellationToken) {
        let inner = &self.inner;
        loop {
            tokio::select! {
                () = inner.dirty.notified() => {}
                () = stopped.cancelled() => return,
            }
            tokio::time::sleep(COMMIT_AFTER).await;
            let waiting: Vec<_> = inner
                .takes()
                .values()
                .filter(|it| it.take.has_pending())
                .map(|it| Arc::clone(&it.take))
                .collect();
            let commits = waiting.into_iter().map(|take| {
                let flushes = inner.flushes.clone();
                async move { take.commit(&flushes).await }
            });
            futures::stream::iter(commits)
                .buffer_unordered(FLUSHES_AT_ONCE)
                .collect::<()>()
                .await;
        }
    }

    /// Starts to record `session` as take `id`, from `pre_roll` before now on as far as it is kept; `header` says what is not the session's to say. What the session acknowledges
    /// after this returned is in the take. What is returned tells when it is over and on stable storage.
    ///
    /// # Errors
    ///
    /// [`StartError`]; then nothing is recorded.
    pub async fn start(
        &self,
        id: TakeId,
        session: SessionHandle,
        header: v1::TakeHeader,
        pre_roll: Duration,
    ) -> Result<watch::Receiver<Option<EndedTake>>, StartError> {
        let room = self.look_at_disk().await;
        if !room.is_enough() {
            return Err(StartError::DiskLow(room));
        }
        if let Some(other) = self.take_of(session.id()) {
            return Err(StartError::Recorded(other));
        }
        let inner = &self.inner;
        let take = OpenTake::create(
            id.clone(),
            session.clone(),
            Arc::clone(&inner.fs),
            inner.dir.clone(),
            &inner.flushes,
            Arc::clone(&inner.ingest),
        );
        let take = Arc::new(take.await?);
        let started = self.start_scribe(&take, header, pre_roll);
        if started.is_err() {
            take.close().await;
            inner.fs.remove(&inner.dir.join(file_name(&id)))?;
        }
        started
    }

    fn start_scribe(
        &self,
        take: &Arc<OpenTake>,
        header: v1::TakeHeader,
        pre_roll: Duration,
    ) -> Result<watch::Receiver<Option<EndedTake>>, StartError> {
        let inner = &self.inner;
        let session = &take.session;
        // Held until the take is listed: of two that start at once, one finds the other.
        let mut takes = inner.takes();
        let mut others = takes
            .values()
            .filter(|it| it.take.session.id() == session.id());
        if let Some(other) = others.next() {
            return Err(StartError::Recorded(other.take.id.clone()));
        }
        let next_sequence = session.hub().newest_sequence() + 1;
        let samples = session.hub().subscribe(SubscribeSpec {
            name: take.id.resource(),
            protocol: "take",
            delivery: Delivery::EveryFrame(if pre_roll.is_zero() {
                StartAt::Sequence(next_sequence)
            } else {
                // Samples of frames that are not in the take are passed over.
                StartAt::Oldest
            }),
            run: None,
        })?;
        let feed = session.record(pre_roll)?;
        let now = unix_nanos(&inner.clock, inner.clock.now_nanos());
        let header = v1::TakeHeader {
            next_sequence,
            next_frame: feed.next_frame,
            last_capture_time_nanos: feed.last_capture_nanos,
            pre_roll_from: feed.pre_roll.first().map_or(0, |it| it.number),
            ..header
        };
        take.add_event(Event::Header(header), now);
        let (end, ended) = watch::channel(None);
        let recording = Recording {
            take: Arc::clone(take),
            ended: ended.clone(),
        };
        takes.insert(take.id.clone(), recording);
        drop(takes);
        let mut scribe = Scribe {
            take: Arc::clone(take),
            first_frame: feed.first_frame(),
            feed,
            samples,
            clock: inner.clock,
            dirty: Arc::clone(&inner.dirty),
            progress: Progress::default(),
        };
        inner.dirty.notify_one();
        let this = self.clone();
        inner.tasks.spawn(async move {
            scribe.run().await;
            let ended = this.finish(&scribe.take).await;
            end.send_replace(Some(ended));
        });
        Ok(ended)
    }

    /// Puts the last of a take on stable storage, and its file into its final form.
    async fn finish(&self, take: &OpenTake) -> EndedTake {
        let inner = &self.inner;
        take.session.stop_recording();
        let now_nanos = inner.clock.now_nanos();
        let stop_time_nanos = now_nanos.saturating_add(inner.clock.unix_offset_nanos());
        let figures = take.figures_added();
        let stop = v1::TakeStop {
            stop_time: Some(timestamp(stop_time_nanos)),
            n_frames: figures.n_frames,
            n_samples: figures.n_samples,
        };
        take.add_event(Event::Stop(stop), unix_nanos(&inner.clock, now_nanos));
        take.commit(&inner.flushes).await;
        take.close().await;
        take.session.recording_settled();
        let (figures, n_bytes, condition) = take.figures();
        let rewritten = self.rewrite(&take.id).await;
        inner.takes().remove(&take.id);
        EndedTake {
            id: take.id.clone(),
            figures: rewritten.as_ref().map_or(figures, |it| it.figures),
            n_bytes: rewritten.map_or(n_bytes, |it| it.n_bytes),
            condition,
            stop_time_nanos,
        }
    }

    async fn rewrite(&self, id: &TakeId) -> Option<Rewritten> {
        match self.try_rewrite(id).await {
            Ok(rewritten) => Some(rewritten),
            Err(error) => {
                tracing::error!(
                    take = %id,
                    error = &error as &dyn std::error::Error,
                    "a take stays as it was recorded"
                );
                self.replaced(id).await
            }
        }
    }

    /// A failure that came after the last step leaves the final form.
    async fn replaced(&self, id: &TakeId) -> Option<Rewritten> {
        let (fs, file) = (
            Arc::clone(&self.inner.fs),
            self.inner.dir.join(file_name(id)),
        );
        self.rework(move || finished(&*fs, &file).ok()).await
    }

    /// Brings the file of a take that is not under way into its final form, in which a crash may have left it already.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`]; the file is then as it was.
    pub async fn try_rewrite(&self, id: &TakeId) -> Result<Rewritten, TakeFileError> {
        let (fs, dir) = (Arc::clone(&self.inner.fs), self.inner.dir.clone());
        let name = file_name(id);
        let work = move || final_form(&*fs, &dir, &name);
        self.rework(work).await
    }

    /// Ends a recording; returns when all of it is on stable storage. `None` when no such take is under way.
    pub async fn stop(&self, id: &TakeId) -> Option<EndedTake> {
        let mut recording = self.inner.takes().get(id).cloned()?;
        recording.take.session.stop_recording();
        let ended = recording.ended.wait_for(Option::is_some).await.ok()?;
        ended.clone()
    }

    /// The take that a session is recorded as.
    pub fn take_of(&self, session: &SessionId) -> Option<TakeId> {
        let takes = self.inner.takes();
        let mut of_session = takes.values().filter(|it| it.take.session.id() == session);
        of_session.next().map(|it| it.take.id.clone())
    }

    /// How a take under way goes.
    pub fn under_way(&self, id: &TakeId) -> Option<TakeUnderWay> {
        let recording = self.inner.takes().get(id).cloned()?;
        let (figures, n_bytes, _) = recording.take.figures();
        Some(TakeUnderWay {
            session: recording.take.session.id().clone(),
            figures,
            n_bytes,
        })
    }

    /// What can be read of a take under way.
    pub fn growth(&self, id: &TakeId) -> Option<Arc<Growth>> {
        let takes = self.inner.takes();
        takes.get(id).map(|it| Arc::clone(&it.take.growth))
    }

    /// Finds frames of the take that a session is recorded as; `present` is what found them before, if it still can.
    pub fn frames_of(
        &self,
        session: &SessionId,
        present: Option<FrameLookup>,
    ) -> Option<FrameLookup> {
        let inner = &self.inner;
        let takes = inner.takes();
        let mut of_session = takes.values().filter(|it| it.take.session.id() == session);
        let take = &of_session.next()?.take;
        let present = present.filter(|it| it.is_of(&take.growth));
        Some(present.unwrap_or_else(|| FrameLookup {
            fs: Arc::clone(&inner.fs),
            file: inner.dir.join(file_name(&take.id)),
            growth: Arc::clone(&take.growth),
            workers: inner.reads.clone(),
            known: Known::default(),
        }))
    }

    /// Runs a reading of a take where it holds nothing up.
    pub async fn read<T, F>(&self, work: F) -> T
    where
        F: FnOnce() -> T + Send + 'static,
        T: Send + 'static,
    {
        self.inner.reads.run(work).await
    }

    /// Lets something go on that [`Self::ended`] waits for.
    pub fn spawn(&self, task: impl Future<Output = ()> + Send + 'static) {
        self.inner.tasks.spawn(task);
    }

    /// Waits until every take that is under way has ended: their sessions are over.
    pub async fn ended(&self) {
        self.inner.tasks.close();
        self.inner.tasks.wait().await;
    }

    /// Runs a call to the file system where it holds nothing up.
    pub async fn run<T, F>(&self, call: F) -> T
    where
        F: FnOnce() -> T + Send + 'static,
        T: Send + 'static,
    {
        self.inner.flushes.run(call).await
    }

    /// Runs something longer with a take's file: reading all of it, or writing it anew.
    pub async fn rework<T, F>(&self, work: F) -> T
    where
        F: FnOnce() -> T + Send + 'static,
        T: Send + 'static,
    {
        self.inner.rewrites.run(work).await
    }
}

impl Inner {
    fn takes(&self) -> MutexGuard<'_, BTreeMap<TakeId, Recording>> {
        self.takes.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
