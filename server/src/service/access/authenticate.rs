//! The layer that asks every request who sent it, whatever door it came through.

use axum::{
    extract::{Request, State},
    http::{HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse as _, Response},
};
use tonic::Status;

use super::{Access, Caller};
use crate::service::http::refuse_in_kind;

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
    match access.caller(request.headers(), request.extensions()) {
        Ok(caller) => {
            request.extensions_mut().insert::<Caller>(caller);
            next.run(request).await
        }
        Err(status) => refuse(&request, status),
    }
}

fn refuse(request: &Request, status: Status) -> Response {
    let mut response = refuse_in_kind(request, status);
    if response.status() == StatusCode::UNAUTHORIZED {
        let headers = response.headers_mut();
        headers.insert(header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
    }
    response.into_response()
}
