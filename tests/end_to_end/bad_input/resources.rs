//! Rows I7, I8, I13 and I15: what clients may pile up, and what becomes of the names that they choose.

use std::time::Duration;

use frontalis_proto::v1::{CreateSessionRequest, PublishMarkersRequest};
use frontalis_server::config::Config;
use harness::{
    HttpAnswer, Publisher, RawConnection, Subscriber, TestServer, assert_refused, encoded,
    every_frame, http_get, http_send,
};
use hyper::{Method, StatusCode};
use tokio::time::Instant;
use tonic::Code;

use super::{
    SUBJECT, beside_a_control_session, beside_a_control_session_of, beside_a_control_session_with,
};

const JSON: [(&str, &str); 1] = [("content-type", "application/json")];
const EVENTS: &str = "/api/v1/sessions/subject/events?delivery=every_frame";
const SUBSCRIBE: &str = "/frontalis.v1.CurveService/Subscribe";

/// Sessions of the control and the subject, and room for one more.
const SESSIONS: u64 = 3;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i7_sessions_in_a_loop_end_at_the_limit_through_every_door() {
    let few = |config: &mut Config| config.limits.sessions = SESSIONS;
    beside_a_control_session_with("I7 sessions", few, async |stage| {
        stage
            .server
            .create_session("last", "actors/reference")
            .await
            .unwrap();
        for attempt in 0..50 {
            let began = Instant::now();
            let refused = stage
                .server
                .create_session(&format!("more-{attempt}"), "actors/reference")
                .await
                .unwrap_err();
            println!("I7: refused after {:?}", began.elapsed());
            assert_refused(&refused, Code::ResourceExhausted, "SESSIONS");
            assert!(refused.message().contains("limited to 3"), "{refused}");
        }
        let body =
            br#"{"sessionId":"more","actor":"actors/reference","kind":"CAPTURE_KIND_MARKERS"}"#;
        let answer = http_send(
            &stage.server,
            &Method::POST,
            "/api/v1/sessions",
            &JSON,
            body,
        )
        .await;
        assert_limit(&answer, "SESSIONS", "limits.sessions", SESSIONS);
        stage.server.end_session("sessions/last").await;
        let created = http_send(
            &stage.server,
            &Method::POST,
            "/api/v1/sessions",
            &JSON,
            body,
        )
        .await;
        assert_eq!(created.status, StatusCode::CREATED, "{}", created.text());
    })
    .await;
}

/// As many as the control session has.
const SUBSCRIBERS: u64 = 4;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i7_subscribers_in_a_loop_end_at_the_limit_through_every_door() {
    let few = |config: &mut Config| config.limits.subscribers_per_session = SUBSCRIBERS;
    beside_a_control_session_with("I7 subscribers", few, async |stage| {
        let mut held = Vec::new();
        for _ in 0..SUBSCRIBERS {
            held.push(
                Subscriber::open(&stage.server, every_frame(SUBJECT))
                    .await
                    .unwrap(),
            );
        }
        let start = frontalis_proto::v1::SubscribeRequest {
            start: Some(every_frame(SUBJECT)),
            credits: 0,
        };
        let mut connection = RawConnection::open(&stage.server).await;
        for kind in ["application/grpc", "application/grpc-web+proto"] {
            let mut call = connection.call(SUBSCRIBE, &[("content-type", kind)]).await;
            call.send(&encoded(&start)).await;
            let refused = call.answer().await.status();
            assert_refused(&refused, Code::ResourceExhausted, "SUBSCRIBERS");
        }
        let answer = http_get(&stage.server, EVENTS).await;
        let limit = "limits.subscribers_per_session";
        assert_limit(&answer, "SUBSCRIBERS", limit, SUBSCRIBERS);
        drop(held.pop());
        harness::assert_eventually!(
            Subscriber::open(&stage.server, every_frame(SUBJECT))
                .await
                .is_ok()
        );
    })
    .await;
}

/// The control session's five, and three more.
const CALLS: u64 = 8;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i7_calls_in_a_loop_end_at_the_limit_through_every_door() {
    let few = |config: &mut Config| config.limits.calls = CALLS;
    beside_a_control_session_with("I7 calls", few, async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let mut held = Vec::new();
        let mut refused = None;
        // What made the session may not have been counted out yet.
        while refused.is_none() {
            assert!(held.len() < 4, "a fourth call was let in");
            let mut call = connection
                .call("/frontalis.v1.CurveService/Follow", &[])
                .await;
            call.send(&encoded(&every_frame(SUBJECT))).await;
            call.finish();
            let (outgoing, response) = call.begin_answer().await;
            refused = tonic::Status::from_header_map(response.headers());
            held.push((outgoing, response));
        }
        assert_refused(&refused.unwrap(), Code::ResourceExhausted, "CALLS");
        for path in ["/api/v1/server", EVENTS] {
            let began = Instant::now();
            let answer = http_get(&stage.server, path).await;
            println!("I7: {path} refused after {:?}", began.elapsed());
            assert_limit(&answer, "CALLS", "limits.calls", CALLS);
        }
        for path in ["/healthz", "/readyz", "/metrics"] {
            let answer = http_get(&stage.server, path).await;
            assert_eq!(answer.status, StatusCode::OK, "{path}");
        }
        drop(held);
        harness::assert_eventually!(
            http_get(&stage.server, "/api/v1/server").await.status == StatusCode::OK
        );
    })
    .await;
}

/// Length of the loop of row I8; `make churn` asks for ten minutes.
const CHURN_SECONDS: &str = "FRONTALIS_CHURN_SECONDS";
const SHORT_CHURN: Duration = Duration::from_secs(5);

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i8_sessions_made_and_ended_in_a_loop_leave_the_figures_flat() {
    let server = TestServer::start_program(|_| {}).await;
    beside_a_control_session_of("I8", server, async |stage| {
        let asked = std::env::var(CHURN_SECONDS).ok();
        let seconds = asked.and_then(|it| it.parse().ok());
        let duration = seconds.map_or(SHORT_CHURN, Duration::from_secs);
        let program = stage.server.program();
        // What is made once is made first: pools, caches, pages of the database.
        churn(&stage.server, &stage.performance, duration / 2).await;
        let (rss, files) = (program.resident_bytes(), program.n_open_files());
        let is_log = |name: &str| name.ends_with("-wal");
        let disk = stage.server.disk_bytes(|it| !is_log(it));
        let n_rounds = churn(&stage.server, &stage.performance, duration).await;
        let grown = program.resident_bytes().saturating_sub(rss);
        let kept = stage.server.disk_bytes(|it| !is_log(it));
        let disk_grown = kept.saturating_sub(disk);
        println!("I8: {n_rounds} rounds, {grown} bytes of memory, {disk_grown} bytes on disk");
        assert!(
            grown <= 4 << 20,
            "{grown} bytes more after {n_rounds} rounds"
        );
        assert!(disk_grown <= 1 << 20, "{disk_grown} bytes more on disk");
        // The database's log is written over from its start when it has a thousand pages.
        let log_bytes = stage.server.disk_bytes(is_log);
        assert!(
            log_bytes <= 8 << 20,
            "{log_bytes} bytes of the database's log"
        );
        harness::assert_eventually!(program.n_open_files() <= files);
    })
    .await;
}

/// A session is made, published into, heard and ended, again and again.
async fn churn(
    server: &TestServer,
    performance: &harness::TestPerformance,
    duration: Duration,
) -> usize {
    let began = Instant::now();
    let mut n_rounds = 0;
    while began.elapsed() < duration {
        server
            .create_session("churn", "actors/reference")
            .await
            .unwrap();
        let start = performance.start("sessions/churn", "camera-1");
        let mut publisher = Publisher::open(server, start).await.unwrap();
        let mut subscriber = Subscriber::open(server, every_frame("sessions/churn"))
            .await
            .unwrap();
        publisher.publish(performance.frames(1..=20)).await;
        subscriber.samples_through(20).await.unwrap();
        server.end_session("sessions/churn").await;
        n_rounds += 1;
    }
    n_rounds
}

/// What a careless page would run.
const SCRIPT: &str = "<script>alert(\"1\")</script><img src=x onerror=alert(1)>&amp;'";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i13_names_with_markup_leave_as_data() {
    beside_a_control_session("I13", async |stage| {
        let request = CreateSessionRequest {
            session_id: "markup".to_owned(),
            actor: "actors/reference".to_owned(),
            kind: frontalis_proto::v1::CaptureKind::Markers.into(),
            display_name: SCRIPT.to_owned(),
            settings: None,
        };
        stage
            .server
            .sessions()
            .await
            .create_session(request)
            .await
            .unwrap();
        let answer = http_get(&stage.server, "/api/v1/sessions/markup").await;
        assert_eq!(answer.json()["displayName"], SCRIPT);
        for path in [
            "/",
            "/docs",
            "/openapi.json",
            "/metrics",
            "/api/v1/sessions",
            "/api/v1/sessions/markup",
            "/api/v1/sessions/%3Cscript%3E",
            "/api/v1/sessions/subject/curves",
            "/api/v1/sessions?pageToken=%3Cscript%3E",
            "/%3Cscript%3Ealert(1)%3C/script%3E",
            "/healthz",
        ] {
            let answer = http_get(&stage.server, path).await;
            assert_eq!(
                answer.headers["x-content-type-options"], "nosniff",
                "{path}"
            );
            let policy = answer.headers["content-security-policy"].to_str().unwrap();
            assert!(policy.contains("default-src"), "{path}: {policy}");
            let is_page = answer.content_type.starts_with("text/html");
            if is_page || answer.content_type.is_empty() {
                assert!(!answer.text().contains("<script>alert"), "{path}");
            }
            if is_page {
                assert!(["/", "/docs"].contains(&path), "{path} is a page");
            }
        }
    })
    .await;
}

/// Text that nobody but a client would choose.
const MARK: &str = "zz-marked-zz";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i15_what_clients_choose_is_never_a_label() {
    beside_a_control_session("I15", async |stage| {
        let series = async || -> Vec<String> {
            let answer = http_get(&stage.server, "/metrics").await;
            assert!(!answer.text().contains(MARK), "{}", answer.text());
            let names = answer.text().lines().filter(|it| !it.starts_with('#'));
            names
                .map(|it| it.rsplit_once(' ').map_or(it, |(name, _)| name).to_owned())
                .collect()
        };
        one_of_each_door(&stage.server, "warm-up").await;
        let before = series().await;
        stage
            .server
            .create_session(MARK, "actors/reference")
            .await
            .unwrap();
        let name = format!("sessions/{MARK}");
        let mut start = stage.performance.start(&name, MARK);
        start.marker_names = stage.performance.marker_names().to_vec();
        start.marker_names.push(MARK.to_owned());
        let frame = PublishMarkersRequest::default();
        let mut publisher = Publisher::open(&stage.server, start).await.unwrap();
        publisher.send_message(frame).await;
        let mut subscribe = every_frame(&name);
        subscribe.subscriber = MARK.to_owned();
        let _subscriber = Subscriber::open(&stage.server, subscribe).await.unwrap();
        for number in 0..20 {
            one_of_each_door(&stage.server, &format!("{MARK}-{number}")).await;
        }
        let after = series().await;
        assert_eq!(after.len(), before.len(), "{before:?} became {after:?}");
    })
    .await;
}

/// Requests through every door in which everything that can be chosen is `text`.
async fn one_of_each_door(server: &TestServer, text: &str) {
    let headers = [("user-agent", text), (text, text)];
    for path in [
        format!("/{text}"),
        format!("/api/v1/sessions/{text}"),
        format!("/api/v1/sessions/{text}/curves"),
        format!("/api/v1/sessions/{text}/events?subscriber={text}"),
        format!("/api/v1/sessions/{text}/stream"),
        format!("/frontalis.v1.CurveService/{text}"),
    ] {
        http_send(server, &Method::GET, &path, &headers, b"").await;
    }
    let frames = format!("/api/v1/sessions/{text}/frames");
    let lines = [
        ("content-type", "application/x-ndjson"),
        ("user-agent", text),
    ];
    http_send(server, &Method::POST, &frames, &lines, b"{}\n").await;
    let mut connection = RawConnection::open(server).await;
    for kind in ["application/grpc", "application/grpc-web+proto", text] {
        for path in [
            format!("/frontalis.v1.CurveService/{text}"),
            format!("/{text}.v1/X"),
        ] {
            let headers = [("content-type", kind), ("user-agent", text)];
            let mut call = connection.call(&path, &headers).await;
            call.finish();
            call.answer().await;
        }
    }
}

#[track_caller]
fn assert_limit(answer: &HttpAnswer, reason: &str, limit: &str, value: u64) {
    assert_eq!(
        answer.status,
        StatusCode::TOO_MANY_REQUESTS,
        "{}",
        answer.text()
    );
    assert_eq!(answer.content_type, "application/problem+json");
    let body = answer.json();
    assert_eq!(body["type"], format!("urn:frontalis:problem:{reason}"));
    assert_eq!(body["limit"], limit, "{body}");
    assert_eq!(body["value"], value, "{body}");
    let seconds: u64 = answer.headers["retry-after"]
        .to_str()
        .unwrap()
        .parse()
        .unwrap();
    assert!(seconds >= 1);
}
