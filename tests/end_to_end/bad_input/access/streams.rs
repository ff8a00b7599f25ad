//! Streams that are open while their caller's token ends: gRPC both ways, WebSocket, server-sent events.

use std::time::Duration;

use frontalis_access::Token;
use frontalis_proto::v1::{
    Ingest, LengthUnit, PublishMarkersRequest, PublishResponse, PublishStart, SubscribeRequest,
    SubscribeResponse, capture_service_client::CaptureServiceClient,
    curve_service_client::CurveServiceClient,
};
use futures::{SinkExt as _, Stream, StreamExt as _, stream};
use harness::{Problem, TestServer, every_frame};
use http_body_util::{BodyExt as _, Empty};
use hyper::{Request, body::Bytes, client::conn::http1};
use hyper_util::rt::TokioIo;
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio_tungstenite::{
    WebSocketStream, client_async, tungstenite::client::IntoClientRequest as _,
};
use tonic::{Code, Status, Streaming};

/// No stream may outlive its caller for longer.
const PATIENCE: Duration = Duration::from_secs(60);

/// One open stream.
pub(super) enum Open {
    Publish(Streaming<PublishResponse>),
    Subscribe(Streaming<SubscribeResponse>),
    WebSocket(Box<WebSocketStream<TcpStream>>),
    Events(hyper::body::Incoming),
}

/// One message, and then nothing, for as long as the other side likes.
fn first_of<T: Send + 'static>(message: T) -> impl Stream<Item = T> + Send + 'static {
    stream::once(async { message }).chain(stream::pending())
}

impl Open {
    pub(super) async fn publish(
        server: &TestServer,
        token: &Token,
        session: &str,
    ) -> Result<Self, Status> {
        let start = PublishStart {
            session: session.to_owned(),
            publisher: "i4".to_owned(),
            unit: LengthUnit::Millimeter.into(),
            rate_hz: 60.0,
            ingest: Ingest::Live.into(),
            ..PublishStart::default()
        };
        let request = PublishMarkersRequest {
            start: Some(start),
            ..PublishMarkersRequest::default()
        };
        let mut client = CaptureServiceClient::new(server.channel_as(token).await);
        let answer = client.publish_markers(first_of(request)).await?;
        let mut answers = answer.into_inner();
        answers.message().await?;
        Ok(Self::Publish(answers))
    }

    pub(super) async fn subscribe(
        server: &TestServer,
        token: &Token,
        session: &str,
    ) -> Result<Self, Status> {
        let request = SubscribeRequest {
            start: Some(every_frame(session)),
            credits: 0,
        };
        let mut client = CurveServiceClient::new(server.channel_as(token).await);
        let mut answers = client.subscribe(first_of(request)).await?.into_inner();
        answers.message().await?;
        Ok(Self::Subscribe(answers))
    }

    async fn web_socket(server: &TestServer, token: &Token, session: &str) -> Self {
        let url = format!("ws://{}/api/v1/{session}/stream", server.address());
        let mut request = url.into_client_request().unwrap();
        let offered = format!(
            "frontalis.v1.subscribe+json, frontalis.bearer.{}",
            token.reveal()
        );
        let headers = request.headers_mut();
        headers.insert("sec-websocket-protocol", offered.parse().unwrap());
        let stream = TcpStream::connect(server.address()).await.unwrap();
        let (mut socket, _) = client_async(request, stream).await.unwrap();
        let start = json!({ "start": { "delivery": "DELIVERY_EVERY_FRAME" } });
        socket.send(start.to_string().into()).await.unwrap();
        socket.next().await.unwrap().unwrap();
        Self::WebSocket(Box::new(socket))
    }

    async fn events(server: &TestServer, token: &Token, session: &str) -> Self {
        let stream = TcpStream::connect(server.address()).await.unwrap();
        let (mut sender, connection) = http1::handshake(TokioIo::new(stream)).await.unwrap();
        tokio::spawn(async move { drop(connection.await) });
        let request = Request::builder()
            .uri(format!("/api/v1/{session}/events?delivery=every_frame"))
            .header("host", server.address().to_string())
            .header("authorization", format!("Bearer {}", token.reveal()))
            .body(Empty::<Bytes>::new())
            .unwrap();
        let answer = sender.send_request(request).await.unwrap();
        assert_eq!(answer.status(), 200);
        Self::Events(answer.into_body())
    }

    pub(super) async fn every_kind(
        server: &TestServer,
        publisher: &Token,
        renderer: &Token,
        session: &str,
    ) -> Vec<Self> {
        vec![
            Self::publish(server, publisher, session).await.unwrap(),
            Self::subscribe(server, renderer, session).await.unwrap(),
            Self::web_socket(server, renderer, session).await,
            Self::events(server, renderer, session).await,
        ]
    }

    /// Reads to the end: the kind of stream, the code and the reason.
    pub(super) async fn end(self) -> (&'static str, String, String) {
        let kind = match &self {
            Self::Publish(_) => "publish over gRPC",
            Self::Subscribe(_) => "subscription over gRPC",
            Self::WebSocket(_) => "WebSocket",
            Self::Events(_) => "server-sent events",
        };
        let ended = tokio::time::timeout(PATIENCE, self.last()).await;
        let (code, reason) = ended.unwrap_or_else(|_| panic!("{kind} goes on"));
        (kind, code, reason)
    }

    async fn last(self) -> (String, String) {
        match self {
            Self::Publish(answers) => grpc_end(answers).await,
            Self::Subscribe(answers) => grpc_end(answers).await,
            Self::WebSocket(mut socket) => loop {
                let text = socket.next().await.unwrap().unwrap().into_text().unwrap();
                let message: Value = serde_json::from_str(&text).unwrap();
                if let Some(problem) = message.get("error") {
                    return of_problem(problem);
                }
            },
            Self::Events(body) => {
                let whole = body.collect().await.unwrap().to_bytes();
                let text = String::from_utf8(whole.to_vec()).unwrap();
                let problem = text.split("event: problem").nth(1).unwrap();
                let data = problem.lines().find_map(|it| it.strip_prefix("data:"));
                of_problem(&serde_json::from_str(data.unwrap().trim()).unwrap())
            }
        }
    }
}

async fn grpc_end<T>(mut answers: Streaming<T>) -> (String, String) {
    loop {
        match answers.message().await {
            Ok(Some(_)) => {}
            Ok(None) => return ("OK".to_owned(), String::new()),
            Err(status) => {
                let code = match status.code() {
                    Code::Unauthenticated => "UNAUTHENTICATED".to_owned(),
                    code => format!("{code:?}"),
                };
                return (code, Problem::of(&status).reason);
            }
        }
    }
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
