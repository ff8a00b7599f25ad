//! The command line against a protected server: tokens made, a login kept, refusals explained; and its audit log.

use std::{
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use frontalis_server::service::audit::FILE_NAME;
use harness::{Protection, TestServer, program};
use serde_json::Value;
use tempfile::TempDir;

/// A person at a terminal, with an account of its own.
struct Person {
    program: PathBuf,
    home: TempDir,
}

impl Person {
    fn new() -> Self {
        Self {
            program: program("frontalis"),
            home: tempfile::tempdir().unwrap(),
        }
    }

    /// Types a line, with `input` on standard input.
    async fn types(&self, line: &str, input: &str) -> Output {
        let mut child = Command::new(&self.program)
            .args(line.split_whitespace())
            .env("XDG_CONFIG_HOME", self.home.path())
            .env_remove("FRONTALIS_SERVER")
            .env_remove("FRONTALIS_TOKEN")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let input = input.to_owned();
        let waiting = tokio::task::spawn_blocking(move || {
            // A command that reads nothing may be gone already.
            drop(stdin.write_all(input.as_bytes()));
            drop(stdin);
            child.wait_with_output()
        });
        waiting.await.unwrap().unwrap()
    }

    /// A line that succeeds; what it printed.
    async fn does(&self, line: &str) -> String {
        self.does_with(line, "").await
    }

    async fn does_with(&self, line: &str, input: &str) -> String {
        let output = self.types(line, input).await;
        let complained = text_of(&output.stderr);
        assert!(output.status.success(), "{line}\n{complained}");
        text_of(&output.stdout)
    }

    /// A line that fails; what it complained.
    async fn fails(&self, line: &str) -> String {
        let output = self.types(line, "").await;
        assert_eq!(output.status.code(), Some(1), "{line}");
        text_of(&output.stderr)
    }

    fn login_file(&self) -> PathBuf {
        self.home.path().join("frontalis/credentials.toml")
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_login_is_kept_for_its_server_and_forgotten_on_request() {
    let (anna, protection) = (Person::new(), Protection::new());
    let file = protection.token_file().display().to_string();
    let create = format!("token create --token-file {file} --role operator --name Anna");
    let token = anna.does(&create).await;
    assert_eq!(token.lines().count(), 1, "the token and nothing else");

    let server = TestServer::start_with(|it| protection.apply(it)).await;
    let url = format!("https://{}", server.address());
    let ca_cert = protection.ca_cert().display().to_string();
    let login = format!("login --server {url} --ca-cert {ca_cert}");
    let said = anna.does_with(&login, &token).await;
    assert!(
        said.contains("operator") && !said.contains(token.trim()),
        "{said}"
    );
    assert_eq!(mode(&anna.login_file()), 0o600);

    // Without a flag: the server, its authority and the token are those of the login.
    let who: Value = serde_json::from_str(&anna.does("server --json").await).unwrap();
    assert_eq!(who["caller"]["role"], "ROLE_OPERATOR");
    assert_eq!((&who["tls"], &who["tokens"]), (&true.into(), &true.into()));
    let sessions: Value = serde_json::from_str(&anna.does("session list --json").await).unwrap();
    assert_eq!(sessions.get("sessions"), None);

    anna.does("logout").await;
    let complained = anna
        .fails(&format!("session list --server {url} --ca-cert {ca_cert}"))
        .await;
    assert!(complained.contains("frontalis login"), "{complained}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_refused_connection_says_what_to_do() {
    let (anna, protection, stranger) = (Person::new(), Protection::new(), Protection::new());
    let token = protection.token(frontalis_access::Role::Viewer, "*");
    let server = TestServer::start_with(|it| protection.apply(it)).await;
    let address = server.address();
    let ca_cert = protection.ca_cert().display().to_string();
    let token = token.display();
    for (line, advice) in [
        // Another authority, another name, no TLS where there is some.
        (
            format!(
                "session list --server https://{address} --ca-cert {} --token-file {token}",
                stranger.ca_cert().display()
            ),
            "--ca-cert",
        ),
        (
            format!(
                "session list --server https://localhost:{} --ca-cert {ca_cert}",
                address.port()
            ),
            "--server has to use a name",
        ),
        (
            format!("session list --server http://{address}"),
            "--server https://",
        ),
        // A role that may not.
        (
            format!(
                "session create --actor anna --server https://{address} --ca-cert {ca_cert} --token-file {token}"
            ),
            "your token does not allow this",
        ),
    ] {
        let complained = anna.fails(&line).await;
        assert!(complained.contains(advice), "{line}\n{complained}");
    }
    // A login that is refused is not kept.
    let output = anna
        .types(
            &format!("login --server https://{address} --ca-cert {ca_cert}"),
            "frontalis_wrong",
        )
        .await;
    assert!(!output.status.success() && !anna.login_file().exists());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_server_without_tls_is_told_from_one_with_it() {
    let (anna, server) = (Person::new(), TestServer::start().await);
    let complained = anna
        .fails(&format!("server --server https://{}", server.address()))
        .await;
    assert!(
        complained.contains("http:// instead of https://"),
        "{complained}"
    );
    anna.does(&format!("server --server {}", server.url()))
        .await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_audit_log_is_verified_and_the_first_line_that_was_tampered_with_is_named() {
    let (anna, server) = (Person::new(), TestServer::with_session("take-1").await);
    server.end_session("sessions/take-1").await;
    let folder = server.stop().await;
    let log = folder.path().join(FILE_NAME);
    let verify = format!("audit verify {}", log.display());
    let said = anna.does(&verify).await;
    assert!(said.contains("3 lines; the chain holds"), "{said}");

    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(&log, text.replace("session_create", "session_created")).unwrap();
    let output = anna.types(&verify, "").await;
    let said = text_of(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("3 lines; line 2 is not"), "{said}");
    let output = anna.types(&format!("{verify} --json"), "").await;
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{report}");
    assert_eq!(
        (&report["lines"], &report["firstBrokenLine"]),
        (&"3".into(), &"2".into())
    );

    let complained = anna.fails("audit verify nowhere/audit.log").await;
    assert!(complained.contains("nowhere/audit.log"), "{complained}");
}

fn mode(path: &Path) -> u32 {
    use std::os::unix::fs::PermissionsExt as _;
    std::fs::metadata(path).unwrap().permissions().mode() & 0o777
}

fn text_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
