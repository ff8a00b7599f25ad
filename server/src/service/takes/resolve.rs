//! Takes that are solved again: a task each, step by step on a bounded pool, with nothing left of one that is given up.

use std::sync::Arc;

use frontalis_proto::v1;
use futures::Stream;
use tokio::{
    sync::{OwnedSemaphorePermit, mpsc},
    time::{Duration, Instant},
};
use tonic::{Code, Status};

use super::{Takes, sha256, take_id};
use crate::{
    catalogue::{CatalogueError, TakeContent, TakeLabels, TakeRow, TakeState},
    config::RESOLVES,
    name::TakeId,
    service::grpc::{refusal, status::refuse},
    take::{Advance, ResolveError, ResolveTarget, Resolved, TakeToResolve},
    wire,
};

/// How often progress is told.
const PROGRESS_EVERY: Duration = Duration::from_millis(200);

/// Ids that are tried for the new take.
const MAX_IDS: i64 = 100;

/// What is asked for.
pub struct ResolveOrder {
    /// The take.
    pub from: TakeRow,
    /// Another revision of its actor; `None`: as recorded.
    pub actor_revision: Option<u32>,
    /// Absent fields: as recorded.
    pub settings: v1::SessionSettings,
}

type Told = mpsc::Sender<Result<v1::ResolveTakeResponse, Status>>;

impl Takes {
    /// Starts to solve a take again. Whoever drops the stream ends it, and nothing is left of it.
    ///
    /// # Errors
    ///
    /// `TAKE_RECORDING`, `TAKE_UNREADABLE`, or that too many are being solved.
    pub fn resolve(
        &self,
        order: ResolveOrder,
    ) -> Result<impl Stream<Item = Result<v1::ResolveTakeResponse, Status>> + Send + 'static, Status>
    {
        check_state(&order.from)?;
        let permit = Arc::clone(&self.resolves)
            .try_acquire_owned()
            .map_err(|_| refusal::limit("RESOLVES", "re-solves at once", RESOLVES))?;
        let (told, mut responses) = mpsc::channel(1);
        let this = self.clone();
        self.recorder.spawn(async move {
            if let Err(status) = this.resolve_into_new(order, &told, permit).await {
                // Whoever asked may have gone.
                let _gone = told.send(Err(status)).await;
            }
        });
        Ok(futures::stream::poll_fn(move |context| {
            responses.poll_recv(context)
        }))
    }

    async fn resolve_into_new(
        &self,
        order: ResolveOrder,
        told: &Told,
        _permit: OwnedSemaphorePermit,
    ) -> Result<(), Status> {
        let id = self.claim_id(&order.from).await?;
        let made = self.resolve_as(&id, &order, told).await;
        match made {
            Ok(Some(row)) => {
                tracing::info!(take = %id, from = %order.from.id, "a take was solved again");
                let last = v1::ResolveTakeResponse {
                    frames_done: row.content.n_frames,
                    n_frames: row.content.n_frames,
                    take: Some(wire::take::take(&row)),
                };
                let _gone = told.send(Ok(last)).await;
                Ok(())
            }
            Ok(None) => {
                self.erase(&id).await?;
                Ok(())
            }
            Err(status) => {
                self.erase(&id).await?;
                Err(status)
            }
        }
    }

    /// A free id, under which a crash leaves nothing.
    async fn claim_id(&self, from: &TakeRow) -> Result<TakeId, Status> {
        let now_nanos = self.unix_now();
        for millis in 0..MAX_IDS {
            let id = take_id(&from.session, now_nanos + millis * 1_000_000);
            match self.store.claim_take(&id).await {
                Ok(()) => return Ok(id),
                Err(CatalogueError::TakeExists) => {}
                Err(error) => return Err(error.into()),
            }
        }
        Err(CatalogueError::TakeExists.into())
    }

    /// `None` when whoever asked has gone.
    async fn resolve_as(
        &self,
        id: &TakeId,
        order: &ResolveOrder,
        told: &Told,
    ) -> Result<Option<TakeRow>, Status> {
        let from = &order.from;
        self.check_readable(from).await?;
        let (fs, dir) = (Arc::clone(&self.fs), self.dir.clone());
        let (origin, n_bytes) = (from.id.clone(), from.content.n_bytes);
        let opened = self
            .resolvers
            .run(move || TakeToResolve::open(&*fs, &dir, &origin, n_bytes));
        let opened = opened.await.map_err(|it| status(&it))?;
        let recorded = opened.actor_revision();
        let recorded_actor = self.store.load_actor(&from.actor, recorded).await?;
        let other_revision = match order.actor_revision.filter(|it| *it != recorded) {
            Some(revision) => Some((
                self.store.load_actor(&from.actor, revision).await?,
                revision,
            )),
            None => None,
        };
        let revision = order.actor_revision.unwrap_or(recorded);
        let package = self.store.package(&from.actor, revision).await?;
        let package_sha256 = self.resolvers.run(move || sha256(&package)).await;
        let target = ResolveTarget {
            take: id.clone(),
            from: from.id.clone(),
            recorded_actor,
            other_revision,
            package_sha256,
            asked: order.settings.clone(),
        };
        let (fs, dir) = (Arc::clone(&self.fs), self.dir.clone());
        let begun = self.resolvers.run(move || opened.begin(fs, dir, target));
        let begun = begun.await.map_err(|it| status(&it))?;
        let Some(resolved) = Box::pin(self.solve(begun, order, told)).await? else {
            return Ok(None);
        };
        let row = new_row(id, from, revision, &resolved);
        Ok(Some(self.store.add_claimed_take(row).await?))
    }

    async fn solve(
        &self,
        mut resolve: crate::take::Resolve,
        order: &ResolveOrder,
        told: &Told,
    ) -> Result<Option<Resolved>, Status> {
        let mut last_told = Instant::now();
        loop {
            if told.is_closed() {
                return Ok(None);
            }
            let now_nanos = self.clock.now_nanos();
            let step = self.resolvers.run(move || resolve.advance(now_nanos));
            let (next, advance) = step.await.map_err(|it| status(&it))?;
            match (next, advance) {
                (Some(mut next), Advance::NeedsActor { revision }) => {
                    let actor = self.store.load_actor(&order.from.actor, revision).await?;
                    next.give_actor(actor, revision);
                    resolve = next;
                }
                (Some(next), Advance::More { frames_done }) => {
                    resolve = next;
                    if last_told.elapsed() >= PROGRESS_EVERY {
                        last_told = Instant::now();
                        tell(told, frames_done, order.from.content.n_frames).await;
                    }
                }
                (_, Advance::Over(resolved)) => return Ok(Some(resolved)),
                (None, _) => return Err(Status::internal("a re-solve ended before its end")),
            }
        }
    }
}

async fn tell(told: &Told, frames_done: u64, n_frames: u64) {
    let progress = v1::ResolveTakeResponse {
        frames_done,
        n_frames,
        take: None,
    };
    // That whoever asked has gone is seen before the next step.
    let _gone = told.send(Ok(progress)).await;
}

fn check_state(from: &TakeRow) -> Result<(), Status> {
    let refused = |reason, message: &str| Err(refuse(Code::FailedPrecondition, reason, message));
    match from.state {
        TakeState::Recording => refused(
            "TAKE_RECORDING",
            "the take is being recorded: stop it before it is solved again",
        ),
        TakeState::Recovering => refused(
            "TAKE_RECOVERING",
            "the take was cut short by a crash and is being brought into order: try again soon",
        ),
        TakeState::Quarantined => refused("TAKE_UNREADABLE", "the take's file cannot be read"),
        TakeState::Closed | TakeState::Degraded | TakeState::TruncatedDiskFull => Ok(()),
    }
}

fn new_row(id: &TakeId, from: &TakeRow, actor_revision: u32, resolved: &Resolved) -> TakeRow {
    let figures = resolved.figures;
    TakeRow {
        id: id.clone(),
        actor_revision,
        labels: TakeLabels {
            circled: false,
            notes: String::new(),
            ..from.labels.clone()
        },
        content: TakeContent {
            first_frame: figures.first_frame,
            last_frame: figures.last_frame,
            n_frames: figures.n_frames,
            n_bytes: resolved.n_bytes,
        },
        state: TakeState::Closed,
        recovered: false,
        resolved_from: Some(from.id.clone()),
        ..from.clone()
    }
}

fn status(error: &ResolveError) -> Status {
    match error {
        ResolveError::Field(error) => error.clone().into(),
        ResolveError::NoHeader | ResolveError::State(_) => {
            refuse(Code::DataLoss, "TAKE_DAMAGED", chain(error))
        }
        ResolveError::File(_) => refuse(Code::Internal, "STORAGE", chain(error)),
    }
}

/// An error with its causes.
fn chain(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |it| it.source());
    let texts: Vec<_> = causes.map(ToString::to_string).collect();
    texts.join(": ")
}
