//! Where an error becomes an HTTP status: `application/problem+json` (RFC 9457).
//!
//! Both doors refuse alike: a problem is made from the gRPC status that the same call would get.

use axum::{
    Extension,
    extract::Request,
    http::{HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use serde_json::{Map, Value, json};
use tonic::{Code, Status};

use crate::service::grpc::status::{metadata_of, reason_of};

/// Longest `instance`, in characters.
const MAX_INSTANCE: usize = 256;

/// A refusal on its way out.
#[derive(Clone, Debug)]
pub struct Problem {
    status: StatusCode,
    reason: String,
    detail: String,
    figures: Vec<(String, String)>,
}

impl Problem {
    /// A refusal that has no gRPC counterpart.
    pub fn new(status: StatusCode, reason: &str, detail: &str) -> Self {
        Self {
            status,
            reason: reason.to_owned(),
            detail: detail.to_owned(),
            figures: Vec::new(),
        }
    }

    fn body(&self) -> Value {
        let mut body = Map::new();
        body.insert(
            "type".into(),
            json!(format!("urn:frontalis:problem:{}", self.reason)),
        );
        body.insert("title".into(), json!(title(&self.reason)));
        body.insert("status".into(), json!(self.status.as_u16()));
        body.insert("detail".into(), json!(self.detail));
        for (key, value) in &self.figures {
            // Figures a program can read; a number stays a number.
            let value = value
                .parse::<u64>()
                .map_or_else(|_| json!(value), |it| json!(it));
            body.entry(key.clone()).or_insert(value);
        }
        Value::Object(body)
    }
}

impl From<Status> for Problem {
    fn from(status: Status) -> Self {
        Self {
            status: http_status(status.code()),
            reason: reason_of(&status).unwrap_or_else(|| "INTERNAL".to_owned()),
            detail: status.message().to_owned(),
            figures: metadata_of(&status),
        }
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let body = self.body().to_string();
        let kind = HeaderValue::from_static("application/problem+json");
        (
            self.status,
            [(header::CONTENT_TYPE, kind)],
            Extension(self),
            body,
        )
            .into_response()
    }
}

/// Writes the request's path into every problem as its `instance`.
pub async fn with_instance(request: Request, next: Next) -> Response {
    let instance: String = request.uri().path().chars().take(MAX_INSTANCE).collect();
    let mut response = next.run(request).await;
    if let Some(problem) = response.extensions_mut().remove::<Problem>() {
        let mut body = problem.body();
        body["instance"] = json!(instance);
        response.headers_mut().remove(header::CONTENT_LENGTH);
        *response.body_mut() = body.to_string().into();
    }
    response
}

/// `NEW_RUN` as a person reads it: `new run`.
fn title(reason: &str) -> String {
    reason.to_lowercase().replace('_', " ")
}

/// The mapping of BAD_INPUT, "Status mapping".
fn http_status(code: Code) -> StatusCode {
    match code {
        Code::Ok => StatusCode::OK,
        Code::InvalidArgument => StatusCode::BAD_REQUEST,
        Code::Unauthenticated => StatusCode::UNAUTHORIZED,
        Code::PermissionDenied => StatusCode::FORBIDDEN,
        Code::NotFound => StatusCode::NOT_FOUND,
        Code::AlreadyExists | Code::Aborted | Code::FailedPrecondition => StatusCode::CONFLICT,
        Code::OutOfRange => StatusCode::RANGE_NOT_SATISFIABLE,
        Code::ResourceExhausted => StatusCode::TOO_MANY_REQUESTS,
        Code::Unimplemented => StatusCode::NOT_IMPLEMENTED,
        Code::Unavailable => StatusCode::SERVICE_UNAVAILABLE,
        Code::DeadlineExceeded => StatusCode::GATEWAY_TIMEOUT,
        Code::Cancelled | Code::Internal | Code::DataLoss | Code::Unknown => {
            StatusCode::INTERNAL_SERVER_ERROR
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hub::RangeError;

    #[test]
    fn a_problem_says_what_the_grpc_status_says() {
        let status = Status::from(RangeError::NewRun {
            wanted: 1,
            current: 3,
        });
        let problem = Problem::from(status);
        assert_eq!(problem.status, StatusCode::RANGE_NOT_SATISFIABLE);
        let body = problem.body();
        assert_eq!(body["type"], "urn:frontalis:problem:NEW_RUN");
        assert_eq!(body["title"], "new run");
        assert_eq!(body["status"], 416);
        assert_eq!(body["run"], 3);
    }

    #[test]
    fn figures_never_replace_the_fields_of_a_problem() {
        let mut problem = Problem::new(StatusCode::NOT_FOUND, "ROUTE", "no such route");
        problem.figures.push(("status".into(), "200".into()));
        assert_eq!(problem.body()["status"], 404);
    }
}
