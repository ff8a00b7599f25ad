//! `/api/v1/server`: what this server is, and who asks.

use axum::{Json, extract::State};
use frontalis_proto::v1::{self, server_service_server::ServerService as _};

use super::{
    Doors,
    call::{Answer, Call},
    openapi::Refusals,
};

/// What this server is, and what the caller may do.
#[utoipa::path(
    get,
    path = "/api/v1/server",
    operation_id = "getServer",
    tag = "server",
    responses(
        (status = 200, description = "The server.", body = ref("#/components/schemas/Server")),
        Refusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ServerService/GetServer"))),
)]
pub(super) async fn get(State(doors): State<Doors>, call: Call) -> Answer<v1::Server> {
    let request = call.request(v1::GetServerRequest {});
    let response = doors.services.server.get_server(request).await?;
    Ok(Json(response.into_inner().server.unwrap_or_default()))
}
