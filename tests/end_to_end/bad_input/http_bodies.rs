//! Rows D11, D12, E1, E9, E10 and F5 where bodies come over plain HTTP.

use std::{net::SocketAddr, time::Duration};

use frontalis_proto::v1::PublishMarkersRequest;
use futures::future::join_all;
use harness::{http_send, toy_files, zip};
use hyper::{Method, StatusCode};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    time::{interval, timeout},
};

use super::{beside_a_control_session, connections::PATIENCE};

const JSON: (&str, &str) = ("content-type", "application/json");
const LINES: (&str, &str) = ("content-type", "application/x-ndjson");
const SESSIONS: &str = "/api/v1/sessions";
const SUBJECT: &str = "/api/v1/sessions/subject";
const FRAMES: &str = "/api/v1/sessions/subject/frames";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d11_a_compressed_upload_is_not_inflated() {
    beside_a_control_session("D11", async |stage| {
        let package = zip(&toy_files());
        let gzip = [&[0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3][..], &package].concat();
        let zstd = [&[0x28, 0xb5, 0x2f, 0xfd][..], &package].concat();
        for (what, content) in [("gzip", &gzip), ("zstd", &zstd)] {
            let refused = stage.server.import("bomb", content).await.unwrap_err();
            harness::assert_refused(&refused, tonic::Code::Unimplemented, "COMPRESSION");
            let plain = [("content-type", "application/octet-stream")];
            let path = "/api/v1/actors/bomb";
            let answer = http_send(&stage.server, &Method::PUT, path, &plain, content).await;
            assert_problem(&answer, StatusCode::NOT_IMPLEMENTED, "COMPRESSION");
            let encoded = [plain[0], ("content-encoding", what)];
            let answer = http_send(&stage.server, &Method::PUT, path, &encoded, content).await;
            assert_problem(&answer, StatusCode::NOT_IMPLEMENTED, "COMPRESSION");
        }
        // An archive in an archive is not opened either.
        let mut nested = toy_files();
        nested.insert("neutral.obj".to_owned(), zip(&toy_files()));
        let refused = stage
            .server
            .import("bomb", &zip(&nested))
            .await
            .unwrap_err();
        harness::assert_refused(&refused, tonic::Code::Unimplemented, "COMPRESSION");
        // A small archive of a large file is not inflated beyond the limit of a file.
        let mut bomb = toy_files();
        bomb.insert("neutral.obj".to_owned(), vec![b'\n'; 65 << 20]);
        let bomb = zip(&bomb);
        assert!(bomb.len() < 1 << 20, "{} bytes", bomb.len());
        let refused = stage.server.import("bomb", &bomb).await.unwrap_err();
        harness::assert_refused(&refused, tonic::Code::ResourceExhausted, "BASIS_SIZE");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d12_json_bodies_that_are_not_strict_are_refused() {
    beside_a_control_session("D12 bodies", async |stage| {
        let deep = format!(
            "{{\"settings\":{}{}}}",
            "{\"a\":".repeat(8_000),
            "}".repeat(8_000)
        );
        let keys: Vec<_> = (0..5_000).map(|it| format!("\"k{it}\":1")).collect();
        let keys = format!("{{{}}}", keys.join(","));
        let bodies = [
            deep.as_str(),
            keys.as_str(),
            "",
            "[]",
            "null",
            "\"text\"",
            "{",
            "{}{}",
            "{} x",
            "{\"settings\":{\"smoothing\":1e400}}",
            "{\"settings\":{\"smoothing\":NaN}}",
            "{\"settings\":{\"smoothing\":Infinity}}",
            "{\"settings\":{\"neutralFrames\":-1}}",
            "{\"settings\":{\"neutralFrames\":99999999999}}",
            "{\"settings\":{},\"settings\":{}}",
            "{\"displayName\":\"a\",\"display_name\":\"b\"}",
            "{\"displayName\":\"\\ud800\"}",
            "{\"displayName\":\"a\nb\"}",
            "{\"unknownField\":1}",
            "{'actor':'x'}",
            "{\"actor\":\"x\",}",
            "// comment\n{}",
            "\u{feff}{}",
        ];
        for body in bodies {
            let shown: String = body.chars().take(60).collect();
            let answer = http_send(
                &stage.server,
                &Method::POST,
                SESSIONS,
                &[JSON],
                body.as_bytes(),
            )
            .await;
            assert_eq!(
                answer.status,
                StatusCode::BAD_REQUEST,
                "{shown}: {}",
                answer.text()
            );
            assert_eq!(
                answer.json()["type"],
                "urn:frontalis:problem:JSON",
                "{shown}: {}",
                answer.text()
            );
            // An empty patch asks for nothing.
            if !body.is_empty() {
                let answer = http_send(
                    &stage.server,
                    &Method::PATCH,
                    SUBJECT,
                    &[JSON],
                    body.as_bytes(),
                )
                .await;
                assert_eq!(
                    answer.status,
                    StatusCode::BAD_REQUEST,
                    "{shown}: {}",
                    answer.text()
                );
            }
            if !body.trim().is_empty() && !body.contains('\n') {
                let answer = http_send(
                    &stage.server,
                    &Method::POST,
                    FRAMES,
                    &[LINES],
                    body.as_bytes(),
                )
                .await;
                assert!(
                    answer.status.is_client_error(),
                    "{shown}: {}",
                    answer.text()
                );
            }
        }
        let no_text = b"{\"displayName\":\"\xff\"}";
        let answer = http_send(&stage.server, &Method::POST, SESSIONS, &[JSON], no_text).await;
        assert_problem(&answer, StatusCode::BAD_REQUEST, "JSON");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e1_a_body_above_the_limit_is_413() {
    beside_a_control_session("E1 bodies", async |stage| {
        let huge = format!("{{\"displayName\":\"{}\"}}", "x".repeat(2 << 20));
        for (method, path, kind) in [
            (Method::POST, SESSIONS, JSON),
            (Method::PATCH, SUBJECT, JSON),
            (Method::POST, "/api/v1/sessions/subject/end", JSON),
            (Method::POST, "/api/v1/sessions/subject/recenter", JSON),
            (Method::POST, FRAMES, LINES),
        ] {
            let answer = http_send(&stage.server, &method, path, &[kind], huge.as_bytes()).await;
            assert_eq!(
                answer.status,
                StatusCode::PAYLOAD_TOO_LARGE,
                "{path}: {}",
                answer.text()
            );
            assert!(answer.json()["value"].is_u64(), "{path}: {}", answer.text());
        }
        let answer = declared_upload(stage.server.address(), (64 << 20) + 1).await;
        assert!(answer.starts_with("HTTP/1.1 413"), "{answer}");
        assert!(answer.contains(":BASIS_SIZE"), "{answer}");
    })
    .await;
}

/// The answer to an upload of so many bytes, of which the first few are sent: the server does not wait for the others.
async fn declared_upload(address: SocketAddr, n_bytes: usize) -> String {
    let mut stream = TcpStream::connect(address).await.unwrap();
    let head = format!(
        "PUT /api/v1/actors/huge HTTP/1.1\r\nhost: {address}\r\n\
         content-type: application/octet-stream\r\ncontent-length: {n_bytes}\r\n\r\nPK"
    );
    stream.write_all(head.as_bytes()).await.unwrap();
    let mut answer = Vec::new();
    while !answer.ends_with(b"}") {
        let read = timeout(PATIENCE, stream.read_buf(&mut answer));
        assert!(read.await.unwrap().unwrap() > 0, "closed without an answer");
    }
    String::from_utf8(answer).unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e9_a_compressed_body_is_not_taken() {
    beside_a_control_session("E9 bodies", async |stage| {
        for encoding in ["gzip", "br", "zstd", "deflate", "identity, gzip", "nothing"] {
            for (path, kind) in [(SESSIONS, JSON), (FRAMES, LINES)] {
                let headers = [kind, ("content-encoding", encoding)];
                let answer = http_send(&stage.server, &Method::POST, path, &headers, b"{}").await;
                assert_problem(&answer, StatusCode::NOT_IMPLEMENTED, "COMPRESSION");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_another_content_type_on_an_http_path_is_415() {
    beside_a_control_session("E10 bodies", async |stage| {
        for kind in [
            "text/plain",
            "application/x-www-form-urlencoded",
            "multipart/form-data",
            "",
        ] {
            for path in [SESSIONS, FRAMES] {
                let headers = [("content-type", kind)];
                let answer = http_send(&stage.server, &Method::POST, path, &headers, b"{}").await;
                assert_problem(&answer, StatusCode::UNSUPPORTED_MEDIA_TYPE, "CONTENT_TYPE");
            }
        }
    })
    .await;
}

/// A request that is begun, and goes on one byte at a time.
struct Slow {
    what: &'static str,
    method: &'static str,
    path: &'static str,
    kind: &'static str,
    begun: Vec<u8>,
}

impl Slow {
    /// The last that the server says.
    async fn answer(self, address: SocketAddr) -> (&'static str, String) {
        let Self {
            what,
            method,
            path,
            kind,
            begun,
        } = self;
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: localhost\r\nContent-Type: {kind}\r\nContent-Length: 1000000\r\n\r\n"
        );
        let mut stream = TcpStream::connect(address).await.unwrap();
        stream.write_all(head.as_bytes()).await.unwrap();
        stream.write_all(&begun).await.unwrap();
        let (mut incoming, mut outgoing) = stream.split();
        let mut said = Vec::new();
        let drip = async {
            let mut ticks = interval(Duration::from_millis(100));
            while outgoing.write_all(b" ").await.is_ok() {
                ticks.tick().await;
            }
        };
        let read = async {
            let is_over = |said: &[u8]| String::from_utf8_lossy(said).contains("problem:");
            while !is_over(&said) && incoming.read_buf(&mut said).await.unwrap() > 0 {}
        };
        let answered = async {
            tokio::select! {
                () = read => {}
                () = drip => {}
            }
        };
        timeout(PATIENCE, answered).await.expect(what);
        (what, String::from_utf8(said).unwrap())
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f5_bodies_that_come_byte_by_byte_end_their_requests() {
    beside_a_control_session("F5 bodies", async |stage| {
        let start = PublishMarkersRequest {
            start: Some(stage.performance.start("", "slow")),
            ..PublishMarkersRequest::default()
        };
        let slow = [
            Slow {
                what: "a JSON body",
                method: "POST",
                path: SESSIONS,
                kind: JSON.1,
                begun: b"{".to_vec(),
            },
            Slow {
                what: "a line of frames",
                method: "POST",
                path: FRAMES,
                kind: LINES.1,
                begun: [&serde_json::to_vec(&start).unwrap()[..], b"\n{"].concat(),
            },
            Slow {
                what: "a block of an upload",
                method: "PUT",
                path: "/api/v1/actors/slow",
                kind: "application/zip",
                begun: b"PK".to_vec(),
            },
        ];
        let address = stage.server.address();
        for (what, said) in join_all(slow.map(|it| it.answer(address))).await {
            let late = "urn:frontalis:problem:MESSAGE_DEADLINE";
            assert!(said.contains(late), "{what}: {said}");
        }
    })
    .await;
}

#[track_caller]
fn assert_problem(answer: &harness::HttpAnswer, status: StatusCode, reason: &str) {
    assert_eq!(answer.status, status, "{}", answer.text());
    assert_eq!(answer.content_type, "application/problem+json");
    assert_eq!(
        answer.json()["type"],
        format!("urn:frontalis:problem:{reason}")
    );
}
