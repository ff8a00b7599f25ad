//! Row F13: HTTP/1 requests whose end two readers would see at two places, and those that are too long.

use std::time::Duration;

use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    time::timeout,
};

use super::{Stage, beside_a_control_session};

const PATIENCE: Duration = Duration::from_secs(30);

/// The statuses that these bytes get before the server closes.
async fn statuses(stage: &Stage, sent: &[u8]) -> Vec<u16> {
    let mut stream = TcpStream::connect(stage.server.address()).await.unwrap();
    // The server may have closed before it has read all.
    drop(stream.write_all(sent).await);
    let mut answer = Vec::new();
    // A reset is a close too.
    drop(
        timeout(PATIENCE, stream.read_to_end(&mut answer))
            .await
            .unwrap(),
    );
    let answer = String::from_utf8_lossy(&answer).into_owned();
    let lines = answer.split("HTTP/1.1 ").skip(1);
    lines.map(|it| it[..3].parse().unwrap()).collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f13_requests_that_smuggle_others_are_refused_and_the_connection_closed() {
    beside_a_control_session("F13 smuggling", async |stage| {
        let hidden = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
        let post = "POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n";
        let shapes = [
            format!("{post}Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n{hidden}"),
            format!("{post}Transfer-Encoding: chunked\r\nContent-Length: 5\r\n\r\n0\r\n\r\n{hidden}"),
            format!("{post}Content-Length: 0\r\nContent-Length: {}\r\n\r\n{hidden}", hidden.len()),
            format!("{post}Content-Length: 2\r\nContent-Length: 2\r\n\r\n{{}}{hidden}"),
            format!("{post}Content-Length: +2\r\n\r\n{{}}{hidden}"),
            format!("{post}Content-Length: 2, 2\r\n\r\n{{}}{hidden}"),
            format!("{post}Transfer-Encoding: chunked, identity\r\n\r\n0\r\n\r\n{hidden}"),
            format!("{post}Transfer-Encoding : chunked\r\n\r\n0\r\n\r\n{hidden}"),
            format!("GET /healthz HTTP/1.1\nHost: localhost\n\n{hidden}"),
            format!("GET /healthz HTTP/1.1\r\nHost: localhost\nX: y\r\n\r\n{hidden}"),
            format!("GET /healthz HTTP/1.1\r\nHost: localhost\r\n folded: x\r\n\r\n{hidden}"),
            format!("GET /healthz HTTP/1.1\r\nHost: localhost\r\nX: a\0b\r\n\r\n{hidden}"),
        ];
        for shape in shapes {
            let statuses = statuses(stage, shape.as_bytes()).await;
            assert_eq!(statuses, [400], "{shape}");
        }
        let second = format!("{hidden}GET /healthz HTTP/1.1\nHost: localhost\n\n{hidden}");
        assert_eq!(statuses(stage, second.as_bytes()).await, [200, 400]);
        let clear = hidden.replace("\r\n\r\n", "\r\nConnection: close\r\n\r\n");
        assert_eq!(statuses(stage, format!("{hidden}{clear}").as_bytes()).await, [200, 200]);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f13_chunks_that_are_larger_than_any_body_are_refused() {
    beside_a_control_session("F13 chunks", async |stage| {
        let post = "POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n";
        for chunk in ["ffffffffffffffff\r\nx", "fffffffffffffffff\r\nx", "-1\r\nx", "2\n{}\r\n0\r\n\r\n"] {
            let statuses = statuses(stage, format!("{post}{chunk}").as_bytes()).await;
            assert_eq!(statuses, [400], "{chunk}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f13_what_is_too_long_is_said_to_be() {
    beside_a_control_session("F13 sizes", async |stage| {
        let get = |path: &str, headers: &str| {
            format!("GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n{headers}\r\n")
        };
        let long = |n| format!("/{}", "x".repeat(n));
        let cases = [
            ("a path of 9 KiB", get(&long(9 << 10), ""), vec![414]),
            // The library reads 64 KiB of a head and looks no further.
            ("a path of 64 KiB", get(&long(64 << 10), ""), vec![414, 431]),
            (
                "20 KiB of headers",
                get("/", &format!("A: {}\r\n", "x".repeat(20 << 10))),
                vec![431],
            ),
            (
                "1 MiB of headers",
                get("/", &format!("A: {}\r\n", "x".repeat(1 << 20))),
                vec![431],
            ),
            ("200 headers", get("/", &"A: b\r\n".repeat(200)), vec![431]),
            (
                "no host",
                "GET / HTTP/1.1\r\nConnection: close\r\n\r\n".to_owned(),
                vec![400],
            ),
            ("two hosts", get("/", "Host: localhost\r\n"), vec![400]),
        ];
        for (what, sent, allowed) in cases {
            let statuses = statuses(stage, sent.as_bytes()).await;
            // The answer to what was not read to its end may be lost with the connection.
            let lost = statuses.is_empty() && sent.len() > 64 << 10;
            assert!(
                lost || statuses.iter().all(|it| allowed.contains(it)),
                "{what}: {statuses:?}"
            );
            assert!(lost || statuses.len() == 1, "{what}: {statuses:?}");
        }
    })
    .await;
}
