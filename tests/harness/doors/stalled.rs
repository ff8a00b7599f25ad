//! Clients of the HTTP doors that stop reading: what each costs in memory, and the others in time (CONTRACTS G4).

use std::{fmt, time::Duration};

use tokio::{
    io::AsyncWriteExt as _,
    net::{TcpSocket, TcpStream},
    time::sleep,
};
use tokio_util::sync::CancellationToken;

use super::SocketFrames;
use crate::{
    TestServer,
    real_time::{RunningSession, percentile},
};

/// Subscribers that read.
const N_HEALTHY: usize = 8;
/// Subscribers that do not.
const N_STALLED: usize = 64;
/// Shorter than a connection that takes nothing is kept.
const SPAN: Duration = Duration::from_secs(11);
/// Their receive buffers, so that the server's side fills soon.
const RECEIVE_BYTES: u32 = 2 * 1024;

/// What to ask for, and never read.
const KINDS: [(&str, &str); 5] = [
    ("nobody", ""),
    (
        "WebSocket, LATEST with 2 credits",
        r#"{"start":{"credits":2}}"#,
    ),
    (
        "WebSocket, EVERY_FRAME",
        r#"{"start":{"delivery":"DELIVERY_EVERY_FRAME"}}"#,
    ),
    ("SSE, LATEST", "delivery=latest"),
    ("SSE, EVERY_FRAME", "delivery=every_frame"),
];

/// What was measured.
#[derive(Clone, Debug)]
pub struct StalledDoors {
    rows: Vec<Row>,
}

#[derive(Clone, Debug)]
struct Row {
    kind: &'static str,
    grown_bytes: f64,
    p50_micros: f64,
    p99_micros: f64,
    n_missing: u64,
}

impl StalledDoors {
    /// Measures one server after the other, each a program of its own: what one kind had used is not there for the next.
    pub async fn measure() -> Self {
        let mut rows = Vec::new();
        for kind in KINDS {
            let server = TestServer::start_program(|_| {}).await;
            server.import_reference().await;
            rows.push(stall(&server, kind).await);
            server.stop().await;
        }
        Self { rows }
    }
}

impl fmt::Display for StalledDoors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{N_HEALTHY} gRPC subscribers of every frame at 120 Hz beside {N_STALLED} that do not read, {} s each",
            SPAN.as_secs()
        )?;
        let alone = &self.rows[0];
        for row in &self.rows {
            let kib = (row.grown_bytes - alone.grown_bytes) / N_STALLED as f64 / 1024.0;
            writeln!(
                f,
                "  {:<33} {kib:6.1} KiB each; the others: p50 {:.0} us, p99 {:.0} us ({:+.0}), missing {}",
                row.kind,
                row.p50_micros,
                row.p99_micros,
                row.p99_micros - alone.p99_micros,
                row.n_missing
            )?;
        }
        Ok(())
    }
}

async fn stall(server: &TestServer, (kind, asked): (&'static str, &str)) -> Row {
    let id = "stall";
    let stop = CancellationToken::new();
    let session = RunningSession::start(server, id, N_HEALTHY, stop.clone()).await;
    sleep(Duration::from_secs(1)).await;
    let before = server.program().resident_bytes();
    let mut stalled = Vec::new();
    if !asked.is_empty() {
        for _ in 0..N_STALLED {
            stalled.push(open(server, id, asked).await);
        }
    }
    sleep(SPAN).await;
    let after = server.program().resident_bytes();
    let status = server
        .session(&format!("sessions/{id}"))
        .await
        .status
        .unwrap();
    assert_eq!(
        status.subscribers.len(),
        N_HEALTHY + stalled.len(),
        "{kind}: somebody was cut"
    );
    stop.cancel();
    let outcome = session.finish(server).await;
    drop(stalled);
    let mut latencies = outcome.latencies_micros;
    latencies.sort_by(f64::total_cmp);
    Row {
        kind,
        grown_bytes: after as f64 - before as f64,
        p50_micros: percentile(&latencies, 50),
        p99_micros: percentile(&latencies, 99),
        n_missing: outcome.n_missing,
    }
}

/// Sends everything at once, and reads nothing.
async fn open(server: &TestServer, id: &str, asked: &str) -> TcpStream {
    let socket = TcpSocket::new_v4().unwrap();
    socket.set_recv_buffer_size(RECEIVE_BYTES).unwrap();
    let mut stream = socket.connect(server.address()).await.unwrap();
    let host = server.address();
    let sent = if asked.starts_with('{') {
        let head = SocketFrames::handshake(server, id, "frontalis.v1.subscribe+json");
        [
            head.as_bytes(),
            &SocketFrames::frame(0x81, asked.as_bytes()),
        ]
        .concat()
    } else {
        let head =
            format!("GET /api/v1/sessions/{id}/events?{asked} HTTP/1.1\r\nHost: {host}\r\n\r\n");
        head.into_bytes()
    };
    stream.write_all(&sent).await.unwrap();
    stream
}
