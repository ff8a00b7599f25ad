//! Paths and queries that several resources share, and how a query is read.

mod parameters;
mod word;

use serde::Deserialize;
use utoipa::IntoParams;

pub(super) use parameters::read;
pub(super) use word::Word;

/// Part of a list.
#[derive(Deserialize, IntoParams)]
#[serde(rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(super) struct ListQuery {
    /// Entries of the page; 0: 50, more than 500: 500.
    #[serde(default)]
    #[param(required = false, maximum = 4_294_967_295_u64)]
    pub page_size: u32,
    /// `nextPageToken` of the page before; empty: the first page.
    #[serde(default)]
    #[param(required = false, pattern = "^[a-z0-9_-]{0,63}$", example = "")]
    pub page_token: String,
}

/// An actor in the path.
#[derive(IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "only describes the path")]
pub(super) struct ActorPath {
    /// The actor's id: `actors/ID` is its name.
    #[param(pattern = "^[a-z0-9][a-z0-9_-]{0,62}$", example = "reference")]
    id: String,
}

/// A session in the path.
#[derive(IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "only describes the path")]
pub(super) struct SessionPath {
    /// The session's id: `sessions/ID` is its name.
    #[param(pattern = "^[a-z0-9][a-z0-9_-]{0,62}$", example = "take-1")]
    id: String,
}

/// A take in the path.
#[derive(IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "only describes the path")]
pub(super) struct TakePath {
    /// The take's id: `takes/ID` is its name.
    #[param(pattern = "^[a-z0-9][a-z0-9_-]{0,62}$", example = "take-1-19f3")]
    id: String,
}
