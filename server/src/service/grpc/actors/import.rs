//! One import: the stream's chunks, the package they make, the revision that comes of it.
//!
//! Sizes are refused while the bytes still come; nothing is stored before the whole package was read and accepted.

use std::{sync::Arc, time::Duration};

use frontalis_analysis::{
    face::actor::RankPolicy,
    format::actor_package::{self, PackageError, ReadActor},
    space::LengthUnit,
};
use frontalis_proto::v1;
use tonic::{Code, Status, Streaming};

use super::{ActorsGrpc, MAX_CHUNK_BYTES};
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

impl ActorsGrpc {
    pub(super) async fn import(
        &self,
        mut stream: Streaming<v1::ImportActorRequest>,
    ) -> Result<v1::ImportActorResponse, Status> {
        let first = next(&mut stream)
            .await?
            .ok_or_else(|| order("the stream has no message"))?;
        let start = first
            .start
            .ok_or_else(|| order("the first message must hold start"))?;
        let start = ImportStart::try_from(start)?;
        let mut package = Vec::new();
        self.append(&mut package, &first.chunk)?;
        while let Some(message) = next(&mut stream).await? {
            if message.start.is_some() {
                return Err(order("start comes once"));
            }
            self.append(&mut package, &message.chunk)?;
        }
        self.store_package(start, package).await
    }

    fn append(&self, package: &mut Vec<u8>, chunk: &[u8]) -> Result<(), Status> {
        if chunk.len() > MAX_CHUNK_BYTES {
            return Err(refusal::too_large("CHUNK_SIZE", "chunk", MAX_CHUNK_BYTES));
        }
        if package.len() + chunk.len() > self.max_package_bytes {
            return Err(refusal::too_large(
                "BASIS_SIZE",
                "limits.package_mib",
                self.max_package_bytes,
            ));
        }
        package.extend_from_slice(chunk);
        if COMPRESSED.iter().any(|magic| package.starts_with(magic)) {
            return Err(refusal::package(&PackageError::Compressed));
        }
        Ok(())
    }

    async fn store_package(
        &self,
        start: ImportStart,
        package: Vec<u8>,
    ) -> Result<v1::ImportActorResponse, Status> {
        let rank = if start.regularize {
            RankPolicy::Regularize
        } else {
            RankPolicy::Refuse
        };
        let (read, package) = self
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
        let added = self.store.add_revision(new, self.unix_now_nanos()).await?;
        self.store
            .keep_loaded(&added.actor, added.revision, &Arc::new(read.actor));
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

async fn next(
    stream: &mut Streaming<v1::ImportActorRequest>,
) -> Result<Option<v1::ImportActorRequest>, Status> {
    let in_time = tokio::time::timeout(MESSAGE_DEADLINE, stream.message()).await;
    in_time.unwrap_or_else(|_| {
        let message = format!("no message for {} s", MESSAGE_DEADLINE.as_secs());
        Err(refuse(Code::DeadlineExceeded, "MESSAGE_DEADLINE", message))
    })
}

fn order(message: &str) -> Status {
    refuse(Code::FailedPrecondition, "PROTOCOL_ORDER", message)
}
