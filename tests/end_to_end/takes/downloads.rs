//! Takes over HTTP: the same service, and files in parts.

use frontalis_proto::v1::{TakeFormat, take_event::Event};
use harness::{
    HttpAnswer, RecordedTake, TestPerformance, TestServer, assert_eventually, http_get, http_send,
};
use hyper::Method;
use serde_json::{Value, json};

use super::{SESSION, export, export_as, get, recorded};

async fn send(server: &TestServer, method: Method, path: &str, body: &Value) -> HttpAnswer {
    let kind = [("content-type", "application/json")];
    http_send(server, &method, path, &kind, body.to_string().as_bytes()).await
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_lives_over_http_as_it_does_over_grpc() {
    let server = TestServer::with_session("stage").await;
    let body = json!({ "session": SESSION, "slate": "12A" });
    let started = send(&server, Method::POST, "/api/v1/takes", &body).await;
    assert_eq!(started.status, 201, "{}", started.text());
    let path = started.headers["location"].to_str().unwrap().to_owned();
    let name = path.replace("/api/v1/", "");
    assert_eq!(started.json()["state"], "TAKE_STATE_RECORDING");
    let again = send(&server, Method::POST, "/api/v1/takes", &body).await;
    assert_eq!(
        (again.status.as_u16(), &again.json()["type"]),
        (409, &"urn:frontalis:problem:TAKE_RECORDING".into())
    );
    let under_way = http_get(&server, &format!("{path}/file")).await;
    assert_eq!(
        (
            under_way.status.as_u16(),
            &under_way.headers["accept-ranges"]
        ),
        (200, &"none".parse().unwrap())
    );
    assert!(under_way.headers.get("etag").is_none());
    // The first commit comes a little after the start.
    let file = format!("{path}/file");
    assert_eventually!(matches!(
        RecordedTake::read(&http_get(&server, &file).await.body).events.first(),
        Some(Event::Header(it)) if it.take == name
    ));

    let change =
        json!({ "take": { "circled": true, "notes": "the one" }, "updateMask": "circled,notes" });
    let changed = send(&server, Method::PATCH, &path, &change).await;
    assert_eq!(changed.status, 200, "{}", changed.text());
    assert_eq!(
        (&changed.json()["circled"], &changed.json()["notes"]),
        (&true.into(), &"the one".into())
    );
    let stopped = send(&server, Method::POST, &format!("{path}/stop"), &json!({})).await;
    assert_eq!(
        stopped.json()["state"],
        "TAKE_STATE_CLOSED",
        "{}",
        stopped.text()
    );
    let over_grpc = json!(get(&server, &name).await.unwrap());
    assert_eq!(http_get(&server, &path).await.json(), over_grpc);
    for query in [
        "",
        "?session=sessions/stage",
        "?actor=actors/reference&slate=12A",
        "?pageSize=1",
    ] {
        let listed = http_get(&server, &format!("/api/v1/takes{query}"))
            .await
            .json();
        assert_eq!(listed["takes"], json!([over_grpc]), "{query}");
    }
    let none = http_get(&server, "/api/v1/takes?slate=12B").await.json();
    assert_eq!(none, json!({}));

    let deleted = http_send(&server, &Method::DELETE, &path, &[], b"").await;
    assert_eq!(deleted.status, 200, "{}", deleted.text());
    for path in [
        path.clone(),
        format!("{path}/file"),
        format!("{path}/file?format=csv"),
    ] {
        let gone = http_get(&server, &path).await;
        assert_eq!(
            (gone.status.as_u16(), &gone.json()["type"]),
            (404, &"urn:frontalis:problem:TAKE".into())
        );
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_download_that_broke_off_goes_on_where_it_was() {
    let server = TestServer::with_session("stage").await;
    let frames = TestPerformance::reference().frames(1..=120);
    let take = recorded(&server, "12A", frames).await;
    let path = format!("/api/v1/{}/file", take.name);
    let whole = http_get(&server, &path).await;
    assert_eq!(whole.body, export(&server, &take.name).await);
    assert_eq!(whole.headers["accept-ranges"], "bytes");
    let name = whole.headers["content-disposition"].to_str().unwrap();
    assert!(
        name.starts_with("attachment; filename=\"12A_1.mcap\""),
        "{name}"
    );
    let tag = whole.headers["etag"].to_str().unwrap().to_owned();
    let n_bytes = whole.body.len();
    let with = async |headers: &[(&str, &str)]| {
        http_send(&server, &Method::GET, &path, headers, b"").await
    };
    let half = n_bytes / 2;
    let first = with(&[("range", &format!("bytes=0-{}", half - 1))]).await;
    let rest = with(&[("range", &format!("bytes={half}-")), ("if-range", &tag)]).await;
    assert_eq!((first.status.as_u16(), rest.status.as_u16()), (206, 206));
    assert_eq!(
        rest.headers["content-range"].to_str().unwrap(),
        format!("bytes {half}-{}/{n_bytes}", n_bytes - 1)
    );
    assert_eq!([first.body, rest.body].concat(), whole.body);
    let other = with(&[("range", "bytes=0-1"), ("if-range", "\"another\"")]).await;
    assert_eq!((other.status.as_u16(), &other.body), (200, &whole.body));
    let held = with(&[("if-none-match", &tag)]).await;
    assert_eq!((held.status.as_u16(), held.body.len()), (304, 0));
    let head = http_send(&server, &Method::HEAD, &path, &[], b"").await;
    assert_eq!(
        head.headers["content-length"].to_str().unwrap(),
        n_bytes.to_string()
    );
    assert_eq!((head.status.as_u16(), head.body.len()), (200, 0));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_format_is_the_same_through_both_doors() {
    let server = TestServer::with_session("stage").await;
    let frames = TestPerformance::reference().frames(1..=60);
    let take = recorded(&server, "12A", frames).await;
    for (format, word, kind) in [
        (TakeFormat::Csv, "csv", "text/csv; charset=utf-8"),
        (
            TakeFormat::LiveLinkCsv,
            "live_link_csv",
            "text/csv; charset=utf-8",
        ),
        (
            TakeFormat::Trc,
            "trc",
            "text/tab-separated-values; charset=utf-8",
        ),
        (TakeFormat::C3d, "c3d", "application/octet-stream"),
        (TakeFormat::Glb, "TAKE_FORMAT_GLB", "model/gltf-binary"),
    ] {
        let path = format!("/api/v1/{}/file?format={word}", take.name);
        let answer = http_get(&server, &path).await;
        assert_eq!(
            (answer.status.as_u16(), answer.content_type.as_str()),
            (200, kind)
        );
        let (bytes, told) = export_as(&server, &take.name, format).await.unwrap();
        assert_eq!(answer.body, bytes, "{word}");
        assert_eq!(
            answer.headers["frontalis-frames"].to_str().unwrap(),
            told.n_frames.to_string()
        );
        assert_eq!(
            answer.headers["trailer"],
            "frontalis-bytes, frontalis-sha256"
        );
    }
    let unknown = http_get(&server, &format!("/api/v1/{}/file?format=bvh", take.name)).await;
    assert_eq!(
        (unknown.status.as_u16(), &unknown.json()["field"]),
        (400, &"format".into())
    );
    server.stop().await;
}
