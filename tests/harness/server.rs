//! A whole server inside the test: the real listener on port 0, a folder of its own, stopped by a value.

use std::{net::SocketAddr, path::Path, sync::Arc};

use frontalis_proto::v1::{
    Actor, CreateSessionRequest, EndSessionRequest, GetSessionRequest, ImportActorRequest,
    ImportActorResponse, ImportActorStart, Session, SessionSettings,
    actor_service_client::ActorServiceClient, session_service_client::SessionServiceClient,
    take_service_client::TakeServiceClient,
};
use frontalis_server::{
    Ground, Server,
    config::{Config, IN_MEMORY},
    fs::Fs,
    service::listener::Incoming,
};
use tempfile::TempDir;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use tonic::{
    Status,
    service::interceptor::InterceptedService,
    transport::{Channel, Endpoint},
};

use crate::{
    keys::{Bearer, Keys},
    server_program::ServerProgram,
    tls::TestTls,
};

/// Size of an import's chunks.
const CHUNK_BYTES: usize = 256 * 1024;

/// A connection that shows the token of the harness, where the server asks for one.
pub type TestChannel = InterceptedService<Channel, Bearer>;

/// A server that lives as long as the test wants it to.
pub struct TestServer {
    config: Config,
    folder: TempDir,
    running: Running,
    keys: Option<Keys>,
    tls: Option<TestTls>,
}

/// A program that is gone, and its folder.
pub struct StoppedServer {
    config: Config,
    folder: TempDir,
}

impl StoppedServer {
    /// Starts another on the same folder.
    pub async fn start_again(self) -> TestServer {
        let file = self.folder.path().join("frontalis.toml");
        let started = tokio::task::spawn_blocking(move || ServerProgram::start(&file));
        TestServer {
            running: Running::Program(Box::new(started.await.unwrap())),
            config: self.config,
            folder: self.folder,
            keys: None,
            tls: None,
        }
    }
}

/// In this process, or a program of its own.
enum Running {
    Inside {
        server: Server,
        shutdown: CancellationToken,
    },
    Program(Box<ServerProgram>),
}

impl TestServer {
    /// Starts with the defaults, an empty folder and a free port.
    pub async fn start() -> Self {
        Self::start_with(|_| {}).await
    }

    /// Starts with other settings than the defaults.
    pub async fn start_with(change: impl FnOnce(&mut Config)) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut config = Config {
            listen: SocketAddr::from(([127, 0, 0, 1], 0)),
            data_dir: folder.path().to_str().unwrap().to_owned(),
            ..Config::default()
        };
        change(&mut config);
        let running = spawn(&config).await;
        Self {
            config,
            folder,
            running,
            keys: None,
            tls: None,
        }
    }

    /// Starts one that forgets everything but its takes, which it keeps here.
    pub async fn start_on(files: Arc<dyn Fs>) -> Self {
        let config = Config {
            listen: SocketAddr::from(([127, 0, 0, 1], 0)),
            data_dir: IN_MEMORY.to_owned(),
            ..Config::default()
        };
        let listener = TcpListener::bind(config.listen).await.unwrap();
        let address = listener.local_addr().unwrap();
        let (ground, incoming) = (
            Ground::with_takes_in(&config, files).unwrap(),
            Incoming::Port(listener),
        );
        let shutdown = CancellationToken::new();
        let run = frontalis_server::run_on;
        let server = run(ground, config.clone(), incoming, address, shutdown.clone()).await;
        let running = Running::Inside {
            server: server.unwrap(),
            shutdown,
        };
        Self {
            config,
            folder: tempfile::tempdir().unwrap(),
            running,
            keys: None,
            tls: None,
        }
    }

    /// Its data directory.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Starts one that asks for tokens; the harness shows its own.
    pub async fn start_guarded(change: impl FnOnce(&mut Config)) -> Self {
        let mut keys = None;
        let mut server = Self::start_with(|config| {
            let path = std::path::Path::new(&config.data_dir).join("tokens.toml");
            config.token_file = path.display().to_string();
            keys = Some(Keys::write(path));
            change(config);
        })
        .await;
        server.keys = keys;
        server
    }

    /// The tokens of a server that asks for them.
    ///
    /// # Panics
    ///
    /// When it does not.
    pub fn keys(&mut self) -> &mut Keys {
        self.keys.as_mut().expect("a guarded server")
    }

    /// An operator's token, of a server that asks for tokens.
    ///
    /// # Panics
    ///
    /// When it does not.
    pub fn operator_token(&self) -> &str {
        self.keys
            .as_ref()
            .expect("a guarded server")
            .operator()
            .reveal()
    }

    /// Makes the server look at its files now.
    pub fn reload(&self) {
        if let Running::Inside { server, .. } = &self.running {
            server.reload();
        }
    }

    /// The figures of a server in this process.
    ///
    /// # Panics
    ///
    /// When it is a program of its own.
    pub fn metrics_text(&self) -> String {
        match &self.running {
            Running::Inside { server, .. } => server.metrics().to_text(),
            Running::Program(_) => panic!("ask the program over HTTP"),
        }
    }

    /// Starts the program itself, with other settings than the defaults: its memory is that of the server alone.
    pub async fn start_program(change: impl FnOnce(&mut Config)) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut config = Config {
            listen: SocketAddr::from(([127, 0, 0, 1], 0)),
            data_dir: folder.path().to_str().unwrap().to_owned(),
            ..Config::default()
        };
        change(&mut config);
        let file = folder.path().join("frontalis.toml");
        std::fs::write(&file, config.to_toml()).unwrap();
        let started = tokio::task::spawn_blocking(move || ServerProgram::start(&file));
        Self {
            config,
            folder,
            running: Running::Program(Box::new(started.await.unwrap())),
            keys: None,
            tls: None,
        }
    }

    /// The program that was started.
    pub fn program(&self) -> &ServerProgram {
        match &self.running {
            Running::Program(program) => program,
            Running::Inside { .. } => panic!("this server is no program of its own"),
        }
    }

    /// The server's data directory.
    pub fn data_dir(&self) -> &std::path::Path {
        self.config.data_dir.as_ref()
    }

    /// What the files with such names take on disk.
    pub fn disk_bytes(&self, has_name: impl Fn(&str) -> bool) -> u64 {
        let mut folders = vec![self.folder.path().to_owned()];
        let mut n_bytes = 0;
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let entry = entry.unwrap();
                // A file may be gone by now.
                let Ok(metadata) = entry.metadata() else {
                    continue;
                };
                if metadata.is_dir() {
                    folders.push(entry.path());
                } else if entry.file_name().to_str().is_some_and(&has_name) {
                    n_bytes += metadata.len();
                }
            }
        }
        n_bytes
    }

    /// Drains the server and waits until it is gone.
    pub async fn stop(self) -> TempDir {
        self.begin_drain();
        let clean = match self.running {
            Running::Inside { server, .. } => server.stopped().await,
            Running::Program(mut program) => program.wait().await,
        };
        assert!(clean, "the drain took longer than its grace");
        self.folder
    }

    /// Starts one with the reference face and a session of it.
    pub async fn with_session(id: &str) -> Self {
        let server = Self::start().await;
        server.import_reference().await;
        server.create_session(id, "actors/reference").await.unwrap();
        server
    }

    /// Drains the server and starts another on the same folder and the same port.
    pub async fn restart(self) -> Self {
        self.restart_after(|_| {}).await
    }

    /// The same, with something done to the folder in between.
    pub async fn restart_after(mut self, change: impl FnOnce(&Path)) -> Self {
        let (address, mut config) = (self.address(), self.config.clone());
        let (keys, tls) = (self.keys.take(), self.tls.take());
        let folder = self.stop().await;
        change(folder.path());
        config.listen = address;
        let running = spawn(&config).await;
        Self {
            config,
            folder,
            running,
            keys,
            tls,
        }
    }

    /// Kills the program, as a crash does, and starts another on the same folder and the same port.
    ///
    /// # Panics
    ///
    /// When it is no program of its own.
    pub async fn kill_and_restart(self) -> Self {
        self.kill_and_restart_after(|_| {}).await
    }

    /// The same, with something done to the folder in between.
    ///
    /// # Panics
    ///
    /// When it is no program of its own.
    pub async fn kill_and_restart_after(self, change: impl FnOnce(&Path)) -> Self {
        let mut config = self.config.clone();
        config.listen = self.address();
        match self.running {
            Running::Program(program) => program.kill(),
            Running::Inside { .. } => panic!("this server is no program of its own"),
        }
        change(self.folder.path());
        let file = self.folder.path().join("frontalis.toml");
        std::fs::write(&file, config.to_toml()).unwrap();
        let started = tokio::task::spawn_blocking(move || ServerProgram::start(&file));
        Self {
            running: Running::Program(Box::new(started.await.unwrap())),
            config: self.config,
            folder: self.folder,
            keys: self.keys,
            tls: self.tls,
        }
    }

    /// A client of its takes.
    pub async fn takes(&self) -> TakeServiceClient<TestChannel> {
        TakeServiceClient::new(self.channel().await)
    }

    /// Drains the program and waits until it is gone.
    ///
    /// # Panics
    ///
    /// When it is no program of its own, or something had to be cut.
    pub async fn terminate(self) -> StoppedServer {
        self.begin_drain();
        let Running::Program(mut program) = self.running else {
            panic!("this server is no program of its own");
        };
        assert!(program.wait().await, "the drain took longer than its grace");
        StoppedServer {
            config: self.config,
            folder: self.folder,
        }
    }

    /// Drains the program and waits for its exit code.
    ///
    /// # Panics
    ///
    /// When it is no program of its own.
    pub async fn exit_code(self) -> Option<i32> {
        self.begin_drain();
        match self.running {
            Running::Program(mut program) => program.exit_code().await,
            Running::Inside { .. } => panic!("this server is no program of its own"),
        }
    }

    /// What SIGTERM does, without waiting.
    pub fn begin_drain(&self) {
        match &self.running {
            Running::Inside { shutdown, .. } => shutdown.cancel(),
            Running::Program(program) => program.terminate(),
        }
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        match &self.running {
            Running::Inside { server, .. } => server.address(),
            Running::Program(program) => program.address(),
        }
    }

    /// Where it listens, as a client writes it.
    pub fn url(&self) -> String {
        let scheme = if self.tls.is_some() { "https" } else { "http" };
        format!("{scheme}://{}", self.address())
    }

    /// A connection of its own.
    pub async fn channel(&self) -> TestChannel {
        let bearer = self.keys.as_ref().map(Keys::bearer).unwrap_or_default();
        InterceptedService::new(self.bare_channel().await, bearer)
    }

    /// A connection of its own that shows another token.
    pub async fn channel_as(&self, token: &frontalis_access::Token) -> TestChannel {
        InterceptedService::new(self.bare_channel().await, Bearer::of(token))
    }

    /// A connection of its own that shows no token.
    pub async fn bare_channel(&self) -> Channel {
        match &self.tls {
            None => self.endpoint().connect().await.unwrap(),
            Some(tls) => self.channel_over(tls).await,
        }
    }

    /// A connection of its own that shows no token but what this client of TLS shows.
    pub async fn channel_over(&self, tls: &TestTls) -> Channel {
        let channel = tls.channel(&self.endpoint(), self.address()).await;
        channel.unwrap()
    }

    fn endpoint(&self) -> Endpoint {
        let endpoint = Endpoint::from_shared(format!("http://{}", self.address()));
        endpoint.unwrap().tcp_nodelay(true)
    }

    /// From now on the harness speaks TLS to it.
    #[must_use]
    pub fn spoken_to_over(mut self, tls: TestTls) -> Self {
        self.tls = Some(tls);
        self
    }

    /// A client of the actors.
    pub async fn actors(&self) -> ActorServiceClient<TestChannel> {
        ActorServiceClient::new(self.channel().await)
    }

    /// A client of the sessions.
    pub async fn sessions(&self) -> SessionServiceClient<TestChannel> {
        SessionServiceClient::new(self.channel().await)
    }

    /// Imports a package in chunks.
    ///
    /// # Errors
    ///
    /// When the server refuses it.
    pub async fn import(&self, id: &str, package: &[u8]) -> Result<ImportActorResponse, Status> {
        let start = ImportActorStart {
            actor_id: id.to_owned(),
            ..ImportActorStart::default()
        };
        self.import_as(start, package).await
    }

    /// Imports a package with everything that can be said about it.
    ///
    /// # Errors
    ///
    /// When the server refuses it.
    pub async fn import_as(
        &self,
        start: ImportActorStart,
        package: &[u8],
    ) -> Result<ImportActorResponse, Status> {
        let first = ImportActorRequest {
            start: Some(start),
            chunk: Vec::new(),
        };
        let chunks = package.chunks(CHUNK_BYTES).map(|chunk| ImportActorRequest {
            start: None,
            chunk: chunk.to_vec(),
        });
        let messages: Vec<_> = std::iter::once(first).chain(chunks).collect();
        let answer = self
            .actors()
            .await
            .import_actor(tokio_stream::iter(messages))
            .await?;
        Ok(answer.into_inner())
    }

    /// Imports the reference face as `actors/reference`.
    pub async fn import_reference(&self) -> Actor {
        let package = crate::package::reference_package();
        self.import("reference", &package)
            .await
            .unwrap()
            .actor
            .unwrap()
    }

    /// Creates a session of an actor, markers, with the default settings.
    ///
    /// # Errors
    ///
    /// When the server refuses it.
    pub async fn create_session(&self, id: &str, actor: &str) -> Result<Session, Status> {
        self.create_session_with(id, actor, SessionSettings::default())
            .await
    }

    /// Creates a session of an actor, markers.
    ///
    /// # Errors
    ///
    /// When the server refuses it.
    pub async fn create_session_with(
        &self,
        id: &str,
        actor: &str,
        settings: SessionSettings,
    ) -> Result<Session, Status> {
        let request = CreateSessionRequest {
            session_id: id.to_owned(),
            actor: actor.to_owned(),
            kind: frontalis_proto::v1::CaptureKind::Markers.into(),
            settings: Some(settings),
            display_name: String::new(),
        };
        let answer = self.sessions().await.create_session(request).await?;
        Ok(answer.into_inner().session.unwrap())
    }

    /// The session as it is now.
    pub async fn session(&self, name: &str) -> Session {
        let name = name.to_owned();
        let answer = self
            .sessions()
            .await
            .get_session(GetSessionRequest { name })
            .await;
        answer.unwrap().into_inner().session.unwrap()
    }

    /// Ends a session.
    pub async fn end_session(&self, name: &str) -> Session {
        let name = name.to_owned();
        let answer = self
            .sessions()
            .await
            .end_session(EndSessionRequest { name })
            .await;
        answer.unwrap().into_inner().session.unwrap()
    }
}

async fn spawn(config: &Config) -> Running {
    let listener = TcpListener::bind(config.listen).await.unwrap();
    let shutdown = CancellationToken::new();
    let server = frontalis_server::run(config.clone(), listener, shutdown.clone())
        .await
        .unwrap();
    Running::Inside { server, shutdown }
}
