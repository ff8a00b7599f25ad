//! The body of a request as the message that is due.

use axum::{
    body::Body,
    extract::{FromRequest, Request},
    http::{HeaderMap, HeaderValue, StatusCode, header},
};
use bytes::Bytes;
use http_body_util::{BodyExt as _, LengthLimitError, Limited};
use serde::de::DeserializeOwned;
use tonic::{Code, Status};

use super::{Problem, json};
use crate::{config::SMALL_MESSAGE_BYTES, service::grpc::status::refuse};

/// The message of the body.
pub(in crate::service::http) struct Message<T>(pub T);

/// A message of which the path says a part, so that the body must not.
pub(in crate::service::http) trait PathFields:
    DeserializeOwned + Default + Send
{
    /// The fields that the path says, as JSON names them.
    const IN_PATH: &'static [&'static str];
    /// Whether nothing is left that a body must say.
    const MAY_BE_ABSENT: bool;
}

impl<S: Send + Sync, T: PathFields> FromRequest<S> for Message<T> {
    type Rejection = Problem;

    async fn from_request(request: Request, _state: &S) -> Result<Self, Problem> {
        let (parts, body) = request.into_parts();
        check_encoding(&parts.headers)?;
        let kind = media_type(&parts.headers);
        if kind.as_deref().is_some_and(|it| it != "application/json") {
            return Err(not_json());
        }
        let bytes = read(body).await?;
        if bytes.is_empty() && T::MAY_BE_ABSENT {
            return Ok(Self(T::default()));
        }
        if kind.is_none() {
            return Err(not_json());
        }
        json::message(&bytes, T::IN_PATH).map(Self)
    }
}

/// Type and subtype of the content, in lower case, without parameters.
pub(in crate::service::http) fn media_type(headers: &HeaderMap) -> Option<String> {
    let kind = headers.get(header::CONTENT_TYPE)?;
    let kind = kind.to_str().unwrap_or_default();
    let essence = kind.split(';').next().unwrap_or_default();
    Some(essence.trim().to_ascii_lowercase())
}

/// Bodies come as they are (BAD_INPUT D11).
///
/// # Errors
///
/// `UNIMPLEMENTED COMPRESSION` for any other encoding.
pub(in crate::service::http) fn check_encoding(headers: &HeaderMap) -> Result<(), Status> {
    let encodings = headers.get_all(header::CONTENT_ENCODING);
    let plain = |it: &HeaderValue| it.as_bytes().eq_ignore_ascii_case(b"identity");
    if encodings.iter().all(plain) {
        return Ok(());
    }
    let message = "a body with a content encoding is not accepted";
    Err(refuse(Code::Unimplemented, "COMPRESSION", message))
}

async fn read(body: Body) -> Result<Bytes, Problem> {
    let read = Limited::new(body, SMALL_MESSAGE_BYTES).collect().await;
    let read = read.map_err(|error| {
        if error.is::<LengthLimitError>() {
            return too_large();
        }
        let detail = "the body ended before it was complete";
        Problem::new(StatusCode::BAD_REQUEST, "BODY", detail)
    })?;
    Ok(read.to_bytes())
}

fn too_large() -> Problem {
    let detail = format!("the body is limited to {SMALL_MESSAGE_BYTES} bytes");
    Problem::new(StatusCode::PAYLOAD_TOO_LARGE, "BODY_SIZE", &detail)
        .with("limit", "body")
        .with("value", &SMALL_MESSAGE_BYTES.to_string())
}

fn not_json() -> Problem {
    let detail = "the content type must be application/json";
    Problem::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "CONTENT_TYPE", detail)
}
