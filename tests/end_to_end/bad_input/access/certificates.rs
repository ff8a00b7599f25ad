//! A client certificate that is revoked while its connections are open.

use harness::{TestAuthority, TestServer, assert_eventually};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    time::{Duration, Instant, timeout},
};
use tokio_rustls::client::TlsStream;

use super::super::beside_a_control_session_of;

const PATIENCE: Duration = Duration::from_mins(1);

const RULE: &str =
    "\n[[certificate]]\ncommon_name = \"renderer-1\"\nrole = \"renderer\"\nsessions = [\"*\"]\n";

async fn ask(stream: &mut TlsStream<TcpStream>, path: &str) {
    let request = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n");
    stream.write_all(request.as_bytes()).await.unwrap();
}

/// Reads until this was said; false when the server closes before.
async fn hears(stream: &mut TlsStream<TcpStream>, expected: &str) -> bool {
    let mut said = Vec::new();
    let hear = async {
        loop {
            if String::from_utf8_lossy(&said).contains(expected) {
                return true;
            }
            if stream.read_buf(&mut said).await.unwrap_or(0) == 0 {
                return false;
            }
        }
    };
    timeout(PATIENCE, hear).await.unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i4_a_revoked_certificate_ends_streams_and_requests_of_open_connections() {
    let authority = TestAuthority::new("authority");
    let shown = authority.client("renderer-1", 7, 2100);
    let mut server = TestServer::start_guarded(|config| {
        (config.tls.cert, config.tls.key) = authority.server_files(&["127.0.0.1"]);
        config.tls.client_ca = authority.ca_file();
        config.tls.client_crl = authority.revoked_file(&[]);
    })
    .await
    .spoken_to_over(authority.believer(None, &["h2"]));
    let text = server.keys().file().to_toml() + RULE;
    server.keys().write_text(&text);
    server.reload();
    beside_a_control_session_of("I4 certificates", server, async |stage| {
        let address = stage.server.address();
        let client = authority.believer(Some(&shown), &["http/1.1"]);
        let is_let_in = async || {
            let mut stream = client.connect(address).await.unwrap();
            ask(&mut stream, "/api/v1/server").await;
            hears(&mut stream, "HTTP/1.1").await
                && hears(&mut stream, "\"name\":\"renderer-1\"").await
        };
        assert_eventually!(is_let_in().await);
        let mut events = client.connect(address).await.unwrap();
        ask(
            &mut events,
            "/api/v1/sessions/subject/events?delivery=every_frame",
        )
        .await;
        assert!(hears(&mut events, "200 OK").await);
        let mut kept = client.connect(address).await.unwrap();
        ask(&mut kept, "/api/v1/server").await;
        assert!(hears(&mut kept, "200 OK").await);

        authority.revoked_file(&[&shown]);
        stage.server.reload();
        let revoked_at = Instant::now();
        // Asked all the time: an idle connection is closed for another reason.
        let is_refused = async |stream: &mut TlsStream<TcpStream>| {
            ask(stream, "/api/v1/server").await;
            let mut said = Vec::new();
            loop {
                assert_ne!(stream.read_buf(&mut said).await.unwrap(), 0);
                let said = String::from_utf8_lossy(&said);
                if said.contains("401 Unauthorized") || said.contains("\"name\":\"renderer-1\"") {
                    return said.contains("401 Unauthorized");
                }
            }
        };
        assert_eventually!(is_refused(&mut kept).await);
        assert!(hears(&mut events, "urn:frontalis:problem:UNAUTHENTICATED").await);
        let after = revoked_at.elapsed();
        println!(
            "I4: events ended {:.1} s after their certificate was revoked",
            after.as_secs_f64()
        );
        assert!(after < Duration::from_secs(30), "{after:?}");
    })
    .await;
}
