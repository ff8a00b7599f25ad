//! What is answered where nothing else answers, in the protocol that the peer speaks (BAD_INPUT E10, CONTRACTS O-9).

use std::any::Any;

use axum::{
    body::Body,
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, Method, StatusCode, Version, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use tonic::{Code, Status};
use tower_http::catch_panic::ResponseForPanic;

use super::problem::Problem;
use crate::{
    service::{grpc::status::refuse, peer::Door},
    telemetry::{Metrics, Protocol},
};

/// No route of that path.
pub async fn unknown(request: Request) -> Response {
    if let Some(door) = grpc_door(request.headers()) {
        let status = refuse(Code::Unimplemented, "METHOD", "there is no such method");
        return grpc(status, door, request.headers());
    }
    if matches!(*request.method(), Method::TRACE | Method::CONNECT) {
        let problem = Problem::new(
            StatusCode::METHOD_NOT_ALLOWED,
            "HTTP_METHOD",
            "this server has nothing to trace and nowhere to connect to",
        );
        // Allowed here is nothing.
        return ([(header::ALLOW, "")], problem).into_response();
    }
    Problem::new(
        StatusCode::NOT_FOUND,
        "ROUTE",
        "there is no such path; see /",
    )
    .into_response()
}

/// The path exists, the method does not.
pub(super) async fn method_not_allowed(request: Request) -> Response {
    if let Some(door) = grpc_door(request.headers()) {
        let status = refuse(
            Code::Unimplemented,
            "METHOD",
            "this path does not speak gRPC",
        );
        return grpc(status, door, request.headers());
    }
    // The router adds what this path allows.
    Problem::new(
        StatusCode::METHOD_NOT_ALLOWED,
        "HTTP_METHOD",
        "this path has other methods; the header allow names them",
    )
    .into_response()
}

/// Lets no gRPC pass to the routes of plain HTTP.
pub async fn http_only(request: Request, next: Next) -> Response {
    if grpc_door(request.headers()).is_some() {
        return method_not_allowed(request).await;
    }
    next.run(request).await
}

/// Lets only gRPC and gRPC-web pass to the gRPC services.
pub async fn grpc_only(
    State(metrics): State<Metrics>,
    mut request: Request,
    next: Next,
) -> Response {
    let Some(door) = grpc_door(request.headers()) else {
        metrics.request(Protocol::Http);
        return not_grpc(request.method());
    };
    if door == Door::GrpcWeb {
        metrics.request(Protocol::GrpcWeb);
        if request.method() != Method::POST {
            return only_post();
        }
    } else {
        metrics.request(Protocol::Grpc);
        if request.version() != Version::HTTP_2 {
            let message = "gRPC needs HTTP/2";
            let status = refuse(Code::Unimplemented, "HTTP_VERSION", message);
            return grpc(status, door, request.headers());
        }
    }
    request.extensions_mut().insert(door);
    next.run(request).await
}

fn not_grpc(method: &Method) -> Response {
    if method != Method::POST {
        return only_post();
    }
    Problem::new(
        StatusCode::UNSUPPORTED_MEDIA_TYPE,
        "CONTENT_TYPE",
        "this path speaks gRPC: the content type must be application/grpc or application/grpc-web",
    )
    .into_response()
}

fn only_post() -> Response {
    let problem = Problem::new(
        StatusCode::METHOD_NOT_ALLOWED,
        "HTTP_METHOD",
        "this path is called with POST, as gRPC",
    );
    ([(header::ALLOW, "POST")], problem).into_response()
}

/// A refusal in the protocol that the request speaks, whatever it asked for.
pub fn refuse_in_kind(request: &Request, status: Status) -> Response {
    match grpc_door(request.headers()) {
        Some(door) => grpc(status, door, request.headers()),
        None => Problem::from(status).into_response(),
    }
}

/// A refusal as the door's clients read it; gRPC-web takes the status from the headers too, under its own type.
fn grpc(status: Status, door: Door, asked: &HeaderMap) -> Response {
    let mut response = status.into_http::<Body>();
    if door == Door::GrpcWeb {
        let kind = HeaderValue::from_static(grpc_web_kind(asked));
        response.headers_mut().insert(header::CONTENT_TYPE, kind);
    }
    response
}

/// The type of an answer over gRPC-web: what is accepted, or as it was asked.
fn grpc_web_kind(asked: &HeaderMap) -> &'static str {
    let kind = asked
        .get(header::ACCEPT)
        .filter(|it| it.as_bytes().starts_with(b"application/grpc-web"))
        .or_else(|| asked.get(header::CONTENT_TYPE));
    if kind.is_some_and(|it| it.as_bytes().starts_with(b"application/grpc-web-text")) {
        "application/grpc-web-text+proto"
    } else {
        "application/grpc-web+proto"
    }
}

/// By which of the gRPC doors a request comes, if by one; exactly the types that are read.
fn grpc_door(headers: &HeaderMap) -> Option<Door> {
    let kind = headers.get(header::CONTENT_TYPE)?.as_bytes();
    let rest = kind.strip_prefix(b"application/grpc")?;
    match rest {
        b"-web" | b"-web+proto" | b"-web-text" | b"-web-text+proto" => Some(Door::GrpcWeb),
        b"" => Some(Door::Grpc),
        rest if rest.starts_with(b"+proto") || rest.starts_with(b";") => Some(Door::Grpc),
        _ => None,
    }
}

/// Answers a panic of an HTTP handler, without its message.
#[derive(Clone)]
pub(super) struct HttpPanic(pub Metrics);

impl ResponseForPanic for HttpPanic {
    type ResponseBody = Body;

    fn response_for_panic(&mut self, _panic: Box<dyn Any + Send>) -> Response {
        self.0.panicked();
        tracing::error!("an HTTP handler panicked");
        let detail = "the server made a mistake; it goes on";
        Problem::new(StatusCode::INTERNAL_SERVER_ERROR, "PANIC", detail).into_response()
    }
}

/// Answers a panic of a gRPC handler, without its message.
#[derive(Clone)]
pub struct GrpcPanic(pub Metrics);

impl ResponseForPanic for GrpcPanic {
    type ResponseBody = Body;

    fn response_for_panic(&mut self, _panic: Box<dyn Any + Send>) -> Response {
        self.0.panicked();
        tracing::error!("a gRPC handler panicked");
        let message = "the server made a mistake; it goes on";
        let status = refuse(Code::Internal, "PANIC", message);
        // What is written for gRPC-web is so outside of here.
        grpc(status, Door::Grpc, &HeaderMap::new())
    }
}
