//! Names, origins and what answers carry, at a router of two routes.

use axum::{
    Router,
    body::Body,
    http::{Method, StatusCode},
    middleware,
    routing::get,
};

use super::*;
use crate::config::{Http, Tls as TlsFiles};

fn router(change: impl FnOnce(&mut Http)) -> Router {
    behind(Guard::new(&config(change), None))
}

fn config(change: impl FnOnce(&mut Http)) -> Config {
    let mut config = Config::default();
    change(&mut config.http);
    config
}

fn behind(guard: Guard) -> Router {
    let page = || async { axum::response::Html("<p>page</p>") };
    Router::new()
        .route("/", get(|| async { "data" }).post(|| async { "changed" }))
        .route("/page", get(page))
        .layer(middleware::from_fn_with_state(guard, check))
}

async fn answer(router: Router, method: Method, headers: &[(&str, &str)]) -> Response {
    let mut request = Request::builder().method(method).uri("/");
    for (name, value) in headers {
        request = request.header(*name, *value);
    }
    let request = request.body(Body::empty()).unwrap();
    router.oneshot(request).await.unwrap()
}

async fn status(router: Router, headers: &[(&str, &str)]) -> StatusCode {
    answer(router, Method::GET, headers).await.status()
}

#[tokio::test]
async fn only_names_of_this_server_are_answered() {
    let named = || router(|http| http.hosts = vec!["Rig.Example".to_owned()]);
    for host in [
        "localhost",
        "localhost:7400",
        "127.0.0.1:7400",
        "[::1]:7400",
        "192.168.7.3",
        "rig.example",
        "RIG.example.:7400",
    ] {
        assert_eq!(
            status(named(), &[("host", host)]).await,
            StatusCode::OK,
            "{host}"
        );
    }
    for host in [
        "evil.example",
        "rig.example.evil.example",
        "localhost.evil.example",
        "127.0.0.1.evil.example",
        "0x7f000001",
        "2130706433",
    ] {
        let status = status(named(), &[("host", host)]).await;
        assert_eq!(status, StatusCode::MISDIRECTED_REQUEST, "{host}");
    }
    for unclear in [
        &[("host", "")][..],
        &[],
        &[("host", "localhost"), ("host", "localhost")],
        &[("host", "a@localhost")],
    ] {
        assert_eq!(
            status(named(), unclear).await,
            StatusCode::BAD_REQUEST,
            "{unclear:?}"
        );
    }
}

#[tokio::test]
async fn the_names_in_the_certificate_are_this_servers() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let names = vec!["rig.example".to_owned()];
    let certified = rcgen::generate_simple_self_signed(names).unwrap();
    std::fs::write(path("cert.pem"), certified.cert.pem()).unwrap();
    std::fs::write(path("key.pem"), certified.signing_key.serialize_pem()).unwrap();
    let files = TlsFiles {
        cert: path("cert.pem"),
        key: path("key.pem"),
        ..TlsFiles::default()
    };
    let guard = Guard::new(&Config::default(), Some(Tls::load(&files).unwrap()));
    let named = answer(
        behind(guard.clone()),
        Method::GET,
        &[("host", "rig.example")],
    )
    .await;
    assert_eq!(named.status(), StatusCode::OK);
    assert_eq!(
        named.headers()["strict-transport-security"],
        "max-age=31536000"
    );
    // Other programs answer at localhost too, and perhaps without TLS.
    let local = answer(behind(guard.clone()), Method::GET, &[("host", "localhost")]).await;
    assert!(!local.headers().contains_key("strict-transport-security"));
    let own = [("host", "rig.example"), ("origin", "https://rig.example")];
    assert_eq!(status(behind(guard.clone()), &own).await, StatusCode::OK);
    let plain = [("host", "rig.example"), ("origin", "http://rig.example")];
    assert_eq!(status(behind(guard), &plain).await, StatusCode::FORBIDDEN);
}

#[tokio::test]
async fn a_page_of_another_origin_is_refused_whatever_it_asks_for() {
    let host = ("host", "localhost:7400");
    for origin in [
        "https://evil.example",
        "null",
        "*",
        "",
        "http://localhost",
        "https://localhost:7400",
        "http://localhost:7400.evil.example",
    ] {
        for method in [Method::GET, Method::POST, Method::OPTIONS] {
            let answer = answer(router(|_| {}), method, &[host, ("origin", origin)]).await;
            assert_eq!(answer.status(), StatusCode::FORBIDDEN, "{origin}");
            assert!(!answer.headers().contains_key("access-control-allow-origin"));
        }
    }
    let twice = [
        host,
        ("origin", "http://localhost:7400"),
        ("origin", "null"),
    ];
    assert_eq!(status(router(|_| {}), &twice).await, StatusCode::FORBIDDEN);
    let own = [host, ("origin", "http://localhost:7400")];
    let answer = answer(router(|_| {}), Method::POST, &own).await;
    assert_eq!(answer.status(), StatusCode::OK);
}

#[tokio::test]
async fn a_listed_page_is_told_what_it_may_do_and_no_other_is() {
    let listed = || router(|http| http.origins = vec!["https://dashboard.example".to_owned()]);
    let headers = [
        ("host", "localhost:7400"),
        ("origin", "https://dashboard.example"),
        ("access-control-request-method", "POST"),
        ("access-control-request-headers", "authorization,x-grpc-web"),
    ];
    let preflight = answer(listed(), Method::OPTIONS, &headers).await;
    assert_eq!(preflight.status(), StatusCode::OK);
    let allowed = &preflight.headers()["access-control-allow-origin"];
    assert_eq!(allowed, "https://dashboard.example");
    let sent = preflight.headers()["access-control-allow-headers"]
        .to_str()
        .unwrap();
    assert!(
        sent.contains("authorization") && sent.contains("x-grpc-web"),
        "{sent}"
    );
    assert!(
        !preflight
            .headers()
            .contains_key("access-control-allow-credentials")
    );
    let asked = answer(listed(), Method::GET, &headers[..2]).await;
    let seen = asked.headers()["access-control-expose-headers"]
        .to_str()
        .unwrap();
    assert!(seen.contains("grpc-status-details-bin"), "{seen}");
    assert!(asked.headers()["vary"].to_str().unwrap().contains("origin"));
    // Without an origin OPTIONS is a method like any other.
    let bare = answer(listed(), Method::OPTIONS, &headers[..1]).await;
    assert_eq!(bare.status(), StatusCode::METHOD_NOT_ALLOWED);
}

#[tokio::test]
async fn grpc_is_refused_in_its_own_form() {
    for kind in ["application/grpc", "application/grpc-web+proto"] {
        let foreign = [
            ("host", "localhost"),
            ("origin", "null"),
            ("content-type", kind),
        ];
        let misdirected = [("host", "evil.example"), ("content-type", kind)];
        for headers in [&foreign[..], &misdirected] {
            let answer = answer(router(|_| {}), Method::POST, headers).await;
            assert_eq!(answer.status(), StatusCode::OK);
            assert_eq!(answer.headers()["content-type"], kind);
            assert_eq!(answer.headers()["grpc-status"], "7");
        }
    }
}

#[tokio::test]
async fn answers_say_what_a_browser_may_do_with_them() {
    let host = [("host", "localhost")];
    let data = answer(router(|_| {}), Method::GET, &host).await;
    assert_eq!(
        data.headers()["content-security-policy"],
        "default-src 'none'; frame-ancestors 'none'"
    );
    assert_eq!(data.headers()["x-content-type-options"], "nosniff");
    assert_eq!(data.headers()["referrer-policy"], "no-referrer");
    assert_eq!(data.headers()["cache-control"], "no-store");
    let page = Request::builder().uri("/page").header("host", "localhost");
    let page = router(|_| {})
        .oneshot(page.body(Body::empty()).unwrap())
        .await
        .unwrap();
    let policy = page.headers()["content-security-policy"].to_str().unwrap();
    assert!(policy.starts_with("default-src 'self';"), "{policy}");
}

#[tokio::test]
async fn long_targets_and_large_headers_have_their_own_answers() {
    let long = format!("/?{}", "x".repeat(MAX_TARGET_BYTES));
    let request = Request::builder().uri(long).header("host", "localhost");
    let answered = router(|_| {})
        .oneshot(request.body(Body::empty()).unwrap())
        .await
        .unwrap();
    assert_eq!(answered.status(), StatusCode::URI_TOO_LONG);
    assert_eq!(answered.headers()["connection"], "close");
    let large = "x".repeat(16 * 1024);
    let headers = [("host", "localhost"), ("a", &large)];
    let status = status(router(|_| {}), &headers).await;
    assert_eq!(status, StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE);
}
