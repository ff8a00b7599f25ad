//! The deadline that a client gives its call, `grpc-timeout` (BAD_INPUT E11).
//!
//! A call is cut when its time is over, answered or not: what it held is free, and the client is told why. A header that
//! cannot be read is ignored, as gRPC says.

use std::{
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use axum::{body::Body, extract::Request, middleware::Next, response::Response};
use bytes::Bytes;
use http::HeaderMap;
use hyper::body::{Body as _, Frame};
use tokio::time::{Instant, Sleep, sleep_until, timeout_at};
use tonic::{Code, Status};

use super::grpc::status::refuse;

/// The header.
const TIMEOUT: &str = "grpc-timeout";

/// Longest deadline; a longer one is this one.
pub const LONGEST_DEADLINE: Duration = Duration::from_hours(720);

/// A shorter deadline is over before the call was read.
const SHORTEST_DEADLINE: Duration = Duration::from_millis(1);

/// Most digits that the specification allows.
const MAX_DIGITS: usize = 8;

/// Cuts a call whose client said how long it may take.
pub async fn enforce(request: Request, next: Next) -> Response {
    let Some(timeout) = timeout(request.headers()) else {
        return next.run(request).await;
    };
    if timeout < SHORTEST_DEADLINE {
        return exceeded().into_http();
    }
    let end = Instant::now() + timeout;
    match timeout_at(end, next.run(request)).await {
        Ok(answer) if answer.body().is_end_stream() => answer,
        Ok(answer) => answer.map(|body| Body::new(Until::new(body, end))),
        Err(_elapsed) => exceeded().into_http(),
    }
}

fn exceeded() -> Status {
    let message = "the deadline of the call is over";
    refuse(Code::DeadlineExceeded, "DEADLINE", message)
}

/// The deadline in the headers, when there is one that can be read.
fn timeout(headers: &HeaderMap) -> Option<Duration> {
    let text = headers.get(TIMEOUT)?.to_str().ok()?;
    let (digits, unit) = text.split_at_checked(text.len().checked_sub(1)?)?;
    let is_number =
        (1..=MAX_DIGITS).contains(&digits.len()) && digits.bytes().all(|it| it.is_ascii_digit());
    let count: u64 = is_number.then(|| digits.parse().ok())??;
    let timeout = match unit {
        "H" => Duration::from_secs(count * 3_600),
        "M" => Duration::from_secs(count * 60),
        "S" => Duration::from_secs(count),
        "m" => Duration::from_millis(count),
        "u" => Duration::from_micros(count),
        "n" => Duration::from_nanos(count),
        _ => return None,
    };
    Some(timeout.min(LONGEST_DEADLINE))
}

/// An answer that ends with a status when its time is over.
struct Until {
    /// None: over.
    body: Option<Body>,
    end: Pin<Box<Sleep>>,
}

impl Until {
    fn new(body: Body, end: Instant) -> Self {
        Self {
            body: Some(body),
            end: Box::pin(sleep_until(end)),
        }
    }
}

impl hyper::body::Body for Until {
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
        if this.end.as_mut().poll(cx).is_ready() {
            this.body = None;
            let mut trailers = HeaderMap::new();
            let written = exceeded().add_header(&mut trailers);
            return Poll::Ready(written.is_ok().then(|| Ok(Frame::trailers(trailers))));
        }
        Pin::new(body).poll_frame(cx)
    }

    fn is_end_stream(&self) -> bool {
        self.body.as_ref().is_none_or(Body::is_end_stream)
    }
}

#[cfg(test)]
mod tests {
    use axum::{Router, middleware, routing::post};
    use http_body_util::{BodyExt as _, StreamBody};
    use tower::ServiceExt as _;

    use super::*;
    use crate::service::grpc::status::reason_of;

    fn read(text: &str) -> Option<Duration> {
        let mut headers = HeaderMap::new();
        headers.insert(TIMEOUT, text.parse().unwrap());
        timeout(&headers)
    }

    #[test]
    fn a_timeout_is_read_as_the_specification_says() {
        assert_eq!(read("1n"), Some(Duration::from_nanos(1)));
        assert_eq!(read("20u"), Some(Duration::from_micros(20)));
        assert_eq!(read("300m"), Some(Duration::from_millis(300)));
        assert_eq!(read("4S"), Some(Duration::from_secs(4)));
        assert_eq!(read("5M"), Some(Duration::from_mins(5)));
        assert_eq!(read("6H"), Some(Duration::from_hours(6)));
        assert_eq!(read("99999999H"), Some(LONGEST_DEADLINE));
    }

    #[test]
    fn what_cannot_be_read_is_ignored() {
        for text in [
            "",
            "S",
            "1",
            "-1S",
            "+1S",
            "1.5S",
            "1s",
            "1 S",
            "123456789S",
            "1SS",
            "0x1S",
            "1\u{b5}",
        ] {
            let mut headers = HeaderMap::new();
            let value = http::HeaderValue::from_bytes(text.as_bytes()).unwrap();
            headers.insert(TIMEOUT, value);
            assert_eq!(timeout(&headers), None, "{text:?}");
        }
    }

    /// A call that answers after a second, then streams for ever.
    fn endless() -> Router {
        let answer = async || {
            tokio::time::sleep(Duration::from_secs(1)).await;
            let beat = async |()| {
                tokio::time::sleep(Duration::from_secs(1)).await;
                Some((
                    Ok::<_, axum::Error>(Frame::data(Bytes::from_static(b"x"))),
                    (),
                ))
            };
            Body::new(StreamBody::new(futures::stream::unfold((), beat)))
        };
        Router::new()
            .route("/", post(answer))
            .layer(middleware::from_fn(enforce))
    }

    async fn call(timeout: &str) -> Response {
        let request = Request::post("/").header(TIMEOUT, timeout);
        endless()
            .oneshot(request.body(Body::empty()).unwrap())
            .await
            .unwrap()
    }

    fn assert_exceeded(headers: &HeaderMap) {
        let status = Status::from_header_map(headers).unwrap();
        assert_eq!(status.code(), Code::DeadlineExceeded);
        assert_eq!(reason_of(&status).as_deref(), Some("DEADLINE"));
    }

    #[tokio::test(start_paused = true)]
    async fn a_call_that_is_not_answered_in_time_is_refused() {
        assert_exceeded(call("1n").await.headers());
        assert_exceeded(call("500m").await.headers());
    }

    #[tokio::test(start_paused = true)]
    async fn a_stream_that_is_cut_says_so_in_its_trailers() {
        let began = Instant::now();
        let collected = call("3500m").await.into_body().collect().await.unwrap();
        assert_eq!(began.elapsed(), Duration::from_millis(3_500));
        assert_exceeded(collected.trailers().unwrap());
        assert_eq!(collected.to_bytes().len(), 2);
    }
}
