//! A refusal has the same reason over HTTP as over gRPC, and says all that a problem document has.

use frontalis_proto::v1;
use harness::{Problem, TestServer, http_get, http_send};
use hyper::Method;
use serde_json::json;
use tonic::Status;

use super::{act, send};

const JSON: (&str, &str) = ("content-type", "application/json");

/// Method, path, headers and body, then status and reason.
type Refused<'a> = (
    Method,
    &'a str,
    &'a [(&'a str, &'a str)],
    &'a [u8],
    u16,
    &'a str,
);

fn same(status: &Status, reason: &str) {
    assert_eq!(Problem::of(status).reason, reason);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn both_doors_refuse_for_the_same_reason() {
    let server = TestServer::with_session("stage").await;
    let taken = json!({ "sessionId": "stage", "actor": "actors/reference", "kind": 1 });
    let answer = send(&server, Method::POST, "/api/v1/sessions", &taken).await;
    assert_eq!(
        (answer.status.as_u16(), &answer.json()["type"]),
        (409, &json!("urn:frontalis:problem:SESSION_EXISTS"))
    );
    let refused = server.create_session("stage", "actors/reference").await;
    same(&refused.unwrap_err(), "SESSION_EXISTS");

    let cases = [
        (
            json!({ "settings": { "neutralFrames": 0 } }),
            400,
            "SOLVER_OPTIONS",
            Some("settings.neutralFrames"),
        ),
        (
            json!({ "updateMask": "colour" }),
            400,
            "FIELD_MASK",
            Some("updateMask"),
        ),
        (json!({ "actorRevision": 9 }), 404, "ACTOR", None),
    ];
    for (body, status, reason, field) in cases {
        let answer = send(&server, Method::PATCH, "/api/v1/sessions/stage", &body).await;
        let problem = answer.json();
        assert_eq!(answer.status.as_u16(), status, "{problem}");
        assert_eq!(problem["type"], format!("urn:frontalis:problem:{reason}"));
        assert_eq!(problem["field"].as_str(), field);
        let mut request: v1::UpdateSessionRequest = serde_json::from_value(body).unwrap();
        request.name = "sessions/stage".into();
        let refused = server.sessions().await.update_session(request).await;
        same(&refused.unwrap_err(), reason);
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_problem_says_all_that_it_has_to() {
    let server = TestServer::with_session("stage").await;
    let session = "/api/v1/sessions/stage";
    let large = vec![b' '; (1 << 20) + 1];
    let deep = format!(
        "{{\"settings\":{{\"smoothing\":{}{}}}}}",
        "[".repeat(400),
        "]".repeat(400)
    );
    let encoded = ("content-encoding", "br");
    let text = ("content-type", "text/plain");
    let requests: [Refused<'_>; 15] = [
        (Method::PATCH, session, &[JSON], &large, 413, "BODY_SIZE"),
        (Method::PATCH, session, &[text], b"{}", 415, "CONTENT_TYPE"),
        (Method::PATCH, session, &[], b"{}", 415, "CONTENT_TYPE"),
        (
            Method::PATCH,
            session,
            &[JSON, encoded],
            b"{}",
            501,
            "COMPRESSION",
        ),
        (Method::PATCH, session, &[JSON], b"", 400, "JSON"),
        (Method::PATCH, session, &[JSON], b"{} {}", 400, "JSON"),
        (
            Method::PATCH,
            session,
            &[JSON],
            b"{\"name\":\"sessions/a\"}",
            400,
            "JSON",
        ),
        (Method::PATCH, session, &[JSON], b"\xff", 400, "JSON"),
        (
            Method::PATCH,
            session,
            &[JSON],
            deep.as_bytes(),
            400,
            "JSON",
        ),
        (Method::PUT, session, &[], b"", 405, "HTTP_METHOD"),
        (
            Method::GET,
            "/api/v1/sessions/nobody",
            &[],
            b"",
            404,
            "SESSION",
        ),
        (Method::GET, "/api/v1/sessions/A", &[], b"", 400, "NAME"),
        (Method::GET, "/api/v1/sessions/a%2Fb", &[], b"", 400, "NAME"),
        (
            Method::GET,
            "/api/v1/sessions?pageSize=1&pageSize=1",
            &[],
            b"",
            400,
            "QUERY",
        ),
        (Method::GET, "/api/v1/nothing", &[], b"", 404, "ROUTE"),
    ];
    for (method, path, headers, body, status, reason) in requests {
        let answer = http_send(&server, &method, path, headers, body).await;
        let problem = answer.json();
        assert_eq!(answer.content_type, "application/problem+json");
        assert_eq!(answer.status.as_u16(), status, "{method} {path}: {problem}");
        assert_eq!(problem["status"], status);
        assert_eq!(problem["type"], format!("urn:frontalis:problem:{reason}"));
        let title = problem["title"].as_str().unwrap();
        assert!(title.contains(' ') && title != reason, "{title}");
        assert_eq!(problem["instance"], path.split('?').next().unwrap());
        assert!(!problem["detail"].as_str().unwrap().is_empty());
    }
    let answer = http_send(&server, &Method::PATCH, session, &[JSON], &large).await;
    assert_eq!(answer.json()["limit"], "body");
    assert_eq!(answer.json()["value"], 1 << 20);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_path_names_the_methods_that_it_has() {
    let server = TestServer::start().await;
    for (path, method, allowed) in [
        ("/api/v1/sessions", Method::DELETE, "GET,HEAD,POST"),
        ("/api/v1/sessions/a", Method::POST, "GET,HEAD,PATCH"),
        ("/api/v1/sessions/a/end", Method::GET, "POST"),
        ("/api/v1/actors/a", Method::PATCH, "DELETE,GET,HEAD,PUT"),
        ("/api/v1/server", Method::POST, "GET,HEAD"),
        ("/openapi.json", Method::POST, "GET,HEAD"),
        ("/healthz", Method::TRACE, "GET,HEAD"),
    ] {
        let answer = act(&server, method, path).await;
        assert_eq!(answer.status, 405, "{path}");
        let allow = answer.headers["allow"].to_str().unwrap();
        let mut methods: Vec<&str> = allow.split(',').collect();
        methods.sort_unstable();
        assert_eq!(methods.join(","), allowed, "{path}");
        assert_eq!(answer.json()["type"], "urn:frontalis:problem:HTTP_METHOD");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_limit_says_when_to_come_back() {
    let server = TestServer::start_with(|config| config.limits.sessions = 1).await;
    server.import_reference().await;
    server
        .create_session("a", "actors/reference")
        .await
        .unwrap();
    let one_more = json!({ "actor": "actors/reference", "kind": "CAPTURE_KIND_MARKERS" });
    let answer = send(&server, Method::POST, "/api/v1/sessions", &one_more).await;
    assert_eq!(answer.status, 429);
    assert_eq!(answer.headers["retry-after"], "1");
    let problem = answer.json();
    assert_eq!(
        (&problem["limit"], &problem["value"]),
        (&json!("limits.sessions"), &json!(1))
    );
    assert_eq!(http_get(&server, "/api/v1/sessions").await.status, 200);
    server.stop().await;
}
