//! Rows F6 to F10: HTTP/2 frames that cost a server more than they cost a peer, or that make no sense.
//!
//! They go to a program of its own, whose memory is measured; its processor time is printed (CONTRACTS G12).

use std::{
    collections::BTreeMap,
    net::SocketAddr,
    sync::{Arc, Mutex},
};

use frontalis_server::service::listener::ControlFrame;
use harness::{
    Cost, Subscriber, TestServer, every_frame,
    raw_http2::{
        Ended, PREFACE, RawHttp2, flag, frame, get, kind, literal, request_block, take_frame,
    },
};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::{TcpListener, TcpStream},
};
use tonic::transport::Endpoint;

use super::{Stage, beside_a_control_session, beside_a_control_session_of};

const PUBLISH: &str = "/frontalis.v1.CaptureService/PublishMarkers";

const MIB: u64 = 1 << 20;
const KIB: u64 = 1 << 10;

/// More than any flood may take before it is ended.
const ENOUGH_BYTES: usize = 64 << 20;

const NO_ERROR: u32 = 0;
const PROTOCOL_ERROR: u32 = 1;
const FLOW_CONTROL_ERROR: u32 = 3;
const STREAM_CLOSED: u32 = 5;
const REFUSED_STREAM: u32 = 7;
const ENHANCE_YOUR_CALM: u32 = 11;

async fn row(name: &str, test: impl AsyncFnOnce(&Stage)) {
    let server = TestServer::start_program(|_| {}).await;
    beside_a_control_session_of(name, server, test).await;
}

/// Runs an abuse to the end of its connection, says what it cost, and bounds its memory.
async fn abuse(
    stage: &Stage,
    what: &str,
    most_bytes: u64,
    abuse: impl AsyncFnOnce(SocketAddr) -> Ended,
) -> Ended {
    let program = stage.server.program();
    // The first connection of a kind makes what the later ones use.
    answers(stage.server.address()).await;
    let (ended, cost) = Cost::of(program, abuse(program.address())).await;
    println!(
        "G12: {what}: GOAWAY {:?}, {cost}, closed {} ms after the last byte",
        ended.goaways(),
        ended.after.as_millis()
    );
    assert!(cost.grown_bytes <= most_bytes, "{what}: {cost}");
    answers(stage.server.address()).await;
    ended
}

/// Another connection is served as ever.
async fn answers(address: SocketAddr) {
    let mut raw = RawHttp2::open(address, &[]).await;
    assert!(raw.send(&get(1, "/healthz")).await);
    loop {
        let frame = raw.next().await.unwrap();
        if (frame.stream, frame.kind) == (1, kind::DATA) {
            assert_eq!(frame.content, b"ok\n");
            return;
        }
    }
}

/// The beginning of a call that goes on: its headers without an end of the stream.
fn open_call(stream: u32) -> Vec<u8> {
    let block = [
        request_block("POST", PUBLISH),
        literal("content-type", "application/grpc"),
        literal("te", "trailers"),
    ];
    frame(kind::HEADERS, flag::END_HEADERS, stream, &block.concat())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f6_streams_that_are_opened_and_reset_end_the_connection() {
    row("F6", async |stage| {
        let ended = abuse(
            stage,
            "rapid reset, 100,000 streams",
            16 * MIB,
            async |address| {
                let mut raw = RawHttp2::open(address, &[]).await;
                let opened_and_reset = |n: u32| {
                    let stream = 2 * n + 1;
                    let cancel = frame(kind::RST_STREAM, 0, stream, &8_u32.to_be_bytes());
                    [get(stream, "/healthz"), cancel].concat()
                };
                for first in (0..100_000_u32).step_by(1_000) {
                    let block: Vec<u8> =
                        (first..first + 1_000).flat_map(opened_and_reset).collect();
                    if !raw.send(&block).await {
                        break;
                    }
                }
                raw.until_closed().await
            },
        )
        .await;
        assert!(
            ended.goaways().contains(&ENHANCE_YOUR_CALM),
            "{:?}",
            ended.goaways()
        );
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f7_headers_without_an_end_and_beyond_the_limit_cost_little() {
    row("F7", async |stage| {
        let begun = frame(
            kind::HEADERS,
            flag::END_STREAM,
            1,
            &request_block("GET", "/healthz"),
        );
        for (what, content) in [
            ("CONTINUATION frames without content", Vec::new()),
            (
                "CONTINUATION frames of 16 KiB, 16 MiB of headers",
                literal("a", &"b".repeat(120)).repeat(130),
            ),
        ] {
            let ended = abuse(stage, what, 16 * MIB, async |address| {
                let mut raw = RawHttp2::open(address, &[]).await;
                raw.send(&begun).await;
                raw.flood(&frame(kind::CONTINUATION, 0, 1, &content), 16 << 20)
                    .await;
                raw.until_closed().await
            })
            .await;
            assert!(!ended.goaways().is_empty(), "{what}: {:?}", ended.frames);
        }
        // An entry of 4,000 bytes that is remembered, and then named 12,000 times: 48 MB in 16 KiB.
        let mut entry = vec![0x40, 1, b'a', 0x7f, 0xa1, 0x1e];
        entry.extend([b'b'; 4_000]);
        let bomb = [entry, vec![0xbe; 12_000]].concat();
        let fields = literal("a", "b").repeat(10_000);
        for (what, fields) in [
            ("10,000 header fields", fields),
            ("an HPACK bomb of 48 MB", bomb),
        ] {
            let ended = abuse(stage, what, 16 * MIB, async |address| {
                let mut raw = RawHttp2::open(address, &[]).await;
                let block = [request_block("GET", "/healthz"), fields].concat();
                let mut pieces = block.chunks(16_000).peekable();
                let mut bytes = frame(kind::HEADERS, flag::END_STREAM, 1, pieces.next().unwrap());
                while let Some(piece) = pieces.next() {
                    let flags = if pieces.peek().is_none() {
                        flag::END_HEADERS
                    } else {
                        0
                    };
                    bytes.extend(frame(kind::CONTINUATION, flags, 1, piece));
                }
                if bytes.len() <= 16_100 {
                    bytes[4] |= flag::END_HEADERS;
                }
                raw.send(&bytes).await;
                raw.until_closed().await
            })
            .await;
            println!("{what}: {:?}", ended.frames);
            let served = ended.frames.iter().any(|it| it.content == b"ok\n");
            assert!(!served, "{what} was answered");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f8_control_frames_whose_answers_nobody_reads_end_the_connection() {
    row("F8", async |stage| {
        let floods = [
            ("PING", frame(kind::PING, 0, 0, b"12345678")),
            ("SETTINGS", frame(kind::SETTINGS, 0, 0, &[])),
            (
                "WINDOW_UPDATE",
                frame(kind::WINDOW_UPDATE, 0, 0, &1_u32.to_be_bytes()),
            ),
            ("PRIORITY", frame(kind::PRIORITY, 0, 1, &[0, 0, 0, 0, 16])),
            ("unknown frames", frame(0xbe, 0, 0, b"12345678")),
        ];
        for (what, bytes) in floods {
            let ended = abuse(stage, what, MIB, async |address| {
                let mut raw = RawHttp2::open(address, &[]).await;
                let n_sent = raw.flood(&bytes, ENOUGH_BYTES).await;
                assert!(n_sent < ENOUGH_BYTES, "{what}: {n_sent} bytes were taken");
                raw.until_closed().await
            })
            .await;
            // Behind ten thousand answers that nobody reads, the last frame does not get through.
            let got_through = what == "PING" || !ended.goaways().is_empty();
            assert!(got_through, "{what}: {:?}", ended.frames);
        }
        let ping = frame(kind::PING, 0, 0, b"12345678");
        let ended = abuse(stage, "PING, answers read", MIB, async |address| {
            let raw = RawHttp2::open(address, &[]).await;
            raw.flood_and_read(&ping).await
        })
        .await;
        assert_eq!(ended.goaways(), [NO_ERROR]);
        let metrics = harness::http_get(&stage.server, "/metrics").await;
        let ping = "frontalis_connections_flooded_total{frames=\"ping\"} 2\n";
        assert!(metrics.text().contains(ping), "{}", metrics.text());
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f9_data_frames_without_data_end_the_connection() {
    row("F9", async |stage| {
        let ended = abuse(stage, "empty DATA", MIB, async |address| {
            let mut raw = RawHttp2::open(address, &[]).await;
            raw.send(&open_call(1)).await;
            let n_sent = raw.flood(&frame(kind::DATA, 0, 1, &[]), ENOUGH_BYTES).await;
            assert!(n_sent < ENOUGH_BYTES, "{n_sent} bytes were taken");
            raw.until_closed().await
        })
        .await;
        assert!(!ended.goaways().is_empty(), "{:?}", ended.frames);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f10_streams_above_the_limit_are_refused_one_by_one() {
    row("F10 streams", async |stage| {
        let mut raw = RawHttp2::open(stage.server.address(), &[]).await;
        let calls: Vec<u8> = (0..300).flat_map(|n| open_call(2 * n + 1)).collect();
        assert!(raw.send(&calls).await);
        let mut refused = Vec::new();
        while refused.len() < 300 - 256 {
            let frame = raw.next().await.unwrap();
            if frame.kind == kind::RST_STREAM {
                assert_eq!(frame.content, REFUSED_STREAM.to_be_bytes());
                refused.push(frame.stream);
            }
        }
        let above: Vec<u32> = (256..300).map(|n| 2 * n + 1).collect();
        assert_eq!(refused, above);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f10_frames_that_make_no_sense_end_the_connection() {
    row("F10", async |stage| {
        let largest = (u32::MAX >> 1).to_be_bytes();
        let grow = frame(kind::WINDOW_UPDATE, 0, 0, &largest);
        let cases = [
            (
                "a stream's number again",
                [get(3, "/healthz"), get(1, "/healthz")].concat(),
                vec![PROTOCOL_ERROR, STREAM_CLOSED],
            ),
            ("an even number", get(2, "/healthz"), vec![PROTOCOL_ERROR]),
            (
                "data on a stream that is not open",
                frame(kind::DATA, 0, 1, b"x"),
                vec![PROTOCOL_ERROR, STREAM_CLOSED],
            ),
            (
                "a window above 2^31 - 1",
                grow.repeat(2),
                vec![FLOW_CONTROL_ERROR],
            ),
            (
                "more padding than frame",
                [open_call(1), frame(kind::DATA, flag::PADDED, 1, &[9, 0, 0])].concat(),
                vec![PROTOCOL_ERROR],
            ),
            (
                "settings on a stream",
                frame(kind::SETTINGS, 0, 1, &[]),
                vec![PROTOCOL_ERROR],
            ),
        ];
        for (what, bytes, codes) in cases {
            let ended = abuse(stage, what, 256 * KIB, async |address| {
                let mut raw = RawHttp2::open(address, &[]).await;
                raw.send(&bytes).await;
                raw.until_closed().await
            })
            .await;
            let goaways = ended.goaways();
            assert!(
                goaways.iter().any(|it| codes.contains(it)),
                "{what}: {goaways:?} {:?}",
                ended.resets()
            );
        }
    })
    .await;
}

/// How many frames of each kind went by.
type Counts = Arc<Mutex<BTreeMap<u8, u32>>>;

/// Stands before a server, and counts what one client sends; where it listens.
async fn counting_before(server: SocketAddr, counts: Counts) -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    tokio::spawn(async move {
        let (mut client, _) = listener.accept().await.unwrap();
        let mut server = TcpStream::connect(server).await.unwrap();
        let (mut from_client, mut to_client) = client.split();
        let (mut from_server, mut to_server) = server.split();
        let up = async {
            let mut preface = [0; PREFACE.len()];
            from_client.read_exact(&mut preface).await?;
            to_server.write_all(&preface).await?;
            let mut received = Vec::new();
            loop {
                let before = received.len();
                if from_client.read_buf(&mut received).await? == 0 {
                    return std::io::Result::Ok(());
                }
                to_server.write_all(&received[before..]).await?;
                while let Some(frame) = take_frame(&mut received) {
                    *counts.lock().unwrap().entry(frame.kind).or_default() += 1;
                }
            }
        };
        let down = tokio::io::copy(&mut from_server, &mut to_client);
        drop(tokio::join!(up, down));
    });
    address
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_client_of_64_streams_at_120_hz_stays_far_below_the_budgets() {
    const N_STREAMS: u32 = 64;
    const N_FRAMES: u64 = 360;
    beside_a_control_session("F8 budgets", async |stage| {
        let counts = Counts::default();
        let proxy = counting_before(stage.server.address(), counts.clone()).await;
        let endpoint = Endpoint::from_shared(format!("http://{proxy}")).unwrap();
        let channel = endpoint.connect().await.unwrap();
        let mut subscribers = Vec::new();
        for _ in 0..N_STREAMS {
            let channel = harness::TestChannel::new(channel.clone(), harness::Bearer::default());
            let start = every_frame("sessions/control");
            subscribers.push(Subscriber::open_on(channel, start).await.unwrap());
        }
        let first = subscribers[0].samples_through(1).await.unwrap().len();
        assert!(first > 0);
        counts.lock().unwrap().clear();
        let through = N_FRAMES;
        let all = subscribers.iter_mut().map(|it| it.samples_through(through));
        for heard in futures::future::join_all(all).await {
            heard.unwrap();
        }
        let counts = counts.lock().unwrap().clone();
        let secs = N_FRAMES as f64 / 120.0;
        let budgets = [
            (kind::PING, ControlFrame::Ping),
            (kind::WINDOW_UPDATE, ControlFrame::WindowUpdate),
            (kind::SETTINGS, ControlFrame::Settings),
            (kind::RST_STREAM, ControlFrame::Reset),
            (kind::PRIORITY, ControlFrame::Priority),
            (kind::CONTINUATION, ControlFrame::Continuation),
        ];
        for (kind, frames) in budgets {
            let n = counts.get(&kind).copied().unwrap_or_default();
            println!(
                "F8: {N_STREAMS} streams at 120 Hz send {:.0} {} frames a second, {} allowed",
                f64::from(n) / secs,
                frames.name(),
                frames.budget()
            );
            assert!(f64::from(n) / secs <= f64::from(frames.budget()) / 4.0);
        }
    })
    .await;
}
