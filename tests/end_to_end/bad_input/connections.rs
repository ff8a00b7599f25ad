//! Rows F1 to F4 and F11: connections that do not begin, do not go on, vanish, do not read, or are too many.
//!
//! After how long the default deadlines close a connection is tested beside the listener, on a paused clock; here every
//! other deadline lies beyond the patience, so that it is the right one that closes.

use std::{net::SocketAddr, time::Duration};

use frontalis_proto::v1::SubscribeRequest;
use frontalis_server::config::Config;
use futures::{
    FutureExt as _, StreamExt as _,
    future::{join_all, select_all},
};
use harness::{
    Cost, Publisher, Subscriber, TestServer, Vanishing, assert_eventually, encoded, every_frame,
    http_get,
    raw_http2::{PREFACE, frame, get, kind},
};
use hyper::Request;
use rustix::process::{Pid, Resource, Rlimit, getrlimit, prlimit};
use socket2::SockRef;
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    time::{Instant, timeout},
};

use super::{
    GOOD_FRAMES, SUBJECT, Stage, beside_a_control_session_of, beside_a_control_session_with,
};

/// How long anything is waited for.
pub(super) const PATIENCE: Duration = Duration::from_secs(40);

/// A deadline that does not end within the patience.
pub(super) const LONG_SECS: u64 = 60;

const MIB: u64 = 1 << 20;

/// The headers' deadline alone closes.
fn only_headers(config: &mut Config) {
    config.transport.header_deadline_secs = 1;
    config.transport.keepalive_interval_secs = LONG_SECS;
    config.transport.keepalive_timeout_secs = LONG_SECS;
}

/// An unanswered ping alone closes.
fn only_pings(config: &mut Config) {
    config.transport.header_deadline_secs = LONG_SECS;
    config.transport.keepalive_interval_secs = 1;
    config.transport.keepalive_timeout_secs = 1;
}

/// Says something, then nothing; how long the server waits until it closes.
pub(super) async fn closed_after(address: SocketAddr, said: &[u8]) -> Duration {
    // The server's clock may begin before the connection is told here.
    let began = Instant::now();
    let mut stream = TcpStream::connect(address).await.unwrap();
    drop(stream.write_all(said).await);
    let mut rest = Vec::new();
    // A reset is a close too.
    drop(
        timeout(PATIENCE, stream.read_to_end(&mut rest))
            .await
            .unwrap(),
    );
    began.elapsed()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f1_five_hundred_connections_that_do_not_begin_are_closed_in_time() {
    let server = TestServer::start_program(only_headers).await;
    beside_a_control_session_of("F1", server, async |stage| {
        let program = stage.server.program();
        let silent: [(&str, &[u8]); 3] = [
            ("nothing", b""),
            ("half the preface", &PREFACE[..12]),
            ("half a request", b"GET / HTTP/1.1\r\nHost: lo"),
        ];
        for (what, said) in silent {
            let all = join_all((0..500).map(|_| closed_after(program.address(), said)));
            let (waits, cost) = Cost::of(program, all).await;
            let longest = waits.iter().max().unwrap();
            println!(
                "G12: 500 connections that say {what}: {cost}, the last closed after {} ms",
                longest.as_millis()
            );
            assert!(cost.grown_bytes <= 16 * MIB, "{cost}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f1_connections_of_one_peer_above_the_limit_are_closed_at_once() {
    let change = |config: &mut Config| {
        config.limits.connections_per_peer = 100;
        // What is closed is closed by the limit.
        config.transport.header_deadline_secs = LONG_SECS;
    };
    beside_a_control_session_with("F1 limits", change, async |stage| {
        let address = stage.server.address();
        let mut held = Vec::new();
        for _ in 0..100 {
            held.push(TcpStream::connect(address).await.unwrap());
        }
        // The control session has some of the places.
        let ends = held.iter_mut().map(|it| Box::pin(it.read_u8()));
        let first = timeout(PATIENCE, select_all(ends)).await;
        drop(first.expect("none was closed"));
        let is_open = |it: &mut TcpStream| it.read_u8().now_or_never().is_none();
        let n_open = held.iter_mut().map(is_open).filter(|it| *it).count();
        assert!((80..100).contains(&n_open), "{n_open} of 100 are open");
        drop(held);
        let refused = "frontalis_connections_refused_total{limit=\"connections_per_peer\"}";
        assert_eventually!(metrics(address).await.contains(refused));
    })
    .await;
}

/// The server's figures; nothing when it closes the connection at once.
async fn metrics(address: SocketAddr) -> String {
    let mut stream = TcpStream::connect(address).await.unwrap();
    let ask = b"GET /metrics HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    drop(stream.write_all(ask).await);
    let mut answer = String::new();
    drop(stream.read_to_string(&mut answer).await);
    answer
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f2_connections_that_fall_silent_are_closed() {
    beside_a_control_session_with("F2", only_pings, async |stage| {
        let settings = frame(kind::SETTINGS, 0, 0, &[]);
        let begun = [PREFACE, &settings].concat();
        let asked = [&begun, get(1, "/healthz").as_slice()].concat();
        print_closing(stage, "no answer to a ping", &begun).await;
        print_closing(stage, "a request, then no answer to a ping", &asked).await;
    })
    .await;
    beside_a_control_session_with("F2 HTTP/1", only_headers, async |stage| {
        let answered = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
        print_closing(stage, "HTTP/1 after its answer", answered).await;
    })
    .await;
}

async fn print_closing(stage: &Stage, what: &str, said: &[u8]) {
    let after = closed_after(stage.server.address(), said).await;
    let millis = after.as_millis();
    println!("F2: {what}: closed after {millis} ms, 1 s allowed for each wait");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f3_peers_that_vanish_are_found_and_what_they_held_is_free() {
    let change = |config: &mut Config| {
        config.transport.keepalive_interval_secs = 1;
        config.transport.keepalive_timeout_secs = 1;
    };
    beside_a_control_session_with("F3", change, async |stage| {
        let address = stage.server.address();
        let vanishing = Vanishing::default();
        let start = stage.performance.start(SUBJECT, "camera-1");
        let channel = vanishing.channel(address).await;
        let mut publisher = Publisher::open_on(channel, start.clone()).await.unwrap();
        let frames = stage.performance.frames(1..=GOOD_FRAMES);
        publisher.send(frames).await;
        publisher.accepted(GOOD_FRAMES).await.unwrap();
        let channel = vanishing.channel(address).await;
        let _over_grpc = Subscriber::open_on(channel, every_frame(SUBJECT))
            .await
            .unwrap();
        let mut over_sse = vanishing.connect(address).await.unwrap();
        let events = format!(
            "GET /api/v1/{SUBJECT}/events?delivery=every_frame HTTP/1.1\r\nHost: localhost\r\n\r\n"
        );
        over_sse.write_all(events.as_bytes()).await.unwrap();
        assert_eventually!(n_subscribers(stage, SUBJECT).await == 2);

        vanishing.vanish();
        let since = Instant::now();
        assert_eventually!(n_subscribers(stage, SUBJECT).await == 0);
        let found = since.elapsed();
        let mut next = Publisher::open(&stage.server, start.clone()).await;
        while next.is_err() && since.elapsed() < PATIENCE {
            next = Publisher::open(&stage.server, start.clone()).await;
        }
        assert_eq!(next.unwrap().started.next_expected, GOOD_FRAMES + 1);
        println!(
            "F3: subscribers over gRPC and SSE gone after {} ms, the session free after {} ms, 2 s allowed for a ping",
            found.as_millis(),
            since.elapsed().as_millis()
        );
    })
    .await;
}

async fn n_subscribers(stage: &Stage, session: &str) -> usize {
    let session = stage.server.session(session).await;
    session.status.unwrap().subscribers.len()
}

/// A subscriber whose connection answers pings, and that reads nothing, or a byte a second.
struct Stalled {
    reader: tokio::task::JoinHandle<()>,
    /// Open as long as the stream of its requests.
    _requests: h2::SendStream<hyper::body::Bytes>,
    driver: tokio::task::JoinHandle<()>,
}

impl Drop for Stalled {
    fn drop(&mut self) {
        self.reader.abort();
        self.driver.abort();
    }
}

/// How much a subscriber reads.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reads {
    NoByte,
    OneByte,
    AByteASecond,
}

impl Stalled {
    async fn open(address: SocketAddr, reads: Reads) -> Self {
        let stream = TcpStream::connect(address).await.unwrap();
        let (mut requests, connection) = h2::client::Builder::new()
            .initial_window_size(u32::from(reads != Reads::NoByte))
            .handshake::<_, hyper::body::Bytes>(stream)
            .await
            .unwrap();
        let driver = tokio::spawn(async move { drop(connection.await) });
        let request = Request::post(format!(
            "http://{address}/frontalis.v1.CurveService/Subscribe"
        ))
        .header("content-type", "application/grpc")
        .header("te", "trailers")
        .body(())
        .unwrap();
        let (answer, mut body) = requests.send_request(request, false).unwrap();
        let start = SubscribeRequest {
            start: Some(every_frame("sessions/control")),
            credits: 0,
        };
        body.send_data(encoded(&start).into(), false).unwrap();
        let mut answer = answer.await.unwrap().into_body();
        let reader = async move {
            if reads == Reads::AByteASecond {
                let mut ticks = tokio::time::interval(Duration::from_secs(1));
                while let Some(Ok(bytes)) = answer.data().await {
                    ticks.tick().await;
                    drop(answer.flow_control().release_capacity(bytes.len()));
                }
            }
            std::future::pending::<()>().await;
            drop(answer);
        };
        Self {
            reader: tokio::spawn(reader),
            _requests: body,
            driver,
        }
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f4_readers_that_make_no_room_cost_little_and_hold_up_nobody() {
    const N_STALLED: usize = 32;
    const FRAMES: u64 = 360;
    let server = TestServer::start_program(|_| {}).await;
    beside_a_control_session_of("F4", server, async |stage| {
        let program = stage.server.program();
        let kinds = [
            ("no byte", Reads::NoByte),
            ("one byte", Reads::OneByte),
            ("a byte a second", Reads::AByteASecond),
        ];
        for (what, reads) in kinds {
            let stall = async {
                let open = (0..N_STALLED).map(|_| Stalled::open(program.address(), reads));
                let stalled = join_all(open).await;
                let received = async || {
                    let session = stage.server.session("sessions/control").await;
                    session.status.unwrap().frames_received
                };
                let target = received().await + FRAMES;
                assert_eventually!(received().await >= target);
                stalled
            };
            let (stalled, cost) = Cost::of(program, stall).await;
            println!(
                "G12: {N_STALLED} readers of every frame that read {what}, {FRAMES} frames: {cost}"
            );
            // What the session keeps of its own samples is a part of it.
            assert!(cost.grown_bytes <= 16 * MIB, "{cost}");
            assert_eq!(
                n_subscribers(stage, "sessions/control").await,
                N_STALLED + 4
            );
            drop(stalled);
            assert_eventually!(n_subscribers(stage, "sessions/control").await == 4);
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f4_a_follower_of_the_newest_that_lives_and_does_not_read_goes_on_when_it_reads() {
    const SESSION: &str = "sessions/control";
    // Twice what a peer's machine has to answer, in frames of the control session.
    const FRAMES: u64 = 480;
    let change = |config: &mut Config| {
        config.transport.keepalive_interval_secs = 1;
        config.transport.keepalive_timeout_secs = 1;
    };
    beside_a_control_session_with("F4 events", change, async |stage| {
        let socket = tokio::net::TcpSocket::new_v4().unwrap();
        socket.set_recv_buffer_size(4096).unwrap();
        let mut stalled = socket.connect(stage.server.address()).await.unwrap();
        let request = format!(
            "GET /api/v1/{SESSION}/events?maxRateHz=1000&withMarkers=true HTTP/1.1\r\nHost: localhost\r\n\r\n"
        );
        stalled.write_all(request.as_bytes()).await.unwrap();
        let received = async || {
            let session = stage.server.session(SESSION).await;
            session.status.unwrap().frames_received
        };
        let target = received().await + FRAMES;
        assert_eventually!(received().await >= target);
        assert_eq!(n_subscribers(stage, SESSION).await, 5);
        let mut lines = tokio::io::AsyncBufReadExt::lines(tokio::io::BufReader::new(stalled));
        let fresh = async {
            while let Some(line) = lines.next_line().await.unwrap() {
                let sequence = line.strip_prefix("id: ").and_then(|it| it.split(':').nth(1));
                if sequence.is_some_and(|it| it.parse::<u64>().unwrap() >= target) {
                    return;
                }
            }
            panic!("the stream ended");
        };
        timeout(PATIENCE, fresh).await.unwrap();
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f11_ten_thousand_connects_disturb_nobody() {
    let server = TestServer::start_program(|_| {}).await;
    beside_a_control_session_of("F11 connects", server, async |stage| {
        let program = stage.server.program();
        let storm = async {
            let began = Instant::now();
            let connects = futures::stream::iter(0..10_000).for_each_concurrent(64, async |_| {
                let stream = TcpStream::connect(program.address()).await.unwrap();
                // Ends with a reset, so that no port waits.
                SockRef::from(&stream)
                    .set_linger(Some(Duration::ZERO))
                    .unwrap();
            });
            connects.await;
            began.elapsed()
        };
        let (took, cost) = Cost::of(program, storm).await;
        println!("G12: 10,000 connects in {} ms: {cost}", took.as_millis());
        assert!(cost.grown_bytes <= 16 * MIB, "{cost}");
        assert_eq!(http_get(&stage.server, "/healthz").await.text(), "ok\n");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f11_a_server_without_file_descriptors_recovers_by_itself() {
    let server = TestServer::start_program(|_| {}).await;
    beside_a_control_session_of("F11 descriptors", server, async |stage| {
        let program = stage.server.program();
        let id = Pid::from_raw(i32::try_from(program.id()).unwrap());
        let few = Rlimit {
            current: Some(program.n_open_files() as u64 + 8),
            ..getrlimit(Resource::Nofile)
        };
        prlimit(id, Resource::Nofile, few).unwrap();
        let mut held = Vec::new();
        for _ in 0..64 {
            held.push(TcpStream::connect(program.address()).await.unwrap());
        }
        // Nothing can be accepted now; what is open goes on, which the control session shows.
        let waiting = timeout(Duration::from_secs(3), http_get(&stage.server, "/healthz"));
        assert!(
            waiting.await.is_err(),
            "a connection was accepted without a descriptor"
        );
        drop(held);
        let answer = timeout(PATIENCE, http_get(&stage.server, "/metrics"));
        let metrics = answer.await.unwrap();
        let failures = metrics
            .text()
            .lines()
            .find_map(|it| it.strip_prefix("frontalis_accept_failures_total "));
        let n: u64 = failures.unwrap().parse().unwrap();
        println!("F11: accepting failed {n} times, then went on");
        assert!(n >= 1);
    })
    .await;
}
