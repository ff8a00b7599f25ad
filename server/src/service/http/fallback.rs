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
    service::grpc::status::refuse,
    telemetry::{Metrics, Protocol},
};

/// No route of that path.
pub async fn unknown(request: Request) -> Response {
    if speaks_grpc(request.headers()) {
        let status = refuse(Code::Unimplemented, "METHOD", "there is no such method");
        return grpc(status);
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
    if speaks_grpc(request.headers()) {
        let status = refuse(
            Code::Unimplemented,
            "METHOD",
            "this path does not speak gRPC",
        );
        return grpc(status);
    }
    // The router adds what this path allows.
    Problem::new(
        StatusCode::METHOD_NOT_ALLOWED,
        "HTTP_METHOD",
        "this path has other methods; the header allow names them",
    )
    .into_response()
}

/// Lets only gRPC pass to the gRPC services.
pub async fn grpc_only(State(metrics): State<Metrics>, request: Request, next: Next) -> Response {
    if !speaks_grpc(request.headers()) {
        metrics.request(Protocol::Http);
        if request.method() != Method::POST {
            let problem = Problem::new(
                StatusCode::METHOD_NOT_ALLOWED,
                "HTTP_METHOD",
                "this path is called with POST, as gRPC",
            );
            return ([(header::ALLOW, "POST")], problem).into_response();
        }
        return Problem::new(
            StatusCode::UNSUPPORTED_MEDIA_TYPE,
            "CONTENT_TYPE",
            "this path speaks gRPC: the content type must be application/grpc",
        )
        .into_response();
    }
    metrics.request(Protocol::Grpc);
    if request.version() != Version::HTTP_2 {
        return grpc(refuse(
            Code::Unimplemented,
            "HTTP_VERSION",
            "gRPC needs HTTP/2",
        ));
    }
    next.run(request).await
}

fn grpc(status: Status) -> Response {
    status.into_http::<Body>()
}

fn speaks_grpc(headers: &HeaderMap) -> bool {
    let kind = headers.get(header::CONTENT_TYPE).map(HeaderValue::as_bytes);
    kind.and_then(|it| it.strip_prefix(b"application/grpc"))
        .is_some_and(|rest| {
            rest.is_empty() || rest.starts_with(b"+proto") || rest.starts_with(b";")
        })
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
        grpc(refuse(
            Code::Internal,
            "PANIC",
            "the server made a mistake; it goes on",
        ))
    }
}
