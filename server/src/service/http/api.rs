//! `/api/v1`: actors, sessions and curves as JSON.

use axum::{
    Json,
    extract::{
        Path, Query, State,
        rejection::{PathRejection, QueryRejection},
    },
    http::StatusCode,
};
use serde::Deserialize;
use serde_json::{Value, json};
use tonic::Status;

use super::{Doors, problem::Problem};
use crate::{
    name::SessionId,
    telemetry::Protocol,
    wire::{self, invalid::FieldError, page::Page},
};

/// Samples of one answer when the client names no number, and the most.
const CURVES: [usize; 2] = [100, 1_000];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ListQuery {
    #[serde(default)]
    page_size: u32,
    #[serde(default)]
    page_token: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CurvesQuery {
    /// The run that `after` counts in; absent or 0: the current one.
    run: Option<u64>,
    /// The last sequence that the client has; absent: from the oldest that is kept.
    after: Option<u64>,
    limit: Option<usize>,
}

pub(super) async fn actors(
    State(doors): State<Doors>,
    query: Result<Query<ListQuery>, QueryRejection>,
) -> Result<Json<Value>, Problem> {
    doors.metrics.request(Protocol::Http);
    let page = page(query)?;
    let found = doors
        .store
        .actors(page.after.clone(), page.n_to_read())
        .await;
    let mut found = found.map_err(Status::from)?;
    let next = page.cut(&mut found, |it| it.actor.to_string());
    let actors: Vec<Value> = found
        .iter()
        .map(|it| wire::json::actor(&wire::actor::actor(it)))
        .collect();
    Ok(Json(json!({ "actors": actors, "next_page_token": next })))
}

pub(super) async fn sessions(
    State(doors): State<Doors>,
    query: Result<Query<ListQuery>, QueryRejection>,
) -> Result<Json<Value>, Problem> {
    doors.metrics.request(Protocol::Http);
    let (found, next) = doors.sessions.list(&page(query)?).await?;
    let sessions: Vec<Value> = found.iter().map(wire::json::session).collect();
    Ok(Json(
        json!({ "sessions": sessions, "next_page_token": next }),
    ))
}

pub(super) async fn session(
    State(doors): State<Doors>,
    path: Result<Path<String>, PathRejection>,
) -> Result<Json<Value>, Problem> {
    doors.metrics.request(Protocol::Http);
    let found = doors.sessions.get(&id(path)?).await?;
    Ok(Json(wire::json::session(&found)))
}

pub(super) async fn curves(
    State(doors): State<Doors>,
    path: Result<Path<String>, PathRejection>,
    query: Result<Query<CurvesQuery>, QueryRejection>,
) -> Result<Json<Value>, Problem> {
    doors.metrics.request(Protocol::Http);
    let id = id(path)?;
    let Query(query) = query.map_err(|error| unreadable(&error))?;
    let [usual, most] = CURVES;
    let limit = query.limit.unwrap_or(usual).min(most);
    let handle = doors.sessions.handle(&id).await?;
    let page = handle
        .hub()
        .page(query.run.filter(|run| *run != 0), query.after, limit)
        .map_err(Status::from)?;
    Ok(Json(wire::json::curves(&id, &handle.actor(), &page)))
}

fn id(path: Result<Path<String>, PathRejection>) -> Result<SessionId, Problem> {
    let named = |text: &str| SessionId::parse(text).map_err(FieldError::name("id"));
    match path {
        Ok(Path(text)) => Ok(named(&text).map_err(Status::from)?),
        // Bytes that are no UTF-8 are no id either.
        Err(_) => Ok(named("").map_err(Status::from)?),
    }
}

fn page(query: Result<Query<ListQuery>, QueryRejection>) -> Result<Page, Problem> {
    let Query(query) = query.map_err(|error| unreadable(&error))?;
    Ok(Page::parse(query.page_size, &query.page_token).map_err(Status::from)?)
}

/// The parser's text names keys and types; values of the client are not repeated.
fn unreadable(error: &QueryRejection) -> Problem {
    tracing::debug!(%error, "a query could not be read");
    let detail = "a parameter of the query is unknown, repeated, or not a number where one is due";
    Problem::new(StatusCode::BAD_REQUEST, "QUERY", detail)
}
