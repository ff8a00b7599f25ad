//! What a browser is told about an answer: what it may do with it, and where it may send more.

use axum::{
    http::{HeaderMap, HeaderValue, header},
    response::Response,
};

/// A page of this server loads from this server only, and no other page frames it.
const PAGE: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
);

/// Everything else loads nothing.
const DATA: HeaderValue = HeaderValue::from_static("default-src 'none'; frame-ancestors 'none'");

/// Browsers keep to TLS for this name for a year.
const PINNED: HeaderValue = HeaderValue::from_static("max-age=31536000");

/// Marks an answer, unless it is gRPC, which no browser shows. What a handler has marked itself stays.
pub(super) fn marked(mut response: Response, is_pinned: bool) -> Response {
    if is_grpc(response.headers()) {
        return response;
    }
    let headers = response.headers_mut();
    let policy = if is_page(headers) { PAGE } else { DATA };
    let fixed = [
        (
            header::X_CONTENT_TYPE_OPTIONS,
            HeaderValue::from_static("nosniff"),
        ),
        (
            header::REFERRER_POLICY,
            HeaderValue::from_static("no-referrer"),
        ),
        (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
        (header::CONTENT_SECURITY_POLICY, policy),
    ];
    let pinned = is_pinned.then_some((header::STRICT_TRANSPORT_SECURITY, PINNED));
    for (name, value) in fixed.into_iter().chain(pinned) {
        headers.entry(name).or_insert(value);
    }
    response
}

/// Whether a message is gRPC or gRPC-web.
pub(super) fn is_grpc(headers: &HeaderMap) -> bool {
    kind_of(headers).starts_with(b"application/grpc")
}

fn is_page(headers: &HeaderMap) -> bool {
    kind_of(headers).starts_with(b"text/html")
}

fn kind_of(headers: &HeaderMap) -> &[u8] {
    let kind = headers.get(header::CONTENT_TYPE);
    kind.map_or(b"", HeaderValue::as_bytes)
}
