//! What a session's takes say of the run before its present one: a publisher that comes back does not send again what is on
//! stable storage there (CONTRACTS D-8, O-14), and a recording that begins by itself goes on under the same slate.

use std::{
    sync::Arc,
    time::{Duration, UNIX_EPOCH},
};

use tonic::Status;

use super::Takes;
use crate::{
    catalogue::{CatalogueError, TakeFilter, TakeLabels, TakeRow, TakeState},
    clock::nanos,
    session::SessionHandle,
    take::{file_name, header},
};

/// Rows that are read at once.
const ROWS_AT_ONCE: usize = 256;

/// Looks at a take that is being recovered: 2 s at most, since a publisher waits.
const MAX_LOOKS: usize = 100;
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// An earlier run of a session, of which a take is on stable storage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedRun {
    /// The run.
    pub run: u64,
    /// Its frames up to this one are in the take.
    pub through: u64,
}

impl Takes {
    /// What is recorded of an earlier run, for a session without frames in its present one. Nothing while its take is still
    /// being recovered after a while: frames are then sent twice, and none is lost.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub async fn recorded_before(
        &self,
        session: &SessionHandle,
    ) -> Result<Option<RecordedRun>, Status> {
        if !session.has_no_frames() {
            return Ok(None);
        }
        let Some(mut row) = self.last_take(session).await? else {
            return Ok(None);
        };
        for _ in 0..MAX_LOOKS {
            if row.state != TakeState::Recovering {
                break;
            }
            tokio::time::sleep(LOOK_EVERY).await;
            row = self.store.take(&row.id).await?;
        }
        if matches!(row.state, TakeState::Recovering | TakeState::Recording) {
            return Ok(None);
        }
        let (fs, file) = (Arc::clone(&self.fs), self.dir.join(file_name(&row.id)));
        let found = self.recorder.read(move || header(&*fs, &file)).await;
        // A file that cannot be read says nothing; whoever asks for it hears why.
        let run = found.ok().flatten().map(|it| it.run);
        let earlier = run.filter(|it| *it < session.run() && row.content.n_frames > 0);
        Ok(earlier.map(|run| RecordedRun {
            run,
            through: row.content.last_frame,
        }))
    }

    /// What a recording is called that begins by itself: as the one before it in the same session, with the next number.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub(super) async fn labels_as_before(
        &self,
        session: &SessionHandle,
    ) -> Result<TakeLabels, CatalogueError> {
        let last = self.last_take(session).await?;
        Ok(last.map_or_else(TakeLabels::default, |it| TakeLabels {
            slate: it.labels.slate,
            gesture: it.labels.gesture,
            ..TakeLabels::default()
        }))
    }

    /// The newest take that was captured of a session since it was created; earlier ones are of another of its name.
    async fn last_take(&self, session: &SessionHandle) -> Result<Option<TakeRow>, CatalogueError> {
        let created = session.create_time().duration_since(UNIX_EPOCH);
        let created_nanos = nanos(created.unwrap_or_default());
        let filter = TakeFilter {
            session: Some(session.id().clone()),
            ..TakeFilter::default()
        };
        let (mut newest, mut after): (Option<TakeRow>, _) = (None, String::new());
        loop {
            let rows = self
                .store
                .takes(filter.clone(), after, ROWS_AT_ONCE)
                .await?;
            let is_last = rows.len() < ROWS_AT_ONCE;
            after = rows.last().map(|it| it.id.to_string()).unwrap_or_default();
            let captured = rows
                .into_iter()
                .filter(|it| it.resolved_from.is_none() && it.start_time_nanos >= created_nanos);
            newest = newest
                .into_iter()
                .chain(captured)
                .max_by_key(|it| it.start_time_nanos);
            if is_last {
                return Ok(newest);
            }
        }
    }
}
