//! Streams that are open while their caller's token ends: both ways through every door that streams.

use std::time::Duration;

use frontalis_access::Token;
use frontalis_proto::v1::{
    Ingest, LengthUnit, PublishMarkersRequest, PublishResponse, PublishStart, SubscribeRequest,
    SubscribeResponse, capture_service_client::CaptureServiceClient,
    curve_service_client::CurveServiceClient,
};
use futures::{Stream, StreamExt as _, stream};
use harness::{
    Closed, EventStream, GrpcWeb, LinePublisher, Problem, TestServer, WebSocket, every_frame,
};
use http::{HeaderMap, HeaderName};
use serde_json::Value;
use tonic::{Code, Status, Streaming};

use super::super::SUBJECT;

/// No stream may outlive its caller for longer.
const PATIENCE: Duration = Duration::from_mins(1);

/// One open stream, of which the first answer was heard.
pub(super) struct Open {
    what: &'static str,
    stream: Kind,
}

enum Kind {
    Publish(Streaming<PublishResponse>),
    Subscribe(Streaming<SubscribeResponse>),
    GrpcWeb(GrpcWeb),
    Lines(LinePublisher),
    SocketPublish(WebSocket),
    SocketSubscribe(WebSocket),
    Events(EventStream),
}

/// What a WebSocket is called here, and its subprotocol.
type Form = (&'static str, &'static str);

const PUBLISH_JSON: Form = (
    "publish over a WebSocket, JSON",
    "frontalis.v1.publish+json",
);
const PUBLISH_PROTOBUF: Form = (
    "publish over a WebSocket, protobuf",
    "frontalis.v1.publish+proto",
);
const SUBSCRIBE_JSON: Form = (
    "subscription over a WebSocket, JSON",
    "frontalis.v1.subscribe+json",
);
const SUBSCRIBE_PROTOBUF: Form = (
    "subscription over a WebSocket, protobuf",
    "frontalis.v1.subscribe+proto",
);

/// One message, and then nothing, for as long as the other side likes.
fn first_of<T: Send + 'static>(message: T) -> impl Stream<Item = T> + Send + 'static {
    stream::once(async { message }).chain(stream::pending())
}

fn publish_start(session: &str) -> PublishMarkersRequest {
    let start = PublishStart {
        session: session.to_owned(),
        publisher: "i4".to_owned(),
        unit: LengthUnit::Millimeter.into(),
        rate_hz: 60.0,
        ingest: Ingest::Live.into(),
        ..PublishStart::default()
    };
    PublishMarkersRequest {
        start: Some(start),
        ..PublishMarkersRequest::default()
    }
}

fn subscribe_start(session: &str) -> SubscribeRequest {
    SubscribeRequest {
        start: Some(every_frame(session)),
        credits: 0,
    }
}

fn id(session: &str) -> &str {
    session.trim_start_matches("sessions/")
}

impl Open {
    pub(super) async fn publish(
        server: &TestServer,
        token: &Token,
        session: &str,
    ) -> Result<Self, Status> {
        let mut client = CaptureServiceClient::new(server.channel_as(token).await);
        let requests = first_of(publish_start(session));
        let mut answers = client.publish_markers(requests).await?.into_inner();
        answers.message().await?;
        Ok(Self {
            what: "publish over gRPC",
            stream: Kind::Publish(answers),
        })
    }

    pub(super) async fn subscribe(
        server: &TestServer,
        token: &Token,
        session: &str,
    ) -> Result<Self, Status> {
        let mut client = CurveServiceClient::new(server.channel_as(token).await);
        let requests = first_of(subscribe_start(session));
        let mut answers = client.subscribe(requests).await?.into_inner();
        answers.message().await?;
        Ok(Self {
            what: "subscription over gRPC",
            stream: Kind::Subscribe(answers),
        })
    }

    async fn grpc_web(server: &TestServer, token: &Token, session: &str) -> Self {
        let start = every_frame(session);
        let mut follow = GrpcWeb::follow_as(server, Some(token), &start).await;
        follow.next().await.unwrap();
        Self {
            what: "subscription over gRPC-web",
            stream: Kind::GrpcWeb(follow),
        }
    }

    async fn lines(server: &TestServer, token: &Token, session: &str) -> Self {
        let first = serde_json::to_string(&publish_start(session)).unwrap();
        let opened = LinePublisher::open_as(server, Some(token), id(session), first).await;
        let mut lines = opened.unwrap();
        lines.next().await.unwrap().unwrap();
        Self {
            what: "publish over NDJSON",
            stream: Kind::Lines(lines),
        }
    }

    async fn socket_publish(
        server: &TestServer,
        token: &Token,
        session: &str,
        (what, subprotocol): Form,
    ) -> Self {
        let opened = WebSocket::open_as(server, Some(token), id(session), subprotocol).await;
        let mut socket = opened.unwrap();
        socket.send(&publish_start(session)).await;
        socket.next::<PublishResponse>().await.unwrap();
        Self {
            what,
            stream: Kind::SocketPublish(socket),
        }
    }

    async fn socket_subscribe(
        server: &TestServer,
        token: &Token,
        session: &str,
        (what, subprotocol): Form,
    ) -> Self {
        let opened = WebSocket::open_as(server, Some(token), id(session), subprotocol).await;
        let mut socket = opened.unwrap();
        socket.send(&subscribe_start(session)).await;
        socket.next::<SubscribeResponse>().await.unwrap();
        Self {
            what,
            stream: Kind::SocketSubscribe(socket),
        }
    }

    async fn events(server: &TestServer, token: &Token, session: &str) -> Self {
        let path = format!("/api/v1/{session}/events?delivery=every_frame");
        let opened = EventStream::open_as(server, Some(token), &path, "").await;
        let mut events = opened.unwrap_or_else(|answer| panic!("{answer:?}"));
        events.answer().await.unwrap().unwrap();
        Self {
            what: "server-sent events",
            stream: Kind::Events(events),
        }
    }

    /// Each publisher has a session of its own; all subscribers follow the subject.
    pub(super) async fn every_kind(
        server: &TestServer,
        publisher: &Token,
        renderer: &Token,
    ) -> Vec<Self> {
        let sessions = ["i4-grpc", "i4-lines", "i4-json", "i4-protobuf"];
        for id in sessions {
            server.create_session(id, "actors/reference").await.unwrap();
        }
        let [grpc, lines, json, protobuf] = sessions.map(|id| format!("sessions/{id}"));
        vec![
            Self::publish(server, publisher, &grpc).await.unwrap(),
            Self::lines(server, publisher, &lines).await,
            Self::socket_publish(server, publisher, &json, PUBLISH_JSON).await,
            Self::socket_publish(server, publisher, &protobuf, PUBLISH_PROTOBUF).await,
            Self::subscribe(server, renderer, SUBJECT).await.unwrap(),
            Self::grpc_web(server, renderer, SUBJECT).await,
            Self::socket_subscribe(server, renderer, SUBJECT, SUBSCRIBE_JSON).await,
            Self::socket_subscribe(server, renderer, SUBJECT, SUBSCRIBE_PROTOBUF).await,
            Self::events(server, renderer, SUBJECT).await,
        ]
    }

    /// Reads to the end: the kind of stream, the code and the reason.
    pub(super) async fn end(self) -> (&'static str, String, String) {
        let what = self.what;
        let ended = tokio::time::timeout(PATIENCE, self.stream.last()).await;
        let (code, reason) = ended.unwrap_or_else(|_| panic!("{what} goes on"));
        (what, code, reason)
    }
}

impl Kind {
    async fn last(self) -> (String, String) {
        match self {
            Self::Publish(answers) => grpc_end(answers).await,
            Self::Subscribe(answers) => grpc_end(answers).await,
            Self::GrpcWeb(mut follow) => {
                while follow.next().await.is_some() {}
                of_trailers(&follow.trailers)
            }
            Self::Lines(mut lines) => loop {
                if let Err(problem) = lines.next().await.unwrap() {
                    return of_problem(&problem);
                }
            },
            Self::SocketPublish(mut socket) => loop {
                if let Err(closed) = socket.next::<PublishResponse>().await {
                    return of_closed(&closed);
                }
            },
            Self::SocketSubscribe(mut socket) => loop {
                if let Err(closed) = socket.next::<SubscribeResponse>().await {
                    return of_closed(&closed);
                }
            },
            Self::Events(mut events) => loop {
                if let Err(problem) = events.answer().await.unwrap() {
                    return of_problem(&problem);
                }
            },
        }
    }
}

async fn grpc_end<T>(mut answers: Streaming<T>) -> (String, String) {
    loop {
        match answers.message().await {
            Ok(Some(_)) => {}
            Ok(None) => return ("OK".to_owned(), String::new()),
            Err(status) => return of_status(&status),
        }
    }
}

fn of_status(status: &Status) -> (String, String) {
    let code = match status.code() {
        Code::Unauthenticated => "UNAUTHENTICATED".to_owned(),
        code => format!("{code:?}"),
    };
    (code, Problem::of(status).reason)
}

fn of_trailers(trailers: &str) -> (String, String) {
    let mut headers = HeaderMap::new();
    for line in trailers.lines() {
        let (name, value) = line.split_once(':').unwrap();
        let name: HeaderName = name.parse().unwrap();
        headers.insert(name, value.parse().unwrap());
    }
    of_status(&Status::from_header_map(&headers).unwrap())
}

/// The last text is the problem, and the close frame says the same.
fn of_closed(closed: &Closed) -> (String, String) {
    let (code, reason) = of_problem(closed.problem.as_ref().unwrap());
    assert_eq!((closed.code, &closed.reason), (1008, &reason));
    (code, reason)
}

fn of_problem(problem: &Value) -> (String, String) {
    let code = match problem["status"].as_u64() {
        Some(401) => "UNAUTHENTICATED".to_owned(),
        status => format!("{status:?}"),
    };
    let reason = problem["type"].as_str().unwrap_or_default();
    let reason = reason.trim_start_matches("urn:frontalis:problem:");
    (code, reason.to_owned())
}
