//! How many calls may be in progress, through every door: each may hold part of a message (CONTRACTS O-1, O-3).
//!
//! A call is refused before any of it is read, and its place is free again when its answer is sent or dropped. Who goes
//! on after its answer, as a WebSocket does, takes the [`Place`] along.

use std::{
    pin::Pin,
    sync::Arc,
    task::{Context, Poll},
};

use axum::{
    body::Body,
    extract::{Request, State},
    http::{HeaderMap, header},
    middleware::Next,
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use hyper::body::{Frame, SizeHint};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tonic::Status;

use super::{grpc::refusal::limit, http::Problem};
use crate::config::Limits;

/// Calls of this service may hold a large message each.
const CAPTURE: &str = "/frontalis.v1.CaptureService/";

/// How the path of a publisher's HTTP request ends, and what the name of its WebSocket protocol begins with.
const FRAMES: &str = "/frames";
const PUBLISH: &str = "frontalis.v1.publish+";

/// Must be answered however many calls there are: overload makes a server neither dead nor unready.
const HEALTH: [&str; 4] = [
    "/grpc.health.v1.Health/Check",
    "/healthz",
    "/readyz",
    "/metrics",
];

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

/// The place of one call, in its request's extensions; free when the last clone is dropped.
#[derive(Clone, Debug)]
pub struct Place {
    _held: Arc<[OwnedSemaphorePermit]>,
}

impl Calls {
    /// No call is in progress.
    pub fn new(limits: &Limits) -> Self {
        Self {
            all: Counted::new("limits.calls", limits.calls),
            capture: Counted::new("limits.publishers", limits.publishers),
        }
    }

    /// Calls in progress, of every door.
    pub fn in_progress(&self) -> usize {
        self.all.in_progress()
    }

    fn admit(&self, path: &str, headers: &HeaderMap) -> Result<Option<Place>, Status> {
        if HEALTH.contains(&path) {
            return Ok(None);
        }
        let mut held = vec![self.all.take()?];
        if path.starts_with(CAPTURE) || path.ends_with(FRAMES) || publishes(headers) {
            held.push(self.capture.take()?);
        }
        Ok(Some(Place { _held: held.into() }))
    }
}

fn publishes(headers: &HeaderMap) -> bool {
    let protocols = headers.get_all(header::SEC_WEBSOCKET_PROTOCOL);
    let mut names = protocols.iter().filter_map(|it| it.to_str().ok());
    names.any(|it| it.split(',').any(|name| name.trim().starts_with(PUBLISH)))
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

    fn in_progress(&self) -> usize {
        self.limit - self.places.available_permits()
    }
}

/// Lets a gRPC call pass, or refuses it at a limit.
pub async fn admit_grpc(State(calls): State<Calls>, request: Request, next: Next) -> Response {
    admit(&calls, request, next, Status::into_http).await
}

/// Lets an HTTP request pass, or refuses it at a limit.
pub async fn admit_http(State(calls): State<Calls>, request: Request, next: Next) -> Response {
    let refuse = |refused| Problem::from(refused).into_response();
    admit(&calls, request, next, refuse).await
}

async fn admit(
    calls: &Calls,
    mut request: Request,
    next: Next,
    refuse: fn(Status) -> Response,
) -> Response {
    let place = match calls.admit(request.uri().path(), request.headers()) {
        Ok(Some(place)) => place,
        Ok(None) => return next.run(request).await,
        Err(refused) => return refuse(refused),
    };
    request.extensions_mut().insert(place.clone());
    next.run(request).await.map(|body| {
        Body::new(Held {
            body,
            _place: place,
        })
    })
}

/// An answer that holds its call's place until it is gone.
struct Held {
    body: Body,
    _place: Place,
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

    const PUBLISH_MARKERS: &str = "/frontalis.v1.CaptureService/PublishMarkers";
    const FOLLOW: &str = "/frontalis.v1.CurveService/Follow";

    fn calls(calls: u64, publishers: u64) -> Calls {
        Calls::new(&Limits {
            calls,
            publishers,
            ..Limits::default()
        })
    }

    #[test]
    fn a_place_is_free_again_when_its_call_is_gone() {
        let calls = calls(2, 1);
        let admit = |path| calls.admit(path, &HeaderMap::new());
        let publishing = admit(PUBLISH_MARKERS).unwrap();
        assert!(admit(PUBLISH_MARKERS).is_err());
        assert_eq!(calls.in_progress(), 1);
        let other = admit(FOLLOW).unwrap();
        assert!(admit(FOLLOW).is_err());
        assert_eq!(calls.in_progress(), 2);
        for path in HEALTH {
            assert!(admit(path).unwrap().is_none());
        }
        drop(publishing);
        drop(other);
        assert_eq!(calls.in_progress(), 0);
        assert!(admit(PUBLISH_MARKERS).is_ok());
    }

    #[test]
    fn a_publisher_counts_as_one_through_every_door() {
        let calls = calls(8, 1);
        let mut socket = HeaderMap::new();
        let protocols = "frontalis.bearer.x, frontalis.v1.publish+proto";
        socket.insert(header::SEC_WEBSOCKET_PROTOCOL, protocols.parse().unwrap());
        let stream = "/api/v1/sessions/s/stream";
        let frames = "/api/v1/sessions/s/frames";
        for (path, headers) in [
            (PUBLISH_MARKERS, HeaderMap::new()),
            (frames, HeaderMap::new()),
            (stream, socket.clone()),
        ] {
            let held = calls.admit(path, &headers).unwrap();
            assert!(calls.admit(PUBLISH_MARKERS, &HeaderMap::new()).is_err());
            assert!(calls.admit(frames, &HeaderMap::new()).is_err());
            assert!(calls.admit(stream, &socket).is_err());
            assert!(calls.admit(stream, &HeaderMap::new()).is_ok());
            drop(held);
        }
    }
}
