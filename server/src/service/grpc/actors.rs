//! `ActorService`: packages in, actors listed, packages out.

mod convert;
mod import;
mod seen;

use std::{pin::Pin, sync::Arc};

use bytes::Bytes;
use frontalis_proto::v1::{self, actor_service_server::ActorService};
use futures::{Stream, StreamExt as _, stream};
use http::Extensions;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tonic::{Code, Request, Response, Status, Streaming};

use super::{refusal, status::refuse};
use crate::{
    catalogue::{Store, TakeFilter},
    clock::ServerClock,
    executor::Workers,
    name::ActorId,
    service::{
        access::{Action, Caller},
        audit::Audit,
        erasure::{self, Erasure},
        peer::Peer,
    },
    session::SessionRegistry,
    wire::{self, invalid::FieldError, page::Page},
};

pub use import::{Import, ImportStage, Progress};

/// Largest chunk of a package, in either direction.
pub const MAX_CHUNK_BYTES: usize = 1 << 20;

type Responses<T> = Pin<Box<dyn Stream<Item = Result<T, Status>> + Send>>;

/// The service; cheap to clone.
#[derive(Clone)]
pub struct ActorsGrpc {
    store: Store,
    registry: SessionRegistry,
    clock: ServerClock,
    workers: Workers,
    max_package_bytes: usize,
    /// One permit an import, held from its first message to its answer: each may hold a whole package.
    imports: Arc<Semaphore>,
    max_imports: usize,
    /// One permit an export, held until its last chunk is sent or its stream dropped.
    exports: Arc<Semaphore>,
    max_exports: usize,
    audit: Audit,
    erasure: Erasure,
}

/// How much of packages there may be at once.
#[derive(Clone, Copy, Debug)]
pub struct ActorLimits {
    /// Largest package, bytes.
    pub package_bytes: usize,
    /// Imports at once.
    pub imports: usize,
    /// Exports at once.
    pub exports: usize,
}

/// The right to import one package, from its first message to its answer.
pub struct ImportPlace {
    permit: OwnedSemaphorePermit,
    peer: Peer,
}

impl ActorsGrpc {
    /// Imports run on `workers`; the sessions of `registry` say which actors a caller sees.
    pub fn new(
        store: Store,
        registry: SessionRegistry,
        clock: ServerClock,
        workers: Workers,
        limits: ActorLimits,
        erasure: Erasure,
    ) -> Self {
        Self {
            store,
            registry,
            clock,
            workers,
            max_package_bytes: limits.package_bytes,
            imports: Arc::new(Semaphore::new(limits.imports)),
            max_imports: limits.imports,
            exports: Arc::new(Semaphore::new(limits.exports)),
            max_exports: limits.exports,
            audit: erasure.audit.clone(),
            erasure,
        }
    }

    /// A place for one import, before any of it is read; every door asks here first.
    pub(in crate::service) fn admit_import(
        &self,
        extensions: &Extensions,
    ) -> Result<ImportPlace, Status> {
        let peer = Peer::of(extensions);
        peer.caller.may(Action::MakeActors)?;
        let permit = Arc::clone(&self.imports)
            .try_acquire_owned()
            .map_err(|_| refusal::limit("IMPORTS", "limits.imports", self.max_imports))?;
        Ok(ImportPlace { permit, peer })
    }

    fn unix_now_nanos(&self) -> i64 {
        self.clock
            .now_nanos()
            .saturating_add(self.clock.unix_offset_nanos())
    }
}

fn id(name: &str) -> Result<ActorId, Status> {
    Ok(ActorId::from_resource(name).map_err(FieldError::name("name"))?)
}

#[tonic::async_trait]
impl ActorService for ActorsGrpc {
    async fn import_actor(
        &self,
        request: Request<Streaming<v1::ImportActorRequest>>,
    ) -> Result<Response<v1::ImportActorResponse>, Status> {
        let place = self.admit_import(request.extensions())?;
        let imported = self.import(place, request.into_inner()).await?;
        Ok(Response::new(imported))
    }

    type ExportActorStream = Responses<v1::ExportActorResponse>;

    async fn export_actor(
        &self,
        request: Request<v1::ExportActorRequest>,
    ) -> Result<Response<Self::ExportActorStream>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadActors)?;
        let request = request.into_inner();
        let id = id(&request.name)?;
        self.check_seen(&caller, &id)?;
        let permit = Arc::clone(&self.exports)
            .try_acquire_owned()
            .map_err(|_| refusal::limit("EXPORTS", "limits.exports", self.max_exports))?;
        let revision = match request.revision {
            0 => self.store.actor(&id).await?.revision,
            revision => revision,
        };
        let package = Bytes::from(self.store.package(&id, revision).await?);
        let starts = (0..package.len()).step_by(MAX_CHUNK_BYTES);
        let chunks = stream::iter(starts).map(move |start| {
            let _held = &permit;
            let end = package.len().min(start + MAX_CHUNK_BYTES);
            let chunk = package.slice(start..end).to_vec();
            Ok(v1::ExportActorResponse { chunk })
        });
        Ok(Response::new(caller.while_valid(chunks)))
    }

    async fn get_actor(
        &self,
        request: Request<v1::GetActorRequest>,
    ) -> Result<Response<v1::GetActorResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadActors)?;
        let id = id(&request.into_inner().name)?;
        self.check_seen(&caller, &id)?;
        let newest = self.store.actor(&id).await?;
        let actor = Some(wire::actor::actor(&newest));
        Ok(Response::new(v1::GetActorResponse { actor }))
    }

    async fn list_actors(
        &self,
        request: Request<v1::ListActorsRequest>,
    ) -> Result<Response<v1::ListActorsResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadActors)?;
        let request = request.into_inner();
        let page = Page::parse(request.page_size, &request.page_token)?;
        let mut found = self.read_page(&caller, &page).await?;
        let next_page_token = page.cut(&mut found, |it| it.actor.to_string());
        Ok(Response::new(v1::ListActorsResponse {
            actors: found.iter().map(wire::actor::actor).collect(),
            next_page_token,
        }))
    }

    async fn delete_actor(
        &self,
        request: Request<v1::DeleteActorRequest>,
    ) -> Result<Response<v1::DeleteActorResponse>, Status> {
        let peer = Peer::of(request.extensions());
        peer.caller.may(Action::DeleteActor)?;
        let request = request.into_inner();
        let id = id(&request.name)?;
        let deleted = if request.with_takes {
            self.erasure.actor(&id).await.map(Some)
        } else {
            self.delete_without_takes(&id).await.map(|()| None)
        };
        let receipt = self
            .audit
            .outcome("actor_delete", &peer, &id.resource(), deleted)?;
        let what = receipt.as_ref().map(erasure::in_words);
        tracing::info!(actor = %id, what, "actor erased");
        Ok(Response::new(v1::DeleteActorResponse { receipt }))
    }

    type ImproveBasisStream = Responses<v1::ImproveBasisResponse>;

    async fn improve_basis(
        &self,
        request: Request<v1::ImproveBasisRequest>,
    ) -> Result<Response<Self::ImproveBasisStream>, Status> {
        Caller::of(request.extensions()).may(Action::MakeActors)?;
        Err(not_built("ImproveBasis"))
    }

    type TrainRegionsStream = Responses<v1::TrainRegionsResponse>;

    async fn train_regions(
        &self,
        request: Request<v1::TrainRegionsRequest>,
    ) -> Result<Response<Self::TrainRegionsStream>, Status> {
        Caller::of(request.extensions()).may(Action::MakeActors)?;
        Err(not_built("TrainRegions"))
    }
}

impl ActorsGrpc {
    /// Takes of nobody could not be exported in full nor solved again.
    async fn delete_without_takes(&self, id: &ActorId) -> Result<(), Status> {
        let filter = TakeFilter {
            actor: Some(id.clone()),
            ..TakeFilter::default()
        };
        let takes = self.store.takes(filter, String::new(), 1).await?;
        if let Some(take) = takes.first() {
            let message = format!(
                "{} has takes, {} among them: they are erased with their actor (`with_takes`), or first",
                id.resource(),
                take.id.resource()
            );
            return Err(refuse(Code::FailedPrecondition, "ACTOR_HAS_TAKES", message));
        }
        Ok(self.store.delete_actor(id).await?)
    }
}

/// An RPC that later versions fill.
pub(super) fn not_built(what: &str) -> Status {
    let message = format!("this server cannot do {what} yet");
    refuse(Code::Unimplemented, "NOT_IMPLEMENTED", message)
}
