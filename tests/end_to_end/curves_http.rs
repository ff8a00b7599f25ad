//! The same port speaks plain HTTP: curves for a script that polls, the lists, health and metrics.

use harness::{Publisher, Subscriber, TestPerformance, TestServer, every_frame, http_get};

const SESSION: &str = "sessions/stage";
const FRAMES: u64 = 40;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_script_reads_every_curve_by_polling() {
    let server = staged().await;
    let mut seen = Vec::new();
    let mut run = None;
    loop {
        let position = run.map_or_else(String::new, |run| format!("run={run}&"));
        let after = seen.len();
        let path = format!("/api/v1/sessions/stage/curves?{position}after={after}&limit=7");
        let answer = http_get(&server, &path).await;
        assert_eq!(answer.status, 200, "{}", answer.text());
        let json = answer.json();
        run = number(&json["header"]["run"]);
        // An empty list is left out.
        let Some(samples) = json.get("samples") else {
            break;
        };
        let samples = samples.as_array().unwrap();
        assert!(samples.len() <= 7);
        for sample in samples {
            assert_eq!(sample["activations"].as_array().unwrap().len(), 16);
            seen.push(number(&sample["sequence"]).unwrap());
        }
    }
    assert_eq!(seen, (1..=FRAMES).collect::<Vec<_>>());

    let other = format!(
        "/api/v1/sessions/stage/curves?run={}&after=0&limit=7",
        run.unwrap() + 1
    );
    let refused = http_get(&server, &other).await;
    assert_eq!(refused.status, 416);
    assert_eq!(refused.content_type, "application/problem+json");
    assert_eq!(refused.json()["type"], "urn:frontalis:problem:NEW_RUN");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn lists_health_and_metrics_are_plain_http() {
    let server = staged().await;
    let actors = http_get(&server, "/api/v1/actors").await;
    assert!(
        actors.text().contains("actors/reference"),
        "{}",
        actors.text()
    );
    let sessions = http_get(&server, "/api/v1/sessions").await;
    assert!(sessions.text().contains(SESSION), "{}", sessions.text());
    let session = http_get(&server, "/api/v1/sessions/stage").await;
    assert_eq!(
        (session.status.as_u16(), &session.json()["name"]),
        (200, &SESSION.into())
    );
    for path in ["/healthz", "/readyz"] {
        assert_eq!(http_get(&server, path).await.status, 200, "{path}");
    }
    let metrics = http_get(&server, "/metrics").await;
    assert_eq!(metrics.status, 200);
    assert!(metrics.text().contains("frontalis_"), "{}", metrics.text());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_is_not_there_is_a_problem_document() {
    let server = staged().await;
    for (path, status, reason) in [
        ("/api/v1/sessions/nobody", 404, "SESSION"),
        ("/api/v1/sessions/nobody/curves", 404, "SESSION"),
        ("/api/v1/sessions/..%2f..%2fetc", 400, "NAME"),
        ("/api/v1/sessions/UPPER", 400, "NAME"),
    ] {
        let answer = http_get(&server, path).await;
        assert_eq!(answer.status.as_u16(), status, "{path}: {}", answer.text());
        assert_eq!(answer.content_type, "application/problem+json", "{path}");
        let problem = answer.json();
        assert_eq!(
            problem["type"],
            format!("urn:frontalis:problem:{reason}"),
            "{path}"
        );
        assert_eq!(problem["status"], status, "{path}");
    }
    assert_eq!(http_get(&server, "/nothing/here").await.status, 404);
    server.stop().await;
}

/// 64 bits are text in JSON.
fn number(text: &serde_json::Value) -> Option<u64> {
    text.as_str()?.parse().ok()
}

/// A server with a session that has solved its frames.
async fn staged() -> TestServer {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publisher.publish(performance.frames(1..=FRAMES)).await;
    let mut subscriber = Subscriber::open(&server, every_frame(SESSION))
        .await
        .unwrap();
    subscriber.samples_through(FRAMES).await.unwrap();
    server
}
