//! Rows E3, E10 and E11: text that is no gRPC-web, the wrong protocol for a path, and deadlines that mean nothing.

use base64::{Engine as _, engine::general_purpose::STANDARD};
use frontalis_proto::v1::GetSessionRequest;
use harness::{RawConnection, assert_refused, encoded, http_send};
use hyper::{Method, StatusCode};
use tonic::Code;

use super::{SUBJECT, beside_a_control_session};

const GET: &str = "/frontalis.v1.SessionService/GetSession";
const PUBLISH: &str = "/frontalis.v1.CaptureService/PublishMarkers";
const FOLLOW: &str = "/frontalis.v1.CurveService/Follow";

fn request() -> Vec<u8> {
    encoded(&GetSessionRequest {
        name: SUBJECT.to_owned(),
    })
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_another_content_type_on_a_grpc_path_is_415() {
    beside_a_control_session("E10 content type", async |stage| {
        for kind in [
            "application/json",
            "text/plain",
            "application/grpcx",
            "application/grpc-other",
            "",
        ] {
            let headers = [("content-type", kind)];
            let answer = http_send(&stage.server, &Method::POST, GET, &headers, b"{}").await;
            assert_problem(&answer, StatusCode::UNSUPPORTED_MEDIA_TYPE, "CONTENT_TYPE");
        }
        let answer = http_send(&stage.server, &Method::POST, GET, &[], b"").await;
        assert_problem(&answer, StatusCode::UNSUPPORTED_MEDIA_TYPE, "CONTENT_TYPE");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_grpc_over_http_1_is_unimplemented() {
    beside_a_control_session("E10 HTTP/1.1", async |stage| {
        let headers = [("content-type", "application/grpc")];
        let answer = http_send(&stage.server, &Method::POST, GET, &headers, &request()).await;
        let status = tonic::Status::from_header_map(&answer.headers).unwrap();
        assert_refused(&status, Code::Unimplemented, "HTTP_VERSION");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_grpc_where_there_is_no_such_method_is_unimplemented() {
    beside_a_control_session("E10 methods", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        for path in [
            "/frontalis.v1.SessionService/Nothing",
            "/frontalis.v1.NothingService/GetSession",
            "/frontalis.v2.SessionService/GetSession",
            "/frontalis.v1.SessionService/",
            "/frontalis.v1.SessionService/GetSession/more",
            "/api/v1/sessions",
            "/api/v1/sessions/subject",
            "/healthz",
            "/nothing",
            "/",
        ] {
            let answer = connection.answer(path, &request()).await;
            assert_eq!(answer.http, StatusCode::OK, "{path}: {answer:?}");
            let refused = answer.status();
            assert_refused(&refused, Code::Unimplemented, "METHOD");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_unknown_paths_and_methods_over_http_are_404_and_405() {
    beside_a_control_session("E10 HTTP", async |stage| {
        for path in [
            "/nothing",
            "/api/v1/nothing",
            "/api/v2/sessions",
            "/api/v1/sessions/s/x",
        ] {
            let answer = http_send(&stage.server, &Method::GET, path, &[], b"").await;
            assert_problem(&answer, StatusCode::NOT_FOUND, "ROUTE");
        }
        let own = stage.server.address().to_string();
        for (method, path) in [
            (Method::TRACE, "/"),
            (Method::TRACE, "/api/v1/sessions"),
            (Method::TRACE, "/nothing"),
            (Method::TRACE, GET),
            (Method::CONNECT, own.as_str()),
            (Method::DELETE, "/healthz"),
            (Method::PUT, "/api/v1/sessions"),
            (Method::GET, GET),
            (Method::DELETE, PUBLISH),
        ] {
            let answer = http_send(&stage.server, &method, path, &[], b"").await;
            assert_problem(&answer, StatusCode::METHOD_NOT_ALLOWED, "HTTP_METHOD");
            assert!(answer.headers.contains_key("allow"), "{method} {path}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_other_methods_over_http_2_are_405() {
    beside_a_control_session("E10 HTTP/2", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let plain = [("content-type", "text/plain")];
        for method in [Method::TRACE, Method::PATCH, Method::GET] {
            for path in [GET, PUBLISH] {
                let mut call = connection.request(&method, path, &plain).await;
                call.finish();
                let answer = call.answer().await;
                assert_eq!(
                    answer.http,
                    StatusCode::METHOD_NOT_ALLOWED,
                    "{method} {path}"
                );
                assert_eq!(answer.headers["allow"], "POST");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e11_a_deadline_that_is_over_is_exceeded() {
    beside_a_control_session("E11 over", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        for path in [GET, PUBLISH, FOLLOW, "/grpc.health.v1.Health/Watch"] {
            for timeout in ["1n", "0n", "999u", "0S"] {
                let mut call = connection.call(path, &[("grpc-timeout", timeout)]).await;
                call.send(&request()).await;
                let refused = call.answer().await.status();
                assert_refused(&refused, Code::DeadlineExceeded, "DEADLINE");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e11_a_stream_is_cut_at_its_deadline_with_what_was_sent_before() {
    beside_a_control_session("E11 cut", async |stage| {
        let _publisher = stage.publisher().await;
        let start = encoded(&harness::every_frame(SUBJECT));
        let mut connection = RawConnection::open(&stage.server).await;
        for timeout in ["300m", "300000u", "1S"] {
            let mut call = connection.call(FOLLOW, &[("grpc-timeout", timeout)]).await;
            call.send(&start).await;
            call.finish();
            let answer = call.answer().await;
            assert!(!answer.body.is_empty(), "nothing came before the deadline");
            assert_refused(&answer.status(), Code::DeadlineExceeded, "DEADLINE");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e11_huge_deadlines_are_capped_and_malformed_ones_ignored() {
    beside_a_control_session("E11 odd", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        for timeout in [
            "99999999H",
            "99999999S",
            "1",
            "S",
            "",
            "-1S",
            "+1n",
            "1 n",
            "1x",
            "1N",
            "0x1n",
            "123456789n",
            "1.5n",
            "1n1n",
        ] {
            let mut call = connection.call(GET, &[("grpc-timeout", timeout)]).await;
            call.send(&request()).await;
            call.finish();
            let answer = call.answer().await.status();
            assert_eq!(answer.code(), Code::Ok, "{timeout:?}: {answer:?}");
        }
    })
    .await;
}

#[track_caller]
fn assert_problem(answer: &harness::HttpAnswer, status: StatusCode, reason: &str) {
    let text = String::from_utf8_lossy(&answer.body);
    assert_eq!(answer.status, status, "{text}");
    assert_eq!(answer.content_type, "application/problem+json", "{text}");
    let body = answer.json();
    assert_eq!(body["type"], format!("urn:frontalis:problem:{reason}"));
    assert_eq!(body["status"], status.as_u16());
    assert!(body["instance"].is_string(), "{text}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e10_grpc_web_is_refused_in_the_form_that_it_is_read_in() {
    beside_a_control_session("E10 gRPC-web", async |stage| {
        let text = "application/grpc-web-text+proto";
        let binary = "application/grpc-web+proto";
        for (asked, accepted, answered) in [
            ("application/grpc-web-text", text, text),
            ("application/grpc-web-text", "*/*", text),
            (text, binary, binary),
            (binary, text, text),
            ("application/grpc-web", "*/*", binary),
        ] {
            let headers = [("content-type", asked), ("accept", accepted)];
            let path = "/frontalis.v1.Nothing/Nothing";
            let answer = http_send(&stage.server, &Method::POST, path, &headers, b"").await;
            assert_eq!(answer.content_type, answered, "{asked}, {accepted}");
            assert_eq!(answer.headers["grpc-status"], "12");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e3_text_of_grpc_web_is_base64() {
    beside_a_control_session("E3 gRPC-web text", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let headers = [
            ("content-type", "application/grpc-web-text"),
            ("accept", "application/grpc-web+proto"),
        ];
        let good = STANDARD.encode(request());
        let (cut, not_padded) = (&good[..good.len() - 5], good.trim_end_matches('='));
        let stray = good.replacen('A', "!", 1);
        let with_line_ends = format!("{good}\r\n");
        for text in [cut, not_padded, &stray, &with_line_ends, "secret"] {
            let mut call = connection.call(GET, &headers).await;
            call.send(text.as_bytes()).await;
            call.finish();
            let refused = call.answer().await.status();
            assert_refused(&refused, Code::InvalidArgument, "BASE64");
        }
        let mut call = connection.call(GET, &headers).await;
        call.send(good.as_bytes()).await;
        call.finish();
        let answer = call.answer().await.status();
        assert_eq!(answer.code(), Code::Ok, "{answer:?}");
    })
    .await;
}
