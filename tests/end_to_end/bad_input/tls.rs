//! Row F12: what is no TLS, stalls, or shows a certificate that is not believed; and a new certificate while frames flow.

use std::{net::SocketAddr, path::Path, process::Stdio};

use frontalis_server::{config::Config, service::audit::FILE_NAME};
use harness::{ClientCert, TestAuthority, TestServer, TestTls, assert_eventually};
use rustls::{ClientConnection, pki_types::ServerName};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    process::Command,
    time::timeout,
};

use super::{
    beside_a_control_session_of,
    connections::{LONG_SECS, PATIENCE, closed_after},
};

const HTTP1: [&str; 1] = ["http/1.1"];

/// A server that speaks TLS, and a harness that does.
async fn server(authority: &TestAuthority, change: impl FnOnce(&mut Config)) -> TestServer {
    let server = TestServer::start_with(|config| {
        (config.tls.cert, config.tls.key) = authority.server_files(&["127.0.0.1"]);
        // What is no handshake is closed by this deadline, and by no other.
        config.transport.handshake_deadline_secs = 1;
        config.transport.header_deadline_secs = LONG_SECS;
        change(config);
    });
    server
        .await
        .spoken_to_over(authority.believer(None, &["h2"]))
}

/// The first bytes that a real client sends.
fn hello(tls: &TestTls, address: SocketAddr) -> Vec<u8> {
    let name = ServerName::from(address.ip());
    let mut client = ClientConnection::new(tls.config(), name).unwrap();
    let mut bytes = Vec::new();
    client.write_tls(&mut bytes).unwrap();
    bytes
}

/// `GET path` over TLS; none when the server refuses the client.
async fn get(tls: &TestTls, address: SocketAddr, path: &str) -> Option<String> {
    let mut stream = tls.connect(address).await.ok()?;
    let request = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).await.ok()?;
    let mut answer = String::new();
    let read = timeout(PATIENCE, stream.read_to_string(&mut answer)).await;
    read.unwrap().ok()?;
    Some(answer)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f12_what_is_no_handshake_is_closed_in_time() {
    let authority = TestAuthority::new("authority");
    let server = server(&authority, |_| {}).await;
    beside_a_control_session_of("F12 handshakes", server, async |stage| {
        let address = stage.server.address();
        let client = authority.believer(None, &HTTP1);
        let hello = hello(&client, address);
        let ssl3 = [0x16, 3, 0, 0, 45, 1, 0, 0, 41, 3, 0];
        let tls1 = [
            &[0x16, 3, 1, 0, 47, 1, 0, 0, 43, 3, 1][..],
            &[7; 32],
            &[0, 0, 4, 0, 47, 0, 53, 1, 0],
        ]
        .concat();
        let cases: [(&str, Vec<u8>); 8] = [
            (
                "plain text",
                b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n".to_vec(),
            ),
            (
                "the preface of HTTP/2",
                harness::raw_http2::PREFACE.to_vec(),
            ),
            ("garbage", vec![0xff; 4_096]),
            ("a hello of SSL 3", [&ssl3[..], &[0; 50]].concat()),
            ("a hello of TLS 1.0", tls1),
            (
                "garbage after the hello",
                [&hello, &[0xff; 100][..]].concat(),
            ),
            (
                "half a hello, then nothing",
                hello[..hello.len() / 2].to_vec(),
            ),
            ("nothing", Vec::new()),
        ];
        for (what, said) in cases {
            let after = closed_after(address, &said).await;
            println!(
                "F12: {what}: closed after {} ms, 1 s allowed",
                after.as_millis()
            );
        }
        let metrics = get(&client, address, "/metrics").await.unwrap();
        for why in ["protocol", "stalled"] {
            let counted = format!("frontalis_tls_handshake_failures_total{{why=\"{why}\"}}");
            assert!(metrics.contains(&counted), "{metrics}");
        }
    })
    .await;
}

/// TLS 1.3 has no renegotiation; of TLS 1.2 the library speaks none, and no second handshake follows.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f12_a_renegotiation_is_refused() {
    let Some(version) = openssl(&["version"], "").await else {
        println!("left out: f12_a_renegotiation_is_refused: openssl is not installed");
        return;
    };
    println!("F12: {}", version.trim());
    let authority = TestAuthority::new("authority");
    // A refused renegotiation is no request: the connection ends as one that asks for nothing.
    let server = server(&authority, |config| {
        config.transport.header_deadline_secs = 1;
    })
    .await;
    beside_a_control_session_of("F12 renegotiation", server, async |stage| {
        let address = stage.server.address().to_string();
        let ca = authority.ca_file();
        let shake = ["s_client", "-connect", &address, "-CAfile", &ca, "-tls1_2"];
        // `R` at the beginning of a line begins one.
        let said = openssl(&shake, "R\n").await.unwrap();
        assert!(said.contains("New, TLSv1.2"), "{said}");
        let (_, after) = said.split_once("RENEGOTIATING").unwrap();
        assert!(after.contains("error:"), "{said}");
        assert!(!after.contains("verify return"), "{said}");
    })
    .await;
}

/// What a third party's client says; none when it is not there.
async fn openssl(args: &[&str], typed: &str) -> Option<String> {
    let mut child = Command::new("openssl")
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .kill_on_drop(true)
        .spawn()
        .ok()?;
    let mut stdin = child.stdin.take().unwrap();
    // It may have ended before it was told anything.
    drop(stdin.write_all(typed.as_bytes()).await);
    // Held open: with its end the client would not wait for an answer.
    let output = timeout(PATIENCE, child.wait_with_output()).await.unwrap();
    drop(stdin);
    let output = output.unwrap();
    let said = [output.stdout, output.stderr].concat();
    Some(String::from_utf8_lossy(&said).into_owned())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f12_certificates_of_clients_that_are_not_believed_are_refused() {
    let (authority, other) = (TestAuthority::new("authority"), TestAuthority::new("other"));
    let revoked = authority.client("revoked", 7, 2100);
    let (ca, crl) = (authority.ca_file(), authority.revoked_file(&[&revoked]));
    let mut data_dir = String::new();
    let server = server(&authority, |config| {
        (config.tls.client_ca, config.tls.client_crl) = (ca, crl);
        data_dir.clone_from(&config.data_dir);
    });
    beside_a_control_session_of("F12 certificates", server.await, async |stage| {
        let address = stage.server.address();
        let good = authority.client("good", 8, 2100);
        let answer = async |shown: Option<&ClientCert>| {
            let client = authority.believer(shown, &HTTP1);
            get(&client, address, "/metrics").await
        };
        assert!(answer(None).await.is_some(), "a certificate was demanded");
        assert!(answer(Some(&good)).await.is_some());
        let refused = [
            ("expired", authority.client("expired", 9, 2021)),
            ("of another authority", other.client("other", 10, 2100)),
            ("revoked", revoked),
        ];
        for (what, certificate) in &refused {
            assert_eq!(answer(Some(certificate)).await, None, "{what}");
        }
        let counted = "frontalis_tls_handshake_failures_total{why=\"certificate\"} 3\n";
        let metrics = answer(None).await.unwrap();
        assert!(metrics.contains(counted), "{metrics}");
        let audit = Path::new(&data_dir).join(FILE_NAME);
        for why in ["expired", "issued by an authority", "revoked"] {
            let is_noted = || {
                let text = std::fs::read_to_string(&audit).unwrap();
                text.lines()
                    .any(|it| it.contains("auth_failure") && it.contains(why))
            };
            assert_eventually!(is_noted(), "{why} is no line of the audit log");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_new_certificate_is_shown_to_new_connections_and_open_ones_go_on() {
    let authority = TestAuthority::new("authority");
    let server = server(&authority, |_| {}).await;
    beside_a_control_session_of("TLS reload", server, async |stage| {
        let address = stage.server.address();
        let client = authority.believer(None, &HTTP1);
        let shown = async || {
            let stream = client.connect(address).await.unwrap();
            stream.get_ref().1.peer_certificates().unwrap()[0].clone()
        };
        let before = shown().await;
        authority.server_files(&["127.0.0.1"]);
        assert_eventually!(shown().await != before);
        // It is counted after it is shown.
        let taken = "frontalis_tls_certificate_reloads_total{taken=\"yes\"} 1\n";
        let metrics = async || get(&client, address, "/metrics").await.unwrap();
        assert_eventually!(metrics().await.contains(taken));
    })
    .await;
}
