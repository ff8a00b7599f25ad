//! Clients that share no code with the server: what the page for renderer developers shows, run against it.
//!
//! Each prints one line a promise and fails when one is broken. Each runs against a server in the clear, and against one
//! with TLS and tokens.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use frontalis_access::Role;
use frontalis_proto::v1::PublishMarkersRequest;
use harness::{Protection, TestPerformance, TestServer, reference_package};
use tempfile::TempDir;

/// Frames of the take that every client publishes.
const N_FRAMES: u64 = 90;
/// Frames in one message.
const BATCH: usize = 10;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn python_over_grpc_imports_publishes_subscribes_resumes_and_reads_health() {
    let Some(python) = python() else { return };
    let mut command = client(&python, "python/grpc_client.py");
    command.push("--proto".into());
    command.push(repository().join("proto").into());
    let promises = [
        "server:",
        "import:",
        "export:",
        "publish:",
        "every frame:",
        "latest:",
        "end:",
        "refusal:",
        "health:",
        "reflection:",
    ];
    run_against_both(&command, &promises).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn python_over_http_needs_the_standard_library_only() {
    let Some(python) = on_path("python3") else {
        return;
    };
    let command = client(&python, "python/http_client.py");
    let promises = [
        "server:", "import:", "session:", "publish:", "poll:", "events:", "refusal:", "end:",
    ];
    run_against_both(&command, &promises).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn typescript_over_grpc_and_grpc_web_shows_with_credits_and_resumes() {
    let Some(node) = Node::find() else { return };
    // Made anew from the .proto files, then type-checked: a message that changed is found here.
    node.run("buf", &["generate", "../../../proto"]).await;
    node.run("tsc", &[]).await;
    let promises = [
        "server over grpc:",
        "server over grpc-web:",
        "import:",
        "session:",
        "publish:",
        "credits:",
        "resume over grpc:",
        "resume over grpc-web:",
        "refusal over grpc:",
        "refusal over grpc-web:",
    ];
    run_against_both(&node.client("grpc_client.ts"), &promises).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn typescript_over_websockets_does_with_what_a_browser_has() {
    let Some(node) = Node::find() else { return };
    let promises = ["import:", "publish:", "latest:", "resume:", "refusal:"];
    run_against_both(&node.client("web_client.ts"), &promises).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn curl_does_everything_that_matters() {
    let (Some(bash), Some(_)) = (on_path("bash"), on_path("curl")) else {
        return;
    };
    let command = client(&bash, "curl/client.sh");
    let promises = [
        "server:", "import:", "model:", "session:", "publish:", "by hand:", "poll:", "end:",
        "events:", "resume:", "refusal:",
    ];
    run_against_both(&command, &promises).await;
}

/// Interpreter and script.
fn client(interpreter: &Path, script: &str) -> Vec<OsString> {
    vec![interpreter.into(), clients().join(script).into()]
}

async fn run_against_both(client: &[OsString], promises: &[&str]) {
    let take = Take::write();
    let server = TestServer::start().await;
    // Again on the same server: what a client makes, it ends.
    for _run in 0..2 {
        run_client(client, &server.url(), &take, &[], promises).await;
    }
    server.stop().await;

    let protection = Protection::new();
    let token = protection.token(Role::Publisher, "python*,typescript,web,curl*");
    let operator = protection.token(Role::Operator, "*");
    let server = TestServer::start_with(|it| protection.apply(it)).await;
    let url = format!("https://{}", server.address());
    let shown: [OsString; 6] = [
        "--ca-cert".into(),
        protection.ca_cert().into(),
        "--token-file".into(),
        token.into(),
        "--operator-token-file".into(),
        operator.into(),
    ];
    run_client(client, &url, &take, &shown, promises).await;
    server.stop().await;
}

async fn run_client(
    client: &[OsString],
    url: &str,
    take: &Take,
    more: &[OsString],
    promises: &[&str],
) {
    let mut command = Command::new(&client[0]);
    command.args(&client[1..]).args(["--server", url]);
    command.arg("--package").arg(&take.package);
    command.arg("--frames").arg(&take.frames);
    command.args(more);
    // As a browser, Node has its authorities from outside.
    if let Some(at) = more.iter().position(|it| it == "--ca-cert") {
        command.env("NODE_EXTRA_CA_CERTS", &more[at + 1]);
    }
    let said = run(&mut command).await;
    println!("{said}");
    for promise in promises {
        let is_kept = said.lines().any(|it| it.starts_with(promise));
        assert!(is_kept, "{promise} is missing:\n{said}");
    }
}

/// What every client is given.
struct Take {
    package: PathBuf,
    frames: PathBuf,
    _folder: TempDir,
}

impl Take {
    fn write() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (package, frames) = (
            folder.path().join("reference.glb"),
            folder.path().join("take.ndjson"),
        );
        std::fs::write(&package, reference_package()).unwrap();
        std::fs::write(&frames, take_as_json_lines()).unwrap();
        Self {
            package,
            frames,
            _folder: folder,
        }
    }
}

/// One `PublishMarkersRequest` a line: the start without its session, then the frames.
fn take_as_json_lines() -> String {
    let performance = TestPerformance::reference();
    let start = PublishMarkersRequest {
        start: Some(performance.start("", "client")),
        ..PublishMarkersRequest::default()
    };
    let frames = performance.frames(1..=N_FRAMES);
    let frames = frames.chunks(BATCH).map(|batch| PublishMarkersRequest {
        frames: batch.to_vec(),
        ..PublishMarkersRequest::default()
    });
    std::iter::once(start)
        .chain(frames)
        .map(|it| serde_json::to_string(&it).unwrap() + "\n")
        .collect()
}

/// Runs a program to its end; what it printed.
async fn run(command: &mut Command) -> String {
    let shown = format!("{command:?}");
    let child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let waiting = tokio::task::spawn_blocking(|| child.wait_with_output());
    let output = waiting.await.unwrap().unwrap();
    let (said, complained) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{shown}\n{said}\n{complained}");
    said
}

/// The environment that `make python` makes, when it is complete.
fn python() -> Option<PathBuf> {
    let venv = repository().join(".venv");
    if venv.join("ready").is_file() {
        return Some(venv.join("bin/python"));
    }
    println!("left out: clients::python_over_grpc: no .venv; `make python` makes it");
    None
}

/// Node with what `make node` installs.
struct Node {
    program: PathBuf,
    folder: PathBuf,
}

impl Node {
    fn find() -> Option<Self> {
        let program = on_path("node")?;
        let folder = clients().join("typescript");
        if !folder.join("node_modules/ready").is_file() {
            println!("left out: clients::typescript: no node_modules; `make node` makes them");
            return None;
        }
        Some(Self { program, folder })
    }

    /// Runs one of the installed programs in the folder of the clients.
    async fn run(&self, program: &str, arguments: &[&str]) {
        let program = self.folder.join("node_modules/.bin").join(program);
        run(Command::new(program)
            .args(arguments)
            .current_dir(&self.folder))
        .await;
    }

    /// How a client is started: Node 20 reads TypeScript through a loader.
    fn client(&self, script: &str) -> Vec<OsString> {
        let loader = self.folder.join("node_modules/tsx/dist/esm/index.mjs");
        vec![
            self.program.clone().into(),
            "--import".into(),
            format!("file://{}", loader.display()).into(),
            self.folder.join(script).into(),
        ]
    }
}

fn on_path(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&path)
        .map(|it| it.join(program))
        .find(|it| it.is_file());
    if found.is_none() {
        println!("left out: clients that need {program}, which is not here");
    }
    found
}

fn clients() -> PathBuf {
    repository().join("tests/clients")
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
