//! `POST /api/v1/sessions/{id}/frames`: `PublishMarkers` as lines of JSON, streamed both ways.
//!
//! The contract is that of `capture.proto`. The first answer decides the status; from then on a failure is the last
//! line, `{"error": …}`.

mod lines;

use axum::{
    body::Body,
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::Response,
};
use bytes::Bytes;
use frontalis_proto::v1;
use futures::{Stream, StreamExt as _, future, stream};
use tonic::Status;

use self::lines::Lines;
use super::{
    Doors,
    call::{Call, check_encoding, media_type},
    message::{Incoming as _, from_json, write_json},
    openapi::{BodyRefusals, ObjectRefusals, Refusals, StateRefusals},
    problem::Problem,
    query::SessionPath,
};
use crate::service::peer::Peer;

const NDJSON: &str = "application/x-ndjson";

/// Publishes frames: one message a line in, one answer a line out, both while they come.
///
/// The contract is that of `CaptureService.PublishMarkers`; `start.session` may be left out. A coordinate that was not
/// seen is `"NaN"`, three for a marker. Once the first answer is there a failure is the last line, `{"error": …}`.
#[utoipa::path(
    post,
    path = "/api/v1/sessions/{id}/frames",
    operation_id = "publishMarkers",
    tag = "capture",
    params(SessionPath),
    request_body(
        description = "Messages, one a line: the first holds `start`, the others frames.",
        content(
            (ref("#/components/schemas/PublishMarkersRequest") = "application/x-ndjson"),
        ),
    ),
    responses(
        (
            status = 200,
            description = "Answers, one a line: the first holds `started`.",
            content(
                (ref("#/components/schemas/PublishResponse") = "application/x-ndjson"),
            ),
        ),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.CaptureService/PublishMarkers"))),
)]
pub(super) async fn publish(
    State(doors): State<Doors>,
    call: Call,
    request: Request,
) -> Result<Response, Problem> {
    check_encoding(request.headers())?;
    check_content_type(request.headers())?;
    let instance = request.uri().path().to_owned();
    let peer = Peer::of(call.extensions());
    let limit_bytes = doors.services.max_message_bytes;
    let requests = requests(request.into_body(), call.name("sessions"), limit_bytes);
    let mut responses = doors.services.capture.publish(requests, peer);
    let first = match responses.next().await {
        Some(first) => first?,
        None => return Err(Status::internal("the stream has no answer").into()),
    };
    let answers = stream::once(future::ready(Ok(first))).chain(responses);
    let lines = answers.map(move |it| Ok::<_, Status>(line(it, &instance)));
    let mut response = Response::new(Body::from_stream(lines));
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(NDJSON));
    headers.insert("x-accel-buffering", HeaderValue::from_static("no"));
    Ok(response)
}

/// A form of another site can send no such type, so that it must ask first.
fn check_content_type(headers: &HeaderMap) -> Result<(), Problem> {
    if media_type(headers).as_deref() == Some(NDJSON) {
        return Ok(());
    }
    let detail = "frames are sent as application/x-ndjson: one message a line";
    let status = StatusCode::UNSUPPORTED_MEDIA_TYPE;
    Err(Problem::new(status, "CONTENT_TYPE", detail))
}

fn requests(
    body: Body,
    session: String,
    limit_bytes: usize,
) -> impl Stream<Item = Result<v1::PublishMarkersRequest, Status>> + Send + Unpin + 'static {
    Lines::new(body.into_data_stream(), limit_bytes).map(move |line| {
        let mut request: v1::PublishMarkersRequest = from_json(&line?)?;
        request.place(&session)?;
        Ok(request)
    })
}

/// One answer; a failure is the last.
fn line(answer: Result<v1::PublishResponse, Status>, instance: &str) -> Bytes {
    let mut text = Vec::with_capacity(128);
    let written = answer.and_then(|it| write_json(&it, &mut text));
    if let Err(status) = written {
        text = Problem::from(status).in_stream(instance).into_bytes();
    }
    text.push(b'\n');
    text.into()
}
