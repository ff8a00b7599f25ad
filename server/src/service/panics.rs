//! A panic while an answer is streamed ends that answer and nothing else (CONTRACTS O-9).
//!
//! Panics of handlers are caught where handlers are called; what a handler returns is polled later, by the connection.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    pin::Pin,
    task::{Context, Poll},
};

use axum::{body::Body, extract::State, response::Response};
use bytes::Bytes;
use http::HeaderMap;
use hyper::body::{Body as _, Frame, SizeHint};
use tonic::{Code, Status};

use super::grpc::status::refuse;
use crate::telemetry::Metrics;

/// What a panic is answered with, whatever its message.
pub const DETAIL: &str = "the server made a mistake; it goes on";

/// Guards the stream of a gRPC answer: after a panic its trailers say `INTERNAL PANIC`.
pub async fn guard_grpc(State(metrics): State<Metrics>, answer: Response) -> Response {
    answer.map(|body| Guarded::over(body, metrics, in_trailers))
}

/// Guards the stream of any other answer: after a panic it breaks off, so that nobody takes it for complete.
pub async fn guard_http(State(metrics): State<Metrics>, answer: Response) -> Response {
    answer.map(|body| Guarded::over(body, metrics, broken_off))
}

type Last = fn() -> Result<Frame<Bytes>, axum::Error>;

fn in_trailers() -> Result<Frame<Bytes>, axum::Error> {
    let mut trailers = HeaderMap::new();
    let status = refuse(Code::Internal, "PANIC", DETAIL);
    status.add_header(&mut trailers).map_err(axum::Error::new)?;
    Ok(Frame::trailers(trailers))
}

fn broken_off() -> Result<Frame<Bytes>, axum::Error> {
    Err(axum::Error::new(Status::internal(DETAIL)))
}

/// An answer that may panic while it is polled.
struct Guarded {
    /// None: it panicked.
    body: Option<Body>,
    metrics: Metrics,
    last: Last,
}

impl Guarded {
    fn over(body: Body, metrics: Metrics, last: Last) -> Body {
        if body.is_end_stream() {
            return body;
        }
        Body::new(Self {
            body: Some(body),
            metrics,
            last,
        })
    }
}

impl hyper::body::Body for Guarded {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let this = self.get_mut();
        let Some(body) = &mut this.body else {
            return Poll::Ready(None);
        };
        // What panicked is dropped and never polled again, so nobody sees it half changed.
        let polled = catch_unwind(AssertUnwindSafe(|| Pin::new(body).poll_frame(cx)));
        polled.unwrap_or_else(|_panic| {
            this.metrics.panicked();
            tracing::error!("an answer panicked while it was streamed");
            this.body = None;
            Poll::Ready(Some((this.last)()))
        })
    }

    fn is_end_stream(&self) -> bool {
        self.body.as_ref().is_none_or(Body::is_end_stream)
    }

    fn size_hint(&self) -> SizeHint {
        self.body
            .as_ref()
            .map_or_else(SizeHint::default, Body::size_hint)
    }
}
