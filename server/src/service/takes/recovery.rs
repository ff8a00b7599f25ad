//! Brings into order what the last process left in the directory of takes, while the server already works (CONTRACTS U-5 to
//! U-7): temporary files, takes cut short, files without a row.
//!
//! Every step may be cut by a crash, and is done again at the next start with the same result.

use std::{
    collections::BTreeSet,
    ffi::OsString,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use frontalis_proto::v1;
use futures::StreamExt as _;
use tonic::{Code, Status};

use super::Takes;
use crate::{
    catalogue::{CatalogueError, TakeContent, TakeLabels, TakeRow, TakeState},
    fs::TEMPORARY_SUFFIX,
    name::{ActorId, SessionId, TakeId},
    service::grpc::status::{Refusal, refuse},
    take::{
        Belonging, Recovered, Rewritten, ScanError, TakeFileError, file_name, final_form, header,
        recover, survey,
    },
    wire::actor::unix_nanos,
};

/// Takes that are recovered at once; sessions that capture meanwhile need the other core.
const RECOVERIES_AT_ONCE: usize = 2;

/// Rows that are read at once.
const ROWS_AT_ONCE: usize = 256;

/// When to ask again for a take that is being recovered.
const ASK_AGAIN: Duration = Duration::from_secs(1);

/// What is still to be brought into order. Cheap to clone; clones share it.
#[derive(Clone, Debug, Default)]
pub struct RecoveryProgress(Arc<AtomicU64>);

impl RecoveryProgress {
    /// Steps that are ahead; 0: all is in order.
    fn n_left(&self) -> u64 {
        self.0.load(Ordering::Acquire)
    }

    fn begin(&self, n_steps: u64) {
        self.0.store(n_steps, Ordering::Release);
    }

    fn step(&self) {
        self.0.fetch_sub(1, Ordering::AcqRel);
    }
}

/// What the last process left.
#[derive(Debug)]
pub struct LeftOver {
    /// Every name in the directory of takes, from before this process made any.
    names: Vec<OsString>,
    /// Takes that were cut short.
    n_takes: u64,
}

/// The steps beside one for each take: temporary files, and files without a row.
const OTHER_STEPS: u64 = 2;

impl Takes {
    /// Looks at what the last process left, before anything new begins; [`Self::recover`] brings it into order.
    ///
    /// # Errors
    ///
    /// That the catalogue or the directory failed.
    pub async fn look_at_left_over(&self) -> Result<LeftOver, CatalogueError> {
        let n_takes = self.store.begin_recovery().await?;
        let (fs, dir) = (Arc::clone(&self.fs), self.dir.clone());
        let names = self.recorder.run(move || fs.list(&dir)).await?;
        self.recovery.begin(n_takes + OTHER_STEPS);
        Ok(LeftOver { names, n_takes })
    }

    /// Brings everything into order that the last process left. What cannot be is named in the log, and costs nothing else.
    pub async fn recover(self, left: LeftOver) {
        self.remove_temporary(&left.names).await;
        self.recovery.step();
        if let Err(error) = self.recover_rows().await {
            let error = &error as &dyn std::error::Error;
            tracing::error!(
                error,
                "not every take could be recovered; the next start tries again"
            );
        }
        if let Err(error) = self.adopt_files(left.names).await {
            let error = &error as &dyn std::error::Error;
            tracing::error!(error, "files without a row stay so until the next start");
        }
        self.recovery.begin(0);
        if left.n_takes > 0 {
            let n_takes = left.n_takes;
            tracing::info!(n_takes, "takes that were cut short are in order");
        }
    }

    /// Whether all that the last process left is in order.
    ///
    /// # Errors
    ///
    /// `TAKE_RECOVERING`, with how much is ahead.
    pub fn check_in_order(&self) -> Result<(), Status> {
        match self.recovery.n_left() {
            0 => Ok(()),
            n_left => {
                let message = format!(
                    "takes that a crash left are being brought into order, {n_left} steps are ahead"
                );
                Err(recovering(message, n_left))
            }
        }
    }

    /// Whether the contents of a take can be asked for.
    ///
    /// # Errors
    ///
    /// `TAKE_RECOVERING` while its file is being brought into order, `TAKE_FORMAT` when a newer server wrote it,
    /// `TAKE_UNREADABLE` when it is of another take.
    pub async fn check_readable(&self, row: &TakeRow) -> Result<(), Status> {
        if row.state == TakeState::Recovering {
            let n_left = self.recovery.n_left();
            let message = format!(
                "{} was cut short by a crash and is being brought into order, {n_left} steps are ahead",
                row.id.resource()
            );
            return Err(recovering(message, n_left));
        }
        let (fs, file) = (Arc::clone(&self.fs), self.dir.join(file_name(&row.id)));
        let is_quarantined = row.state == TakeState::Quarantined;
        match self.recorder.run(move || header(&*fs, &file)).await {
            // Whoever put it there, it is nobody's business under this name.
            Ok(Some(other)) if !is_quarantined && other.take != row.id.resource() => Err(refuse(
                Code::DataLoss,
                "TAKE_UNREADABLE",
                format!(
                    "the file of {} is of another take, {}; it is left as it is",
                    row.id.resource(),
                    other.take
                ),
            )),
            Err(TakeFileError::Scan(error @ ScanError::NewerFormat { .. })) => Err(refuse(
                Code::FailedPrecondition,
                "TAKE_FORMAT",
                format!("{}: {error}", row.id.resource()),
            )),
            _ => Ok(()),
        }
    }

    async fn remove_temporary(&self, names: &[OsString]) {
        let temporary = names
            .iter()
            .filter_map(|it| it.to_str())
            .filter(|it| it.ends_with(TEMPORARY_SUFFIX));
        for name in temporary {
            let (fs, file) = (Arc::clone(&self.fs), self.dir.join(name));
            if let Err(error) = self.recorder.run(move || fs.remove(&file)).await {
                tracing::warn!(name, %error, "a temporary file could not be removed yet");
            }
        }
    }

    async fn recover_rows(&self) -> Result<(), CatalogueError> {
        let mut after = String::new();
        loop {
            let rows = self.store.takes_to_recover(after, ROWS_AT_ONCE).await?;
            let Some(last) = rows.last() else {
                return Ok(());
            };
            after = last.id.to_string();
            let recoveries = rows.into_iter().map(|row| self.recover_row(row));
            futures::stream::iter(recoveries)
                .buffer_unordered(RECOVERIES_AT_ONCE)
                .collect::<()>()
                .await;
        }
    }

    async fn recover_row(&self, row: TakeRow) {
        let was_open = row.state == TakeState::Recovering;
        let wanted = Belonging {
            take: row.id.resource(),
            session: row.session.resource(),
            actor: row.actor.resource(),
        };
        let (fs, dir, name) = (Arc::clone(&self.fs), self.dir.clone(), file_name(&row.id));
        let work = move || recover(&*fs, &dir, &name, &wanted);
        let recovered = self.recorder.rework(work).await;
        let id = row.id.clone();
        if let Err(error) = self.keep_recovered(row, recovered).await {
            let error = &error as &dyn std::error::Error;
            tracing::error!(take = %id, error, "a take is recovered, which could not be stored");
        }
        if was_open {
            self.recovery.step();
        }
    }

    async fn keep_recovered(
        &self,
        row: TakeRow,
        recovered: Recovered,
    ) -> Result<(), CatalogueError> {
        let row = match recovered {
            Recovered::Whole(it) => {
                tracing::info!(
                    take = %row.id,
                    n_frames = it.figures.n_frames,
                    n_bytes = it.n_bytes,
                    n_damaged_bytes = it.n_damaged_bytes,
                    n_tail_bytes = it.n_tail_bytes,
                    "a take was recovered"
                );
                whole(row, &it)
            }
            Recovered::NeverBegun if row.state == TakeState::Recovering => {
                tracing::warn!(take = %row.id, "a take that had not begun is forgotten");
                self.remove_file(&row.id).await?;
                return self.store.forget_take(&row.id).await;
            }
            Recovered::NeverBegun => return Ok(()),
            Recovered::Foreign(other) => {
                tracing::error!(take = %row.id, ?other, "the file is of another take, it is left as it is");
                quarantined(row)
            }
            Recovered::Unreadable(error) => {
                let error = &error as &dyn std::error::Error;
                tracing::error!(take = %row.id, error, "a take cannot be read, it is left as it is");
                quarantined(row)
            }
        };
        self.store.end_take(row).await.map(drop)
    }

    /// Makes rows for files that have none.
    async fn adopt_files(&self, names: Vec<OsString>) -> Result<(), CatalogueError> {
        let known = self.store.known_takes().await?;
        for name in names {
            let name = name.to_string_lossy().into_owned();
            if name.ends_with(TEMPORARY_SUFFIX) {
                continue;
            }
            match unknown_take(&name, &known) {
                Some(Ok(id)) => self.adopt(&id).await,
                Some(Err(())) => tracing::warn!(name, "a file that is no take's is left alone"),
                None => {}
            }
        }
        Ok(())
    }

    async fn adopt(&self, id: &TakeId) {
        match self.try_adopt(id).await {
            Ok(Some(row)) => {
                tracing::warn!(take = %id, n_frames = row.content.n_frames, "a take without a row has one again");
            }
            Ok(None) => {
                tracing::warn!(take = %id, "the file of a take that had not begun was removed");
            }
            Err(error) => {
                let error = &*error;
                tracing::error!(take = %id, error, "a file without a row cannot be taken up, it is left as it is");
            }
        }
    }

    async fn try_adopt(
        &self,
        id: &TakeId,
    ) -> Result<Option<TakeRow>, Box<dyn std::error::Error + Send + Sync>> {
        let (fs, dir, name) = (Arc::clone(&self.fs), self.dir.clone(), file_name(id));
        let found = self.recorder.rework(move || found(&*fs, &dir, &name)).await;
        let (header, content, is_its_own) = match found {
            Err(TakeFileError::Scan(ScanError::NotBegun)) => {
                self.remove_file(id).await?;
                return Ok(None);
            }
            found => found?,
        };
        let row = row_of(id, &header)?;
        let row = if is_its_own {
            whole(row, &content)
        } else {
            tracing::error!(take = %id, says = header.take, "a file says that it is of another take");
            quarantined(row)
        };
        Ok(Some(self.store.add_take(row).await?))
    }

    /// What the files say, for a server without a catalogue; nothing is changed (BAD_INPUT H7).
    ///
    /// # Errors
    ///
    /// That the directory cannot be read.
    pub async fn list_by_files(&self) -> Result<u64, CatalogueError> {
        let (fs, dir) = (Arc::clone(&self.fs), self.dir.clone());
        let names = self.recorder.run(move || fs.list(&dir)).await?;
        let mut rows = Vec::new();
        for name in names {
            let name = name.to_string_lossy().into_owned();
            let Some(Ok(id)) = unknown_take(&name, &BTreeSet::new()) else {
                continue;
            };
            match self.surveyed(&id).await {
                Ok(row) => rows.push(row),
                Err(error) => {
                    let error = &*error;
                    tracing::error!(take = %id, error, "a file cannot be listed");
                }
            }
        }
        let n_takes = rows.len() as u64;
        self.store.add_takes(rows).await?;
        Ok(n_takes)
    }

    async fn surveyed(
        &self,
        id: &TakeId,
    ) -> Result<TakeRow, Box<dyn std::error::Error + Send + Sync>> {
        let (fs, file) = (Arc::clone(&self.fs), self.dir.join(file_name(id)));
        let look = move || Ok::<_, TakeFileError>((header(&*fs, &file)?, survey(&*fs, &file)?));
        let (header, content) = self.recorder.rework(look).await?;
        let row = row_of(id, &header.ok_or(NO_HEADER)?)?;
        Ok(whole(row, &content))
    }
}

const NO_HEADER: &str = "the file does not say of whom it is";

/// Header and content of a file without a row, and whether it says that it is the take that its name says. Only then it is
/// brought into its final form.
fn found(
    fs: &dyn crate::fs::Fs,
    dir: &std::path::Path,
    name: &str,
) -> Result<(v1::TakeHeader, Rewritten, bool), TakeFileError> {
    let header = header(fs, &dir.join(name))?;
    let header = header.ok_or(TakeFileError::Scan(ScanError::Head))?;
    let is_its_own = TakeId::from_resource(&header.take).is_ok_and(|it| file_name(&it) == name);
    let content = if is_its_own {
        final_form(fs, dir, name)?
    } else {
        Rewritten::default()
    };
    Ok((header, content, is_its_own))
}

/// The take of a file that has no row; `None` when it has one, an error when no take has such a file.
fn unknown_take(name: &str, known: &BTreeSet<TakeId>) -> Option<Result<TakeId, ()>> {
    let id = name.strip_suffix(".mcap").map(TakeId::parse);
    match id {
        Some(Ok(id)) => (!known.contains(&id)).then_some(Ok(id)),
        _ => Some(Err(())),
    }
}

/// What a file says of its take; what people said later is not in it.
fn row_of(
    id: &TakeId,
    header: &v1::TakeHeader,
) -> Result<TakeRow, Box<dyn std::error::Error + Send + Sync>> {
    Ok(TakeRow {
        id: id.clone(),
        session: SessionId::from_resource(&header.session)?,
        actor: ActorId::from_resource(&header.actor)?,
        actor_revision: header.actor_revision,
        labels: TakeLabels {
            slate: header.slate.clone(),
            number: header.number,
            gesture: header.gesture.clone(),
            circled: false,
            notes: String::new(),
        },
        start_time_nanos: header.start_time.as_ref().map_or(0, unix_nanos),
        stop_time_nanos: None,
        content: TakeContent::default(),
        state: TakeState::Recovering,
        resolved_from: None,
        start_timecode: None,
        with_images: header.with_images,
        recovered: true,
    })
}

fn whole(row: TakeRow, found: &Rewritten) -> TakeRow {
    let last = i64::try_from(found.last_time_nanos).unwrap_or(i64::MAX);
    TakeRow {
        stop_time_nanos: Some(
            row.stop_time_nanos
                .unwrap_or(last.max(row.start_time_nanos)),
        ),
        content: TakeContent {
            first_frame: found.figures.first_frame,
            last_frame: found.figures.last_frame,
            n_frames: found.figures.n_frames,
            n_bytes: found.n_bytes,
        },
        state: TakeState::Closed,
        start_timecode: found.figures.start_timecode,
        recovered: true,
        ..row
    }
}

fn quarantined(row: TakeRow) -> TakeRow {
    TakeRow {
        stop_time_nanos: Some(row.stop_time_nanos.unwrap_or(row.start_time_nanos)),
        state: TakeState::Quarantined,
        ..row
    }
}

fn recovering(message: String, n_left: u64) -> Status {
    Refusal::new(Code::Unavailable, "TAKE_RECOVERING", message)
        .with("steps_left", &n_left)
        .retry_after(ASK_AGAIN)
        .into_status()
}
