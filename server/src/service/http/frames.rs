//! `POST /api/v1/sessions/{id}/frames`: `PublishMarkers` as lines of JSON, streamed both ways.
//!
//! The contract is that of `capture.proto`. The first answer decides the status; from then on a failure is the last
//! line, `{"error": …}`.

mod lines;

use axum::{
    body::{Body, BodyDataStream},
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::Response,
};
use bytes::Bytes;
use frontalis_proto::v1;
use futures::{Stream, StreamExt as _, future, stream};
use tonic::Status;

use self::lines::{Line, Lines};
use super::{
    Doors,
    call::{Call, check_encoding, media_type},
    message::{Incoming as _, Taken, from_json, write_json},
    openapi::{BodyRefusals, ObjectRefusals, Refusals, StateRefusals},
    problem::Problem,
    query::SessionPath,
};
use crate::service::{access::Action, grpc::capture::CaptureGrpc, peer::Peer};

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
    let peer = Peer::of(call.extensions());
    CaptureGrpc::admit(&peer.caller)?;
    if let Err(problem) = check_form(request.headers()) {
        // What cannot be read cannot say that it takes over, which is all that some callers may.
        peer.caller.may(Action::Publish)?;
        return Err(problem);
    }
    let instance = request.uri().path().to_owned();
    let limit_bytes = doors.services.max_message_bytes;
    let lines = Lines::new(request.into_body().into_data_stream(), limit_bytes);
    let taken = Taken::none("line");
    let requests = requests(lines, call.name("sessions"), taken.clone());
    let mut responses = doors.services.capture.publish(requests, peer);
    let first = match responses.next().await {
        Some(first) => first.map_err(|status| taken.problem(status))?,
        None => return Err(Status::internal("the stream has no answer").into()),
    };
    let answers = stream::once(future::ready(Ok(first))).chain(responses);
    let lines = answers.map(move |it| Ok::<_, Status>(line(it, &taken, &instance)));
    let mut response = Response::new(Body::from_stream(lines));
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(NDJSON));
    headers.insert("x-accel-buffering", HeaderValue::from_static("no"));
    Ok(response)
}

fn check_form(headers: &HeaderMap) -> Result<(), Problem> {
    check_encoding(headers)?;
    check_content_type(headers)
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
    lines: Lines<BodyDataStream>,
    session: String,
    taken: Taken,
) -> impl Stream<Item = Result<v1::PublishMarkersRequest, Status>> + Send + Unpin + 'static {
    lines.map(move |Line { number, text }| {
        taken.take(number);
        let mut request: v1::PublishMarkersRequest = from_json(&text?, number)?;
        request.place(&session)?;
        Ok(request)
    })
}

/// One answer; a failure is the last.
fn line(answer: Result<v1::PublishResponse, Status>, taken: &Taken, instance: &str) -> Bytes {
    let mut text = Vec::with_capacity(128);
    let written = answer.and_then(|it| write_json(&it, &mut text));
    if let Err(status) = written {
        text = taken.problem(status).in_stream(instance).into_bytes();
    }
    text.push(b'\n');
    text.into()
}
