//! Health, metrics, reflection, JSON, and answers in the protocol of the peer.

use serde_json::Value;
use tokio_stream::StreamExt as _;
use tonic_health::pb::{
    HealthCheckRequest, health_check_response::ServingStatus, health_client::HealthClient,
};

use super::Stage;

async fn health(stage: &Stage, service: &str) -> ServingStatus {
    let request = HealthCheckRequest {
        service: service.to_owned(),
    };
    let answer = HealthClient::new(stage.channel.clone())
        .check(request)
        .await
        .unwrap();
    answer.into_inner().status()
}

#[tokio::test]
async fn health_says_what_serves() {
    let stage = Stage::in_memory().await;
    assert_eq!(health(&stage, "").await, ServingStatus::Serving);
    assert_eq!(
        health(&stage, "frontalis.v1.CaptureService").await,
        ServingStatus::Serving
    );
    assert_eq!(
        health(&stage, "frontalis.v1.TakeService").await,
        ServingStatus::Serving
    );
    assert_eq!(stage.get("/healthz").await, (200, "ok\n".into()));
    assert_eq!(stage.get("/readyz").await, (200, "ready\n".into()));
}

#[tokio::test]
async fn both_versions_of_reflection_list_the_services() {
    use tonic_reflection::pb::{v1, v1alpha};
    let stage = Stage::in_memory().await;
    let ask = v1::ServerReflectionRequest {
        host: String::new(),
        message_request: Some(v1::server_reflection_request::MessageRequest::ListServices(
            String::new(),
        )),
    };
    let mut client =
        v1::server_reflection_client::ServerReflectionClient::new(stage.channel.clone());
    let mut answers = client
        .server_reflection_info(tokio_stream::once(ask))
        .await
        .unwrap()
        .into_inner();
    let text = format!("{:?}", answers.next().await.unwrap().unwrap());
    for service in [
        "ActorService",
        "SessionService",
        "CaptureService",
        "CurveService",
        "TakeService",
    ] {
        assert!(text.contains(&format!("frontalis.v1.{service}")), "{text}");
    }
    let ask = v1alpha::ServerReflectionRequest {
        host: String::new(),
        message_request: Some(
            v1alpha::server_reflection_request::MessageRequest::ListServices(String::new()),
        ),
    };
    let mut client =
        v1alpha::server_reflection_client::ServerReflectionClient::new(stage.channel.clone());
    let mut answers = client
        .server_reflection_info(tokio_stream::once(ask))
        .await
        .unwrap()
        .into_inner();
    assert!(format!("{:?}", answers.next().await.unwrap().unwrap()).contains("grpc.health.v1"));
}

#[tokio::test]
async fn metrics_count_sessions_by_state_and_hold_no_client_text() {
    let stage = Stage::in_memory().await;
    stage.create("a-very-special-name").await;
    let (status, text) = stage.get("/metrics").await;
    assert_eq!(status, 200);
    assert!(
        text.contains("frontalis_sessions{state=\"waiting\"} 1\n"),
        "{text}"
    );
    assert!(text.contains("frontalis_insecure 0\n"), "{text}");
    assert!(text.contains("frontalis_ready 1\n"), "{text}");
    assert!(!text.contains("special"), "{text}");
}

#[tokio::test]
async fn curves_over_http_name_their_run_and_refuse_another() {
    let stage = Stage::in_memory().await;
    stage.create("s").await;
    let json = |body: &str| -> Value { serde_json::from_str(body).unwrap() };
    let (status, body) = stage
        .get("/api/v1/sessions/s/curves?run=1&after=0&limit=5")
        .await;
    assert_eq!(status, 200, "{body}");
    let body = json(&body);
    assert_eq!(
        (&body["header"]["run"], body.get("newestSequence")),
        // Zero is left out, and 64 bits are text, as the protobuf JSON mapping says.
        (&"1".into(), None)
    );
    let controls = body["header"]["controls"].as_array().unwrap();
    assert_eq!(controls.len(), 16);
    let (status, body) = stage.get("/api/v1/sessions/s/curves?run=9").await;
    let body = json(&body);
    assert_eq!(status, 416);
    assert_eq!(body["type"], "urn:frontalis:problem:NEW_RUN");
    assert_eq!(body["run"], 1);
    let (status, body) = stage.get("/api/v1/sessions/s/curves?run=1&after=77").await;
    let body = json(&body);
    assert_eq!(
        (status, &body["firstAvailable"]),
        (416, &1.into()),
        "{body}"
    );
    let (status, body) = stage.get("/api/v1/sessions/s").await;
    assert_eq!(status, 200);
    assert_eq!(json(&body)["status"]["state"], "SESSION_STATE_WAITING");
}

#[tokio::test]
async fn a_query_that_cannot_be_read_is_a_problem() {
    let stage = Stage::in_memory().await;
    for query in ["limit=x", "limit=-1", "colour=red", "run=1&run=2"] {
        let (status, body) = stage
            .get(&format!("/api/v1/sessions/s/curves?{query}"))
            .await;
        assert_eq!(status, 400, "{query}: {body}");
        assert!(
            body.contains("urn:frontalis:problem:QUERY"),
            "{query}: {body}"
        );
    }
    let (status, body) = stage.get("/api/v1/sessions/%ff").await;
    assert_eq!(status, 400);
    assert!(body.contains("urn:frontalis:problem:NAME"), "{body}");
    let (status, body) = stage.get("/nothing/here").await;
    assert_eq!(status, 404);
    assert!(body.contains("urn:frontalis:problem:ROUTE"), "{body}");
}

#[tokio::test]
async fn a_port_that_others_can_reach_unprotected_is_called_insecure_wherever_one_looks() {
    let exposed = Stage::with(|config| {
        config.listen = ([0, 0, 0, 0], 0).into();
        config.allow_insecure = true;
    })
    .await;
    let index = exposed.get("/").await.1;
    assert!(index.contains("INSECURE"), "{index}");
    let metrics = exposed.get("/metrics").await.1;
    assert!(metrics.contains("frontalis_insecure 1\n"), "{metrics}");
    let server = exposed.get("/api/v1/server").await.1;
    assert!(server.contains("\"insecure\":true"), "{server}");

    let local = Stage::in_memory().await;
    let index = local.get("/").await.1;
    assert!(!index.contains("INSECURE"), "{index}");
    let metrics = local.get("/metrics").await.1;
    assert!(metrics.contains("frontalis_insecure 0\n"), "{metrics}");
}
