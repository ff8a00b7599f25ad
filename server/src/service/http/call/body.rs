//! The body of a request as the message that is due.
//!
//! Few bodies may be large at once, so that what all calls hold stays within the worst case (CONTRACTS O-2).

use std::sync::Arc;

use axum::{
    body::Body,
    extract::{FromRequest, Request},
    http::{HeaderMap, HeaderValue, StatusCode, header},
};
use bytes::BytesMut;
use frontalis_analysis::{
    face::actor::MAX_MUSCLES, marker_analysis::objective::MAX_EXCLUSIVE_PAIRS,
};
use http_body_util::BodyExt as _;
use prost::Name;
use tokio::sync::{Semaphore, SemaphorePermit};
use tonic::{Code, Status};

use super::Problem;
use crate::{
    config::{LARGE_BODIES, LARGE_BODY_BYTES, SMALL_MESSAGE_BYTES},
    service::{
        access::{Action, Caller},
        grpc::{refusal::limit, status::refuse},
        http::{
            Doors,
            json::{self, Rules},
        },
    },
};

/// Most objects in a body: the message, the settings in it, and their bounds and pairs; a pair too many is still read, to be
/// refused by name.
const MAX_OBJECTS: usize = 8 + MAX_MUSCLES + 2 * MAX_EXCLUSIVE_PAIRS;

/// The message of the body.
pub(in crate::service::http) struct Message<T>(pub T);

/// A message that is a body, of which the path may say a part that the body then must not.
pub(in crate::service::http) trait BodyMessage:
    Name + Default + Send
{
    /// What is done with it: whoever may not is told so before the body is read.
    const ACTION: Action;
    /// The fields that the path says, as JSON names them.
    const IN_PATH: &'static [&'static str];
    /// Whether nothing is left that a body must say.
    const MAY_BE_ABSENT: bool;
}

/// How many bodies may be large at once; cheap to clone.
#[derive(Clone, Debug)]
pub struct LargeBodies(Arc<Semaphore>);

impl Default for LargeBodies {
    fn default() -> Self {
        Self(Arc::new(Semaphore::new(LARGE_BODIES)))
    }
}

impl<T: BodyMessage> FromRequest<Doors> for Message<T> {
    type Rejection = Problem;

    async fn from_request(request: Request, doors: &Doors) -> Result<Self, Problem> {
        let (parts, body) = request.into_parts();
        Caller::of(&parts.extensions).may(T::ACTION)?;
        check_encoding(&parts.headers)?;
        let kind = media_type(&parts.headers);
        if kind.as_deref().is_some_and(|it| it != "application/json") {
            return Err(not_json());
        }
        let (bytes, _place) = doors.large_bodies.read(body).await?;
        if bytes.is_empty() && T::MAY_BE_ABSENT {
            return Ok(Self(T::default()));
        }
        if kind.is_none() {
            return Err(not_json());
        }
        let rules = Rules {
            in_path: T::IN_PATH,
            max_objects: MAX_OBJECTS,
        };
        let read = json::read(&bytes, rules).map_err(Status::from)?;
        Ok(Self(read))
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

impl LargeBodies {
    /// The body, and the place that it takes while it is held.
    async fn read(
        &self,
        mut body: Body,
    ) -> Result<(BytesMut, Option<SemaphorePermit<'_>>), Problem> {
        let mut bytes = BytesMut::new();
        let mut place = None;
        while let Some(frame) = body.frame().await {
            let Ok(data) = frame.map_err(|_cut| cut())?.into_data() else {
                continue;
            };
            let n_bytes = bytes.len() + data.len();
            if n_bytes > LARGE_BODY_BYTES {
                return Err(too_large());
            }
            if n_bytes > SMALL_MESSAGE_BYTES && place.is_none() {
                let full = |_| limit("BODIES", "large bodies", LARGE_BODIES);
                place = Some(self.0.try_acquire().map_err(full)?);
            }
            bytes.extend_from_slice(&data);
        }
        Ok((bytes, place))
    }
}

fn cut() -> Problem {
    let detail = "the body ended before it was complete";
    Problem::new(StatusCode::BAD_REQUEST, "BODY", detail)
}

fn too_large() -> Problem {
    let detail = format!("the body is limited to {LARGE_BODY_BYTES} bytes");
    Problem::new(StatusCode::PAYLOAD_TOO_LARGE, "BODY_SIZE", &detail)
        .with("limit", "body")
        .with("value", &LARGE_BODY_BYTES.to_string())
}

fn not_json() -> Problem {
    let detail = "the content type must be application/json";
    Problem::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "CONTENT_TYPE", detail)
}
