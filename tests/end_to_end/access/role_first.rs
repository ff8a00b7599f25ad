//! The role comes before the content: whoever may not publish hears that, whatever was sent, and nothing of what is wrong
//! with it.

use base64::{Engine as _, engine::general_purpose::STANDARD};
use frontalis_access::{Role, Token};
use frontalis_proto::v1::{LengthUnit, PublishMarkersRequest, PublishStart};
use futures::{SinkExt as _, StreamExt as _};
use harness::{RawConnection, TestServer, assert_refused, encoded, framed, http_send, prefixed};
use hyper::Method;
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio_tungstenite::{
    client_async,
    tungstenite::{self, Message, client::IntoClientRequest as _},
};
use tonic::{Code, Status};

use super::guarded;

const PUBLISH: &str = "/frontalis.v1.CaptureService/PublishMarkers";
const FRAMES: &str = "/api/v1/sessions/s/frames";
const LINES: (&str, &str) = ("content-type", "application/x-ndjson");

/// What nobody who may publish gets through with: empty, no JSON, no start, a start with everything wrong.
fn contents() -> Vec<String> {
    let long = format!("{{\"start\":{}", " ".repeat(2 << 20));
    let wrong = json!({ "start": { "publisher": "", "unit": 77, "rateHz": -1, "secret": 1 } });
    let image = json!({ "start": { "publisher": "a", "image": {} } });
    let mut contents = vec!["{".to_owned(), "[]".to_owned(), long];
    contents.extend([json!({}), json!({ "frames": [] }), wrong, image].map(|it| it.to_string()));
    contents
}

fn bearer(token: &Token) -> String {
    format!("Bearer {}", token.reveal())
}

#[track_caller]
fn assert_role(problem: &Value, role: Role) {
    assert_eq!(problem["type"], "urn:frontalis:problem:ROLE", "{problem}");
    assert_eq!(problem["status"], 403, "{problem}");
    assert_eq!(problem["role"], role.name(), "{problem}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn whoever_may_not_publish_hears_that_first_through_every_door() {
    let roles = [Role::Operator, Role::Renderer, Role::Viewer];
    let (server, tokens) = guarded(roles.map(|it| (it, "*"))).await;
    for (role, token) in roles.into_iter().zip(&tokens) {
        for content in contents() {
            assert_role(&lines(&server, token, &[LINES], &content).await, role);
            assert_role(&socket(&server, token, Message::text(content)).await, role);
        }
        assert_role(&lines(&server, token, &[LINES], "").await, role);
        let other = ("content-type", "text/plain");
        let encoded_as = ("content-encoding", "gzip");
        for headers in [&[other][..], &[LINES, encoded_as], &[]] {
            assert_role(&lines(&server, token, headers, "{}").await, role);
        }
        for answer in grpc(&server, token).await {
            assert_refused(&answer, Code::PermissionDenied, "ROLE");
        }
        for (method, path) in [
            (Method::POST, "/api/v1/sessions"),
            (Method::PATCH, "/api/v1/sessions/s"),
            (Method::POST, "/api/v1/sessions/s/end"),
        ] {
            let authorization = bearer(token);
            let headers = [("authorization", authorization.as_str())];
            let answer = http_send(&server, &method, path, &headers, b"{").await;
            if role == Role::Operator {
                assert_eq!(answer.status, 415, "{}", answer.text());
            } else {
                assert_role(&answer.json(), role);
            }
        }
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_operator_who_takes_over_hears_what_is_wrong_with_the_rest() {
    let (server, [operator]) = guarded([(Role::Operator, "*")]).await;
    let start =
        json!({ "takeover": true, "publisher": "a", "unit": "LENGTH_UNIT_METER", "rateHz": -1 });
    let start = json!({ "start": start }).to_string();
    let problem = lines(&server, &operator, &[LINES], &start).await;
    assert_eq!(problem["type"], "urn:frontalis:problem:RATE", "{problem}");
    assert_eq!(
        (&problem["field"], &problem["line"]),
        (&json!("start.rateHz"), &json!(1))
    );
    let problem = socket(&server, &operator, Message::text(start)).await;
    assert_eq!(problem["type"], "urn:frontalis:problem:RATE", "{problem}");
    server.stop().await;
}

/// The problem of a body of lines.
async fn lines(server: &TestServer, token: &Token, headers: &[(&str, &str)], body: &str) -> Value {
    let authorization = bearer(token);
    let mut headers = headers.to_vec();
    headers.push(("authorization", &authorization));
    let answer = http_send(server, &Method::POST, FRAMES, &headers, body.as_bytes()).await;
    assert_eq!(
        answer.content_type,
        "application/problem+json",
        "{}",
        answer.text()
    );
    answer.json()
}

/// The problem of a WebSocket that publishes: of its handshake, or after one message.
async fn socket(server: &TestServer, token: &Token, first: Message) -> Value {
    let url = format!("ws://{}/api/v1/sessions/s/stream", server.address());
    let mut request = url.into_client_request().unwrap();
    let headers = request.headers_mut();
    let subprotocol = "frontalis.v1.publish+json".parse().unwrap();
    headers.insert("sec-websocket-protocol", subprotocol);
    headers.insert("authorization", bearer(token).parse().unwrap());
    let stream = TcpStream::connect(server.address()).await.unwrap();
    let mut socket = match client_async(request, stream).await {
        Ok((socket, _)) => socket,
        Err(tungstenite::Error::Http(answer)) => {
            return serde_json::from_slice(answer.body().as_ref().unwrap()).unwrap();
        }
        Err(error) => panic!("{error}"),
    };
    // The server may refuse a long message before all of it is out.
    drop(socket.send(first).await);
    let text = socket.next().await.unwrap().unwrap().into_text().unwrap();
    let mut last: Value = serde_json::from_str(&text).unwrap();
    last["error"].take()
}

/// What bytes of every kind are answered with, over gRPC and both forms of gRPC-web.
async fn grpc(server: &TestServer, token: &Token) -> Vec<Status> {
    let wrong = PublishMarkersRequest {
        start: Some(PublishStart {
            unit: LengthUnit::Unspecified.into(),
            rate_hz: f64::NAN,
            ..PublishStart::default()
        }),
        ..PublishMarkersRequest::default()
    };
    let contents = [
        Vec::new(),
        framed(b""),
        framed(&[0xff; 11]),
        encoded(&wrong),
        prefixed(0, u32::MAX, b""),
        prefixed(1, 2, b"\x0a\x00"),
        framed(&[0x12, 0].repeat(5_000)),
    ];
    let mut connection = RawConnection::open(server).await;
    let mut answers = Vec::new();
    for content in contents {
        let text = STANDARD.encode(&content).into_bytes();
        for (kind, bytes) in [
            ("application/grpc", &content),
            ("application/grpc-web+proto", &content),
            ("application/grpc-web-text", &text),
        ] {
            let headers = [
                ("content-type", kind),
                ("accept", "application/grpc-web+proto"),
                ("authorization", &bearer(token)),
            ];
            let mut call = connection.call(PUBLISH, &headers).await;
            call.send(bytes).await;
            call.finish();
            answers.push(call.answer().await.status());
        }
    }
    answers
}
