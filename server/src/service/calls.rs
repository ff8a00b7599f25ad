//! How many calls may be in progress: each may hold part of a message (CONTRACTS O-1, O-3).
//!
//! A call is refused before any of it is read, and its place is free again when its answer is sent or dropped.

use std::{
    pin::Pin,
    sync::Arc,
    task::{Context, Poll},
};

use axum::{
    body::Body,
    extract::{Request, State},
    middleware::Next,
    response::Response,
};
use bytes::Bytes;
use hyper::body::{Frame, SizeHint};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tonic::Status;

use super::grpc::refusal::limit;
use crate::config::Limits;

/// Calls of this service may hold a large message each.
const CAPTURE: &str = "/frontalis.v1.CaptureService/";

/// Must be answered however many calls there are: overload makes a server neither dead nor unready.
const HEALTH_CHECK: &str = "/grpc.health.v1.Health/Check";

/// Counts calls in progress; cheap to clone.
#[derive(Clone, Debug)]
pub struct Calls {
    all: Counted,
    capture: Counted,
}

#[derive(Clone, Debug)]
struct Counted {
    places: Arc<Semaphore>,
    name: &'static str,
    limit: usize,
}

impl Calls {
    /// No call is in progress.
    pub fn new(limits: &Limits) -> Self {
        Self {
            all: Counted::new("limits.calls", limits.calls),
            capture: Counted::new("limits.publishers", limits.publishers),
        }
    }

    fn admit(&self, path: &str) -> Result<Vec<OwnedSemaphorePermit>, Status> {
        if path == HEALTH_CHECK {
            return Ok(Vec::new());
        }
        let mut places = vec![self.all.take()?];
        if path.starts_with(CAPTURE) {
            places.push(self.capture.take()?);
        }
        Ok(places)
    }
}

impl Counted {
    fn new(name: &'static str, limit: u64) -> Self {
        let limit = usize::try_from(limit)
            .unwrap_or(usize::MAX)
            .min(Semaphore::MAX_PERMITS);
        Self {
            places: Arc::new(Semaphore::new(limit)),
            name,
            limit,
        }
    }

    fn take(&self) -> Result<OwnedSemaphorePermit, Status> {
        let places = Arc::clone(&self.places);
        places
            .try_acquire_owned()
            .map_err(|_| limit("CALLS", self.name, self.limit))
    }
}

/// Lets a call pass, or refuses it at a limit.
pub async fn admit(State(calls): State<Calls>, request: Request, next: Next) -> Response {
    let places = match calls.admit(request.uri().path()) {
        Ok(places) => places,
        Err(refused) => return refused.into_http(),
    };
    next.run(request).await.map(|body| {
        Body::new(Held {
            body,
            _places: places,
        })
    })
}

/// An answer that holds its call's places until it is gone.
struct Held {
    body: Body,
    _places: Vec<OwnedSemaphorePermit>,
}

impl hyper::body::Body for Held {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        Pin::new(&mut self.get_mut().body).poll_frame(cx)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_free_again_when_its_call_is_gone() {
        let limits = Limits {
            calls: 2,
            publishers: 1,
            ..Limits::default()
        };
        let calls = Calls::new(&limits);
        let publishing = calls
            .admit("/frontalis.v1.CaptureService/PublishMarkers")
            .unwrap();
        assert!(
            calls
                .admit("/frontalis.v1.CaptureService/PublishMarkers")
                .is_err()
        );
        let other = calls.admit("/frontalis.v1.CurveService/Follow").unwrap();
        assert!(calls.admit("/frontalis.v1.CurveService/Follow").is_err());
        assert!(calls.admit(HEALTH_CHECK).is_ok());
        drop(publishing);
        drop(other);
        assert!(
            calls
                .admit("/frontalis.v1.CaptureService/PublishMarkers")
                .is_ok()
        );
    }
}
