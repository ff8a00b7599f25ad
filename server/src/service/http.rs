//! Plain HTTP on the same port: every resource and action as JSON, health, metrics, and the description of it all.
//!
//! Handlers turn a request into the message of a service and its answer into JSON; what is checked, allowed and done is
//! the services' business, so that every door does the same.

mod actors;
mod call;
mod curves;
mod descriptors;
mod docs;
mod draining;
mod events;
mod fallback;
mod frames;
mod json;
mod message;
mod observe;
mod openapi;
mod problem;
mod query;
mod server;
mod sessions;
mod stream;
mod streams;
mod takes;

use axum::{
    Extension, Router,
    extract::{MatchedPath, Request, State},
    http::StatusCode,
    middleware::{self, Next},
    response::{IntoResponse as _, Response},
    routing::get,
};
use tower_http::catch_panic::CatchPanicLayer;
use utoipa::openapi::OpenApi;
use utoipa_axum::{router::OpenApiRouter, routes};

use self::openapi::Document;
use super::{door::Services, readiness::Readiness};
use crate::telemetry::{Metrics, Protocol};

pub use call::LargeBodies;
pub use draining::{Draining, heard_out};
pub use fallback::{GrpcPanic, grpc_only, http_only, refuse_in_kind, unknown};
pub use problem::{Problem, with_instance};

/// What the routes read from.
#[derive(Clone)]
pub struct Doors {
    /// What every door opens.
    pub services: Services,
    /// Figures.
    pub metrics: Metrics,
    /// What the server is ready for.
    pub readiness: Readiness,
    /// Places for bodies that are large.
    pub large_bodies: LargeBodies,
}

/// The routes of plain HTTP.
pub fn router(doors: Doors) -> Router {
    let metrics = doors.metrics.clone();
    let (api, operations) = api(&metrics);
    let tokens = doors.services.server.asks_for_tokens();
    api.route("/docs", get(docs::index))
        .route("/docs/", get(docs::page))
        .route("/docs/{*file}", get(docs::file))
        .layer(Extension(Document::new(&operations, tokens)))
        .method_not_allowed_fallback(fallback::method_not_allowed)
        .with_state(doors)
        .layer(CatchPanicLayer::custom(fallback::HttpPanic(metrics)))
}

/// Every route with its description; a route cannot be here without one.
fn api(metrics: &Metrics) -> (Router<Doors>, OpenApi) {
    let observation = OpenApiRouter::new()
        .routes(routes!(observe::index))
        .routes(routes!(observe::healthz))
        .routes(routes!(observe::readyz))
        .routes(routes!(observe::metrics))
        .routes(routes!(openapi::serve))
        .layer(middleware::from_fn(within_deadline));
    let calls = OpenApiRouter::new()
        .routes(routes!(server::get))
        .routes(routes!(actors::list))
        .routes(routes!(actors::get, actors::delete))
        .routes(routes!(sessions::list, sessions::create))
        .routes(routes!(sessions::get, sessions::update))
        .routes(routes!(sessions::recenter))
        .routes(routes!(sessions::end))
        .routes(routes!(curves::read))
        .routes(routes!(takes::list, takes::start))
        .routes(routes!(takes::get, takes::update, takes::delete))
        .layer(middleware::from_fn(within_deadline));
    // What may take longer has deadlines of its own.
    let transfers = OpenApiRouter::new()
        .routes(routes!(actors::import))
        .routes(routes!(actors::model))
        .routes(routes!(actors::package))
        .routes(routes!(takes::stop))
        .routes(routes!(takes::download))
        .routes(routes!(takes::resolve));
    calls
        .merge(transfers)
        .merge(streams::routes())
        .layer(middleware::from_fn_with_state(metrics.clone(), count))
        .merge(observation)
        .split_for_parts()
}

/// A call must be answered within a time.
async fn within_deadline(request: Request, next: Next) -> Response {
    let answered = tokio::time::timeout(call::DEADLINE, next.run(request)).await;
    answered.unwrap_or_else(|_elapsed| {
        let detail = "the request was not complete, or not answered, within 10 s";
        let status = StatusCode::GATEWAY_TIMEOUT;
        Problem::new(status, "MESSAGE_DEADLINE", detail).into_response()
    })
}

async fn count(State(metrics): State<Metrics>, request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>();
    metrics.request(route.map_or(Protocol::Http, |it| streams::protocol(it.as_str())));
    next.run(request).await
}
