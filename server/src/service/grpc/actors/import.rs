//! One import: the stream's chunks, the package they make, the revision that comes of it.
//!
//! Sizes are refused while the bytes still come; nothing is stored before the whole package was read and accepted.

use std::{sync::Arc, time::Duration};

use bytes::Bytes;
use frontalis_analysis::{
    face::actor::RankPolicy,
    format::actor_package::{self, PackageError, ReadActor},
    space::LengthUnit,
};
use frontalis_proto::v1;
use futures::{
    Stream, StreamExt as _, TryStreamExt as _,
    stream::{self, BoxStream},
};
use tonic::{Code, Status, Streaming};

use super::{ActorsGrpc, ImportPlace, MAX_CHUNK_BYTES};
use crate::{
    catalogue::NewRevision,
    service::grpc::{
        refusal,
        status::{Refusal, refuse},
    },
    wire::{self, actor::ImportStart},
};

/// The next message must come within this time (BAD_INPUT F5).
const MESSAGE_DEADLINE: Duration = Duration::from_secs(10);

/// First bytes of gzip, Zstandard, bzip2, xz.
const COMPRESSED: [&[u8]; 4] = [b"\x1f\x8b", b"\x28\xb5\x2f\xfd", b"BZh", b"\xfd7zXZ"];

/// How far an import has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub stage: ImportStage,
    /// Bytes of the package that have come.
    pub received_bytes: usize,
}

/// What an import is at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImportStage {
    /// Bytes are coming.
    #[default]
    Receiving,
    /// The package is read and checked.
    Reading,
    /// The revision is written.
    Storing,
}

/// One import whose start was accepted; it holds its place until it is dropped.
pub struct Import {
    service: ActorsGrpc,
    start: ImportStart,
    package: Vec<u8>,
    place: ImportPlace,
}

impl ActorsGrpc {
    pub(super) async fn import(
        &self,
        place: ImportPlace,
        mut stream: Streaming<v1::ImportActorRequest>,
    ) -> Result<v1::ImportActorResponse, Status> {
        let first = in_time(stream.message()).await?;
        let first = first.ok_or_else(|| order("the stream has no message"))?;
        let start = first
            .start
            .ok_or_else(|| order("the first message must hold start"))?;
        let import = self.begin_import(place, start)?;
        let first = stream::iter([Ok(Bytes::from(first.chunk))]);
        let rest = stream.map(|message| match message? {
            v1::ImportActorRequest { start: Some(_), .. } => Err(order("start comes once")),
            message => Ok(Bytes::from(message.chunk)),
        });
        import.run(first.chain(rest), |_progress| {}).await
    }

    /// Checks what an import says of itself.
    pub(in crate::service) fn begin_import(
        &self,
        place: ImportPlace,
        start: v1::ImportActorStart,
    ) -> Result<Import, Status> {
        Ok(Import {
            service: self.clone(),
            start: ImportStart::try_from(start)?,
            package: Vec::new(),
            place,
        })
    }
}

impl Import {
    /// Refuses a package of `n_bytes` before any of it is read.
    pub(in crate::service) fn check_size(&self, n_bytes: u64) -> Result<(), Status> {
        match usize::try_from(n_bytes) {
            Ok(n_bytes) if n_bytes <= self.service.max_package_bytes => Ok(()),
            _ => Err(self.too_large()),
        }
    }

    /// Takes the package's chunks and stores what they make. `progress` is told after every chunk and at every stage.
    pub(in crate::service) async fn run<S>(
        self,
        chunks: S,
        progress: impl Fn(Progress),
    ) -> Result<v1::ImportActorResponse, Status>
    where
        S: Stream<Item = Result<Bytes, Status>> + Send + 'static,
    {
        let audit = self.service.audit.clone();
        let (peer, object) = (self.place.peer.clone(), self.start.actor.resource());
        let chunks = peer.caller.while_valid(chunks);
        let imported = self.take(chunks, progress).await;
        audit.outcome("actor_import", &peer, &object, imported)
    }

    async fn take(
        mut self,
        mut chunks: BoxStream<'static, Result<Bytes, Status>>,
        progress: impl Fn(Progress),
    ) -> Result<v1::ImportActorResponse, Status> {
        while let Some(chunk) = in_time(chunks.try_next()).await? {
            self.append(&chunk)?;
            progress(self.progress(ImportStage::Receiving));
        }
        progress(self.progress(ImportStage::Reading));
        let storing = self.progress(ImportStage::Storing);
        self.store_package(|| progress(storing)).await
    }

    fn progress(&self, stage: ImportStage) -> Progress {
        Progress {
            stage,
            received_bytes: self.package.len(),
        }
    }

    fn append(&mut self, chunk: &[u8]) -> Result<(), Status> {
        if chunk.len() > MAX_CHUNK_BYTES {
            return Err(refusal::too_large("CHUNK_SIZE", "chunk", MAX_CHUNK_BYTES));
        }
        if self.package.len() + chunk.len() > self.service.max_package_bytes {
            return Err(self.too_large());
        }
        self.package.extend_from_slice(chunk);
        if COMPRESSED
            .iter()
            .any(|magic| self.package.starts_with(magic))
        {
            return Err(refusal::package(&PackageError::Compressed));
        }
        Ok(())
    }

    fn too_large(&self) -> Status {
        let limit = self.service.max_package_bytes;
        refusal::too_large("BASIS_SIZE", "limits.package_mib", limit)
    }

    async fn store_package(self, storing: impl Fn()) -> Result<v1::ImportActorResponse, Status> {
        let Self {
            service,
            start,
            package,
            place: held,
        } = self;
        let rank = if start.regularize {
            RankPolicy::Regularize
        } else {
            RankPolicy::Refuse
        };
        let (read, package) = service
            .workers
            .run(move || (actor_package::read(&package, rank), package))
            .await;
        let read = read.map_err(|error| refusal::package(&error))?;
        check_unit(&start, &read)?;
        let layout = wire::actor::layout(&read.actor, &start);
        let new = NewRevision {
            actor: start.actor,
            layout,
            package,
        };
        storing();
        let now_nanos = service.unix_now_nanos();
        let added = service.store.add_revision(new, now_nanos).await?;
        let loaded = Arc::new(read.actor);
        service
            .store
            .keep_loaded(&added.actor, added.revision, &loaded);
        drop(held.permit);
        tracing::info!(actor = %added.actor, revision = added.revision, "actor imported");
        Ok(v1::ImportActorResponse {
            actor: Some(wire::actor::actor(&added)),
            warnings: read.warnings.iter().map(ToString::to_string).collect(),
        })
    }
}

fn check_unit(start: &ImportStart, read: &ReadActor) -> Result<(), Status> {
    match start.unit {
        Some(declared) if declared != read.unit => Err(unit_mismatch(declared, read.unit)),
        _ => Ok(()),
    }
}

fn unit_mismatch(declared: LengthUnit, found: LengthUnit) -> Status {
    let (declared, found) = (declared.symbol(), found.symbol());
    let message = format!("the request says {declared}, the package is in {found}");
    Refusal::new(Code::InvalidArgument, "UNIT_MISMATCH", message)
        .with("declared", &declared)
        .with("found", &found)
        .into_status()
}

async fn in_time<T>(next: impl Future<Output = Result<T, Status>>) -> Result<T, Status> {
    let in_time = tokio::time::timeout(MESSAGE_DEADLINE, next).await;
    in_time.unwrap_or_else(|_| {
        let message = format!("no message for {} s", MESSAGE_DEADLINE.as_secs());
        Err(refuse(Code::DeadlineExceeded, "MESSAGE_DEADLINE", message))
    })
}

fn order(message: &str) -> Status {
    refuse(Code::FailedPrecondition, "PROTOCOL_ORDER", message)
}
