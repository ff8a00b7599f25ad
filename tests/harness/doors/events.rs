//! Server-sent events, as the standard of HTML reads them.

use frontalis_access::Token;
use frontalis_proto::v1::SubscribeResponse;
use http_body_util::Empty;
use hyper::{Request, body::Bytes};

use super::{Pieces, exchange, whole};
use crate::{HttpAnswer, TestServer};

/// One event.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Event {
    /// `message` when it has no name.
    pub name: String,
    /// Of this event; empty when it has none.
    pub id: String,
    /// Its data.
    pub data: String,
}

/// The client's end of an event stream.
pub struct EventStream {
    pieces: Pieces,
    /// What a browser would send as `Last-Event-ID`.
    pub last_event_id: String,
}

impl EventStream {
    /// Opens `path`; a client that comes back names the last event it has.
    ///
    /// # Errors
    ///
    /// The answer, when it is another than 200.
    pub async fn open(
        server: &TestServer,
        path: &str,
        last_event_id: &str,
    ) -> Result<Self, HttpAnswer> {
        Self::open_as(server, None, path, last_event_id).await
    }

    /// The same with a token.
    ///
    /// # Errors
    ///
    /// The answer, when it is another than 200.
    pub async fn open_as(
        server: &TestServer,
        token: Option<&Token>,
        path: &str,
        last_event_id: &str,
    ) -> Result<Self, HttpAnswer> {
        let mut request = Request::get(path).header("accept", "text/event-stream");
        if !last_event_id.is_empty() {
            request = request.header("last-event-id", last_event_id);
        }
        let answer = exchange(server, token, request, Empty::<Bytes>::new()).await;
        if answer.status() != 200 {
            return Err(whole(answer).await);
        }
        assert_eq!(answer.headers()["content-type"], "text/event-stream");
        assert_eq!(answer.headers()["cache-control"], "no-store");
        assert_eq!(answer.headers()["x-accel-buffering"], "no");
        Ok(Self {
            pieces: Pieces::new(answer.into_body()),
            last_event_id: last_event_id.to_owned(),
        })
    }

    /// The next event; `None` when the stream closed.
    pub async fn next(&mut self) -> Option<Event> {
        let text = String::from_utf8(self.pieces.through(b"\n\n").await?).unwrap();
        let mut event = Event {
            name: "message".to_owned(),
            ..Event::default()
        };
        for line in text.lines() {
            match line.split_once(": ") {
                Some(("event", name)) => name.clone_into(&mut event.name),
                Some(("id", id)) => id.clone_into(&mut event.id),
                Some(("data", data)) => data.clone_into(&mut event.data),
                Some(("retry", _)) | None => {}
                Some(other) => panic!("no field of an event: {other:?}"),
            }
        }
        if !event.id.is_empty() {
            self.last_event_id.clone_from(&event.id);
        }
        Some(event)
    }

    /// The next answer; `None` when the stream closed.
    ///
    /// # Errors
    ///
    /// The problem, when the event is one.
    pub async fn answer(&mut self) -> Option<Result<SubscribeResponse, serde_json::Value>> {
        let event = self.next().await?;
        Some(match event.name.as_str() {
            "message" => Ok(serde_json::from_str(&event.data).unwrap()),
            "problem" => Err(serde_json::from_str(&event.data).unwrap()),
            other => panic!("an event named {other}"),
        })
    }
}
