//! Every status that leaves carries a reason, also those that the codec makes (BAD_INPUT, "Status mapping").

use std::{
    pin::Pin,
    task::{Context, Poll},
};

use axum::{body::Body, response::Response};
use bytes::Bytes;
use http::HeaderMap;
use hyper::body::{Body as _, Frame};
use tonic::{Code, Status};

use super::status::{reason_of, refuse};

/// How the codec's texts begin when a message cannot be read.
const UNREADABLE: [&str; 2] = [
    "failed to decode Protobuf message",
    "Missing request message",
];

/// Completes the status of an answer, in its headers or in its trailers.
pub async fn complete(mut answer: Response) -> Response {
    complete_status(answer.headers_mut());
    if answer.body().is_end_stream() {
        return answer;
    }
    answer.map(|body| Body::new(Completed(body)))
}

fn complete_status(headers: &mut HeaderMap) {
    let Some(status) = Status::from_header_map(headers) else {
        return;
    };
    if status.code() == Code::Ok || reason_of(&status).is_some() {
        return;
    }
    let message = match status.message() {
        "" => status.code().description(),
        message => message,
    };
    let refused = refuse(status.code(), reason(&status), message);
    // A message that fits no header was refused before it came here.
    drop(refused.add_header(headers));
}

fn reason(status: &Status) -> &'static str {
    match status.code() {
        Code::Ok => "OK",
        Code::Cancelled => "CANCELLED",
        Code::Unknown => "UNKNOWN",
        Code::InvalidArgument => "INVALID_ARGUMENT",
        Code::DeadlineExceeded => "DEADLINE",
        Code::NotFound => "NOT_FOUND",
        Code::AlreadyExists => "ALREADY_EXISTS",
        Code::PermissionDenied => "PERMISSION_DENIED",
        Code::ResourceExhausted => "RESOURCE_EXHAUSTED",
        Code::FailedPrecondition => "FAILED_PRECONDITION",
        Code::Aborted => "ABORTED",
        Code::OutOfRange => "MESSAGE_SIZE",
        // The services refuse nothing so without a reason of theirs; what is left is a method that is not there.
        Code::Unimplemented => "METHOD",
        Code::Internal if UNREADABLE.iter().any(|it| status.message().starts_with(it)) => {
            "PROTOBUF"
        }
        Code::Internal => "INTERNAL",
        Code::Unavailable => "UNAVAILABLE",
        Code::DataLoss => "DATA_LOSS",
        Code::Unauthenticated => "UNAUTHENTICATED",
    }
}

/// An answer whose trailers say why.
struct Completed(Body);

impl hyper::body::Body for Completed {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let complete = |mut frame: Frame<Bytes>| {
            if let Some(trailers) = frame.trailers_mut() {
                complete_status(trailers);
            }
            frame
        };
        Pin::new(&mut self.0)
            .poll_frame(cx)
            .map(|frame| frame.map(|it| it.map(complete)))
    }

    fn is_end_stream(&self) -> bool {
        self.0.is_end_stream()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn completed(status: &Status) -> Status {
        let mut headers = HeaderMap::new();
        status.add_header(&mut headers).unwrap();
        complete_status(&mut headers);
        Status::from_header_map(&headers).unwrap()
    }

    #[test]
    fn a_status_of_the_codec_gets_a_reason_and_keeps_code_and_message() {
        let status = completed(&Status::internal("failed to decode Protobuf message: x"));
        assert_eq!(status.code(), Code::Internal);
        assert_eq!(status.message(), "failed to decode Protobuf message: x");
        assert_eq!(reason_of(&status).as_deref(), Some("PROTOBUF"));
    }

    #[test]
    fn a_reason_that_is_there_stays() {
        let status = completed(&refuse(Code::NotFound, "SESSION", "no such session"));
        assert_eq!(reason_of(&status).as_deref(), Some("SESSION"));
    }
}
