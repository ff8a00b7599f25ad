//! `TakeService`: recordings, from their start to their erasure.

use std::pin::Pin;

use frontalis_proto::v1::{self, take_service_server::TakeService};
use futures::Stream;
use tonic::{Request, Response, Status};

use crate::{
    catalogue::{CatalogueError, TakeFilter, TakeRow},
    name::{ActorId, SessionId, TakeId},
    service::{
        access::{Action, Caller},
        audit::Audit,
        peer::Peer,
        take_exports::{OpenTakeFile, TakeExports},
        takes::{ResolveOrder, Takes},
    },
    wire::{
        invalid::{FieldError, FieldProblem},
        page::Page,
        take as wire,
    },
};

type Responses<T> = Pin<Box<dyn Stream<Item = Result<T, Status>> + Send>>;

/// The takes of a server. Cheap to clone.
#[derive(Clone)]
pub struct TakesGrpc {
    takes: Takes,
    exports: TakeExports,
    audit: Audit,
}

impl TakesGrpc {
    /// The service over `takes`, which go out through `exports`.
    pub fn new(takes: Takes, exports: TakeExports, audit: Audit) -> Self {
        Self {
            takes,
            exports,
            audit,
        }
    }

    /// The stored file of a take, for doors that hand out parts of it.
    ///
    /// # Errors
    ///
    /// As [`TakeService::export_take`].
    pub async fn open_file(
        &self,
        request: Request<v1::ExportTakeRequest>,
    ) -> Result<OpenTakeFile, Status> {
        let peer = Peer::of(request.extensions());
        let name = &request.get_ref().name;
        let row = self.allowed(&peer.caller, Action::ReadTakes, name).await?;
        let opened = self.exports.open(&peer, row).await;
        self.audit.outcome("take_export", &peer, name, opened)
    }

    /// The take of this name, if the caller may do this to it. One that it must not see is not there.
    async fn allowed(
        &self,
        caller: &Caller,
        action: Action,
        name: &str,
    ) -> Result<TakeRow, Status> {
        caller.may(action)?;
        let id = TakeId::from_resource(name).map_err(FieldError::name("name"))?;
        let row = self.takes.get(&id).await?;
        if caller.sees(&row.session) {
            Ok(row)
        } else {
            Err(CatalogueError::NoTake.into())
        }
    }
}

#[tonic::async_trait]
impl TakeService for TakesGrpc {
    async fn start_take(
        &self,
        request: Request<v1::StartTakeRequest>,
    ) -> Result<Response<v1::StartTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::Record)?;
        let request = request.into_inner();
        let session =
            SessionId::from_resource(&request.session).map_err(FieldError::name("session"))?;
        caller.may_in(Action::Record, &session)?;
        let row = self
            .takes
            .start(&session, wire::new_take(&request)?)
            .await?;
        Ok(Response::new(v1::StartTakeResponse {
            take: Some(wire::take(&row)),
        }))
    }

    async fn stop_take(
        &self,
        request: Request<v1::StopTakeRequest>,
    ) -> Result<Response<v1::StopTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        let name = &request.get_ref().name;
        let row = self.allowed(&caller, Action::Record, name).await?;
        let row = self.takes.stop(&row.id).await?;
        Ok(Response::new(v1::StopTakeResponse {
            take: Some(wire::take(&row)),
        }))
    }

    async fn get_take(
        &self,
        request: Request<v1::GetTakeRequest>,
    ) -> Result<Response<v1::GetTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        let name = &request.get_ref().name;
        let row = self.allowed(&caller, Action::ReadTakes, name).await?;
        Ok(Response::new(v1::GetTakeResponse {
            take: Some(wire::take(&row)),
        }))
    }

    async fn list_takes(
        &self,
        request: Request<v1::ListTakesRequest>,
    ) -> Result<Response<v1::ListTakesResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadTakes)?;
        let request = request.into_inner();
        let page = Page::parse(request.page_size, &request.page_token)?;
        let filter = filter(request)?;
        if let Some(session) = &filter.session {
            caller.may_in(Action::ReadTakes, session)?;
        }
        let is_seen = |id: &SessionId| caller.sees(id);
        let (rows, next_page_token) = self.takes.list(&filter, &page, is_seen).await?;
        Ok(Response::new(v1::ListTakesResponse {
            takes: rows.iter().map(wire::take).collect(),
            next_page_token,
        }))
    }

    async fn update_take(
        &self,
        request: Request<v1::UpdateTakeRequest>,
    ) -> Result<Response<v1::UpdateTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        let request = request.into_inner();
        let sent = request.take.unwrap_or_default();
        let mask = request.update_mask.unwrap_or_default().paths;
        let row = self.allowed(&caller, Action::Record, &sent.name).await?;
        let labels = wire::relabeled(&row.labels, &sent, &mask)?;
        let row = self.takes.label(&row.id, labels).await?;
        Ok(Response::new(v1::UpdateTakeResponse {
            take: Some(wire::take(&row)),
        }))
    }

    async fn delete_take(
        &self,
        request: Request<v1::DeleteTakeRequest>,
    ) -> Result<Response<v1::DeleteTakeResponse>, Status> {
        let peer = Peer::of(request.extensions());
        let name = &request.get_ref().name;
        let row = self.allowed(&peer.caller, Action::DeleteTake, name).await?;
        let deleted = self.takes.delete(&row.id).await;
        self.audit
            .outcome("take_delete", &peer, &row.id.resource(), deleted)?;
        Ok(Response::new(v1::DeleteTakeResponse {}))
    }

    type ExportTakeStream = Responses<v1::ExportTakeResponse>;

    async fn export_take(
        &self,
        request: Request<v1::ExportTakeRequest>,
    ) -> Result<Response<Self::ExportTakeStream>, Status> {
        let peer = Peer::of(request.extensions());
        let name = &request.get_ref().name;
        let row = self.allowed(&peer.caller, Action::ReadTakes, name).await?;
        let format = format(request.get_ref().format)?;
        let exported = self.exports.export(&peer, &row, format).await;
        let exported = self
            .audit
            .outcome("take_export", &peer, &row.id.resource(), exported)?;
        Ok(Response::new(peer.caller.while_valid(exported)))
    }

    type ResolveTakeStream = Responses<v1::ResolveTakeResponse>;

    async fn resolve_take(
        &self,
        request: Request<v1::ResolveTakeRequest>,
    ) -> Result<Response<Self::ResolveTakeStream>, Status> {
        let caller = Caller::of(request.extensions());
        let name = &request.get_ref().name;
        let row = self.allowed(&caller, Action::MakeActors, name).await?;
        let request = request.into_inner();
        let order = ResolveOrder {
            from: row,
            actor_revision: (request.actor_revision != 0).then_some(request.actor_revision),
            settings: request.settings.unwrap_or_default(),
        };
        Ok(Response::new(Box::pin(self.takes.resolve(order)?)))
    }
}

/// A format by its number; none is the take's own.
fn format(number: i32) -> Result<v1::TakeFormat, FieldError> {
    let unknown = |_| FieldError::new("format", FieldProblem::UnknownEnum(number));
    match v1::TakeFormat::try_from(number).map_err(unknown)? {
        v1::TakeFormat::Unspecified => Ok(v1::TakeFormat::Mcap),
        known => Ok(known),
    }
}

fn filter(request: v1::ListTakesRequest) -> Result<TakeFilter, Status> {
    let given = |it: &String| !it.is_empty();
    let session = Some(&request.session).filter(|it| given(it));
    let actor = Some(&request.actor).filter(|it| given(it));
    Ok(TakeFilter {
        session: session
            .map(|it| SessionId::from_resource(it).map_err(FieldError::name("session")))
            .transpose()?,
        actor: actor
            .map(|it| ActorId::from_resource(it).map_err(FieldError::name("actor")))
            .transpose()?,
        slate: Some(request.slate).filter(given),
    })
}
