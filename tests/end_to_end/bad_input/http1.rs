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
async fn f13_nothing_is_read_after_a_request_whose_end_is_not_clear() {
    beside_a_control_session("F13 after", async |stage| {
        let host = "Host: localhost\r\n";
        let get = format!("GET /healthz HTTP/1.1\r\n{host}\r\n");
        let post =
            format!("POST /api/v1/sessions HTTP/1.1\r\n{host}Content-Type: application/json\r\n");
        let chunked = "Transfer-Encoding: chunked\r\n";
        let zeros = "0".repeat(80);
        // What the library alone would take: it does not look into extensions and trailers, or at zeros.
        let unclear = [
            format!("{post}{chunked}\r\n2;\n\r\n{{}}\r\n0\r\n\r\n"),
            format!("{post}{chunked}\r\n2;a=\nb\r\n{{}}\r\n0\r\n\r\n"),
            format!("{post}{chunked}\r\n2\r\n{{}}\r\n0\r\nA: b\n\r\n"),
            format!("{post}{chunked}\r\n2\r\n{{}}\r\n0\r\n\n"),
            format!("{post}{chunked}\r\n{zeros}2\r\n{{}}\r\n0\r\n\r\n"),
            format!("{post}Content-Length: {zeros}2\r\n\r\n{{}}"),
            format!("{post}Content-Length:{}2\r\n\r\n{{}}", " ".repeat(80)),
        ];
        let smuggled = [
            format!("{post}Content-Length: 2\r\nContent-Length: 2\r\n\r\n{{}}"),
            format!("{post}Content-Length: 5\r\n{chunked}\r\n0\r\n\r\n"),
            format!("{post}{chunked}Content-Length: 5\r\n\r\n0\r\n\r\n"),
            get.replace("\r\n", "\n"),
        ];
        for unclear in &unclear {
            for smuggled in &smuggled {
                let sent = format!("{unclear}{smuggled}{get}");
                assert_eq!(statuses(stage, sent.as_bytes()).await, [400], "{sent}");
            }
            // A route that does not read its body answers, and that is the last answer.
            let unread = unclear.replace("/api/v1/sessions", "/healthz");
            let answered = statuses(stage, format!("{unread}{get}").as_bytes()).await;
            assert!(
                matches!(answered[..], [400 | 405]),
                "{unread}: {answered:?}"
            );
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f13_what_is_too_long_is_said_to_be_and_closed() {
    beside_a_control_session("F13 sizes", async |stage| {
        let get = |path: &str, headers: &str| {
            format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n{headers}\r\n")
        };
        let long = |n| format!("/{}", "x".repeat(n));
        let header = |n| format!("A: {}\r\n", "x".repeat(n));
        let cases = [
            ("a path of 9 KiB", get(&long(9 << 10), ""), 414),
            ("a path of 64 KiB", get(&long(64 << 10), ""), 414),
            ("20 KiB of headers", get("/", &header(20 << 10)), 431),
            ("64 KiB of headers", get("/", &header(64 << 10)), 431),
            ("1 MiB of headers", get("/", &header(1 << 20)), 431),
            ("200 headers", get("/", &"A: b\r\n".repeat(200)), 431),
        ];
        let next = get("/healthz", "");
        for (what, sent, status) in cases {
            // Nothing asks the server to close.
            let statuses = statuses(stage, format!("{sent}{next}").as_bytes()).await;
            assert_eq!(statuses, [status], "{what}");
        }
        let close = "Connection: close\r\n";
        let hosts = [
            ("no host", format!("GET / HTTP/1.1\r\n{close}\r\n")),
            (
                "two hosts",
                get("/", &format!("Host: localhost\r\n{close}")),
            ),
        ];
        for (what, sent) in hosts {
            assert_eq!(statuses(stage, sent.as_bytes()).await, [400], "{what}");
        }
    })
    .await;
}
