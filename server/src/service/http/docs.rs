//! `/docs`: the description as a page, from files in the binary; the page asks no other host for anything.

use std::sync::Arc;

use axum::{
    extract::Path,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Redirect, Response},
};
use utoipa_swagger_ui::Config;

use super::problem::Problem;

/// What the page needs beyond its own files: styles that its scripts set, and icons inside those styles (CONTRACTS S-8).
const POLICY: &str = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; \
    object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// `GET /docs`: its files are relative to it.
pub(super) async fn index() -> Redirect {
    Redirect::permanent("/docs/")
}

/// `GET /docs/`.
pub(super) async fn page() -> Response {
    file(Path("index.html".to_owned())).await
}

/// `GET /docs/{*file}`.
pub(super) async fn file(Path(path): Path<String>) -> Response {
    let config = Config::from("/openapi.json")
        // A badge that would ask another host.
        .validator_url("none")
        .display_operation_id(true)
        .use_base_layout();
    let Ok(Some(file)) = utoipa_swagger_ui::serve(&path, Arc::new(config)) else {
        let detail = "there is no such path; see /";
        return Problem::new(StatusCode::NOT_FOUND, "ROUTE", detail).into_response();
    };
    let mut headers = HeaderMap::new();
    if let Ok(kind) = HeaderValue::from_str(&file.content_type) {
        headers.insert(header::CONTENT_TYPE, kind);
    }
    if file.gzpipped {
        headers.insert(header::CONTENT_ENCODING, HeaderValue::from_static("gzip"));
    }
    let policy = HeaderValue::from_static(POLICY);
    headers.insert(header::CONTENT_SECURITY_POLICY, policy);
    (headers, file.bytes.into_owned()).into_response()
}
