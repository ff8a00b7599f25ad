//! `GET /api/v1/sessions/{id}/events`: `Follow` as server-sent events.
//!
//! Every event is one `SubscribeResponse`; its id is `run:sequence` of the last sample in it, and `run:sequence:end` once
//! the session has ended. A browser that comes back with that id (`Last-Event-ID`) goes on behind it. A failure is an
//! event named `problem`, and the last.

mod query;

use axum::{
    body::Body,
    extract::State,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1::{self, curve_service_server::CurveService as _};
use futures::{FutureExt as _, Stream, StreamExt as _, stream};
use tonic::Status;

use self::query::{EventsQuery, LastEventId, Position};
use super::{
    Doors,
    call::Call,
    message::write_json,
    openapi::{ObjectRefusals, RangeRefusals, Refusals, StateRefusals},
    problem::Problem,
    query::SessionPath,
};
use crate::service::{grpc::curves::Responses, peer::Door};

/// What a browser waits before it comes back, milliseconds.
const RETRY: &[u8] = b"retry: 500\n";
/// Header, state and end: what is left of a session that has ended for one that has every sample.
const RESPONSES_OF_AN_END: usize = 3;

/// Follows a session's curves: every event is one `SubscribeResponse`.
///
/// The id of an event is `run:sequence` of its last sample, that of the last event of a session that ended
/// `run:sequence:end`: take it as it is. A client of every frame that comes back with an id, as `EventSource` does, goes
/// on behind it; one that comes back with that of the end is answered 204. A failure is an event named `problem`, and the last.
#[utoipa::path(
    get,
    path = "/api/v1/sessions/{id}/events",
    operation_id = "followCurves",
    tag = "curves",
    params(SessionPath, EventsQuery, LastEventId),
    responses(
        (
            status = 200,
            description = "Server-sent events; the data of each is one message.",
            content(
                (ref("#/components/schemas/CurveEvent") = "text/event-stream"),
            ),
        ),
        (status = 204, description = "The session has ended, and the client that came back has all of it."),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        RangeRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.CurveService/Follow"))),
)]
pub(super) async fn follow(
    State(doors): State<Doors>,
    call: Call<EventsQuery>,
    uri: axum::http::Uri,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let resumed = query::resumed(&headers)?;
    let start = call.query.start(call.name("sessions"), resumed)?;
    let mut followed = call.request(start);
    followed.extensions_mut().insert(Door::Sse);
    let responses = doors.services.curves.follow(followed).await?.into_inner();
    let mut responses = responses.fuse();
    let mut first = Vec::new();
    if let Some(position) = resumed {
        first = at_hand(&mut responses);
        if is_over(&first, position) {
            return Ok(StatusCode::NO_CONTENT.into_response());
        }
    }
    let responses = stream::iter(first).chain(responses).boxed();
    let events = Events {
        position: resumed.unwrap_or_default(),
        n_left: call.query.limit.unwrap_or(u64::MAX),
        ..Events::new(responses, uri.path())
    };
    Ok(answer(events.stream()))
}

type Answer = Result<v1::SubscribeResponse, Status>;

/// The first responses, as far as they are there.
fn at_hand(responses: &mut (impl Stream<Item = Answer> + Unpin)) -> Vec<Answer> {
    let mut first = Vec::new();
    while first.len() < RESPONSES_OF_AN_END
        && let Some(Some(response)) = responses.next().now_or_never()
    {
        first.push(response);
    }
    first
}

/// Whether the session has ended, and a client that comes back from `position` has all of it.
fn is_over(first: &[Answer], position: Position) -> bool {
    let holds_curves = |it: &v1::SubscribeResponse| !it.samples.is_empty() || !it.gaps.is_empty();
    let has_ended = matches!(first.last(), Some(Ok(last)) if last.end.is_some());
    has_ended && (position.has_ended || !first.iter().flatten().any(holds_curves))
}

fn answer(events: impl Stream<Item = Result<Bytes, Status>> + Send + 'static) -> Response {
    let mut response = Response::new(Body::from_stream(events));
    let mut set = |name, value| {
        response
            .headers_mut()
            .insert(name, HeaderValue::from_static(value))
    };
    set(header::CONTENT_TYPE, "text/event-stream");
    set(header::CACHE_CONTROL, "no-store");
    // A proxy that gathers an answer would hold samples back.
    set(header::HeaderName::from_static("x-accel-buffering"), "no");
    response
}

/// Responses on their way to events.
struct Events {
    responses: Responses,
    instance: String,
    /// Of the newest sample, or where the client was.
    position: Position,
    /// Samples still to send.
    n_left: u64,
    is_first: bool,
    /// Bytes of the event before: the next is about as long.
    n_bytes: usize,
}

impl Events {
    /// All of them, to a client that has none; `instance` is the path, for problems.
    fn new(responses: Responses, instance: &str) -> Self {
        Self {
            responses,
            instance: instance.to_owned(),
            position: Position::default(),
            n_left: u64::MAX,
            is_first: true,
            n_bytes: 256,
        }
    }

    fn stream(self) -> impl Stream<Item = Result<Bytes, Status>> + Send {
        stream::unfold(self, |mut events| async {
            let event = events.next().await?;
            Some((Ok(event), events))
        })
    }

    async fn next(&mut self) -> Option<Bytes> {
        if self.n_left == 0 {
            return None;
        }
        let response = self.responses.next().await?;
        let mut text = Vec::with_capacity(self.n_bytes);
        if std::mem::take(&mut self.is_first) {
            text.extend_from_slice(RETRY);
        }
        let start = text.len();
        if let Err(status) = response.and_then(|it| self.write(it, &mut text)) {
            text.truncate(start);
            self.n_left = 0;
            text.extend_from_slice(b"event: problem\ndata: ");
            text.extend_from_slice(
                Problem::from(status)
                    .document(&self.instance)
                    .to_string()
                    .as_bytes(),
            );
        }
        text.extend_from_slice(b"\n\n");
        self.n_bytes = text.len() + 64;
        Some(text.into())
    }

    fn write(
        &mut self,
        mut response: v1::SubscribeResponse,
        text: &mut Vec<u8>,
    ) -> Result<(), Status> {
        let n_left = usize::try_from(self.n_left).unwrap_or(usize::MAX);
        response.samples.truncate(n_left);
        self.n_left -= response.samples.len() as u64;
        if let Some(header) = &response.header {
            self.position.run = header.run;
        }
        let moves = !response.samples.is_empty() || response.end.is_some();
        if let Some(last) = response.samples.last() {
            self.position.sequence = last.sequence;
        }
        self.position.has_ended |= response.end.is_some();
        if moves {
            text.extend_from_slice(format!("id: {}\n", self.position).as_bytes());
        }
        text.extend_from_slice(b"data: ");
        write_json(&response, text)
    }
}

#[cfg(test)]
mod tests;
