//! Packages go up and come down bit for bit, and an upload says how far it is.

use frontalis_analysis::format::actor_package;
use frontalis_analysis::synthesis::reference_face;
use harness::{HttpAnswer, TestServer, http_get, http_send, reference_package};
use hyper::Method;
use serde_json::{Value, json};

const PATH: &str = "/api/v1/actors/reference";
const ZIP: (&str, &str) = ("content-type", "application/zip");
const GLB: (&str, &str) = ("content-type", "model/gltf-binary");
const LINES: (&str, &str) = ("accept", "application/x-ndjson");

async fn put(server: &TestServer, headers: &[(&str, &str)], body: &[u8]) -> HttpAnswer {
    http_send(server, &Method::PUT, PATH, headers, body).await
}

fn reference_zip() -> Vec<u8> {
    actor_package::write_zip(&reference_face::actor())
}

fn reference_glb() -> Vec<u8> {
    actor_package::write_glb(&reference_face::actor())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_package_comes_down_as_it_went_up_and_as_a_model() {
    let server = TestServer::start().await;
    let path = format!("{PATH}?displayName=One&unit=LENGTH_UNIT_CENTIMETER");
    let first = http_send(&server, &Method::PUT, &path, &[ZIP], &reference_zip()).await;
    assert_eq!(first.status, 200, "{}", first.text());
    assert_eq!(first.json()["actor"]["displayName"], "One");
    let second = put(&server, &[GLB], &reference_glb()).await;
    assert_eq!(second.json()["actor"]["revision"], 2, "{}", second.text());

    for (revision, package, kind, file) in [
        (1, reference_zip(), "application/zip", "reference-r1.zip"),
        (2, reference_glb(), "model/gltf-binary", "reference-r2.glb"),
    ] {
        let down = http_get(&server, &format!("{PATH}/package?revision={revision}")).await;
        assert_eq!(down.content_type, kind);
        assert_eq!(down.body, package);
        let disposition = down.headers["content-disposition"].to_str().unwrap();
        assert_eq!(disposition, format!("attachment; filename=\"{file}\""));
        let length = down.headers["content-length"].to_str().unwrap();
        assert_eq!(length, package.len().to_string());

        let model = http_get(&server, &format!("{PATH}/model.glb?revision={revision}")).await;
        assert_eq!(model.content_type, "model/gltf-binary");
        assert_eq!(model.body, reference_glb());
    }
    let missing = http_get(&server, &format!("{PATH}/model.glb?revision=3")).await;
    assert_eq!(missing.status, 404);
    assert_eq!(missing.json()["type"], "urn:frontalis:problem:ACTOR");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_model_is_sent_again_only_when_it_is_another() {
    let server = TestServer::start().await;
    server.import_reference().await;
    let path = format!("{PATH}/model.glb");
    let tag = tag(&http_get(&server, &path).await);
    let again = |held: String| {
        let (server, path) = (&server, &path);
        async move { http_send(server, &Method::GET, path, &[("if-none-match", &held)], b"").await }
    };
    let held = again(format!("\"other\", W/{tag}")).await;
    assert_eq!((held.status.as_u16(), held.body.len()), (304, 0));
    assert_eq!(self::tag(&held), tag);
    assert_eq!(again("\"other\"".into()).await.status, 200);

    server.import_reference().await;
    assert_eq!(again(tag.clone()).await.status, 200);
    let old = format!("{path}?revision=1");
    assert_eq!(self::tag(&http_get(&server, &old).await), tag);

    // Erased and imported anew, the same revision is another actor's.
    let erased = http_send(&server, &Method::DELETE, PATH, &[], b"").await;
    assert_eq!(erased.status, 200);
    server.import_reference().await;
    assert_eq!(again(tag).await.status, 200);
    server.stop().await;
}

fn tag(answer: &HttpAnswer) -> String {
    answer.headers["etag"].to_str().unwrap().to_owned()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_upload_says_how_far_it_is() {
    let server = TestServer::start().await;
    let package = reference_package();
    let answer = put(&server, &[ZIP, LINES], &package).await;
    assert_eq!(answer.content_type, "application/x-ndjson");
    let lines = lines(&answer);
    let (last, before) = lines.split_last().unwrap();
    assert_eq!(last["result"]["actor"]["name"], "actors/reference");
    let stages: Vec<&str> = before
        .iter()
        .map(|it| it["progress"]["stage"].as_str().unwrap())
        .collect();
    assert!(stages.is_sorted_by_key(|it| {
        ["RECEIVING", "READING", "STORING"]
            .iter()
            .position(|stage| stage == it)
    }));
    assert!(stages.ends_with(&["READING", "STORING"]), "{stages:?}");
    for line in before {
        let total = &line["progress"]["totalBytes"];
        assert_eq!(total, &json!(package.len().to_string()));
    }
    let received = &before.last().unwrap()["progress"]["receivedBytes"];
    assert_eq!(received, &json!(package.len().to_string()));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_upload_that_fails_says_so_in_its_last_line() {
    let server = TestServer::start().await;
    let answer = put(&server, &[ZIP, LINES], b"no package").await;
    assert_eq!(answer.status, 200);
    let lines = lines(&answer);
    let error = &lines.last().unwrap()["error"];
    assert_eq!(error["type"], "urn:frontalis:problem:PARSE");
    assert_eq!(error["instance"], PATH);
    // What is wrong before anything was read is a status.
    let refused = put(&server, &[("content-type", "text/plain"), LINES], b"").await;
    assert_eq!(refused.status, 415);
    server.stop().await;
}

fn lines(answer: &HttpAnswer) -> Vec<Value> {
    let lines = answer.text().lines();
    lines.map(|it| serde_json::from_str(it).unwrap()).collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_package_that_is_compressed_or_too_large_is_refused_by_what_it_is() {
    let server = TestServer::start_with(|config| config.limits.package_mib = 1).await;
    let gzip = [b"\x1f\x8b\x08".as_slice(), &[0; 64]].concat();
    let large = vec![0; 2 << 20];
    let encoded = ("content-encoding", "gzip");
    for (headers, body, status, reason) in [
        (&[ZIP][..], gzip.as_slice(), 501, "COMPRESSION"),
        (&[ZIP, encoded], b"PK", 501, "COMPRESSION"),
        (&[ZIP], &large, 413, "BASIS_SIZE"),
        (&[ZIP, LINES], &large, 413, "BASIS_SIZE"),
        (&[ZIP], b"", 400, "PARSE"),
    ] {
        let answer = put(&server, headers, body).await;
        let problem = answer.json();
        assert_eq!(problem["type"], format!("urn:frontalis:problem:{reason}"));
        assert_eq!(answer.status.as_u16(), status, "{problem}");
        if status == 413 {
            assert_eq!(problem["limit"], "limits.package_mib");
            assert_eq!(problem["value"], 1 << 20);
        }
    }
    let mismatch = format!("{PATH}?unit=LENGTH_UNIT_METER");
    let zip = actor_package_in_centimeters();
    let answer = http_send(&server, &Method::PUT, &mismatch, &[ZIP], &zip).await;
    assert_eq!(answer.json()["type"], "urn:frontalis:problem:UNIT_MISMATCH");
    server.stop().await;
}

fn actor_package_in_centimeters() -> Vec<u8> {
    let zip = reference_zip();
    assert!(zip.len() < 1 << 20, "{}", zip.len());
    zip
}
