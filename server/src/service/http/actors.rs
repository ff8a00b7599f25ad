//! `/api/v1/actors`: packages in, actors listed, packages out.

mod download;
mod upload;

use axum::{Json, extract::State};
use frontalis_proto::v1::{self, actor_service_server::ActorService as _};
use serde::Deserialize;
use utoipa::IntoParams;

use super::{
    Doors,
    call::{Answer, Call},
    openapi::{ObjectRefusals, Refusals, StateRefusals},
    query::{ActorPath, ListQuery},
};

pub(super) use download::{__path_model, __path_package, model, package};
pub(super) use upload::{__path_import, import};

/// How much is erased.
#[derive(Deserialize, IntoParams)]
#[serde(rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(super) struct DeleteQuery {
    /// Erase everything of this person.
    #[serde(default)]
    #[param(required = false)]
    with_takes: bool,
}

/// Actors by id, each as its newest revision.
#[utoipa::path(
    get,
    path = "/api/v1/actors",
    operation_id = "listActors",
    tag = "actors",
    params(ListQuery),
    responses(
        (status = 200, description = "A page.", body = ref("#/components/schemas/ListActorsResponse")),
        Refusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ActorService/ListActors"))),
)]
pub(super) async fn list(
    State(doors): State<Doors>,
    call: Call<ListQuery>,
) -> Answer<v1::ListActorsResponse> {
    let request = call.request(v1::ListActorsRequest {
        page_size: call.query.page_size,
        page_token: call.query.page_token.clone(),
    });
    let response = doors.services.actors.list_actors(request).await?;
    Ok(Json(response.into_inner()))
}

/// One actor as its newest revision.
#[utoipa::path(
    get,
    path = "/api/v1/actors/{id}",
    operation_id = "getActor",
    tag = "actors",
    params(ActorPath),
    responses(
        (status = 200, description = "The actor.", body = ref("#/components/schemas/Actor")),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ActorService/GetActor"))),
)]
pub(super) async fn get(State(doors): State<Doors>, call: Call) -> Answer<v1::Actor> {
    let name = call.name("actors");
    let request = call.request(v1::GetActorRequest { name });
    let response = doors.services.actors.get_actor(request).await?;
    Ok(Json(response.into_inner().actor.unwrap_or_default()))
}

/// Erases the actor and its revisions; refused while a session uses it.
#[utoipa::path(
    delete,
    path = "/api/v1/actors/{id}",
    operation_id = "deleteActor",
    tag = "actors",
    params(ActorPath, DeleteQuery),
    responses(
        (status = 200, description = "Erased.", body = ref("#/components/schemas/DeleteActorResponse")),
        Refusals,
        ObjectRefusals,
        StateRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ActorService/DeleteActor"))),
)]
pub(super) async fn delete(
    State(doors): State<Doors>,
    call: Call<DeleteQuery>,
) -> Answer<v1::DeleteActorResponse> {
    let request = call.request(v1::DeleteActorRequest {
        name: call.name("actors"),
        with_takes: call.query.with_takes,
    });
    let response = doors.services.actors.delete_actor(request).await?;
    Ok(Json(response.into_inner()))
}
