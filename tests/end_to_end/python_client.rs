//! A client made from the `.proto` files alone, in another language, can use the whole service.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use harness::{TestServer, reference_package};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn python_client_imports_publishes_subscribes_and_reads_health_and_reflection() {
    let Some(python) = interpreter() else {
        println!("left out: python_client (all tests): no .venv; `make python` makes it");
        return;
    };
    let server = TestServer::start().await;
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("reference.glb");
    std::fs::write(&package, reference_package()).unwrap();
    let mut command = Command::new(python);
    command
        .arg(repository().join("tests/python/client.py"))
        .args(["--server", &server.address().to_string()])
        .arg("--proto")
        .arg(repository().join("proto"))
        .arg("--package")
        .arg(&package)
        .stdin(Stdio::null());
    let output = tokio::task::spawn_blocking(move || command.output())
        .await
        .unwrap()
        .unwrap();
    let (said, complained) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{said}\n{complained}");
    println!("{said}");
    for promise in [
        "import:",
        "publish:",
        "every frame:",
        "latest:",
        "refusal:",
        "health:",
        "reflection:",
    ] {
        assert!(said.contains(promise), "{promise} is missing:\n{said}");
    }
    server.stop().await;
}

/// The environment that `make python` makes, when it is complete.
fn interpreter() -> Option<PathBuf> {
    let venv = repository().join(".venv");
    venv.join("ready")
        .is_file()
        .then(|| venv.join("bin/python"))
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
