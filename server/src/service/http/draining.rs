//! A refusal that is heard: over HTTP/2, what the client still sends of its request is taken and thrown away before the
//! answer.
//!
//! A stream whose answer ends before its request is reset (RFC 9113, section 8.1), and several clients, curl 7.88 among
//! them, show the reset instead of the answer. So the head of a refusal, and the end of any other answer, wait for the
//! end of the request: for as long as it keeps coming, and within limits. Over HTTP/1 the connection lingers instead,
//! and a client that asks first (`Expect: 100-continue`) is told at once. gRPC has its own end of a call.

use std::{
    pin::Pin,
    sync::Arc,
    task::{Context, Poll, ready},
    time::Duration,
};

use axum::{
    body::{Body, Bytes},
    extract::{Request, State},
    http::{HeaderMap, Method, Version, header},
    middleware::Next,
    response::Response,
};
use http_body_util::BodyExt as _;
use hyper::body::{Body as _, Frame, SizeHint};
use tokio::{
    sync::{Semaphore, oneshot},
    time::timeout,
};

/// Most that is thrown away of one request, bytes: twice the largest package.
const MAX_BYTES: u64 = 128 << 20;
/// A client that sends nothing for so long is answered.
const MAX_PAUSE: Duration = Duration::from_secs(1);
/// A client that still sends after this time is answered.
const MAX_TIME: Duration = Duration::from_secs(10);
/// Requests that are thrown away at once; those beyond are answered as they stand.
const MAX_AT_ONCE: usize = 32;

/// How many requests are being thrown away.
#[derive(Clone)]
pub struct Draining(Arc<Semaphore>);

impl Default for Draining {
    fn default() -> Self {
        Self(Arc::new(Semaphore::new(MAX_AT_ONCE)))
    }
}

/// Answers once the request was heard to its end, or the limits are reached.
pub async fn heard_out(State(draining): State<Draining>, request: Request, next: Next) -> Response {
    if !is_sending(&request) {
        return next.run(request).await;
    }
    let (back, rest) = oneshot::channel();
    let request = request.map(|body| Body::new(Lent::new(body, back)));
    let response = next.run(request).await;
    let drained = draining.drain(rest);
    if response.status().is_client_error() || response.status().is_server_error() {
        drained.await;
        return response;
    }
    response.map(|body| {
        Body::new(Held {
            body,
            drained: Some(Box::pin(drained)),
        })
    })
}

/// Whether the request has a body that comes over HTTP/2 without asking, and is no call of gRPC.
fn is_sending(request: &Request) -> bool {
    request.version() == Version::HTTP_2
        && request.method() != Method::CONNECT
        && !request.headers().contains_key(header::EXPECT)
        && !is_grpc(request.headers())
        && !request.body().is_end_stream()
}

fn is_grpc(headers: &HeaderMap) -> bool {
    let kind = headers.get(header::CONTENT_TYPE);
    kind.is_some_and(|it| it.as_bytes().starts_with(b"application/grpc"))
}

impl Draining {
    /// Takes what is left of a request once nobody reads it any more.
    fn drain(&self, rest: oneshot::Receiver<Body>) -> impl Future<Output = ()> + use<> {
        let places = self.0.clone();
        async move {
            let thrown_away = async {
                let Ok(body) = rest.await else { return };
                if let Ok(_place) = places.try_acquire() {
                    throw_away(body).await;
                }
            };
            // Too slow for the limit: answered as it stands.
            let _in_time = timeout(MAX_TIME, thrown_away).await;
        }
    }
}

async fn throw_away(mut body: Body) {
    if body.size_hint().lower() > MAX_BYTES {
        return;
    }
    let mut n_bytes = 0;
    while let Ok(Some(Ok(frame))) = timeout(MAX_PAUSE, body.frame()).await {
        n_bytes += frame.data_ref().map_or(0, |it| it.len() as u64);
        if n_bytes > MAX_BYTES {
            return;
        }
    }
}

/// The body of a request, given back when its reader has had enough before its end.
struct Lent {
    body: Option<Body>,
    back: Option<oneshot::Sender<Body>>,
}

impl Lent {
    fn new(body: Body, back: oneshot::Sender<Body>) -> Self {
        Self {
            body: Some(body),
            back: Some(back),
        }
    }
}

impl hyper::body::Body for Lent {
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
        let frame = ready!(Pin::new(body).poll_frame(cx));
        if !matches!(frame, Some(Ok(_))) {
            this.body = None;
        }
        Poll::Ready(frame)
    }

    fn is_end_stream(&self) -> bool {
        self.body.as_ref().is_none_or(Body::is_end_stream)
    }

    fn size_hint(&self) -> SizeHint {
        let hint = self.body.as_ref().map(Body::size_hint);
        hint.unwrap_or_else(|| SizeHint::with_exact(0))
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        let body = self.body.take().filter(|it| !it.is_end_stream());
        if let (Some(body), Some(back)) = (body, self.back.take()) {
            // Who does not wait for it has answered.
            let _answered = back.send(body);
        }
    }
}

/// The body of an answer, which does not end before the request was heard.
struct Held<F> {
    body: Body,
    drained: Option<Pin<Box<F>>>,
}

impl<F: Future<Output = ()>> hyper::body::Body for Held<F> {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let this = self.get_mut();
        if let Some(frame) = ready!(Pin::new(&mut this.body).poll_frame(cx)) {
            return Poll::Ready(Some(frame));
        }
        if let Some(drained) = &mut this.drained {
            ready!(drained.as_mut().poll(cx));
            this.drained = None;
        }
        Poll::Ready(None)
    }

    fn is_end_stream(&self) -> bool {
        self.drained.is_none() && self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

#[cfg(test)]
mod tests;
