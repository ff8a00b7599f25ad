//! Connections within limits, and the end of a server.

use std::time::Duration;

use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    time::{Instant, timeout},
};
use tonic_health::pb::{HealthCheckRequest, health_client::HealthClient};

use super::{Stage, refusal};

const PATIENCE: Duration = Duration::from_secs(30);

/// Sends `bytes`, then waits until the server closes.
async fn is_closed_after(stage: &Stage, bytes: &[u8]) {
    let mut stream = TcpStream::connect(stage.server.address()).await.unwrap();
    stream.write_all(bytes).await.unwrap();
    let mut rest = Vec::new();
    // A reset is a close too.
    let _ended = timeout(PATIENCE, stream.read_to_end(&mut rest))
        .await
        .unwrap();
}

#[tokio::test]
async fn peers_that_do_not_begin_or_finish_a_request_are_closed() {
    let stage = Stage::with(|config| config.transport.header_deadline_secs = 1).await;
    let silent = [
        b"".as_slice(),
        b"PRI * HTTP/2.0\r\n",
        b"GET / HTTP/1.1\r\nHost:",
    ];
    futures::future::join_all(silent.map(|it| is_closed_after(&stage, it))).await;
    assert_eq!(stage.get("/healthz").await.0, 200);
}

#[tokio::test]
async fn a_peer_that_answers_no_ping_is_closed() {
    let stage = Stage::with(|config| {
        config.transport.keepalive_interval_secs = 1;
        config.transport.keepalive_timeout_secs = 1;
    })
    .await;
    let settings = [0, 0, 0, 4, 0, 0, 0, 0, 0];
    let preface = [b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n".as_slice(), &settings].concat();
    is_closed_after(&stage, &preface).await;
}

#[tokio::test]
async fn a_connection_above_the_limit_is_closed_and_the_others_go_on() {
    let stage = Stage::with(|config| config.limits.connections = 2).await;
    let held = TcpStream::connect(stage.server.address()).await.unwrap();
    is_closed_after(&stage, b"").await;
    drop(held);
    stage.create("s").await;
}

#[tokio::test]
async fn headers_above_the_limit_are_refused() {
    let stage = Stage::in_memory().await;
    let long = format!(
        "GET /healthz HTTP/1.1\r\nHost: x\r\nA: {}\r\n\r\n",
        "x".repeat(1 << 20)
    );
    is_closed_after(&stage, long.as_bytes()).await;
    assert_eq!(stage.get("/healthz").await.0, 200);
}

#[tokio::test]
async fn a_server_drains_within_its_grace_although_somebody_watches() {
    let stage = Stage::in_memory().await;
    stage.create("s").await;
    let watch = HealthCheckRequest::default();
    let mut health = HealthClient::new(stage.channel.clone());
    let mut watching = health.watch(watch).await.unwrap().into_inner();
    watching.message().await.unwrap();
    let _idle = TcpStream::connect(stage.server.address()).await.unwrap();
    let started = Instant::now();
    let address = stage.server.address();
    assert!(stage.stop().await, "something had to be cut");
    assert!(started.elapsed() < Duration::from_secs(5));
    assert!(TcpStream::connect(address).await.is_err());
    drop(watching);
}

#[tokio::test]
async fn a_message_above_the_limit_is_refused_by_the_transport() {
    let stage = Stage::in_memory().await;
    let huge = frontalis_proto::v1::CreateSessionRequest {
        display_name: "x".repeat(1 << 20),
        ..super::create("s")
    };
    let refused = stage.sessions().create_session(huge).await;
    assert_eq!(refusal(refused).0, tonic::Code::OutOfRange);
}

#[tokio::test]
async fn calls_above_the_limit_are_refused_but_health_still_answers() {
    let stage = Stage::with(|config| config.limits.calls = 1).await;
    let mut health = HealthClient::new(stage.channel.clone());
    let watching = health.watch(HealthCheckRequest::default()).await.unwrap();
    let list = || frontalis_proto::v1::ListSessionsRequest::default();
    let refused = stage.sessions().list_sessions(list()).await;
    assert_eq!(
        refusal(refused),
        (tonic::Code::ResourceExhausted, "CALLS".into())
    );
    health.check(HealthCheckRequest::default()).await.unwrap();
    drop(watching);
    // The reset of the dropped stream is on its way; the place is free once it has arrived.
    let free = async {
        while stage.sessions().list_sessions(list()).await.is_err() {
            tokio::task::yield_now().await;
        }
    };
    timeout(PATIENCE, free).await.unwrap();
}
