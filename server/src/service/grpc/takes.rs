//! `TakeService`: recordings, which later versions fill.

use std::pin::Pin;

use frontalis_proto::v1::{self, take_service_server::TakeService};
use futures::Stream;
use tonic::{Request, Response, Status};

use super::actors::not_built;

type Responses<T> = Pin<Box<dyn Stream<Item = Result<T, Status>> + Send>>;

/// Answers every call with UNIMPLEMENTED.
#[derive(Clone, Copy, Debug, Default)]
pub struct TakesGrpc;

#[tonic::async_trait]
impl TakeService for TakesGrpc {
    async fn start_take(
        &self,
        _request: Request<v1::StartTakeRequest>,
    ) -> Result<Response<v1::StartTakeResponse>, Status> {
        Err(not_built("StartTake"))
    }

    async fn stop_take(
        &self,
        _request: Request<v1::StopTakeRequest>,
    ) -> Result<Response<v1::StopTakeResponse>, Status> {
        Err(not_built("StopTake"))
    }

    async fn get_take(
        &self,
        _request: Request<v1::GetTakeRequest>,
    ) -> Result<Response<v1::GetTakeResponse>, Status> {
        Err(not_built("GetTake"))
    }

    async fn list_takes(
        &self,
        _request: Request<v1::ListTakesRequest>,
    ) -> Result<Response<v1::ListTakesResponse>, Status> {
        Err(not_built("ListTakes"))
    }

    async fn update_take(
        &self,
        _request: Request<v1::UpdateTakeRequest>,
    ) -> Result<Response<v1::UpdateTakeResponse>, Status> {
        Err(not_built("UpdateTake"))
    }

    async fn delete_take(
        &self,
        _request: Request<v1::DeleteTakeRequest>,
    ) -> Result<Response<v1::DeleteTakeResponse>, Status> {
        Err(not_built("DeleteTake"))
    }

    type ExportTakeStream = Responses<v1::ExportTakeResponse>;

    async fn export_take(
        &self,
        _request: Request<v1::ExportTakeRequest>,
    ) -> Result<Response<Self::ExportTakeStream>, Status> {
        Err(not_built("ExportTake"))
    }

    type ResolveTakeStream = Responses<v1::ResolveTakeResponse>;

    async fn resolve_take(
        &self,
        _request: Request<v1::ResolveTakeRequest>,
    ) -> Result<Response<Self::ResolveTakeStream>, Status> {
        Err(not_built("ResolveTake"))
    }
}
