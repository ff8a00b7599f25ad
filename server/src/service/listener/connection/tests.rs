//! Rows F1, F2 and F12: connections that do not begin, stall or fall silent, on a paused clock and with the defaults.

use std::sync::Arc;

use axum::routing::get;
use rustls::{
    ClientConfig, RootCertStore,
    crypto::ring,
    pki_types::{CertificateDer, ServerName, pem::PemObject as _},
};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream, duplex},
    time::Instant,
};
use tokio_rustls::TlsConnector;

use super::{
    super::{admission::Admission, tls::tests::Folder},
    *,
};

const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
/// A frame of settings that names none.
const SETTINGS: &[u8] = &[0, 0, 0, 4, 0, 0, 0, 0, 0];
const NAME: &str = "rig.example";

/// What the network holds between the two: all that the server may say.
const BUFFER_BYTES: usize = 64 * 1024;

fn connections(config: &Config, tls: Option<Tls>) -> Connections {
    Connections {
        router: Router::new().route("/", get(|| async { "ok" })),
        tls,
        http: http(config),
        liveness: Liveness::new(&config.transport),
        handshake_deadline: Duration::from_secs(config.transport.handshake_deadline_secs),
        header_deadline: Duration::from_secs(config.transport.header_deadline_secs),
        metrics: Metrics::new("test"),
        audit: Audit::none(),
        phases: Phases::default(),
        tasks: TaskTracker::new(),
    }
}

fn about(connections: &Connections) -> About {
    let peer = SocketAddr::from(([127, 0, 0, 1], 9));
    let admission = Admission::new(&Config::default().limits, connections.metrics.clone());
    let permit = admission.admit(peer.ip()).unwrap();
    About {
        local: None,
        peer,
        certificate: None,
        open: OpenConnection::new(permit, connections.tasks.token()),
    }
}

/// How long a connection is served whose client does this, and then reads without a word.
async fn closed_after(tls: Option<Tls>, client: impl AsyncFnOnce(&mut DuplexStream)) -> Duration {
    let connections = connections(&Config::default(), tls);
    let (mut peer, stream) = duplex(BUFFER_BYTES);
    let about = about(&connections);
    let began = Instant::now();
    let serving = tokio::spawn(async move {
        match &connections.tls {
            None => connections.serve(stream, about).await,
            Some(tls) => connections.serve_tls(tls, stream, about).await,
        }
        began.elapsed()
    });
    client(&mut peer).await;
    let mut answer = Vec::new();
    peer.read_to_end(&mut answer).await.unwrap();
    drop(peer);
    serving.await.unwrap()
}

async fn closed_after_saying(said: &[u8]) -> Duration {
    closed_after(None, async |peer| peer.write_all(said).await.unwrap()).await
}

#[tokio::test(start_paused = true)]
async fn f1_a_connection_that_does_not_begin_is_closed_after_five_seconds() {
    for said in [
        &b""[..],
        &PREFACE[..12],
        &PREFACE[..23],
        b"GET / HTTP/1.1\r\nHost: lo",
    ] {
        let after = closed_after_saying(said).await;
        assert_eq!(after.as_secs(), 5, "{}", said.escape_ascii());
    }
}

#[tokio::test(start_paused = true)]
async fn f2_a_connection_that_falls_silent_is_closed_within_fifteen_seconds() {
    let begun = [PREFACE, SETTINGS].concat();
    assert_eq!(closed_after_saying(&begun).await.as_secs(), 15);
    let answered = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
    assert_eq!(closed_after_saying(answered).await.as_secs(), 5);
}

#[tokio::test(start_paused = true)]
async fn f12_a_handshake_that_stalls_is_closed_after_five_seconds() {
    let folder = Folder::with(&[NAME]);
    // A record of 512 bytes, which begins like a hello.
    let half_a_hello = [0x16, 3, 1, 2, 0, 1, 0, 1, 252, 3, 3];
    for said in [&b""[..], &half_a_hello] {
        let tls = Tls::load(&folder.paths()).unwrap();
        let after = closed_after(Some(tls), async |peer| peer.write_all(said).await.unwrap()).await;
        assert_eq!(after.as_secs(), 5, "{}", said.escape_ascii());
    }
}

#[tokio::test(start_paused = true)]
async fn f1_a_connection_that_only_shakes_hands_is_closed_within_ten_seconds() {
    let folder = Folder::with(&[NAME]);
    let tls = Tls::load(&folder.paths()).unwrap();
    let mut roots = RootCertStore::empty();
    let certificate = CertificateDer::from_pem_file(folder.path("cert.pem")).unwrap();
    roots.add(certificate).unwrap();
    let provider = Arc::new(ring::default_provider());
    let config = ClientConfig::builder_with_provider(provider)
        .with_safe_default_protocol_versions()
        .unwrap()
        .with_root_certificates(roots)
        .with_no_client_auth();
    let connector = TlsConnector::from(Arc::new(config));
    let after = closed_after(Some(tls), async |peer| {
        let name = ServerName::try_from(NAME).unwrap();
        connector.connect(name, peer).await.unwrap();
    })
    .await;
    assert!((5..=10).contains(&after.as_secs()), "{after:?}");
}
