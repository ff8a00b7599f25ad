//! The control plane of a real server on port 0: what a person or a program does before and after frames flow.

#![expect(
    clippy::unwrap_used,
    reason = "a test may unwrap: its failure is the report"
)]

mod actors;
mod connections;
mod observation;
mod sessions;

use std::time::Duration;

use frontalis_analysis::{format::actor_package, synthesis::reference_face};
use frontalis_proto::v1::{
    self, actor_service_client::ActorServiceClient, session_service_client::SessionServiceClient,
};
use frontalis_server::{
    Server,
    config::{Config, IN_MEMORY},
    run,
    service::{grpc::status::reason_of, listener::bind},
};
use tokio_util::sync::CancellationToken;
use tonic::{Status, transport::Channel};

/// A running server and a connection to it.
struct Stage {
    server: Server,
    shutdown: CancellationToken,
    channel: Channel,
}

impl Stage {
    async fn in_memory() -> Self {
        Self::with(|_| {}).await
    }

    async fn with(change: impl FnOnce(&mut Config)) -> Self {
        let mut config = Config {
            listen: ([127, 0, 0, 1], 0).into(),
            data_dir: IN_MEMORY.to_owned(),
            ..Config::default()
        };
        change(&mut config);
        let listener = bind(config.listen, &config.transport).unwrap();
        let shutdown = CancellationToken::new();
        let server = run(config, listener, shutdown.clone()).await.unwrap();
        let endpoint = format!("http://{}", server.address());
        let channel = Channel::from_shared(endpoint)
            .unwrap()
            .connect()
            .await
            .unwrap();
        Self {
            server,
            shutdown,
            channel,
        }
    }

    fn actors(&self) -> ActorServiceClient<Channel> {
        ActorServiceClient::new(self.channel.clone())
            .max_decoding_message_size(2 << 20)
            .max_encoding_message_size(4 << 20)
    }

    fn sessions(&self) -> SessionServiceClient<Channel> {
        SessionServiceClient::new(self.channel.clone())
    }

    async fn import(&self, id: &str, package: &[u8]) -> Result<v1::ImportActorResponse, Status> {
        let answered = self
            .actors()
            .import_actor(futures::stream::iter(import(id, package)))
            .await;
        answered.map(tonic::Response::into_inner)
    }

    /// Imports the reference actor and creates a session of it.
    async fn create(&self, session_id: &str) -> v1::Session {
        self.import("reference", &reference_package())
            .await
            .unwrap();
        self.sessions()
            .create_session(create(session_id))
            .await
            .unwrap()
            .into_inner()
            .session
            .unwrap()
    }

    async fn get(&self, path: &str) -> (u16, String) {
        http_get(self.server.address(), path).await
    }

    /// Stops the server; whether nothing had to be cut.
    async fn stop(self) -> bool {
        drop(self.channel);
        self.shutdown.cancel();
        self.server.stopped().await
    }
}

fn reference_package() -> Vec<u8> {
    actor_package::write_zip(&reference_face::actor())
}

fn import(id: &str, package: &[u8]) -> Vec<v1::ImportActorRequest> {
    let start = v1::ImportActorStart {
        actor_id: id.to_owned(),
        ..Default::default()
    };
    with_start(start, package)
}

fn with_start(start: v1::ImportActorStart, package: &[u8]) -> Vec<v1::ImportActorRequest> {
    let first = v1::ImportActorRequest {
        start: Some(start),
        chunk: Vec::new(),
    };
    let chunk = |bytes: &[u8]| v1::ImportActorRequest {
        start: None,
        chunk: bytes.to_vec(),
    };
    std::iter::once(first)
        .chain(package.chunks(100_000).map(chunk))
        .collect()
}

fn create(session_id: &str) -> v1::CreateSessionRequest {
    v1::CreateSessionRequest {
        session_id: session_id.to_owned(),
        actor: "actors/reference".to_owned(),
        kind: v1::CaptureKind::Markers.into(),
        ..Default::default()
    }
}

fn refusal<T: std::fmt::Debug>(answer: Result<T, Status>) -> (tonic::Code, String) {
    let status = answer.unwrap_err();
    (status.code(), reason_of(&status).unwrap_or_default())
}

/// One request over HTTP/1, its status and its body.
async fn http_get(address: std::net::SocketAddr, path: &str) -> (u16, String) {
    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
    let mut stream = tokio::net::TcpStream::connect(address).await.unwrap();
    let request = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut answer = String::new();
    let read = stream.read_to_string(&mut answer);
    tokio::time::timeout(Duration::from_secs(20), read)
        .await
        .unwrap()
        .unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    let status = head.split(' ').nth(1).unwrap().parse().unwrap();
    (status, body.to_owned())
}
