//! `GET /api/v1/sessions/{id}/stream`: `Subscribe` and `PublishMarkers` over a WebSocket.
//!
//! The subprotocol says which of the two, and whether messages are JSON in text or protobuf in binary. The messages are
//! those of `curve.proto` and `capture.proto`. A failure is a last text message `{"error": …}` in either form, then a
//! close frame with the reason.

mod closing;
mod conversation;
mod patience;
mod subprotocol;

use axum::{
    body::Body,
    extract::{Request, State},
    http::{HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use futures::{StreamExt as _, channel::mpsc};
use hyper::upgrade::{OnUpgrade, Upgraded};
use hyper_util::rt::TokioIo;
use tokio_tungstenite::{
    WebSocketStream,
    tungstenite::{
        self,
        error::ProtocolError,
        handshake::server::create_response_with_body,
        protocol::{Role, WebSocketConfig},
    },
};
use tonic::Status;

use self::{
    conversation::{Conversation, Topic},
    patience::Metered,
    subprotocol::{Direction, Subprotocol},
};
use super::{
    Doors, call::Call, message::Taken, openapi::Refusals, problem::Problem, query::SessionPath,
};
use crate::{
    config::SMALL_MESSAGE_BYTES,
    name::SessionId,
    service::{
        access::{Action, Caller},
        calls::Place,
        door::Services,
        grpc::capture::CaptureGrpc,
        listener::OpenConnection,
        peer::{Door, Peer},
    },
    wire::invalid::FieldError,
};

/// What is read ahead: a subscriber sends little.
const SUBSCRIBER_READ_BYTES: usize = 2 * 1024;
/// A publisher's frames are a few kilobytes.
const PUBLISHER_READ_BYTES: usize = 16 * 1024;
/// Larger than the largest answer and the pongs beside it; only one answer waits at a time.
const WRITE_BYTES: usize = 8 * 1024 * 1024;

/// Opens a WebSocket: subscribe with credits, or publish.
///
/// Offer one subprotocol: `frontalis.v1.subscribe+json`, `frontalis.v1.subscribe+proto`, `frontalis.v1.publish+json` or
/// `frontalis.v1.publish+proto`. Messages are `SubscribeRequest` and `SubscribeResponse`, or `PublishMarkersRequest` and
/// `PublishResponse`; a failure is a last text message `{"error": …}`, then a close frame with its reason. A browser
/// gives its token as a further subprotocol, `frontalis.bearer.TOKEN`.
#[utoipa::path(
    get,
    path = "/api/v1/sessions/{id}/stream",
    operation_id = "openStream",
    tag = "curves",
    params(SessionPath),
    responses(
        (status = 101, description = "The connection is a WebSocket."),
        (status = 426, description = "The request asks for no WebSocket.", content_type = "application/problem+json", body = ref("#/components/schemas/Problem")),
        Refusals,
    ),
    extensions(
        ("x-grpc-method" = json!("frontalis.v1.CurveService/Subscribe, frontalis.v1.CaptureService/PublishMarkers")),
        ("x-reads" = json!([
            { "$ref": "#/components/schemas/SubscribeRequest" },
            { "$ref": "#/components/schemas/PublishMarkersRequest" },
        ])),
        ("x-writes" = json!([
            { "$ref": "#/components/schemas/SubscribeResponse" },
            { "$ref": "#/components/schemas/PublishResponse" },
        ])),
    ),
)]
pub(super) async fn open(
    State(doors): State<Doors>,
    call: Call,
    mut request: Request,
) -> Result<Response, Problem> {
    let session = call.name("sessions");
    SessionId::from_resource(&session)
        .map_err(FieldError::name("session"))
        .map_err(Status::from)?;
    let mut response = match create_response_with_body(&request, Body::empty) {
        Ok(response) => response,
        Err(error) => return Ok(no_upgrade(&error)),
    };
    let spoken = Subprotocol::offered(request.headers()).ok_or_else(|| {
        let detail =
            "offer a subprotocol: frontalis.v1.subscribe or .publish, with +json or +proto";
        Problem::new(StatusCode::BAD_REQUEST, "SUBPROTOCOL", detail)
    })?;
    // The role before the upgrade, as an answer that every client can read; the scope is checked with the start.
    let caller = Caller::of(request.extensions());
    match spoken.direction {
        Direction::Subscribe => caller.may(Action::Subscribe)?,
        Direction::Publish => CaptureGrpc::admit(&caller)?,
    }
    let name = HeaderValue::from_static(spoken.name());
    response
        .headers_mut()
        .insert(header::SEC_WEBSOCKET_PROTOCOL, name);
    request.extensions_mut().insert(Door::WebSocket);
    let upgrade = hyper::upgrade::on(&mut request);
    let extensions = request.extensions();
    let stream = Stream {
        session,
        instance: request.uri().path().to_owned(),
        spoken,
        peer: Peer::of(extensions),
        _open: extensions.get::<OpenConnection>().cloned(),
        _place: extensions.get::<Place>().cloned(),
    };
    // The task takes the place of the connection's own, which ends with the upgrade.
    tokio::spawn(stream.run(upgrade, doors));
    Ok(response)
}

fn no_upgrade(error: &tungstenite::Error) -> Response {
    if matches!(
        error,
        tungstenite::Error::Protocol(ProtocolError::MissingSecWebSocketKey)
    ) {
        let detail = "the handshake has no Sec-WebSocket-Key";
        return Problem::new(StatusCode::BAD_REQUEST, "HANDSHAKE", detail).into_response();
    }
    let headers = [
        (header::UPGRADE, "websocket"),
        (header::SEC_WEBSOCKET_VERSION, "13"),
    ];
    let detail = "this path is a WebSocket: upgrade over HTTP/1.1, version 13";
    let problem = Problem::new(StatusCode::UPGRADE_REQUIRED, "UPGRADE", detail);
    (headers, problem).into_response()
}

/// One WebSocket from its upgrade on.
struct Stream {
    session: String,
    instance: String,
    spoken: Subprotocol,
    peer: Peer,
    /// Held to its end, so that it counts and the drain waits for it.
    _open: Option<OpenConnection>,
    /// Of the call, held to its end too.
    _place: Option<Place>,
}

impl Stream {
    async fn run(self, upgrade: OnUpgrade, doors: Doors) {
        let phases = doors.readiness.phases.clone();
        let conversing = async {
            match upgrade.await {
                Ok(upgraded) => self.converse(upgraded, doors).await,
                Err(error) => tracing::debug!(%error, "an upgrade failed"),
            }
        };
        tokio::select! {
            () = conversing => {}
            () = phases.cut.cancelled() => {}
        }
    }

    async fn converse(self, upgraded: Upgraded, doors: Doors) {
        let Services {
            capture,
            curves,
            max_message_bytes,
            ..
        } = doors.services;
        let Subprotocol { direction, form } = self.spoken;
        let limit_bytes = match direction {
            Direction::Subscribe => SMALL_MESSAGE_BYTES,
            Direction::Publish => max_message_bytes,
        };
        let io = Metered::new(TokioIo::new(upgraded));
        let config = config(direction, limit_bytes);
        let socket = WebSocketStream::from_raw_socket(io, Role::Server, Some(config)).await;
        let taken = Taken::none("message");
        let topic = Topic {
            session: self.session,
            instance: self.instance,
            taken: taken.clone(),
            form,
            limit_bytes,
            finishes: direction == Direction::Publish,
        };
        match direction {
            Direction::Subscribe => {
                let (inbox, requests) = mpsc::channel(0);
                let requests = requests.inspect(move |_| taken.take_next());
                let responses = curves.subscription(requests, self.peer);
                Conversation::new(topic, socket, inbox, responses)
                    .run()
                    .await;
            }
            Direction::Publish => {
                let (inbox, requests) = mpsc::channel(0);
                let requests = requests.inspect(move |_| taken.take_next());
                let responses = capture.publish(requests, self.peer);
                Conversation::new(topic, socket, inbox, responses)
                    .run()
                    .await;
            }
        }
    }
}

fn config(direction: Direction, limit_bytes: usize) -> WebSocketConfig {
    let read_bytes = match direction {
        Direction::Subscribe => SUBSCRIBER_READ_BYTES,
        Direction::Publish => PUBLISHER_READ_BYTES,
    };
    WebSocketConfig::default()
        .read_buffer_size(read_bytes)
        .write_buffer_size(0)
        .max_write_buffer_size(WRITE_BYTES)
        .max_message_size(Some(limit_bytes))
        .max_frame_size(Some(limit_bytes))
}
