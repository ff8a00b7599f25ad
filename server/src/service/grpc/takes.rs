//! `TakeService`: recordings, which later versions fill.

use std::pin::Pin;

use frontalis_proto::v1::{self, take_service_server::TakeService};
use futures::Stream;
use tonic::{Request, Response, Status};

use super::actors::not_built;
use crate::{
    name::SessionId,
    service::access::{Action, Caller},
    wire::invalid::FieldError,
};

type Responses<T> = Pin<Box<dyn Stream<Item = Result<T, Status>> + Send>>;

/// Answers every call of those who may with UNIMPLEMENTED.
#[derive(Clone, Copy, Debug, Default)]
pub struct TakesGrpc;

/// The role, and the scope where the request names a session.
fn check(caller: &Caller, action: Action, session: Option<&str>) -> Result<(), Status> {
    caller.may(action)?;
    match session {
        None | Some("") => Ok(()),
        Some(name) => {
            let session = SessionId::from_resource(name).map_err(FieldError::name("session"))?;
            caller.may_in(action, &session)
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
        check(
            &caller,
            Action::Record,
            Some(request.get_ref().session.as_str()),
        )?;
        Err(not_built("StartTake"))
    }

    async fn stop_take(
        &self,
        request: Request<v1::StopTakeRequest>,
    ) -> Result<Response<v1::StopTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        check(&caller, Action::Record, None)?;
        Err(not_built("StopTake"))
    }

    async fn get_take(
        &self,
        request: Request<v1::GetTakeRequest>,
    ) -> Result<Response<v1::GetTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        check(&caller, Action::ReadTakes, None)?;
        Err(not_built("GetTake"))
    }

    async fn list_takes(
        &self,
        request: Request<v1::ListTakesRequest>,
    ) -> Result<Response<v1::ListTakesResponse>, Status> {
        let caller = Caller::of(request.extensions());
        check(
            &caller,
            Action::ReadTakes,
            Some(request.get_ref().session.as_str()),
        )?;
        Err(not_built("ListTakes"))
    }

    async fn update_take(
        &self,
        request: Request<v1::UpdateTakeRequest>,
    ) -> Result<Response<v1::UpdateTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        check(&caller, Action::Record, None)?;
        Err(not_built("UpdateTake"))
    }

    async fn delete_take(
        &self,
        request: Request<v1::DeleteTakeRequest>,
    ) -> Result<Response<v1::DeleteTakeResponse>, Status> {
        let caller = Caller::of(request.extensions());
        check(&caller, Action::DeleteTake, None)?;
        Err(not_built("DeleteTake"))
    }

    type ExportTakeStream = Responses<v1::ExportTakeResponse>;

    async fn export_take(
        &self,
        request: Request<v1::ExportTakeRequest>,
    ) -> Result<Response<Self::ExportTakeStream>, Status> {
        let caller = Caller::of(request.extensions());
        check(&caller, Action::ReadTakes, None)?;
        Err(not_built("ExportTake"))
    }

    type ResolveTakeStream = Responses<v1::ResolveTakeResponse>;

    async fn resolve_take(
        &self,
        request: Request<v1::ResolveTakeRequest>,
    ) -> Result<Response<Self::ResolveTakeStream>, Status> {
        let caller = Caller::of(request.extensions());
        check(&caller, Action::MakeActors, None)?;
        Err(not_built("ResolveTake"))
    }
}
