//! `/api/v1/takes`: recordings, from their start to their erasure.

mod body;
mod exported;
mod file;
mod range;
mod resolve;

use axum::{
    Json,
    extract::State,
    http::{StatusCode, header},
    response::{IntoResponse as _, Response},
};
use frontalis_proto::v1::{self, take_service_server::TakeService as _};
use serde::Deserialize;
use utoipa::IntoParams;

use super::{
    Doors,
    call::{Answer, BodyMessage, Call, Message},
    openapi::{BodyRefusals, ObjectRefusals, Refusals, StateRefusals},
    problem::Problem,
    query::TakePath,
};
use crate::service::access::Action;

pub(super) use file::{__path_download, download};
pub(super) use resolve::{__path_resolve, resolve};

impl BodyMessage for v1::StartTakeRequest {
    const ACTION: Action = Action::Record;
    const IN_PATH: &'static [&'static str] = &[];
    const MAY_BE_ABSENT: bool = false;
}

impl BodyMessage for v1::UpdateTakeRequest {
    const ACTION: Action = Action::Record;
    const IN_PATH: &'static [&'static str] = &[];
    const MAY_BE_ABSENT: bool = false;
}

impl BodyMessage for v1::StopTakeRequest {
    const ACTION: Action = Action::Record;
    const IN_PATH: &'static [&'static str] = &["name"];
    const MAY_BE_ABSENT: bool = true;
}

/// Part of the list of takes.
#[derive(Deserialize, IntoParams)]
#[serde(rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(super) struct TakesQuery {
    /// Entries of the page; 0: 50, more than 500: 500.
    #[serde(default)]
    #[param(required = false, maximum = 4_294_967_295_u64)]
    page_size: u32,
    /// `nextPageToken` of the page before; empty: the first page.
    #[serde(default)]
    #[param(required = false, pattern = "^[a-z0-9_-]{0,63}$", example = "")]
    page_token: String,
    /// `sessions/ID`: those of this session; empty: of all.
    #[serde(default)]
    #[param(
        required = false,
        pattern = "^(sessions/[a-z0-9][a-z0-9_-]{0,62})?$",
        example = "sessions/take-1"
    )]
    session: String,
    /// `actors/ID`: those of this actor; empty: of all.
    #[serde(default)]
    #[param(
        required = false,
        pattern = "^(actors/[a-z0-9][a-z0-9_-]{0,62})?$",
        example = "actors/reference"
    )]
    actor: String,
    /// Those of this slate; empty: of all.
    #[serde(default)]
    #[param(required = false, example = "12A")]
    slate: String,
}

/// Takes by id, those under way included.
#[utoipa::path(
    get,
    path = "/api/v1/takes",
    operation_id = "listTakes",
    tag = "takes",
    params(TakesQuery),
    responses(
        (status = 200, description = "A page.", body = ref("#/components/schemas/ListTakesResponse")),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/ListTakes"))),
)]
pub(super) async fn list(
    State(doors): State<Doors>,
    call: Call<TakesQuery>,
) -> Answer<v1::ListTakesResponse> {
    let query = &call.query;
    let request = call.request(v1::ListTakesRequest {
        page_size: query.page_size,
        page_token: query.page_token.clone(),
        session: query.session.clone(),
        actor: query.actor.clone(),
        slate: query.slate.clone(),
    });
    let response = doors.services.takes.list_takes(request).await?;
    Ok(Json(response.into_inner()))
}

/// Starts to record a session: what it acknowledges from then on is in the take.
#[utoipa::path(
    post,
    path = "/api/v1/takes",
    operation_id = "startTake",
    tag = "takes",
    request_body(
        content = ref("#/components/schemas/StartTakeRequest"),
        content_type = "application/json",
        example = json!({ "session": "sessions/take-1", "slate": "12A" }),
    ),
    responses(
        (
            status = 201,
            description = "The take, which is being recorded.",
            body = ref("#/components/schemas/Take"),
            headers(("location" = String, description = "Its path.")),
        ),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/StartTake"))),
)]
pub(super) async fn start(
    State(doors): State<Doors>,
    call: Call,
    Message(message): Message<v1::StartTakeRequest>,
) -> Result<Response, Problem> {
    let request = call.request(message);
    let response = doors.services.takes.start_take(request).await?;
    let take = response.into_inner().take.unwrap_or_default();
    let location = [(header::LOCATION, format!("/api/v1/{}", take.name))];
    Ok((StatusCode::CREATED, location, Json(take)).into_response())
}

/// One take, as far as it has been recorded.
#[utoipa::path(
    get,
    path = "/api/v1/takes/{id}",
    operation_id = "getTake",
    tag = "takes",
    params(TakePath),
    responses(
        (status = 200, description = "The take.", body = ref("#/components/schemas/Take")),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/GetTake"))),
)]
pub(super) async fn get(State(doors): State<Doors>, call: Call) -> Answer<v1::Take> {
    let name = call.name("takes");
    let request = call.request(v1::GetTakeRequest { name });
    let response = doors.services.takes.get_take(request).await?;
    Ok(answer(response.into_inner().take))
}

/// Corrects what is said of a take: slate, number, gesture, the director's choice, notes.
///
/// Without a mask all that is not empty changes. The path names the take, whatever `take.name` says.
#[utoipa::path(
    patch,
    path = "/api/v1/takes/{id}",
    operation_id = "updateTake",
    tag = "takes",
    params(TakePath),
    request_body(
        content = ref("#/components/schemas/UpdateTakeRequest"),
        content_type = "application/json",
        example = json!({ "take": { "circled": true, "notes": "the one" }, "updateMask": "circled,notes" }),
    ),
    responses(
        (status = 200, description = "The take.", body = ref("#/components/schemas/Take")),
        Refusals,
        ObjectRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/UpdateTake"))),
)]
pub(super) async fn update(
    State(doors): State<Doors>,
    call: Call,
    Message(message): Message<v1::UpdateTakeRequest>,
) -> Answer<v1::Take> {
    let take = v1::Take {
        name: call.name("takes"),
        ..message.take.unwrap_or_default()
    };
    let request = call.request(v1::UpdateTakeRequest {
        take: Some(take),
        update_mask: message.update_mask,
    });
    let response = doors.services.takes.update_take(request).await?;
    Ok(answer(response.into_inner().take))
}

/// Ends a recording; answers when all of it is on stable storage. One that is over stays as it is.
#[utoipa::path(
    post,
    path = "/api/v1/takes/{id}/stop",
    operation_id = "stopTake",
    tag = "takes",
    params(TakePath),
    request_body(
        content = ref("#/components/schemas/StopTakeRequest"),
        content_type = "application/json",
    ),
    responses(
        (status = 200, description = "The take.", body = ref("#/components/schemas/Take")),
        Refusals,
        ObjectRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/StopTake"))),
)]
pub(super) async fn stop(
    State(doors): State<Doors>,
    call: Call,
    Message(_message): Message<v1::StopTakeRequest>,
) -> Answer<v1::Take> {
    let name = call.name("takes");
    let request = call.request(v1::StopTakeRequest { name });
    let response = doors.services.takes.stop_take(request).await?;
    Ok(answer(response.into_inner().take))
}

/// Erases a take; nothing of it stays on the server's disk.
#[utoipa::path(
    delete,
    path = "/api/v1/takes/{id}",
    operation_id = "deleteTake",
    tag = "takes",
    params(TakePath),
    responses(
        (status = 200, description = "Erased.", body = ref("#/components/schemas/DeleteTakeResponse")),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/DeleteTake"))),
)]
pub(super) async fn delete(
    State(doors): State<Doors>,
    call: Call,
) -> Answer<v1::DeleteTakeResponse> {
    let name = call.name("takes");
    let request = call.request(v1::DeleteTakeRequest { name });
    let response = doors.services.takes.delete_take(request).await?;
    Ok(Json(response.into_inner()))
}

fn answer(take: Option<v1::Take>) -> Json<v1::Take> {
    Json(take.unwrap_or_default())
}
