//! Processor time of the server for one delivered sample, door by door, beside a plain TCP writer.

use std::{
    fmt,
    io::{Read as _, Write as _},
    net::{TcpListener, TcpStream},
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use frontalis_proto::v1::{SubscribeRequest, SubscribeResponse, SubscribeStart};
use prost::Message as _;
use tokio::{
    task::JoinSet,
    time::{Instant, sleep},
};
use tokio_util::sync::CancellationToken;

use super::{EventStream, GrpcWeb, WebSocket};
use crate::{Subscriber, TestServer, every_frame, real_time::RunningSession};

/// Subscribers of one measurement.
const N_SUBSCRIBERS: usize = 32;
/// Every door has so many turns.
const ROUNDS: usize = 3;
/// Time for the alignment, and for subscribers to catch up.
const SETTLE: Duration = Duration::from_millis(700);
/// Rate of the session.
const RATE_HZ: u32 = 120;
/// The prefix of a gRPC message, bytes.
const PREFIX_BYTES: usize = 5;

const DOORS: [&str; 6] = ["nobody", "grpc", "grpc-web", "ws+proto", "ws+json", "sse"];

/// What was measured.
#[derive(Clone, Debug)]
pub struct DoorCosts {
    /// Name, microseconds a sample, and the worst and best turn.
    doors: Vec<(&'static str, [f64; 3])>,
    raw_micros: f64,
    message_bytes: usize,
}

impl DoorCosts {
    /// Measures a server that is a program of its own.
    pub async fn measure(server: &TestServer, seconds: u64) -> Self {
        let span = Duration::from_secs(seconds);
        let mut turns = vec![Vec::new(); DOORS.len()];
        let mut raw = Vec::new();
        let message = one_message(server).await;
        for round in 0..ROUNDS {
            for (door, turns) in DOORS.into_iter().zip(&mut turns) {
                turns.push(turn(server, door, round, span).await);
            }
            let bytes = [vec![0; PREFIX_BYTES], message.clone()].concat();
            let writing = tokio::task::spawn_blocking(move || raw_turn(&bytes, span));
            raw.push(writing.await.unwrap());
        }
        let seconds = span.as_secs_f64();
        let idle = turns[0].iter().map(|it| it.nanos).sum::<f64>() / ROUNDS as f64;
        let of = |turns: &Vec<Turn>| {
            let micros = turns
                .iter()
                .map(|it| (it.nanos - idle) / it.n_samples / 1e3);
            let mut micros: Vec<f64> = micros.collect();
            micros.sort_by(f64::total_cmp);
            let mean = micros.iter().sum::<f64>() / micros.len() as f64;
            [mean, micros[0], micros[ROUNDS - 1]]
        };
        println!(
            "idle session: {:.2} ms of processor time a second",
            idle / seconds / 1e6
        );
        Self {
            doors: DOORS
                .into_iter()
                .zip(turns.iter().map(of))
                .skip(1)
                .collect(),
            raw_micros: raw.iter().sum::<f64>() / ROUNDS as f64,
            message_bytes: message.len(),
        }
    }
}

impl fmt::Display for DoorCosts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "server's processor time a delivered sample, {N_SUBSCRIBERS} subscribers of every frame, {RATE_HZ} Hz; \
             protobuf message of {} bytes",
            self.message_bytes
        )?;
        writeln!(f, "  raw TCP    {:6.2} us", self.raw_micros)?;
        for (door, [mean, least, most]) in &self.doors {
            let ratio = mean / self.raw_micros;
            writeln!(
                f,
                "  {door:<10} {mean:6.2} us ({least:.2} to {most:.2}), {ratio:.1} x raw TCP"
            )?;
        }
        Ok(())
    }
}

#[derive(Clone, Copy, Debug)]
struct Turn {
    nanos: f64,
    n_samples: f64,
}

/// One door for a while.
async fn turn(server: &TestServer, door: &'static str, round: usize, span: Duration) -> Turn {
    let id = format!("cost-{round}-{}", door.replace('+', "-"));
    let stop = CancellationToken::new();
    let session = RunningSession::start(server, &id, 0, stop.clone()).await;
    let n_samples = Arc::new(AtomicU64::new(0));
    let mut followers = JoinSet::new();
    if door != "nobody" {
        for _ in 0..N_SUBSCRIBERS {
            let following = follow(server, door, &id, Arc::clone(&n_samples)).await;
            followers.spawn(following);
        }
    }
    sleep(SETTLE).await;
    let before = (
        server.program().cpu_nanos(),
        n_samples.load(Ordering::Relaxed),
    );
    sleep(span).await;
    let after = (
        server.program().cpu_nanos(),
        n_samples.load(Ordering::Relaxed),
    );
    stop.cancel();
    session.finish(server).await;
    followers.shutdown().await;
    Turn {
        nanos: (after.0 - before.0) as f64,
        n_samples: (after.1 - before.1) as f64,
    }
}

/// A subscriber that only counts.
async fn follow(
    server: &TestServer,
    door: &str,
    id: &str,
    n_samples: Arc<AtomicU64>,
) -> std::pin::Pin<Box<dyn Future<Output = ()> + Send>> {
    let session = format!("sessions/{id}");
    let start = SubscribeStart {
        from_oldest: false,
        ..every_frame(&session)
    };
    let count = move |answer: &SubscribeResponse| {
        n_samples.fetch_add(answer.samples.len() as u64, Ordering::Relaxed);
    };
    match door {
        "grpc" => {
            let mut subscriber = Subscriber::open(server, start).await.unwrap();
            Box::pin(async move {
                while let Ok(Some(answer)) = subscriber.answer().await {
                    count(&answer);
                }
            })
        }
        "grpc-web" => {
            let mut web = GrpcWeb::follow(server, &start).await;
            Box::pin(async move {
                while let Some(answer) = web.next().await {
                    count(&answer);
                }
            })
        }
        "sse" => {
            let path = format!("/api/v1/sessions/{id}/events?delivery=every_frame");
            let mut events = EventStream::open(server, &path, "").await.unwrap();
            Box::pin(async move {
                while let Some(Ok(answer)) = events.answer().await {
                    count(&answer);
                }
            })
        }
        socket => {
            let form = socket.trim_start_matches("ws");
            let name = format!("frontalis.v1.subscribe{form}");
            let mut socket = WebSocket::open(server, id, &name).await.unwrap();
            socket
                .send(&SubscribeRequest {
                    start: Some(start),
                    credits: 0,
                })
                .await;
            Box::pin(async move {
                while let Ok(answer) = socket.next().await {
                    count(&answer);
                }
            })
        }
    }
}

/// A live message as gRPC sends it.
async fn one_message(server: &TestServer) -> Vec<u8> {
    let stop = CancellationToken::new();
    let session = RunningSession::start(server, "cost-message", 0, stop.clone()).await;
    let mut subscriber = Subscriber::open(server, every_frame("sessions/cost-message"))
        .await
        .unwrap();
    let message = loop {
        let answer = subscriber.answer().await.unwrap().unwrap();
        if answer.samples.len() == 1 && answer.samples[0].frame > 60 {
            break answer.encode_to_vec();
        }
    };
    stop.cancel();
    session.finish(server).await;
    message
}

/// The same bytes at the same rate to as many connections, from one thread: microseconds a write.
#[expect(
    clippy::disallowed_methods,
    reason = "the plain writer is a thread without a runtime"
)]
fn raw_turn(bytes: &[u8], span: Duration) -> f64 {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let mut writers = Vec::new();
    let mut readers = Vec::new();
    for _ in 0..N_SUBSCRIBERS {
        let mut reader = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let (writer, _) = listener.accept().unwrap();
        writer.set_nodelay(true).unwrap();
        writers.push(writer);
        readers.push(std::thread::spawn(move || {
            let mut buffer = [0; 4096];
            while reader.read(&mut buffer).is_ok_and(|n| n > 0) {}
        }));
    }
    let period = Duration::from_secs(1) / RATE_HZ;
    let (began, before) = (Instant::now(), thread_nanos());
    let mut n_written = 0_u32;
    let mut next = began;
    while began.elapsed() < span {
        for writer in &mut writers {
            writer.write_all(bytes).unwrap();
            n_written += 1;
        }
        next += period;
        std::thread::sleep(next.saturating_duration_since(Instant::now()));
    }
    let nanos = thread_nanos() - before;
    drop(writers);
    for reader in readers {
        reader.join().unwrap();
    }
    nanos as f64 / f64::from(n_written) / 1e3
}

fn thread_nanos() -> u64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split_whitespace().next().unwrap().parse().unwrap()
}
