//! The description of the HTTP door holds, and its page needs nothing from elsewhere.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use frontalis_analysis::{format::actor_package, synthesis::reference_face};
use harness::{TestServer, http_get};

/// Cases of each operation, in each phase that makes them up.
const EXAMPLES: &str = "25";
/// Another number, for a longer run: `make schemathesis`.
const EXAMPLES_VARIABLE: &str = "FRONTALIS_SCHEMATHESIS_EXAMPLES";
/// The same cases every time.
const SEED: &str = "20040401";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn schemathesis_finds_nothing() {
    let Some(program) = program() else {
        println!("left out: openapi::schemathesis: no .venv-schemathesis; `make clients` makes it");
        return;
    };
    let server = TestServer::start().await;
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("reference.zip");
    let bytes = actor_package::write_zip(&reference_face::actor());
    std::fs::write(&package, &bytes).unwrap();
    // The ids of the description's examples, so that more is seen than what is not there.
    server.import("reference", &bytes).await.unwrap();
    let session = server.create_session("take-1", "actors/reference").await;
    session.unwrap();
    let examples = std::env::var(EXAMPLES_VARIABLE).unwrap_or_else(|_| EXAMPLES.to_owned());
    let mut command = Command::new(program);
    command
        .arg("--config-file")
        .arg(clients().join("schemathesis.toml"))
        .args(["run", &format!("{}/openapi.json", server.url())])
        .args(["--checks", "all", "--continue-on-failure"])
        .args(["--max-examples", &examples, "--seed", SEED])
        .env("PYTHONPATH", clients())
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("SCHEMATHESIS_HOOKS", "hooks")
        .env("FRONTALIS_PACKAGE", &package)
        // What it remembers of a run belongs to that run.
        .current_dir(folder.path())
        .stdin(Stdio::null());
    let output = tokio::task::spawn_blocking(move || command.output());
    let output = output.await.unwrap().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let complained = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}\n{complained}");
    println!("{said}");
    assert_eq!(http_get(&server, "/healthz").await.status, 200);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_page_of_the_description_asks_no_other_host() {
    let server = TestServer::start().await;
    let moved = http_get(&server, "/docs").await;
    assert_eq!(
        (moved.status.as_u16(), &moved.headers["location"]),
        (308, &"/docs/".parse().unwrap())
    );
    let page = http_get(&server, "/docs/").await;
    assert_eq!(page.status, 200);
    let policy = page.headers["content-security-policy"].to_str().unwrap();
    assert!(policy.starts_with("default-src 'self';"), "{policy}");
    assert!(policy.contains("frame-ancestors 'none'"), "{policy}");
    assert_eq!(page.headers["x-content-type-options"], "nosniff");

    let mut files = vec!["index.html".to_owned()];
    files.extend(values_of(page.text(), "src=\""));
    files.extend(values_of(page.text(), "href=\""));
    assert!(files.len() > 5, "{files:?}");
    for file in files {
        assert!(!file.contains("//"), "{file}");
        let path = format!("/docs/{}", file.trim_start_matches("./"));
        let answer = http_get(&server, &path).await;
        assert_eq!(answer.status, 200, "{path}");
        let is_style = answer.content_type == "text/css";
        if is_style {
            let outside = values_of(answer.text(), "url(");
            assert!(outside.iter().all(|it| it.starts_with("data:")), "{path}");
        }
    }
    let start = http_get(&server, "/docs/swagger-initializer.js").await;
    assert!(
        start.text().contains("\"/openapi.json\""),
        "{}",
        start.text()
    );
    assert!(
        start.text().contains("\"validatorUrl\": \"none\""),
        "{}",
        start.text()
    );
    assert!(!start.text().contains("://"), "{}", start.text());
    assert_eq!(http_get(&server, "/docs/nothing.js").await.status, 404);
    server.stop().await;
}

/// What stands between `before` and the next quote or bracket, each time.
fn values_of(text: &str, before: &str) -> Vec<String> {
    let parts = text.split(before).skip(1);
    let values = parts.filter_map(|it| it.trim_start_matches('"').split(['"', ')']).next());
    values.map(str::to_owned).collect()
}

/// The program that `make schemathesis-program` installs, when it is complete.
fn program() -> Option<PathBuf> {
    let venv = repository().join(".venv-schemathesis");
    venv.join("ready")
        .is_file()
        .then(|| venv.join("bin/schemathesis"))
}

fn clients() -> PathBuf {
    repository().join("tests/clients/schemathesis")
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_index_names_every_operation() {
    let server = TestServer::start().await;
    let index = http_get(&server, "/").await;
    let document = http_get(&server, "/openapi.json").await.json();
    let mut n_operations = 0;
    for (path, operations) in document["paths"].as_object().unwrap() {
        for method in operations.as_object().unwrap().keys() {
            let line = format!("{} {path}", method.to_uppercase());
            let is_line = |it: &str| it.split('?').next() == Some(&line);
            assert!(
                index.text().lines().any(is_line),
                "{line}: {}",
                index.text()
            );
            n_operations += 1;
        }
    }
    assert!(n_operations >= 20, "{n_operations}");
    println!("{}", index.text());
    server.stop().await;
}
