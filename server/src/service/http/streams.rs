//! The streams of a session over HTTP: lines, events and web sockets, each the same contract as its gRPC method.
//!
//! They stand apart from the other routes, whose answers have a deadline.

use utoipa_axum::{router::OpenApiRouter, routes};

use super::{Doors, events, frames, stream};
use crate::telemetry::Protocol;

/// Their routes.
pub(super) fn routes() -> OpenApiRouter<Doors> {
    OpenApiRouter::new()
        .routes(routes!(frames::publish))
        .routes(routes!(events::follow))
        .routes(routes!(stream::open))
}

/// What a route is counted as.
pub(super) fn protocol(route: &str) -> Protocol {
    match route.rsplit('/').next() {
        Some("events") => Protocol::Sse,
        Some("stream") => Protocol::WebSocket,
        _ => Protocol::Http,
    }
}
