//! `/api/v1/sessions`: one actor, one capture, any number of subscribers.

use axum::{
    Json,
    extract::State,
    http::{StatusCode, header},
    response::{IntoResponse as _, Response},
};
use frontalis_proto::v1::{self, session_service_server::SessionService as _};

use super::{
    Doors,
    call::{Answer, BodyMessage, Call, Message},
    openapi::{BodyRefusals, ObjectRefusals, Refusals, StateRefusals},
    problem::Problem,
    query::{ListQuery, SessionPath},
};
use crate::service::access::Action;

impl BodyMessage for v1::CreateSessionRequest {
    const ACTION: Action = Action::CreateSession;
    const IN_PATH: &'static [&'static str] = &[];
    const MAY_BE_ABSENT: bool = false;
}

impl BodyMessage for v1::UpdateSessionRequest {
    const ACTION: Action = Action::ChangeSession;
    const IN_PATH: &'static [&'static str] = &["name"];
    const MAY_BE_ABSENT: bool = false;
}

impl BodyMessage for v1::RecenterSessionRequest {
    const ACTION: Action = Action::ChangeSession;
    const IN_PATH: &'static [&'static str] = &["name"];
    const MAY_BE_ABSENT: bool = true;
}

impl BodyMessage for v1::EndSessionRequest {
    const ACTION: Action = Action::EndSession;
    const IN_PATH: &'static [&'static str] = &["name"];
    const MAY_BE_ABSENT: bool = true;
}

/// Sessions by id, those that ended within the retention included.
#[utoipa::path(
    get,
    path = "/api/v1/sessions",
    operation_id = "listSessions",
    tag = "sessions",
    params(ListQuery),
    responses(
        (status = 200, description = "A page.", body = ref("#/components/schemas/ListSessionsResponse")),
        Refusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.SessionService/ListSessions"))),
)]
pub(super) async fn list(
    State(doors): State<Doors>,
    call: Call<ListQuery>,
) -> Answer<v1::ListSessionsResponse> {
    let request = call.request(v1::ListSessionsRequest {
        page_size: call.query.page_size,
        page_token: call.query.page_token.clone(),
    });
    let response = doors.services.sessions.list_sessions(request).await?;
    Ok(Json(response.into_inner()))
}

/// Creates a session of the newest revision of its actor.
#[utoipa::path(
    post,
    path = "/api/v1/sessions",
    operation_id = "createSession",
    tag = "sessions",
    request_body(
        content = ref("#/components/schemas/CreateSessionRequest"),
        content_type = "application/json",
        example = json!({
            "sessionId": "take-1", "actor": "actors/reference", "kind": "CAPTURE_KIND_MARKERS"
        }),
    ),
    responses(
        (
            status = 201,
            description = "The session.",
            body = ref("#/components/schemas/Session"),
            headers(("location" = String, description = "Its path.")),
        ),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.SessionService/CreateSession"))),
)]
pub(super) async fn create(
    State(doors): State<Doors>,
    call: Call,
    Message(message): Message<v1::CreateSessionRequest>,
) -> Result<Response, Problem> {
    let request = call.request(message);
    let response = doors.services.sessions.create_session(request).await?;
    let session = response.into_inner().session.unwrap_or_default();
    let location = [(header::LOCATION, format!("/api/v1/{}", session.name))];
    Ok((StatusCode::CREATED, location, Json(session)).into_response())
}

/// One session with its settings and its status.
#[utoipa::path(
    get,
    path = "/api/v1/sessions/{id}",
    operation_id = "getSession",
    tag = "sessions",
    params(SessionPath),
    responses(
        (status = 200, description = "The session.", body = ref("#/components/schemas/Session")),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.SessionService/GetSession"))),
)]
pub(super) async fn get(State(doors): State<Doors>, call: Call) -> Answer<v1::Session> {
    let name = call.name("sessions");
    let request = call.request(v1::GetSessionRequest { name });
    let response = doors.services.sessions.get_session(request).await?;
    Ok(answer(response.into_inner().session))
}

/// Changes settings, or moves the session to another revision of its actor, between two frames.
#[utoipa::path(
    patch,
    path = "/api/v1/sessions/{id}",
    operation_id = "updateSession",
    tag = "sessions",
    params(SessionPath),
    request_body(
        content = ref("#/components/schemas/UpdateSessionRequest"),
        content_type = "application/json",
        example = json!({ "settings": { "regionMode": "REGION_MODE_SPLIT" } }),
    ),
    responses(
        (status = 200, description = "The session.", body = ref("#/components/schemas/Session")),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.SessionService/UpdateSession"))),
)]
pub(super) async fn update(
    State(doors): State<Doors>,
    call: Call,
    Message(message): Message<v1::UpdateSessionRequest>,
) -> Answer<v1::Session> {
    let name = call.name("sessions");
    let request = call.request(v1::UpdateSessionRequest { name, ..message });
    let response = doors.services.sessions.update_session(request).await?;
    Ok(answer(response.into_inner().session))
}

/// Takes another neutral face: the next usable frames, or the quietest that were seen.
///
/// A live session goes on with its alignment until the new one is known.
#[utoipa::path(
    post,
    path = "/api/v1/sessions/{id}/recenter",
    operation_id = "recenterSession",
    tag = "sessions",
    params(SessionPath),
    request_body(
        content = ref("#/components/schemas/RecenterSessionRequest"),
        content_type = "application/json",
    ),
    responses(
        (status = 200, description = "The session.", body = ref("#/components/schemas/Session")),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.SessionService/RecenterSession"))),
)]
pub(super) async fn recenter(
    State(doors): State<Doors>,
    call: Call,
    Message(message): Message<v1::RecenterSessionRequest>,
) -> Answer<v1::Session> {
    let name = call.name("sessions");
    let request = call.request(v1::RecenterSessionRequest { name, ..message });
    let response = doors.services.sessions.recenter_session(request).await?;
    Ok(answer(response.into_inner().session))
}

/// Ends the session once what is queued is done. One that has ended stays so.
#[utoipa::path(
    post,
    path = "/api/v1/sessions/{id}/end",
    operation_id = "endSession",
    tag = "sessions",
    params(SessionPath),
    request_body(
        content = ref("#/components/schemas/EndSessionRequest"),
        content_type = "application/json",
    ),
    responses(
        (status = 200, description = "The session.", body = ref("#/components/schemas/Session")),
        Refusals,
        ObjectRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.SessionService/EndSession"))),
)]
pub(super) async fn end(
    State(doors): State<Doors>,
    call: Call,
    Message(_message): Message<v1::EndSessionRequest>,
) -> Answer<v1::Session> {
    let name = call.name("sessions");
    let request = call.request(v1::EndSessionRequest { name });
    let response = doors.services.sessions.end_session(request).await?;
    Ok(answer(response.into_inner().session))
}

fn answer(session: Option<v1::Session>) -> Json<v1::Session> {
    Json(session.unwrap_or_default())
}
