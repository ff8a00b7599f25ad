//! Plain HTTP on the same port: state and curves as JSON, health, metrics.
//!
//! Everything here reads; what changes something goes through gRPC.

mod api;
mod fallback;
mod observe;
mod problem;

use std::time::Duration;

use axum::{
    Router,
    extract::Request,
    http::{HeaderValue, StatusCode, header},
    middleware::{self, Next},
    response::Response,
    routing::get,
};
use tower_http::{catch_panic::CatchPanicLayer, timeout::TimeoutLayer};

use super::{door::Services, sessions::Sessions};
use crate::{catalogue::Store, shutdown::Phases, telemetry::Metrics};

pub use fallback::{GrpcPanic, grpc_only, unknown};
pub use problem::with_instance;

/// A request must be answered within this time.
const DEADLINE: Duration = Duration::from_secs(10);

/// What the routes read from.
#[derive(Clone)]
pub struct Doors {
    /// Actors.
    pub store: Store,
    /// Sessions and their curves.
    pub sessions: Sessions,
    /// What every door opens.
    pub services: Services,
    /// Figures.
    pub metrics: Metrics,
    /// Whether the server drains.
    pub phases: Phases,
}

/// The routes of plain HTTP.
pub fn router(doors: Doors) -> Router {
    let metrics = doors.metrics.clone();
    Router::new()
        .route("/", get(observe::index))
        .route("/healthz", get(observe::healthz))
        .route("/readyz", get(observe::readyz))
        .route("/metrics", get(observe::metrics))
        .route("/api/v1/actors", get(api::actors))
        .route("/api/v1/sessions", get(api::sessions))
        .route("/api/v1/sessions/{id}", get(api::session))
        .route("/api/v1/sessions/{id}/curves", get(api::curves))
        .method_not_allowed_fallback(fallback::method_not_allowed)
        .with_state(doors)
        .layer(TimeoutLayer::with_status_code(
            StatusCode::GATEWAY_TIMEOUT,
            DEADLINE,
        ))
        .layer(CatchPanicLayer::custom(fallback::HttpPanic(metrics)))
        .layer(middleware::from_fn(inert))
}

/// Whatever a browser is handed is data: not to be guessed at, kept, or framed.
async fn inert(request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    let fixed = [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::CACHE_CONTROL, "no-store"),
        (
            header::CONTENT_SECURITY_POLICY,
            "default-src 'none'; frame-ancestors 'none'",
        ),
    ];
    for (name, value) in fixed {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}
