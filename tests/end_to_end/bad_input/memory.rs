//! Rows E2 and E5: what messages may cost before they are refused, measured on a server of its own process.

use frontalis_proto::v1::{MarkerFrame, PublishMarkersRequest, PublishStart};
use harness::{Problem, RawConnection, TestServer, assert_refused, encoded, framed, prefixed};
use prost::Message as _;
use tonic::Code;

use super::{SUBJECT, beside_a_control_session_of};

const PUBLISH: &str = "/frontalis.v1.CaptureService/PublishMarkers";
const UPDATE: &str = "/frontalis.v1.SessionService/UpdateSession";
const CREATE: &str = "/frontalis.v1.SessionService/CreateSession";

const KIB: u64 = 1 << 10;
const MIB: u64 = 1 << 20;

/// Calls that wait for the rest of a message at once.
const N_WAITING: usize = 200;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e2_a_prefix_larger_than_its_data_ends_in_time_and_reserves_nothing() {
    // The control session keeps samples of its own, the more the longer a busy machine takes: no more than this of them.
    let server = TestServer::start_program(|config| config.limits.window_mib = 1).await;
    beside_a_control_session_of("E2", server, async |stage| {
        let sent_bytes = 1_000;
        for (path, declared_bytes) in [(PUBLISH, 1 << 20), (CREATE, 64 << 10)] {
            let mut connection = RawConnection::open(&stage.server).await;
            let program = stage.server.program();
            let empty = program.resident_bytes();
            let mut calls = Vec::new();
            for _ in 0..N_WAITING {
                calls.push(connection.call(path, &[]).await);
            }
            // Asked behind them, so they have been read.
            connection.answer(path, &framed(b"")).await;
            let (before, before_data) = (program.resident_bytes(), program.data_bytes());
            let content = vec![0x0a; sent_bytes];
            for call in &mut calls {
                call.send(&prefixed(0, declared_bytes, &content)).await;
            }
            connection.answer(path, &framed(b"")).await;
            let grown = program.resident_bytes().saturating_sub(before);
            let reserved = program.data_bytes().saturating_sub(before_data);
            println!(
                "E2: {N_WAITING} calls to {path}: {} KiB while idle, {} KiB more with {} KiB of messages, {} KiB reserved",
                before.saturating_sub(empty) / KIB,
                grown / KIB,
                (N_WAITING * sent_bytes) as u64 / KIB,
                reserved / KIB,
            );
            let allowed = N_WAITING as u64 * (sent_bytes as u64 + 16 * KIB);
            assert!(grown <= allowed, "{grown} bytes held, {allowed} allowed");
            // What is reserved and never written is not resident, and must not be there either.
            assert!(reserved <= allowed, "{reserved} bytes reserved, {allowed} allowed");
            let ended = futures::future::join_all(calls.into_iter().map(harness::RawCall::answer));
            for answer in ended.await {
                let problem = Problem::of(&answer.status());
                assert_eq!(problem.code, Code::DeadlineExceeded, "{problem:?}");
                let reasons = ["MESSAGE_DEADLINE", "START_TIMEOUT"];
                assert!(reasons.contains(&problem.reason.as_str()), "{problem:?}");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e5_messages_that_grow_when_they_are_decoded_cost_less_than_16_mib() {
    let server = TestServer::start_program(|_| {}).await;
    beside_a_control_session_of("E5", server, async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let most = (1 << 20) - 64;
        // An empty frame each; a start whose marker names are all empty; numbers that are not packed, or packed.
        let frames = [0x12, 0].repeat(most / 2);
        let names = nested(1, &[0x1a, 0].repeat(most / 2));
        let loose = nested(2, &[0x25, 0, 0, 0x80, 0x3f].repeat(most / 5));
        let packed = MarkerFrame {
            number: 1,
            positions: vec![1.0; most / 4 - 10],
            ..MarkerFrame::default()
        };
        let packed = PublishMarkersRequest {
            start: Some(PublishStart::default()),
            frames: vec![packed],
            clock: None,
        };
        let echoes = nested(9, &[0x0a, 0].repeat(most / 2));
        let cases = [
            ("empty frames", PUBLISH, frames, "MESSAGE_PARTS"),
            ("empty names", PUBLISH, names, "NAME"),
            ("loose numbers", PUBLISH, loose, "PROTOCOL_ORDER"),
            ("packed numbers", PUBLISH, packed.encode_to_vec(), "NAME"),
            ("unknown messages", PUBLISH, echoes, "PROTOCOL_ORDER"),
            (
                "a mask of empty paths",
                UPDATE,
                nested(4, &[0x0a, 0].repeat(32_000)),
                "NAME",
            ),
            (
                "4 MiB where 64 KiB are taken",
                UPDATE,
                [0x12, 0].repeat(2 << 20),
                "MESSAGE_SIZE",
            ),
        ];
        let program = stage.server.program();
        for (what, path, content, reason) in cases {
            program.forget_peak();
            let before = program.resident_bytes();
            let refused = connection.answer(path, &framed(&content)).await.status();
            let grown = program.peak_resident_bytes().saturating_sub(before);
            println!(
                "E5: {what}, {} KiB: {} KiB at most",
                content.len() as u64 / KIB,
                grown / KIB
            );
            assert_eq!(Problem::of(&refused).reason, reason, "{what}: {refused}");
            assert!(grown <= 16 * MIB, "{what}: {grown} bytes");
        }
        let session = frontalis_proto::v1::GetSessionRequest {
            name: SUBJECT.to_owned(),
        };
        let path = "/frontalis.v1.SessionService/GetSession";
        let answer = connection.answer(path, &encoded(&session)).await.status();
        assert_eq!(answer.code(), Code::Ok);
        let too_many = framed(&[0x12, 0].repeat(4_097));
        let refused = connection.answer(PUBLISH, &too_many).await.status();
        assert_refused(&refused, Code::InvalidArgument, "MESSAGE_PARTS");
    })
    .await;
}

/// A field that holds these bytes.
fn nested(field: u8, content: &[u8]) -> Vec<u8> {
    let mut bytes = vec![field << 3 | 2];
    prost::encoding::encode_varint(content.len() as u64, &mut bytes);
    bytes.extend(content);
    bytes
}
