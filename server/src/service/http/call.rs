//! One HTTP request as one call of a service: what path, query and body say, and whose request it is.
//!
//! The services check what is asked, so nothing is checked here but the form: JSON of the message that is due, at most
//! 1 MiB and 128 levels deep, without unknown or repeated fields (BAD_INPUT D12). What a client sent is not repeated.

mod body;

use std::time::Duration;

use axum::{
    Json,
    extract::{FromRequestParts, RawPathParams},
    http::{Extensions, request::Parts},
};
use serde::{Deserialize, de::DeserializeOwned};
use tonic::metadata::MetadataMap;

use super::{problem::Problem, query};
use crate::service::peer::Door;

pub use body::LargeBodies;
pub(super) use body::{BodyMessage, Message, check_encoding, media_type};

/// A call must be answered within this time, except for uploads and streams.
pub(super) const DEADLINE: Duration = Duration::from_secs(10);

/// A message as the answer, or why there is none.
pub(super) type Answer<T> = Result<Json<T>, Problem>;

/// Path, query and origin of one request.
pub(super) struct Call<Q = Nothing> {
    extensions: Extensions,
    id: String,
    /// What the query says.
    pub query: Q,
}

/// The query of a path that has none.
#[derive(Deserialize)]
pub(super) struct Nothing {}

impl<Q> Call<Q> {
    /// `collection/{id}`, with the id of the path. It may be none: the service says so.
    pub fn name(&self, collection: &str) -> String {
        format!("{collection}/{}", self.id)
    }

    /// The id of the path as it came, without percent encoding.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// What the server knows of the connection and the caller.
    pub fn extensions(&self) -> &Extensions {
        &self.extensions
    }

    /// The call of a service.
    pub fn request<T>(&self, message: T) -> tonic::Request<T> {
        tonic::Request::from_parts(MetadataMap::new(), self.extensions.clone(), message)
    }
}

impl<S, Q> FromRequestParts<S> for Call<Q>
where
    S: Send + Sync,
    Q: DeserializeOwned + Send,
{
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let query = query::read(parts.uri.query().unwrap_or_default())?;
        // Bytes that are no UTF-8 are no id either; an empty one is refused as what it is.
        let path = RawPathParams::from_request_parts(parts, state).await.ok();
        let id = path.and_then(|path| {
            let id = path.iter().find(|(name, _)| *name == "id");
            id.map(|(_, id)| id.to_owned())
        });
        let id = id.unwrap_or_default();
        let mut extensions = parts.extensions.clone();
        extensions.insert(Door::Http);
        Ok(Self {
            extensions,
            id,
            query,
        })
    }
}
