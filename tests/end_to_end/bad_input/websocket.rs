//! Row E13: WebSocket frames that a library refuses to send, over a bare connection; and rows E3 to E5 where messages come in them.
//!
//! The half that takes its time (no pong for 30 s, fragments of nothing) runs beside the conversation itself, on a paused
//! clock.

use harness::{SocketFrame, SocketFrames, TestServer, assert_eventually};

use super::{SUBJECT, beside_a_control_session};

const JSON: &str = "frontalis.v1.subscribe+json";
const PROTOBUF: &str = "frontalis.v1.subscribe+proto";
const PUBLISH: &str = "frontalis.v1.publish+json";
const PUBLISH_PROTOBUF: &str = "frontalis.v1.publish+proto";

/// Sends `frames` on a new socket of the subject: the close code, and the reason.
async fn closed_after(server: &TestServer, subprotocol: &str, frames: &[Vec<u8>]) -> (u16, String) {
    let mut socket = SocketFrames::open(server, "subject", subprotocol).await;
    for frame in frames {
        // The server may have closed before all of it is out.
        if socket.send(frame).await.is_err() {
            break;
        }
    }
    let mut last_text = String::new();
    loop {
        match socket.next().await {
            SocketFrame::Text(text) => last_text = text,
            SocketFrame::Close(code, reason) => {
                let named = format!("urn:frontalis:problem:{reason}");
                assert!(last_text.contains(&named), "{last_text}");
                return (code, reason);
            }
            SocketFrame::Other => {}
        }
    }
}

fn text(payload: &[u8]) -> Vec<u8> {
    SocketFrames::frame(0x81, payload)
}

fn closed(code: u16, reason: &str) -> (u16, String) {
    (code, reason.to_owned())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e13_the_other_kind_of_message_is_closed_with_1003() {
    beside_a_control_session("E13 kind", async |stage| {
        let binary = SocketFrames::frame(0x82, b"\x10\x02");
        for (subprotocol, frame) in [
            (JSON, binary.clone()),
            (PUBLISH, binary),
            (PROTOBUF, text(b"{}")),
        ] {
            let answer = closed_after(&stage.server, subprotocol, &[frame]).await;
            assert_eq!(answer, closed(1003, "MESSAGE_FORM"), "{subprotocol}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e13_a_frame_of_64_mib_is_closed_with_1009_before_it_comes() {
    beside_a_control_session("E13 size", async |stage| {
        let mut header = vec![0x81, 0xff];
        header.extend((64_u64 << 20).to_be_bytes());
        header.extend([0; 4]);
        for subprotocol in [JSON, PUBLISH] {
            let answer = closed_after(&stage.server, subprotocol, &[header.clone()]).await;
            assert_eq!(answer, closed(1009, "MESSAGE_SIZE"), "{subprotocol}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e13_endless_fragments_are_closed_with_1009() {
    beside_a_control_session("E13 fragments", async |stage| {
        let piece = vec![b' '; 32 * 1024];
        let mut frames = vec![SocketFrames::frame(0x01, &piece)];
        // 64 MiB, if nobody stopped it.
        frames.extend(std::iter::repeat_n(
            SocketFrames::frame(0x00, &piece),
            2_048,
        ));
        let answer = closed_after(&stage.server, PUBLISH, &frames).await;
        assert_eq!(answer, closed(1009, "MESSAGE_SIZE"));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e13_frames_against_the_protocol_are_closed_with_1002() {
    beside_a_control_session("E13 protocol", async |stage| {
        for (what, frame) in [
            ("reserved bits", SocketFrames::frame(0xf1, b"{}")),
            (
                "compressed without an agreement",
                SocketFrames::frame(0xc1, b"{}"),
            ),
            ("a reserved opcode", SocketFrames::frame(0x83, b"{}")),
            ("a reserved control frame", SocketFrames::frame(0x8b, b"")),
            ("a fragmented ping", SocketFrames::frame(0x09, b"")),
            ("a long ping", SocketFrames::frame(0x89, &[0; 126])),
            (
                "a continuation of nothing",
                SocketFrames::frame(0x80, b"{}"),
            ),
            ("no mask", vec![0x81, 2, b'{', b'}']),
        ] {
            let answer = closed_after(&stage.server, JSON, &[frame]).await;
            assert_eq!(answer, closed(1002, "WEBSOCKET"), "{what}");
        }
        let answer = closed_after(&stage.server, JSON, &[text(b"\xc3\x28")]).await;
        assert_eq!(answer, closed(1007, "UTF8"));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e13_a_ping_flood_is_closed_and_leaves_nothing() {
    beside_a_control_session("E13 pings", async |stage| {
        let pings = SocketFrames::frame(0x89, &[0; 125]).repeat(10_000);
        let answer = closed_after(&stage.server, PROTOBUF, &[pings]).await;
        assert_eq!(answer, closed(1008, "PING_FLOOD"));
        let nobody = async || {
            let status = stage.server.session(SUBJECT).await.status.unwrap();
            status.subscribers.is_empty()
        };
        assert_eventually!(nobody().await);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e3_bytes_that_are_no_protobuf_are_closed_with_1007() {
    beside_a_control_session("E3 WebSocket", async |stage| {
        let unreadable: [&[u8]; 4] = [&[0xff; 11], &[0x0a, 0x80], &[0x0a, 0x05, b'x'], &[0x02, 0]];
        for subprotocol in [PROTOBUF, PUBLISH_PROTOBUF] {
            for bytes in unreadable {
                let frame = SocketFrames::frame(0x82, bytes);
                let answer = closed_after(&stage.server, subprotocol, &[frame]).await;
                assert_eq!(
                    answer,
                    closed(1007, "PROTOBUF"),
                    "{subprotocol}: {bytes:x?}"
                );
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e4_groups_nested_thirty_thousand_deep_are_closed_with_1007() {
    beside_a_control_session("E4 WebSocket", async |stage| {
        let groups = SocketFrames::frame(0x82, &[0xa3, 0x06].repeat(30_000));
        for subprotocol in [PROTOBUF, PUBLISH_PROTOBUF] {
            let answer =
                closed_after(&stage.server, subprotocol, std::slice::from_ref(&groups)).await;
            assert_eq!(answer, closed(1007, "PROTOBUF"), "{subprotocol}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e5_messages_that_would_grow_when_they_are_decoded_are_refused_before() {
    beside_a_control_session("E5 WebSocket", async |stage| {
        let parts = SocketFrames::frame(0x82, &[0x12, 0].repeat(30_000));
        let answer = closed_after(&stage.server, PUBLISH_PROTOBUF, &[parts]).await;
        assert_eq!(answer, closed(1008, "MESSAGE_PARTS"));
        let objects = format!("{{\"frames\":[{}{{}}]}}", "{},".repeat(20_000));
        let answer = closed_after(&stage.server, PUBLISH, &[text(objects.as_bytes())]).await;
        assert_eq!(answer, closed(1008, "FRAME_COUNT"));
    })
    .await;
}
