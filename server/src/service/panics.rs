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

#[cfg(test)]
mod tests {
    use axum::{Router, extract::Request, middleware::map_response_with_state, routing::post};
    use futures::StreamExt as _;
    use http_body_util::{BodyExt as _, StreamBody};
    use hyper_util::rt::{TokioExecutor, TokioIo};
    use tower::ServiceExt as _;

    use super::*;
    use crate::service::grpc::status::reason_of;

    /// Two frames, then a panic, or none.
    fn frames(panics: bool) -> Body {
        let frames = futures::stream::iter(0..4).map(move |n| {
            assert!(n < 2 || !panics, "a mistake that the test makes");
            Ok::<_, axum::Error>(Frame::data(Bytes::from_static(b"x")))
        });
        // Others of the connection have their turn between two frames.
        let paced = frames.then(async |it| {
            tokio::task::yield_now().await;
            it
        });
        Body::new(StreamBody::new(Box::pin(paced)))
    }

    fn router(metrics: &Metrics) -> Router {
        let grpc = Router::new()
            .route("/grpc", post(async || frames(true)))
            .route("/well", post(async || frames(false)))
            .layer(map_response_with_state(metrics.clone(), guard_grpc));
        let http = Router::new()
            .route("/http", post(async || frames(true)))
            .layer(map_response_with_state(metrics.clone(), guard_http));
        grpc.merge(http)
    }

    #[tokio::test]
    async fn a_panic_of_one_stream_leaves_its_siblings_on_the_connection_alone() {
        let metrics = Metrics::new("test");
        let (client, server) = tokio::io::duplex(64 * 1024);
        let service = hyper_util::service::TowerToHyperService::new(router(&metrics));
        let serving = hyper::server::conn::http2::Builder::new(TokioExecutor::new())
            .serve_connection(TokioIo::new(server), service);
        let serving = tokio::spawn(serving);
        let (sender, connection) =
            hyper::client::conn::http2::handshake(TokioExecutor::new(), TokioIo::new(client))
                .await
                .unwrap();
        let driving = tokio::spawn(connection);
        let call = async |path: &str| {
            let request = Request::post(format!("http://test{path}"));
            let request = request.body(Body::empty()).unwrap();
            let answer = sender.clone().send_request(request).await.unwrap();
            answer.into_body().collect().await
        };
        let (grpc, http, well) = tokio::join!(call("/grpc"), call("/http"), call("/well"));
        let grpc = grpc.unwrap();
        let status = Status::from_header_map(grpc.trailers().unwrap()).unwrap();
        assert_eq!(status.code(), Code::Internal);
        assert_eq!(reason_of(&status).as_deref(), Some("PANIC"));
        assert_eq!(status.message(), DETAIL);
        assert_eq!(grpc.to_bytes().len(), 2);
        assert!(http.is_err(), "half an answer looks complete");
        assert_eq!(well.unwrap().to_bytes().len(), 4);
        assert_eq!(call("/well").await.unwrap().to_bytes().len(), 4);
        assert_eq!(metrics.panics(), 2);
        drop(sender);
        driving.await.unwrap().unwrap();
        serving.await.unwrap().unwrap();
    }

    #[tokio::test]
    async fn a_stream_that_panicked_is_at_its_end() {
        let metrics = Metrics::new("test");
        let request = Request::post("/grpc").body(Body::empty()).unwrap();
        let mut body = router(&metrics).oneshot(request).await.unwrap().into_body();
        let mut n_frames = 0;
        while let Some(frame) = body.frame().await {
            frame.unwrap();
            n_frames += 1;
        }
        assert_eq!(n_frames, 3);
        assert!(body.is_end_stream());
    }
}
