//! Messages of a request as they come in: each within its size, whole within its time, and never compressed.
//!
//! The codec reserves what a message's prefix declares, before a byte of it is there. So a message is handed on when all
//! of it has come; until then what came is held in small pieces (BAD_INPUT E1, E2, E5, E9, F5; CONTRACTS O-11).

mod begun;

use std::{
    collections::VecDeque,
    error::Error as _,
    pin::Pin,
    task::{Context, Poll, ready},
    time::Duration,
};

use axum::{
    body::Body,
    extract::{Request, State},
    middleware::Next,
    response::Response,
};
use bytes::Bytes;
use http::{HeaderMap, HeaderValue};
use hyper::body::Frame;
use tokio::time::{Sleep, sleep};
use tonic::{Code, Status};

use super::status::{Refusal, refuse};
use begun::{Begun, whole_messages};

/// Names the encoding of a request's messages.
const ENCODING: &str = "grpc-encoding";
/// Names the encodings that an answer is allowed, or a request was.
const ACCEPT_ENCODING: &str = "grpc-accept-encoding";
/// The encoding of messages as they are.
const IDENTITY: &str = "identity";

/// What holds for the messages of each service.
#[derive(Clone, Debug)]
pub struct MessageRules {
    /// A message must be whole so long after the server began to wait for the rest of it.
    pub deadline: Duration,
    /// Services by the start of their path, and the largest message of each, bytes.
    pub sizes: Vec<(&'static str, usize)>,
    /// Largest message of every other service, bytes.
    pub other_bytes: usize,
}

impl MessageRules {
    fn limit_bytes(&self, path: &str) -> usize {
        let named = self.sizes.iter().find(|(it, _)| path.starts_with(it));
        named.map_or(self.other_bytes, |(_, limit_bytes)| *limit_bytes)
    }
}

/// Lets whole messages pass to the services.
pub async fn whole(State(rules): State<MessageRules>, request: Request, next: Next) -> Response {
    if is_compressed(request.headers()) {
        let mut refused = compressed().into_http();
        let identity = HeaderValue::from_static(IDENTITY);
        refused.headers_mut().insert(ACCEPT_ENCODING, identity);
        return refused;
    }
    let limit_bytes = rules.limit_bytes(request.uri().path());
    let whole = |body| Body::new(WholeMessages::new(body, limit_bytes, rules.deadline));
    next.run(request.map(whole)).await
}

fn is_compressed(headers: &HeaderMap) -> bool {
    headers.get(ENCODING).is_some_and(|it| it != IDENTITY)
}

fn compressed() -> Status {
    let message = "compressed messages are not taken";
    refuse(Code::Unimplemented, "COMPRESSION", message)
}

fn too_large(found_bytes: usize, limit_bytes: usize) -> Status {
    let message = format!("the message has {found_bytes} bytes, at most {limit_bytes} are taken");
    Refusal::new(Code::OutOfRange, "MESSAGE_SIZE", message)
        .with("limit", &"message_bytes")
        .with("value", &limit_bytes)
        .into_status()
}

fn too_slow(deadline: Duration) -> Status {
    let message = format!(
        "a message was begun and not complete within {} s",
        deadline.as_secs()
    );
    refuse(Code::DeadlineExceeded, "MESSAGE_DEADLINE", message)
}

/// Whether a body ends because it is no text of gRPC-web: its layer decodes the text before messages are looked at.
fn is_no_text(error: &axum::Error) -> bool {
    let status = error.source().and_then(|it| it.downcast_ref::<Status>());
    status.is_some_and(|it| it.message().starts_with("tonic-web: "))
}

fn no_text() -> Status {
    let message = "the text form of gRPC-web is base64, padded at the end and nowhere else";
    refuse(Code::InvalidArgument, "BASE64", message)
}

/// A request's body of which only whole messages come out.
struct WholeMessages {
    body: Body,
    limit_bytes: usize,
    deadline: Duration,
    /// Whole messages, in pieces.
    whole: VecDeque<Bytes>,
    /// The message of which not everything came.
    begun: Begun,
    /// Runs while somebody waits for the rest of a message. A server that is slow to ask costs the client nothing.
    waiting: Option<Pin<Box<Sleep>>>,
    end: Option<End>,
}

/// What follows the last message.
enum End {
    Trailers(HeaderMap),
    Refused(Status),
    Nothing,
}

impl WholeMessages {
    fn new(body: Body, limit_bytes: usize, deadline: Duration) -> Self {
        Self {
            body,
            limit_bytes,
            deadline,
            whole: VecDeque::new(),
            begun: Begun::default(),
            waiting: None,
            end: None,
        }
    }

    /// Takes bytes in; messages that they complete are whole.
    fn take(&mut self, mut bytes: Bytes) -> Result<(), Status> {
        while !bytes.is_empty() {
            if self.begun.is_empty() {
                let n_bytes = whole_messages(&bytes, self.limit_bytes)?;
                if n_bytes > 0 {
                    self.whole.push_back(bytes.split_to(n_bytes));
                    continue;
                }
            }
            self.begun.take(&mut bytes, self.limit_bytes)?;
            if self.begun.is_whole() {
                self.whole.extend(std::mem::take(&mut self.begun).pieces());
            }
        }
        Ok(())
    }

    fn finish(&mut self, end: End) {
        self.end = Some(if self.begun.is_empty() {
            end
        } else {
            let message = "the stream ended within a message";
            End::Refused(refuse(Code::InvalidArgument, "MESSAGE_CUT", message))
        });
    }

    fn refuse(&mut self, refused: Status) {
        self.begun = Begun::default();
        self.end = Some(End::Refused(refused));
    }

    /// Waits for more of the body; ready when something changed.
    fn poll_body(&mut self, cx: &mut Context<'_>) -> Poll<Result<(), axum::Error>> {
        let polled = hyper::body::Body::poll_frame(Pin::new(&mut self.body), cx);
        let Poll::Ready(frame) = polled else {
            return self.poll_deadline(cx).map(Ok);
        };
        let frame = match frame.transpose() {
            Err(error) if is_no_text(&error) => {
                self.refuse(no_text());
                return Poll::Ready(Ok(()));
            }
            frame => frame?,
        };
        match frame.map(Frame::into_data) {
            Some(Ok(bytes)) => {
                if let Err(refused) = self.take(bytes) {
                    self.refuse(refused);
                }
            }
            Some(Err(trailers)) => {
                let trailers = trailers.into_trailers().unwrap_or_default();
                self.finish(End::Trailers(trailers));
            }
            None => self.finish(End::Nothing),
        }
        Poll::Ready(Ok(()))
    }

    fn poll_deadline(&mut self, cx: &mut Context<'_>) -> Poll<()> {
        if self.begun.is_empty() {
            return Poll::Pending;
        }
        let deadline = self.deadline;
        let waiting = self
            .waiting
            .get_or_insert_with(|| Box::pin(sleep(deadline)));
        ready!(waiting.as_mut().poll(cx));
        self.refuse(too_slow(deadline));
        Poll::Ready(())
    }
}

impl hyper::body::Body for WholeMessages {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let this = self.get_mut();
        loop {
            if let Some(bytes) = this.whole.pop_front() {
                this.waiting = None;
                return Poll::Ready(Some(Ok(Frame::data(bytes))));
            }
            if let Some(end) = &mut this.end {
                return Poll::Ready(match std::mem::replace(end, End::Nothing) {
                    End::Trailers(trailers) => Some(Ok(Frame::trailers(trailers))),
                    End::Refused(status) => Some(Err(axum::Error::new(status))),
                    End::Nothing => None,
                });
            }
            if let Err(error) = ready!(this.poll_body(cx)) {
                return Poll::Ready(Some(Err(error)));
            }
        }
    }
}

#[cfg(test)]
mod tests;
