//! `POST /api/v1/takes/{id}/resolve`: `ResolveTake` as lines of JSON, one as often as there is progress.

use std::convert::Infallible;

use axum::{
    body::Body,
    extract::State,
    http::{HeaderValue, Uri, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1::{self, take_service_server::TakeService as _};
use futures::StreamExt as _;
use tonic::Status;

use crate::service::{
    access::Action,
    http::{
        Doors,
        call::{BodyMessage, Call, Message},
        message::write_json,
        openapi::{BodyRefusals, ObjectRefusals, Refusals, StateRefusals},
        problem::Problem,
        query::TakePath,
    },
};

impl BodyMessage for v1::ResolveTakeRequest {
    const ACTION: Action = Action::MakeActors;
    const IN_PATH: &'static [&'static str] = &["name"];
    const MAY_BE_ABSENT: bool = true;
}

/// Solves the recorded frames again, with another revision or other settings, into a new take.
///
/// Answers with progress, a line each; the last line has the new take, or is `{"error": …}`.
#[utoipa::path(
    post,
    path = "/api/v1/takes/{id}/resolve",
    operation_id = "resolveTake",
    tag = "takes",
    params(TakePath),
    request_body(
        content = ref("#/components/schemas/ResolveTakeRequest"),
        content_type = "application/json",
    ),
    responses(
        (
            status = 200,
            description = "Progress, a line each; the last line has `take`.",
            content((ref("#/components/schemas/ResolveTakeResponse") = "application/x-ndjson")),
        ),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/ResolveTake"))),
)]
pub(in crate::service::http) async fn resolve(
    State(doors): State<Doors>,
    uri: Uri,
    call: Call,
    Message(message): Message<v1::ResolveTakeRequest>,
) -> Result<Response, Problem> {
    let name = call.name("takes");
    let request = call.request(v1::ResolveTakeRequest { name, ..message });
    let response = doors.services.takes.resolve_take(request).await?;
    let instance = uri.path().to_owned();
    let lines = response
        .into_inner()
        .map(move |it| Ok::<_, Infallible>(line(it, &instance)));
    let kind = HeaderValue::from_static("application/x-ndjson");
    let headers = [(header::CONTENT_TYPE, kind)];
    Ok((headers, Body::from_stream(lines)).into_response())
}

/// One answer; a failure is the last.
fn line(answer: Result<v1::ResolveTakeResponse, Status>, instance: &str) -> Bytes {
    let mut text = Vec::new();
    if let Err(status) = answer.and_then(|it| write_json(&it, &mut text)) {
        text = Problem::from(status).in_stream(instance).into_bytes();
    }
    text.push(b'\n');
    Bytes::from(text)
}
