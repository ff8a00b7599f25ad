//! What curl shows when a request with a body is refused: the problem, over TLS as curl comes, which is HTTP/2.

use std::{path::Path, process::Stdio};

use frontalis_access::Role;
use harness::{Protection, TestServer};
use serde_json::Value;
use tokio::process::Command;

/// Each is asked so often: what is lost is lost by chance.
const N_TIMES: usize = 4;

const GLB: &str = "content-type: model/gltf-binary";
const TEXT: &str = "content-type: text/plain";
const NDJSON: &str = "content-type: application/x-ndjson";

/// Method, path, content type, size of the body in bytes, whether a token is shown, then status and reason.
type Refused = (
    &'static str,
    &'static str,
    &'static str,
    usize,
    bool,
    u64,
    &'static str,
);

const REFUSED: [Refused; 9] = [
    (
        "PUT",
        "actors/foo",
        GLB,
        3_200_000,
        false,
        401,
        "UNAUTHENTICATED",
    ),
    ("PUT", "actors/foo", GLB, 100, true, 403, "ROLE"),
    ("PUT", "actors/foo", GLB, 3_200_000, true, 403, "ROLE"),
    ("PUT", "actors/foo", GLB, 70_000_000, true, 403, "ROLE"),
    ("POST", "sessions", TEXT, 3, true, 415, "CONTENT_TYPE"),
    (
        "POST",
        "sessions",
        "content-type: application/json",
        8_000_000,
        true,
        413,
        "BODY_SIZE",
    ),
    ("POST", "nothing", TEXT, 1_000_000, true, 404, "ROUTE"),
    (
        "POST",
        "sessions/none/frames",
        NDJSON,
        3_200_000,
        true,
        413,
        "MESSAGE_SIZE",
    ),
    (
        "POST",
        "sessions/none/frames",
        TEXT,
        3_200_000,
        true,
        415,
        "CONTENT_TYPE",
    ),
];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_refusal_of_a_body_is_seen_over_http2() {
    if !speaks_http2().await {
        println!("left out: curl_refusals: no curl with HTTP/2 is here");
        return;
    }
    let protection = Protection::new();
    let publisher = protection.token(Role::Publisher, "*");
    let operator = protection.token(Role::Operator, "*");
    let server = TestServer::start_with(|it| protection.apply(it)).await;
    let url = format!("https://{}/api/v1/", server.address());
    let folder = tempfile::tempdir().unwrap();
    let body = folder.path().join("body");
    let asked = |token: &Path| Asked {
        url: url.clone(),
        ca_cert: protection.ca_cert(),
        token: std::fs::read_to_string(token).unwrap(),
        body: body.clone(),
    };
    for refused in REFUSED {
        for _ in 0..N_TIMES {
            asked(&publisher).check(refused).await;
        }
    }
    // Above the largest package, to one who may.
    let large = (
        "PUT",
        "actors/foo",
        GLB,
        70_000_000,
        true,
        413,
        "BASIS_SIZE",
    );
    asked(&operator).check(large).await;
    server.stop().await;
}

async fn speaks_http2() -> bool {
    let output = Command::new("curl").arg("--version").output().await;
    output.is_ok_and(|it| String::from_utf8_lossy(&it.stdout).contains("HTTP2"))
}

struct Asked {
    url: String,
    ca_cert: std::path::PathBuf,
    token: String,
    body: std::path::PathBuf,
}

impl Asked {
    async fn check(&self, refused: Refused) {
        let (method, path, kind, n_bytes, shows_token, status, reason) = refused;
        std::fs::write(&self.body, vec![b'x'; n_bytes]).unwrap();
        let mut curl = Command::new("curl");
        curl.args([
            "--silent",
            "--show-error",
            "--max-time",
            "60",
            "--request",
            method,
        ])
        .args(["--header", kind, "--write-out", "\n%{http_version}"])
        .arg("--cacert")
        .arg(&self.ca_cert)
        .arg("--data-binary")
        .arg(format!("@{}", self.body.display()))
        .arg(format!("{}{path}", self.url))
        .stdin(Stdio::null());
        if shows_token {
            curl.arg("--header")
                .arg(format!("authorization: Bearer {}", self.token));
        }
        let output = curl.output().await.unwrap();
        let complained = String::from_utf8_lossy(&output.stderr);
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{refused:?}: {complained}{said}");
        let (problem, version) = said.rsplit_once('\n').unwrap();
        assert_eq!(version, "2", "{refused:?}");
        let problem: Value = serde_json::from_str(problem).unwrap();
        assert_eq!(problem["status"], status, "{refused:?}: {problem}");
        let kind = format!("urn:frontalis:problem:{reason}");
        assert_eq!(problem["type"], kind, "{refused:?}");
    }
}
