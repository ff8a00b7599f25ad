//! Clients that share no code with the server: what the page for renderer developers shows, run against it.
//!
//! Each prints one line a promise and fails when one is broken. Each runs as its page says against a server in the clear,
//! then again on the same server, and against one with TLS and tokens.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use frontalis_access::Role;
use harness::{ClientFiles, Protection, TestServer};

/// How a person runs each of them.
const README: &str = include_str!("../clients/README.md");

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn python_over_grpc_imports_publishes_subscribes_resumes_and_reads_health() {
    let Some(python) = python() else { return };
    let mut client = Client::new(&python, "python/grpc_client.py");
    client.start.push("--proto".into());
    client.start.push(repository().join("proto").into());
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
    client.keeps(&promises).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn python_over_http_needs_the_standard_library_only() {
    let Some(python) = on_path("python3") else {
        return;
    };
    let client = Client::new(&python, "python/http_client.py");
    let promises = [
        "server:", "import:", "session:", "publish:", "poll:", "events:", "refusal:", "end:",
    ];
    client.keeps(&promises).await;
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
        "end:",
        "refusal over grpc:",
        "refusal over grpc-web:",
    ];
    node.client("typescript/grpc_client.ts")
        .keeps(&promises)
        .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn typescript_over_websockets_does_with_what_a_browser_has() {
    let Some(node) = Node::find() else { return };
    let promises = [
        "import:", "publish:", "latest:", "resume:", "refusal:", "end:",
    ];
    node.client("typescript/web_client.ts")
        .keeps(&promises)
        .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn curl_does_everything_that_matters() {
    let (Some(bash), Some(_)) = (on_path("bash"), on_path("curl")) else {
        return;
    };
    let client = Client::new(&bash, "curl/client.sh");
    let promises = [
        "server:", "import:", "model:", "session:", "publish:", "by hand:", "poll:", "end:",
        "events:", "resume:", "refusal:",
    ];
    client.keeps(&promises).await;
}

/// One of the clients.
struct Client {
    /// Under `tests/clients`.
    script: &'static str,
    /// Interpreter, script, and what only this client is given.
    start: Vec<OsString>,
}

impl Client {
    fn new(interpreter: &Path, script: &'static str) -> Self {
        let start = vec![interpreter.into(), clients().join(script).into()];
        Self { script, start }
    }

    /// Runs it against a server in the clear, twice, and against a protected one.
    async fn keeps(&self, promises: &[&str]) {
        let folder = tempfile::tempdir().unwrap();
        let files = ClientFiles::write(folder.path()).unwrap();
        let server = TestServer::start().await;
        let url = server.url();
        check(self.by_hand(&url, folder.path()), promises).await;
        // Again on the same server: what a client makes, it ends.
        check(self.command(&url, &files), promises).await;
        server.stop().await;

        let protection = Protection::new();
        let token = protection.token(Role::Publisher, "python*,typescript,web,curl*");
        let operator = protection.token(Role::Operator, "*");
        let server = TestServer::start_with(|it| protection.apply(it)).await;
        let mut command = self.command(&format!("https://{}", server.address()), &files);
        command.arg("--ca-cert").arg(protection.ca_cert());
        command.arg("--token-file").arg(token);
        command.arg("--operator-token-file").arg(operator);
        // As a browser, Node has its authorities from outside.
        command.env("NODE_EXTRA_CA_CERTS", protection.ca_cert());
        check(command, promises).await;
        server.stop().await;
    }

    fn command(&self, url: &str, files: &ClientFiles) -> Command {
        let mut command = Command::new(&self.start[0]);
        command.args(&self.start[1..]).args(["--server", url]);
        command.arg("--package").arg(&files.package);
        command.arg("--frames").arg(&files.frames);
        command
    }

    /// The line of the page that runs it, with another server and other files.
    fn by_hand(&self, url: &str, files: &Path) -> Command {
        let named = format!("tests/clients/{} ", self.script);
        let line = README.lines().find(|it| it.contains(&named));
        let line = line.unwrap_or_else(|| panic!("the page does not run {}", self.script));
        let files = format!("{}/", files.display());
        let line = line
            .replace("http://127.0.0.1:7400", url)
            .replace("client-files/", &files);
        let mut command = Command::new("bash");
        command.args(["-c", &line]).current_dir(repository());
        command
    }
}

async fn check(mut command: Command, promises: &[&str]) {
    let said = run(&mut command).await;
    println!("{said}");
    for promise in promises {
        let is_kept = said.lines().any(|it| it.starts_with(promise));
        assert!(is_kept, "{promise} is missing:\n{said}");
    }
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

    /// Node 20 reads TypeScript through a loader.
    fn client(&self, script: &'static str) -> Client {
        let loader = self.folder.join("node_modules/tsx/dist/esm/index.mjs");
        let start = vec![
            self.program.clone().into(),
            "--import".into(),
            format!("file://{}", loader.display()).into(),
            clients().join(script).into(),
        ];
        Client { script, start }
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
