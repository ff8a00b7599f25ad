//! Row E12: a client that breaks off at every point of every call leaves nothing behind.

use std::time::Duration;

use frontalis_proto::{FILE_DESCRIPTOR_SET, v1};
use harness::{Publisher, RawConnection, TestServer, encoded, every_frame, framed, http_get};
use prost::Message as _;
use prost_types::FileDescriptorSet;
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    runtime::Handle,
    time::Instant,
};

use super::{SUBJECT, Stage, beside_a_control_session};

/// How long the first bytes of an answer are waited for before the client breaks off.
const PATIENCE: Duration = Duration::from_millis(50);

/// The session that a call makes.
const MADE: &str = "broken-off";

/// Readings before the first call.
const N_READINGS: usize = 50;

/// Methods whose full name differs from those of the descriptor set in the program.
const OTHERS: [&str; 4] = [
    "/grpc.health.v1.Health/Check",
    "/grpc.health.v1.Health/Watch",
    "/grpc.reflection.v1.ServerReflection/ServerReflectionInfo",
    "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
];

/// What a server holds for its clients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Held {
    connections: u64,
    calls: u64,
    subscribers: u64,
    tasks: usize,
}

impl Held {
    /// With the connection that asks, which is the same for every reading.
    async fn by(server: &TestServer) -> Self {
        let text = http_get(server, "/metrics").await;
        let figure = |name: &str| {
            let line = text.text().lines().find_map(|it| it.strip_prefix(name));
            line.unwrap().trim().parse().unwrap()
        };
        Self {
            connections: figure("frontalis_connections "),
            calls: figure("frontalis_calls "),
            subscribers: figure("frontalis_subscribers "),
            tasks: Handle::current().metrics().num_alive_tasks(),
        }
    }

    fn is_within(self, most: Self) -> bool {
        self.connections <= most.connections
            && self.calls <= most.calls
            && self.subscribers <= most.subscribers
            && self.tasks <= most.tasks
    }

    /// What is held when nothing is asked: the least of many readings, since a reading itself is held for a moment.
    async fn at_rest(server: &TestServer) -> Self {
        let mut least = Self::by(server).await;
        for _ in 0..N_READINGS {
            tokio::time::sleep(Duration::from_millis(10)).await;
            let now = Self::by(server).await;
            least = Self {
                connections: least.connections.min(now.connections),
                calls: least.calls.min(now.calls),
                subscribers: least.subscribers.min(now.subscribers),
                tasks: least.tasks.min(now.tasks),
            };
        }
        least
    }

    /// Waits until no more is held than this, and says how long that took.
    async fn again(self, server: &TestServer, what: &str) -> Duration {
        let began = Instant::now();
        harness::assert_eventually!(
            Self::by(server).await.is_within(self),
            "{what}: {:?} is held, {self:?} before",
            Self::by(server).await
        );
        began.elapsed()
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e12_grpc_calls_broken_off_at_every_point_leave_nothing_behind() {
    broken_off_everywhere("E12 gRPC", "application/grpc").await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e12_grpc_web_calls_broken_off_at_every_point_leave_nothing_behind() {
    broken_off_everywhere("E12 gRPC-web", "application/grpc-web+proto").await;
}

async fn broken_off_everywhere(row: &str, kind: &str) {
    beside_a_control_session(row, async |stage| {
        let start = prepare(stage).await;
        let mut slowest = Duration::ZERO;
        for (path, messages) in calls(stage) {
            let mut connection = RawConnection::open(&stage.server).await;
            for (sent, rest) in cuts(&messages) {
                let mut call = connection.call(&path, &[("content-type", kind)]).await;
                call.send(&sent).await;
                call.cancel();
                // Some break off while they listen, some after they have said all.
                let mut call = connection.call(&path, &[("content-type", kind)]).await;
                call.send(&sent).await;
                if rest == 0 {
                    call.finish();
                }
                let answer = call.begin_answer();
                if let Ok((_outgoing, response)) = tokio::time::timeout(PATIENCE, answer).await {
                    let mut body = response.into_body();
                    drop(tokio::time::timeout(PATIENCE, body.data()).await);
                }
                // And some vanish with their connection.
                let mut lost = RawConnection::open(&stage.server).await;
                let mut call = lost.call(&path, &[("content-type", kind)]).await;
                call.send(&sent).await;
                drop(lost);
            }
            drop(connection);
            let took = start.again(&stage.server, &path).await;
            println!("{row}: {path} was back within {took:?}");
            slowest = slowest.max(took);
        }
        println!("{row}: everything was back within {slowest:?}");
        assert_free(stage).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e12_http_requests_broken_off_at_every_point_leave_nothing_behind() {
    beside_a_control_session("E12 HTTP", async |stage| {
        let start = prepare(stage).await;
        let mut slowest = Duration::ZERO;
        for (what, bytes) in requests(stage) {
            let n_head = bytes.windows(4).position(|it| it == b"\r\n\r\n").unwrap() + 4;
            let n_body = bytes.len() - n_head;
            let cuts = [
                1,
                n_head / 2,
                n_head,
                n_head + n_body / 3,
                n_head + n_body / 2,
                bytes.len(),
            ];
            for cut in cuts {
                let mut stream = TcpStream::connect(stage.server.address()).await.unwrap();
                stream.write_all(&bytes[..cut]).await.unwrap();
                if cut == bytes.len() {
                    let mut some = [0; 256];
                    drop(tokio::time::timeout(PATIENCE, stream.read(&mut some)).await);
                }
            }
            slowest = slowest.max(start.again(&stage.server, what).await);
        }
        println!("E12 HTTP: everything was back within {slowest:?}");
        assert_free(stage).await;
    })
    .await;
}

/// A lease is soon free after its publisher, and there are samples to be read; what is held then, with a session more
/// than there is: one of the calls makes it.
async fn prepare(stage: &Stage) -> Held {
    drop(stage.publisher().await);
    let settings = v1::SessionSettings {
        publisher_timeout: Some(pbjson_types::Duration {
            seconds: 0,
            nanos: 100_000_000,
        }),
        ..v1::SessionSettings::default()
    };
    let update = v1::UpdateSessionRequest {
        name: SUBJECT.to_owned(),
        settings: Some(settings),
        ..v1::UpdateSessionRequest::default()
    };
    let mut sessions = stage.server.sessions().await;
    sessions.update_session(update).await.unwrap();
    drop(sessions);
    stage
        .server
        .create_session(MADE, "actors/reference")
        .await
        .unwrap();
    let held = Held::at_rest(&stage.server).await;
    stage.server.end_session(&format!("sessions/{MADE}")).await;
    held
}

/// No lease is left, and no place of a subscriber.
async fn assert_free(stage: &Stage) {
    let start = stage.performance.start(SUBJECT, "camera-9");
    let mut publisher = Publisher::open(&stage.server, start.clone()).await;
    harness::assert_eventually!({
        if publisher.is_err() {
            publisher = Publisher::open(&stage.server, start.clone()).await;
        }
        publisher.is_ok()
    });
    let session = stage.server.session(SUBJECT).await;
    assert_eq!(session.status.unwrap().subscribers, []);
}

/// What is sent before the client breaks off, and how many messages then still were to come: nothing, half of the first
/// message, the first message, and so on.
fn cuts(messages: &[Vec<u8>]) -> Vec<(Vec<u8>, usize)> {
    let mut cuts = vec![(Vec::new(), messages.len())];
    let mut sent = Vec::new();
    for (idx, message) in messages.iter().enumerate() {
        let half = [&sent[..], &message[..=message.len() / 2]].concat();
        cuts.push((half, messages.len() - idx));
        sent.extend(message);
        cuts.push((sent.clone(), messages.len() - idx - 1));
    }
    cuts
}

/// Every method of the protocol with messages that it takes; where none are known, an empty one.
fn calls(stage: &Stage) -> Vec<(String, Vec<Vec<u8>>)> {
    let files = FileDescriptorSet::decode(FILE_DESCRIPTOR_SET).unwrap();
    let mut paths: Vec<String> = OTHERS.map(str::to_owned).to_vec();
    for file in &files.file {
        for service in &file.service {
            let name = format!("{}.{}", file.package(), service.name());
            let methods = service.method.iter();
            paths.extend(methods.map(|it| format!("/{name}/{}", it.name())));
        }
    }
    assert!(paths.len() > 20, "{paths:?}");
    let with_messages = |path: String| {
        let messages = messages(stage, path.rsplit('/').next().unwrap());
        (path, messages)
    };
    paths.into_iter().map(with_messages).collect()
}

fn messages(stage: &Stage, method: &str) -> Vec<Vec<u8>> {
    let name = SUBJECT.to_owned();
    match method {
        "PublishMarkers" => {
            let start = v1::PublishMarkersRequest {
                start: Some(stage.performance.start(SUBJECT, "camera-1")),
                ..v1::PublishMarkersRequest::default()
            };
            let frames = |first| v1::PublishMarkersRequest {
                frames: stage.performance.frames(first..=first + 9),
                ..v1::PublishMarkersRequest::default()
            };
            vec![encoded(&start), encoded(&frames(31)), encoded(&frames(41))]
        }
        "Subscribe" => {
            let start = v1::SubscribeRequest {
                start: Some(every_frame(SUBJECT)),
                credits: 0,
            };
            let credits = v1::SubscribeRequest {
                start: None,
                credits: 3,
            };
            vec![encoded(&start), encoded(&credits)]
        }
        "Follow" => vec![encoded(&every_frame(SUBJECT))],
        "ReadCurves" => vec![encoded(&v1::ReadCurvesRequest {
            session: name,
            ..v1::ReadCurvesRequest::default()
        })],
        "GetSession" => vec![encoded(&v1::GetSessionRequest { name })],
        "RecenterSession" => vec![encoded(&v1::RecenterSessionRequest {
            name,
            ..v1::RecenterSessionRequest::default()
        })],
        "UpdateSession" => vec![encoded(&v1::UpdateSessionRequest {
            name,
            ..v1::UpdateSessionRequest::default()
        })],
        "CreateSession" => vec![encoded(&v1::CreateSessionRequest {
            session_id: MADE.to_owned(),
            actor: "actors/reference".to_owned(),
            kind: v1::CaptureKind::Markers.into(),
            ..v1::CreateSessionRequest::default()
        })],
        "EndSession" => vec![encoded(&v1::EndSessionRequest {
            name: format!("sessions/{MADE}"),
        })],
        "ImportActor" => {
            let package = harness::zip(&harness::toy_files());
            let start = v1::ImportActorRequest {
                start: Some(v1::ImportActorStart {
                    actor_id: "broken-off".to_owned(),
                    ..v1::ImportActorStart::default()
                }),
                chunk: Vec::new(),
            };
            let chunk = v1::ImportActorRequest {
                start: None,
                chunk: package,
            };
            vec![encoded(&start), encoded(&chunk)]
        }
        "ExportActor" => vec![encoded(&v1::ExportActorRequest {
            name: "actors/reference".to_owned(),
            ..v1::ExportActorRequest::default()
        })],
        _ => vec![framed(b"")],
    }
}

/// Requests of every kind as their bytes over HTTP/1.1.
fn requests(stage: &Stage) -> Vec<(&'static str, Vec<u8>)> {
    let host = stage.server.address();
    let get = |path: &str| format!("GET {path} HTTP/1.1\r\nhost: {host}\r\n\r\n").into_bytes();
    let send = |method: &str, path: &str, kind: &str, body: &[u8]| {
        let head = format!(
            "{method} {path} HTTP/1.1\r\nhost: {host}\r\ncontent-type: {kind}\r\ncontent-length: {}\r\n\r\n",
            body.len()
        );
        [head.as_bytes(), body].concat()
    };
    let start = v1::PublishMarkersRequest {
        start: Some(stage.performance.start(SUBJECT, "camera-1")),
        frames: stage.performance.frames(31..=40),
        clock: None,
    };
    let line = serde_json::to_vec(&start).unwrap();
    let lines = [&line[..], b"\n{}\n{}\n"].concat();
    let socket = |protocol: &str, frames: &[&[u8]]| {
        let head = format!(
            "GET /api/v1/sessions/subject/stream HTTP/1.1\r\nhost: {host}\r\nconnection: upgrade\r\n\
             upgrade: websocket\r\nsec-websocket-version: 13\r\nsec-websocket-key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\
             sec-websocket-protocol: frontalis.v1.{protocol}\r\n\r\n"
        );
        let frames = frames.iter().flat_map(|it| masked(it));
        head.into_bytes()
            .into_iter()
            .chain(frames)
            .collect::<Vec<u8>>()
    };
    let subscribe = serde_json::to_vec(&v1::SubscribeRequest {
        start: Some(every_frame(SUBJECT)),
        credits: 0,
    });
    let subscribe = subscribe.unwrap();
    let json = "application/json";
    vec![
        ("index", get("/")),
        ("metrics", get("/metrics")),
        ("server", get("/api/v1/server")),
        ("sessions", get("/api/v1/sessions")),
        ("session", get("/api/v1/sessions/subject")),
        ("curves", get("/api/v1/sessions/subject/curves?limit=1000")),
        ("events", get("/api/v1/sessions/subject/events?delivery=every_frame")),
        ("model", get("/api/v1/actors/reference/model.glb")),
        ("package", get("/api/v1/actors/reference/package")),
        (
            "create",
            send(
                "POST",
                "/api/v1/sessions",
                json,
                br#"{"sessionId":"broken-off","actor":"actors/reference","kind":"CAPTURE_KIND_MARKERS"}"#,
            ),
        ),
        (
            "update",
            send("PATCH", "/api/v1/sessions/subject", json, b"{\"settings\":{}}"),
        ),
        (
            "recenter",
            send("POST", "/api/v1/sessions/subject/recenter", json, b"{}"),
        ),
        (
            "end",
            send("POST", "/api/v1/sessions/broken-off/end", json, b"{}"),
        ),
        (
            "upload",
            send(
                "PUT",
                "/api/v1/actors/broken-off",
                "application/zip",
                &harness::zip(&harness::toy_files()),
            ),
        ),
        (
            "frames",
            send(
                "POST",
                "/api/v1/sessions/subject/frames",
                "application/x-ndjson",
                &lines,
            ),
        ),
        ("subscribing socket", socket("subscribe+json", &[&subscribe, b"{\"credits\":1}"])),
        ("publishing socket", socket("publish+json", &[&line, b"{}"])),
    ]
}

/// A text message of a WebSocket's client; the mask is zero.
fn masked(text: &[u8]) -> Vec<u8> {
    let mut frame = vec![0x81];
    match u16::try_from(text.len()).unwrap() {
        short @ 0..126 => frame.push(0x80 | u8::try_from(short).unwrap()),
        long => {
            frame.push(0x80 | 0x7e);
            frame.extend(long.to_be_bytes());
        }
    }
    frame.extend([0; 4]);
    frame.extend(text);
    frame
}
