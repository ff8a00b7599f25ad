//! A publisher that sends lines of JSON and reads lines of JSON, both on one HTTP/1.1 request.

use frontalis_access::Token;
use frontalis_proto::v1::{PublishMarkersRequest, PublishResponse};
use futures::StreamExt as _;
use http_body_util::StreamBody;
use hyper::{
    Request,
    body::{Bytes, Frame},
};
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;

use super::{Pieces, exchange, to_json, whole};
use crate::{HttpAnswer, TestServer};

/// The client's end of a publish stream.
pub struct LinePublisher {
    lines: Option<mpsc::Sender<String>>,
    answers: Pieces,
}

impl LinePublisher {
    /// Opens a stream with its first line.
    ///
    /// # Errors
    ///
    /// The answer, when it is another than 200.
    pub async fn open(server: &TestServer, id: &str, first: String) -> Result<Self, HttpAnswer> {
        Self::open_as(server, None, id, first).await
    }

    /// The same with a token.
    ///
    /// # Errors
    ///
    /// The answer, when it is another than 200.
    pub async fn open_as(
        server: &TestServer,
        token: Option<&Token>,
        id: &str,
        first: String,
    ) -> Result<Self, HttpAnswer> {
        let (lines, sent) = mpsc::channel(64);
        lines.send(first).await.unwrap();
        let frames = ReceiverStream::new(sent)
            .map(|line| Ok::<_, std::io::Error>(Frame::data(Bytes::from(line + "\n"))));
        let request = Request::post(format!("/api/v1/sessions/{id}/frames"))
            .header("content-type", "application/x-ndjson");
        let answer = exchange(server, token, request, StreamBody::new(frames)).await;
        if answer.status() != 200 {
            return Err(whole(answer).await);
        }
        assert_eq!(answer.headers()["content-type"], "application/x-ndjson");
        Ok(Self {
            lines: Some(lines),
            answers: Pieces::new(answer.into_body()),
        })
    }

    /// Sends a message as one line.
    pub async fn send(&mut self, message: &PublishMarkersRequest) {
        self.send_line(to_json(message)).await;
    }

    /// Sends any line.
    pub async fn send_line(&mut self, line: String) {
        let lines = self.lines.as_ref().expect("the request side is open");
        drop(lines.send(line).await);
    }

    /// Closes the request side.
    pub fn close(&mut self) {
        self.lines = None;
    }

    /// The next answer; `None` at the end.
    ///
    /// # Errors
    ///
    /// The problem of a stream that failed.
    pub async fn next(&mut self) -> Option<Result<PublishResponse, serde_json::Value>> {
        let line = self.answers.through(b"\n").await?;
        let value: serde_json::Value = serde_json::from_slice(&line).unwrap();
        Some(match value.get("error") {
            Some(problem) => Err(problem.clone()),
            None => Ok(serde_json::from_value(value).unwrap()),
        })
    }
}
