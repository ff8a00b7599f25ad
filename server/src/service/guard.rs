//! What every request passes first, whichever door it comes to (CONTRACTS S-8, BAD_INPUT E14, I14).
//!
//! A name that is not this server's is refused, so that no page reaches it by a name that its own owner points here.
//! A page of another origin is refused, whatever it asks for, unless the configuration lists its origin. What goes back
//! to a browser is marked as what it is.

mod answers;
mod cors;
mod names;
mod refusal;

use std::{str::FromStr as _, sync::Arc};

use axum::{
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, Version, header},
    middleware::Next,
    response::Response,
};
use tower::{Layer as _, ServiceExt as _};
use tower_http::cors::CorsLayer;

use super::listener::tls::Tls;
use crate::config::{Config, Origin};
use names::{Asked, Unclear};
use refusal::Refusal;

/// Longest path and query, bytes.
const MAX_TARGET_BYTES: usize = 8 * 1024;

/// What is let through; cheap to clone.
#[derive(Clone)]
pub struct Guard(Arc<Rules>);

struct Rules {
    hosts: Vec<String>,
    origins: Vec<Origin>,
    tls: Option<Tls>,
    max_header_bytes: usize,
    cors: CorsLayer,
}

impl Guard {
    /// Knows the names in the configuration, and those in the certificate as they are when a request comes.
    pub fn new(config: &Config, tls: Option<Tls>) -> Self {
        let lower = |it: &String| it.to_ascii_lowercase();
        let origins = config.http.origins.iter();
        Self(Arc::new(Rules {
            hosts: config.http.hosts.iter().map(lower).collect(),
            origins: origins.filter_map(|it| Origin::from_str(it).ok()).collect(),
            tls,
            max_header_bytes: usize::try_from(config.transport.header_list_kib * 1024)
                .unwrap_or(usize::MAX),
            cors: cors::layer(),
        }))
    }
}

/// Where a request stands with the origin of the page that sent it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    /// No page of another origin sent it.
    Own,
    /// A page that is listed.
    Listed,
    /// Any other page.
    Foreign,
}

/// Lets a request through, or says why not.
pub async fn check(State(Guard(rules)): State<Guard>, request: Request, next: Next) -> Response {
    let is_grpc = answers::is_grpc(request.headers());
    let kind = request.headers().get(header::CONTENT_TYPE).cloned();
    let asked = match rules.admit(&request) {
        Ok(asked) => asked,
        Err(refusal) => {
            let mut response = if is_grpc {
                refusal.into_grpc(kind)
            } else {
                answers::marked(refusal.into_http(), false)
            };
            if refusal.is_of_size() && request.version() < Version::HTTP_2 {
                let close = HeaderValue::from_static("close");
                response.headers_mut().insert(header::CONNECTION, close);
            }
            return response;
        }
    };
    let is_pinned = rules.tls.is_some() && asked.as_ref().is_some_and(Asked::is_a_name);
    let response = match rules.standing(request.headers(), asked.as_ref()) {
        Standing::Own => next.run(request).await,
        Standing::Listed => match rules.cors.layer(next).oneshot(request).await {
            Ok(response) => response,
            Err(never) => match never {},
        },
        Standing::Foreign if is_grpc => return Refusal::Origin.into_grpc(kind),
        Standing::Foreign => Refusal::Origin.into_http(),
    };
    answers::marked(response, is_pinned)
}

impl Rules {
    /// By which name the server was asked; none when the request says none and need not.
    fn admit(&self, request: &Request) -> Result<Option<Asked>, Refusal> {
        let target = request.uri().path_and_query();
        if target.is_some_and(|it| it.as_str().len() > MAX_TARGET_BYTES) {
            return Err(Refusal::Target);
        }
        if size_of(request.headers()) > self.max_header_bytes {
            return Err(Refusal::Headers(self.max_header_bytes));
        }
        let Some(asked) = names::asked(request).map_err(|Unclear| Refusal::NoHost)? else {
            // HTTP/1.1 asks for it; no browser leaves it out in any version.
            let needs_one = request.version() == Version::HTTP_11;
            return if needs_one {
                Err(Refusal::NoHost)
            } else {
                Ok(None)
            };
        };
        if self.is_ours(&asked) {
            Ok(Some(asked))
        } else {
            Err(Refusal::Host)
        }
    }

    fn is_ours(&self, asked: &Asked) -> bool {
        let Some(name) = asked.name() else {
            return true;
        };
        name == "localhost"
            || self.hosts.iter().any(|it| it == name)
            || self.tls.as_ref().is_some_and(|it| it.vouches_for(name))
    }

    fn standing(&self, headers: &HeaderMap, asked: Option<&Asked>) -> Standing {
        let mut origins = headers.get_all(header::ORIGIN).iter();
        let origin = match (origins.next(), origins.next()) {
            (None, _) => return Standing::Own,
            (Some(origin), None) => origin.to_str().ok(),
            (Some(_), Some(_)) => None,
        };
        let Some(origin) = origin.and_then(|it| Origin::from_str(it).ok()) else {
            return Standing::Foreign;
        };
        if asked.is_some_and(|it| it.origin(self.tls.is_some()) == origin) {
            Standing::Own
        } else if self.origins.contains(&origin) {
            Standing::Listed
        } else {
            Standing::Foreign
        }
    }
}

/// As HTTP/2 counts it (RFC 9113, 6.5.2), so that both versions have the same limit.
fn size_of(headers: &HeaderMap) -> usize {
    let size = |(name, value): (&header::HeaderName, &header::HeaderValue)| {
        name.as_str().len() + value.len() + 32
    };
    headers.iter().map(size).sum()
}

#[cfg(test)]
mod tests;
