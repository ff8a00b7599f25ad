//! The program as an operator meets it: its first line, its last line, its exit code.

#![expect(
    clippy::unwrap_used,
    reason = "a test may unwrap: its failure is the report"
)]

use std::{
    io::{BufRead as _, BufReader},
    process::{Child, Command, Output, Stdio},
};

fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_frontalis-server"));
    command.args(arguments).env_clear();
    command
}

fn run(arguments: &[&str]) -> Output {
    program(arguments).output().unwrap()
}

fn error_line(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(text.lines().count(), 1, "{text}");
    text
}

/// Starts a server on a free port; its child process and its address.
fn start(data_dir: &str) -> (Child, String) {
    let (child, line) = start_with(&["--data-dir", data_dir]);
    let address = line.strip_prefix("listening on http://").unwrap();
    (child, address.to_owned())
}

/// Starts a server on a free port; its child process and its first line.
fn start_with(arguments: &[&str]) -> (Child, String) {
    let mut child = program(&["--listen", "127.0.0.1:0", "--log", "warn"])
        .args(arguments)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap())
        .read_line(&mut line)
        .unwrap();
    (child, line.trim().to_owned())
}

fn send(signal: &str, child: &Child) {
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args([signal, &id])
            .status()
            .unwrap()
            .success()
    );
}

#[test]
fn a_busy_port_is_said_in_one_line() {
    let busy = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = busy.local_addr().unwrap().to_string();
    let line = error_line(&run(&[
        "--listen",
        &address,
        "--data-dir",
        ":memory:",
        "--log",
        "error",
    ]));
    assert!(line.contains(&format!("{address} is in use")), "{line}");
}

#[test]
fn an_address_that_others_can_reach_is_refused() {
    let line = error_line(&run(&["--listen", "0.0.0.0:0"]));
    assert!(line.contains("--allow-insecure"), "{line}");
    assert!(line.contains("neither TLS nor tokens"), "{line}");
}

#[test]
fn a_certificate_that_cannot_be_used_is_named_in_one_line() {
    let line = error_line(&run(&[
        "--data-dir",
        ":memory:",
        "--listen",
        "127.0.0.1:0",
        "--log",
        "error",
        "--tls-cert",
        "no-such.pem",
        "--tls-key",
        "no-key.pem",
    ]));
    assert!(line.contains("no-such.pem cannot be read"), "{line}");
}

#[test]
fn with_a_certificate_the_address_is_one_of_https() {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    let names = vec!["localhost".to_owned()];
    let certified = rcgen::generate_simple_self_signed(names).unwrap();
    std::fs::write(path("cert.pem"), certified.cert.pem()).unwrap();
    std::fs::write(path("key.pem"), certified.signing_key.serialize_pem()).unwrap();
    let (cert, key) = (path("cert.pem"), path("key.pem"));
    let (mut server, line) = start_with(&[
        "--data-dir",
        ":memory:",
        "--tls-cert",
        &cert,
        "--tls-key",
        &key,
    ]);
    assert!(
        line.starts_with("listening on https://127.0.0.1:"),
        "{line}"
    );
    // SIGHUP asks for new certificates; it ends nothing.
    send("-HUP", &server);
    send("-TERM", &server);
    assert_eq!(server.wait().unwrap().code(), Some(0));
}

#[test]
fn an_unknown_key_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("f.toml");
    std::fs::write(&path, "[limits]\nsesions = 3\n").unwrap();
    let output = run(&["--config", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        String::from_utf8(output.stderr)
            .unwrap()
            .contains("sesions")
    );
}

#[test]
fn the_documented_configuration_is_checked_and_printed() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../deploy/frontalis.toml");
    let output = run(&["--check", "--config", path]);
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("listen = \"127.0.0.1:7400\""), "{text}");
    assert!(text.contains("of a budget of 12288 MiB"), "{text}");
}

#[test]
fn h10_a_second_server_on_the_same_data_is_refused_and_the_first_ends_with_zero_on_sigterm() {
    let dir = tempfile::tempdir().unwrap();
    let data_dir = dir.path().to_str().unwrap();
    let (mut first, address) = start(data_dir);
    assert!(address.starts_with("127.0.0.1:"));
    let second = run(&[
        "--listen",
        "127.0.0.1:0",
        "--log",
        "error",
        "--data-dir",
        data_dir,
    ]);
    let line = error_line(&second);
    assert!(line.contains("in use by another server (process"), "{line}");
    send("-TERM", &first);
    assert_eq!(first.wait().unwrap().code(), Some(0));
    let (mut third, _) = start(data_dir);
    send("-INT", &third);
    assert_eq!(third.wait().unwrap().code(), Some(0));
}
