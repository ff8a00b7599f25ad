//! The demo: server, simulated stage and curves with one command, which ends by itself and says what it measured.

use std::{
    net::TcpListener,
    process::{Command, Output, Stdio},
};

use harness::program;

#[test]
fn the_demo_ends_by_itself_with_a_summary() {
    let folder = tempfile::tempdir().unwrap();
    let free = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap();
    let output = demo(&free.to_string(), folder.path());
    let said = String::from_utf8_lossy(&output.stdout);
    let complained = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}\n{complained}");
    println!("{said}");
    let said = said.to_lowercase();
    for figure in ["published", "received", "rate", "rms", "p50", "p99"] {
        assert!(
            said.contains(figure),
            "the summary has no {figure}:\n{said}"
        );
    }
}

#[test]
fn a_busy_port_is_said_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let busy = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = busy.local_addr().unwrap().to_string();
    let output = demo(&address, folder.path());
    let complained = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success());
    assert_eq!(complained.trim().lines().count(), 1, "{complained}");
    assert!(complained.contains(&address), "{complained}");
}

fn demo(listen: &str, folder: &std::path::Path) -> Output {
    program("frontalis-server");
    Command::new(program("frontalis"))
        .args(["demo", "--listen", listen, "--seconds", "3", "--data-dir"])
        .arg(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}
