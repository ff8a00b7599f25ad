//! Rows E14 and I14: pages of other origins, and names that are not this server's.

use frontalis_proto::v1::SessionState;
use harness::{HttpAnswer, Problem, TestServer, http_send};
use hyper::{Method, StatusCode};
use tonic::Code;

use super::{Stage, beside_a_control_session, beside_a_control_session_with};

const UPGRADE: [(&str, &str); 4] = [
    ("connection", "upgrade"),
    ("upgrade", "websocket"),
    ("sec-websocket-version", "13"),
    ("sec-websocket-key", "dGhlIHNhbXBsZSBub25jZQ=="),
];

const STREAM: &str = "/api/v1/sessions/subject/stream";

/// `Host` is said by the test.
async fn asked_as(stage: &Stage, host: &str, headers: &[(&str, &str)]) -> HttpAnswer {
    let named = [&[("host", host)], headers].concat();
    http_send(&stage.server, &Method::GET, "/api/v1/sessions", &named, b"").await
}

async fn from_page(
    server: &TestServer,
    method: &Method,
    path: &str,
    origin: &str,
    headers: &[(&str, &str)],
) -> HttpAnswer {
    let headers = [&[("origin", origin)], headers].concat();
    http_send(server, method, path, &headers, b"{}").await
}

fn assert_problem(answer: &HttpAnswer, status: StatusCode, reason: &str) {
    assert_eq!(answer.status, status, "{}", answer.text());
    assert_eq!(answer.content_type, "application/problem+json");
    let kind = format!("urn:frontalis:problem:{reason}");
    assert_eq!(answer.json()["type"], kind);
    assert!(!answer.headers.contains_key("access-control-allow-origin"));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e14_a_foreign_origin_is_refused_at_every_door() {
    beside_a_control_session("E14 origin", async |stage| {
        let server = &stage.server;
        for origin in ["https://evil.example", "null", "http://localhost:1"] {
            let socket = from_page(server, &Method::GET, STREAM, origin, &UPGRADE).await;
            assert_problem(&socket, StatusCode::FORBIDDEN, "ORIGIN");
            let json = [("content-type", "application/json")];
            let post = from_page(server, &Method::POST, "/api/v1/sessions", origin, &json).await;
            assert_problem(&post, StatusCode::FORBIDDEN, "ORIGIN");
            let events = "/api/v1/sessions/subject/events";
            let events = from_page(server, &Method::GET, events, origin, &[]).await;
            assert_problem(&events, StatusCode::FORBIDDEN, "ORIGIN");
        }
        // gRPC-web from a page is refused as gRPC refuses.
        let kind = [
            ("content-type", "application/grpc-web+proto"),
            ("x-grpc-web", "1"),
        ];
        let path = "/frontalis.v1.SessionService/ListSessions";
        let call = from_page(server, &Method::POST, path, "https://evil.example", &kind).await;
        assert_eq!(call.status, StatusCode::OK);
        let status = tonic::Status::from_header_map(&call.headers).unwrap();
        let problem = Problem::of(&status);
        assert_eq!(
            (problem.code, problem.reason.as_str()),
            (Code::PermissionDenied, "ORIGIN")
        );
        // Its own pages may.
        let own = format!("http://{}", server.address());
        let socket = from_page(server, &Method::GET, "/api/v1/sessions", &own, &[]).await;
        assert_eq!(socket.status, StatusCode::OK);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e14_a_name_that_another_owner_points_here_is_refused() {
    let change = |config: &mut frontalis_server::config::Config| {
        config.http.hosts = vec!["rig.example".to_owned()];
    };
    beside_a_control_session_with("E14 host", change, async |stage| {
        for host in [
            "evil.example",
            "evil.example:7400",
            "127.0.0.1.evil.example",
        ] {
            let answer = asked_as(stage, host, &[]).await;
            assert_problem(&answer, StatusCode::MISDIRECTED_REQUEST, "HOST");
            // The page's origin is the name that it was loaded by: the same, and as foreign.
            let origin = format!("http://{host}");
            let answer = asked_as(stage, host, &[("origin", &origin)]).await;
            assert_problem(&answer, StatusCode::MISDIRECTED_REQUEST, "HOST");
            let answer = asked_as(stage, host, &UPGRADE).await;
            assert_problem(&answer, StatusCode::MISDIRECTED_REQUEST, "HOST");
        }
        for host in ["localhost:7400", "127.0.0.1", "[::1]:7400", "rig.example"] {
            assert_eq!(
                asked_as(stage, host, &[]).await.status,
                StatusCode::OK,
                "{host}"
            );
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i14_a_form_and_a_fetch_with_credentials_from_another_site_change_nothing() {
    beside_a_control_session("I14", async |stage| {
        let server = &stage.server;
        let forms = [
            "application/x-www-form-urlencoded",
            "multipart/form-data; boundary=x",
            "text/plain",
        ];
        for kind in forms {
            let headers = [("content-type", kind), ("sec-fetch-site", "cross-site")];
            let path = "/api/v1/sessions/subject/end";
            let form = from_page(
                server,
                &Method::POST,
                path,
                "https://evil.example",
                &headers,
            )
            .await;
            assert_problem(&form, StatusCode::FORBIDDEN, "ORIGIN");
        }
        let credentials = [("cookie", "a=b"), ("authorization", "Bearer x")];
        for method in [Method::GET, Method::PUT, Method::PATCH, Method::DELETE] {
            let path = "/api/v1/sessions/subject";
            let fetch =
                from_page(server, &method, path, "https://evil.example", &credentials).await;
            assert_problem(&fetch, StatusCode::FORBIDDEN, "ORIGIN");
        }
        let asked = [("access-control-request-method", "DELETE")];
        let path = "/api/v1/actors/reference";
        let preflight = from_page(
            server,
            &Method::OPTIONS,
            path,
            "https://evil.example",
            &asked,
        )
        .await;
        assert_problem(&preflight, StatusCode::FORBIDDEN, "ORIGIN");
        let session = server.session(super::SUBJECT).await;
        let state = session.status.unwrap().state();
        assert_eq!(state, SessionState::Waiting);
    })
    .await;
}
