//! Where an error becomes an HTTP status: `application/problem+json` (RFC 9457).
//!
//! Both doors refuse alike: a problem is made from the gRPC status that the same call would get. Names of fields and
//! figures are those of the JSON mapping.

mod title;

use std::time::Duration;

use axum::{
    Extension,
    extract::Request,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use frontalis_proto::json_name;
use serde_json::{Map, Value, json};
use tonic::{Code, Status};

use self::title::title;
use crate::service::grpc::status::{metadata_of, reason_of, retry_after_of};

/// Longest `instance`, in characters.
const MAX_INSTANCE: usize = 256;

/// Greatest whole number that every reader of JSON holds.
const MAX_NUMBER: u64 = 1 << 53;

/// Of all that is exhausted, these are the body itself; trying again will not help.
const TOO_LARGE: [&str; 3] = ["BASIS_SIZE", "CHUNK_SIZE", "MESSAGE_SIZE"];

/// Of every problem document.
pub const MEDIA_TYPE: &str = "application/problem+json";

/// A refusal on its way out.
#[derive(Clone, Debug)]
pub struct Problem {
    status: StatusCode,
    reason: String,
    detail: String,
    figures: Vec<(String, String)>,
    retry_after: Option<Duration>,
}

impl Problem {
    /// A refusal that has no gRPC counterpart.
    pub fn new(status: StatusCode, reason: &str, detail: &str) -> Self {
        Self {
            status,
            reason: reason.to_owned(),
            detail: detail.to_owned(),
            figures: Vec::new(),
            retry_after: None,
        }
    }

    /// Adds a figure that a program can read.
    #[must_use]
    pub fn with(mut self, key: &str, value: &str) -> Self {
        self.figures.push((key.to_owned(), value.to_owned()));
        self
    }

    /// Says by which message of a stream it came: its number from 1, counted in lines or messages.
    #[must_use]
    pub fn of_message(mut self, unit: &'static str, number: u64) -> Self {
        if self.figures.iter().all(|(key, _)| key != unit) {
            self.detail = format!("{unit} {number}: {}", self.detail);
            self.figures.push((unit.to_owned(), number.to_string()));
        }
        self
    }

    /// The document; `instance` is the path of the request.
    pub fn document(&self, instance: &str) -> Value {
        let mut body = self.body();
        let instance: String = instance.chars().take(MAX_INSTANCE).collect();
        body["instance"] = json!(instance);
        body
    }

    /// The last message of a stream that fails: `{"error": …}`.
    pub fn in_stream(&self, instance: &str) -> String {
        json!({ "error": self.document(instance) }).to_string()
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
            // Figures a program can read; a number stays a number as far as every reader of JSON holds it.
            let number = value.parse::<u64>().ok().filter(|it| *it <= MAX_NUMBER);
            let value = number.map_or_else(|| json!(value), |it| json!(it));
            body.entry(key.clone()).or_insert(value);
        }
        Value::Object(body)
    }
}

impl From<Status> for Problem {
    fn from(status: Status) -> Self {
        let reason = reason_of(&status).unwrap_or_else(|| "INTERNAL".to_owned());
        let mut figures = metadata_of(&status);
        let mut detail = status.message().to_owned();
        for (key, value) in &mut figures {
            if key == "field" {
                let name = json_name(value);
                if let Some(rest) = detail.strip_prefix(value.as_str()) {
                    detail = format!("{name}{rest}");
                }
                *value = name;
            }
            *key = json_name(key);
        }
        Self {
            status: http_status(status.code(), &reason),
            retry_after: retry_after_of(&status),
            reason,
            detail,
            figures,
        }
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let body = self.body().to_string();
        let mut headers = HeaderMap::new();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
        if let Some(after) = self.retry_after {
            // Whole seconds, rounded up: who waits less is refused again.
            let secs = after.as_secs() + u64::from(after.subsec_nanos() > 0);
            headers.insert(header::RETRY_AFTER, secs.into());
        }
        if self.status == StatusCode::UNAUTHORIZED {
            let scheme = HeaderValue::from_static("Bearer");
            headers.insert(header::WWW_AUTHENTICATE, scheme);
        }
        (self.status, headers, Extension(self), body).into_response()
    }
}

/// Writes the request's path into every problem as its `instance`.
pub async fn with_instance(request: Request, next: Next) -> Response {
    let instance = request.uri().path().to_owned();
    let mut response = next.run(request).await;
    if let Some(problem) = response.extensions_mut().remove::<Problem>() {
        let body = problem.document(&instance);
        response.headers_mut().remove(header::CONTENT_LENGTH);
        *response.body_mut() = body.to_string().into();
    }
    response
}

/// The mapping of BAD_INPUT, "Status mapping".
fn http_status(code: Code, reason: &str) -> StatusCode {
    if TOO_LARGE.contains(&reason) {
        return StatusCode::PAYLOAD_TOO_LARGE;
    }
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
    use crate::{
        hub::RangeError,
        wire::invalid::{FieldError, FieldProblem},
    };

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
        assert_eq!(body["title"], "The session has started over");
        assert_eq!(body["status"], 416);
        assert_eq!(body["run"], 3);
    }

    #[test]
    fn a_problem_says_in_whole_seconds_when_to_try_again() {
        let limit = crate::service::grpc::refusal::limit("CALLS", "limits.calls", 8);
        let answer = Problem::from(limit).into_response();
        assert_eq!(answer.status(), StatusCode::TOO_MANY_REQUESTS);
        assert_eq!(answer.headers()[header::RETRY_AFTER], "1");
    }

    #[test]
    fn names_are_those_of_the_json_mapping() {
        let refused = FieldError::new("neutral_frames", FieldProblem::Missing).inside("settings");
        let body = Problem::from(Status::from(refused)).body();
        assert_eq!(body["field"], "settings.neutralFrames");
        assert_eq!(body["detail"], "settings.neutralFrames: must be given");
        let not_kept = RangeError::NotKept {
            wanted: 1,
            first_available: 4,
            last_available: 9,
        };
        let body = Problem::from(Status::from(not_kept)).body();
        assert_eq!(
            (&body["firstAvailable"], &body["lastAvailable"]),
            (&json!(4), &json!(9))
        );
    }

    #[test]
    fn a_problem_says_once_by_which_message_it_came() {
        let problem = Problem::new(StatusCode::BAD_REQUEST, "JSON", "no JSON");
        let body = problem.of_message("line", 3).of_message("line", 4).body();
        assert_eq!(body["line"], 3);
        assert_eq!(body["detail"], "line 3: no JSON");
    }

    #[test]
    fn figures_never_replace_the_fields_of_a_problem() {
        let mut problem = Problem::new(StatusCode::NOT_FOUND, "ROUTE", "no such route");
        problem.figures.push(("status".into(), "200".into()));
        assert_eq!(problem.body()["status"], 404);
    }
}
