//! A server whose catalogue is damaged shows the takes that it finds, and changes nothing (BAD_INPUT H7).

use axum::{
    extract::{Request, State},
    http::Method,
    middleware::Next,
    response::Response,
};

use super::{http::refuse_in_kind, readiness::Readiness};

/// Beginnings of the paths that are answered as ever.
const OPEN: [&str; 6] = [
    "/frontalis.v1.TakeService/GetTake",
    "/frontalis.v1.TakeService/ListTakes",
    "/frontalis.v1.TakeService/ExportTake",
    "/frontalis.v1.ServerService/",
    "/api/v1/takes",
    "/api/v1/server",
];

/// Beginnings of the paths of what people work with; others tell of the server itself.
const WORK: [&str; 2] = ["/frontalis.v1.", "/api/"];

/// Refuses what would change something, or show less than there is.
pub async fn read_only(
    State(readiness): State<Readiness>,
    request: Request,
    next: Next,
) -> Response {
    match readiness.check_rescue() {
        Err(refused) if !is_open(&request) => refuse_in_kind(&request, refused),
        _ => next.run(request).await,
    }
}

fn is_open(request: &Request) -> bool {
    let path = request.uri().path();
    let is_any_of = |starts: &[&str]| starts.iter().any(|it| path.starts_with(it));
    let reads = path.starts_with("/frontalis.v1.") || request.method() == Method::GET;
    !is_any_of(&WORK) || (is_any_of(&OPEN) && reads)
}
