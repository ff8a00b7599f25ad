//! Row I6: what is asked of a take's file is had, or refused.

use frontalis_proto::v1::{StartTakeRequest, StopTakeRequest};
use harness::{TestServer, http_get, http_send};
use hyper::Method;

use super::Stage;

async fn take(server: &TestServer, session: &str) -> String {
    let mut takes = server.takes().await;
    let start = StartTakeRequest {
        session: session.to_owned(),
        ..StartTakeRequest::default()
    };
    let take = takes.start_take(start).await.unwrap().into_inner().take;
    let name = take.unwrap().name;
    let stop = StopTakeRequest { name: name.clone() };
    takes.stop_take(stop).await.unwrap();
    name
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i6_range_bombs_paths_and_planted_links_give_nothing_away() {
    super::beside_a_control_session("I6", async |stage: &Stage| {
        let server = &stage.server;
        let name = take(server, super::SUBJECT).await;
        let path = format!("/api/v1/{name}/file");
        let bomb = format!("bytes={}", "0-,".repeat(1_000));
        for range in [
            &bomb,
            "bytes=0-0,1-1",
            "bytes=99999999-",
            "bytes=5-4",
            "bytes=-0",
            "bytes=x-",
        ] {
            let answer = http_send(server, &Method::GET, &path, &[("range", range)], b"").await;
            assert_eq!(answer.status, 416, "{range:.40}");
            assert_eq!(answer.json()["type"], "urn:frontalis:problem:RANGE");
            let place = answer.headers["content-range"].to_str().unwrap();
            assert!(place.starts_with("bytes */"), "{place}");
        }
        for id in [
            "..%2fcatalogue",
            "%2e%2e%2f%2e%2e%2fetc%2fpasswd",
            "a%00b",
            "A",
            ".",
            "%2fetc%2fpasswd",
        ] {
            for rest in ["", "/file", "/file?format=trc"] {
                let answer = http_get(server, &format!("/api/v1/takes/{id}{rest}")).await;
                let status = answer.status.as_u16();
                assert!(matches!(status, 400 | 404), "{id}{rest}: {status}");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i6_a_link_in_the_place_of_a_take_is_not_followed() {
    let server = TestServer::with_session("stage").await;
    let name = take(&server, "sessions/stage").await;
    let outside = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(outside.path(), "a secret of somebody else").unwrap();
    let file = server
        .data_dir()
        .join("takes")
        .join(name.replace("takes/", ""))
        .with_extension("mcap");
    std::fs::remove_file(&file).unwrap();
    std::os::unix::fs::symlink(outside.path(), &file).unwrap();
    for query in ["", "?format=csv", "?format=mcap", "?format=c3d"] {
        let answer = http_get(&server, &format!("/api/v1/{name}/file{query}")).await;
        assert_eq!(answer.status, 500, "{query}");
        assert!(!answer.text().contains("secret"), "{}", answer.text());
    }
    let removed = http_send(
        &server,
        &Method::DELETE,
        &format!("/api/v1/{name}"),
        &[],
        b"",
    )
    .await;
    assert_eq!(removed.status, 200);
    assert!(
        outside.path().exists(),
        "the link is removed, and not what it leads to"
    );
    server.stop().await;
}
