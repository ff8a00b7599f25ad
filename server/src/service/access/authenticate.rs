//! The layer that asks every request who sent it, whatever door it came through.

use std::convert::Infallible;

use axum::{
    body::Body,
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse as _, Response},
};
use futures::{StreamExt as _, TryStreamExt as _};
use http_body_util::{BodyStream, StreamBody};
use hyper::body::Frame;
use tonic::Status;

use super::{Access, Caller};
use crate::service::{http::refuse_in_kind, peer::Door};

/// What is told to everybody: whether the server lives, what it speaks, and how that is read. None of it depends on what
/// the server holds.
const OPEN: [&str; 6] = [
    "/",
    "/healthz",
    "/readyz",
    "/openapi.json",
    "/docs",
    "/grpc.health.v1.Health/Check",
];
/// The pages that show `/openapi.json`.
const OPEN_BELOW: &str = "/docs/";

/// Puts the [`Caller`] into the request's extensions, or refuses it in the protocol that it speaks.
pub async fn authenticate(
    State(access): State<Access>,
    mut request: Request,
    next: Next,
) -> Response {
    let path = request.uri().path();
    if OPEN.contains(&path) || path.starts_with(OPEN_BELOW) {
        return next.run(request).await;
    }
    let door = Door::of(request.headers());
    request.extensions_mut().insert(door);
    match access.caller(request.headers(), request.extensions()) {
        Ok(caller) => {
            request.extensions_mut().insert::<Caller>(caller);
            next.run(request).await
        }
        Err(status) => refuse(&request, status),
    }
}

/// How the paths of the services begin that are not this project's: health, reflection.
const FOREIGN: &str = "/grpc.";

/// Ends the answers of services that do not know callers, as the project's own end theirs: watching the health, asking
/// for descriptors.
pub async fn while_valid_grpc(request: Request, next: Next) -> Response {
    let is_foreign = request.uri().path().starts_with(FOREIGN);
    let caller = Caller::of(request.extensions());
    let response = next.run(request).await;
    if !is_foreign {
        return response;
    }
    response.map(|body| {
        let frames = BodyStream::new(body);
        let frames = frames.map_err(|error| Status::from_error(error.into()));
        let frames = caller.while_valid(frames).map(|frame| {
            Ok::<_, Infallible>(frame.unwrap_or_else(|status| Frame::trailers(trailers(&status))))
        });
        Body::new(StreamBody::new(frames))
    })
}

fn trailers(status: &Status) -> HeaderMap {
    let mut trailers = HeaderMap::new();
    if let Err(error) = status.add_header(&mut trailers) {
        tracing::error!(%error, "a status cannot be written as trailers");
    }
    trailers
}

fn refuse(request: &Request, status: Status) -> Response {
    let mut response = refuse_in_kind(request, status);
    if response.status() == StatusCode::UNAUTHORIZED {
        let headers = response.headers_mut();
        headers.insert(header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
    }
    response.into_response()
}
