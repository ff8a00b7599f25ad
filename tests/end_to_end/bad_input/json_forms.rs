//! Row E6 where messages come as JSON and as queries: values that no enum has, by their place, and defaults in every form.

use frontalis_proto::v1::{PublishResponse, SubscribeResponse};
use harness::{EventStream, HttpAnswer, LinePublisher, TestServer, WebSocket, http_get, http_send};
use hyper::Method;
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

use super::{SUBJECT, beside_a_control_session};

const JSON: [(&str, &str); 1] = [("content-type", "application/json")];
const SESSIONS: &str = "/api/v1/sessions";
const PATH: &str = "/api/v1/sessions/subject";

/// Text, numbers, and what is no value of an enum at all.
fn unknown() -> [Value; 5] {
    [
        json!("NOTHING"),
        json!(77),
        json!(-1),
        json!(1.5),
        json!(true),
    ]
}

fn start(changes: &Value) -> Value {
    let mut start =
        json!({ "publisher": "camera-1", "unit": "LENGTH_UNIT_CENTIMETER", "rateHz": 60 });
    let fields = changes.as_object().unwrap().clone();
    start.as_object_mut().unwrap().extend(fields);
    json!({ "start": start })
}

#[track_caller]
fn assert_problem(problem: &Value, reason: &str, field: &str) {
    assert_eq!(
        problem["type"],
        format!("urn:frontalis:problem:{reason}"),
        "{problem}"
    );
    assert_eq!(problem["status"], 400, "{problem}");
    assert_eq!(problem["field"], field, "{problem}");
    let detail = problem["detail"].as_str().unwrap();
    assert!(
        detail.contains(&format!("{field} must be one of ")),
        "{problem}"
    );
    assert!(!detail.contains("NOTHING"), "{problem}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_an_unknown_enum_value_in_a_body_is_told_by_its_path() {
    beside_a_control_session("E6 bodies", async |stage| {
        for value in unknown() {
            let kind = json!({ "actor": "actors/reference", "kind": value });
            let settings = json!({ "settings": { "regionMode": value } });
            let mut create = json!({ "actor": "actors/reference", "kind": 1 });
            create["settings"] = settings["settings"].clone();
            for (method, path, body, field) in [
                (Method::POST, SESSIONS, &kind, "kind"),
                (Method::POST, SESSIONS, &create, "settings.regionMode"),
                (Method::PATCH, PATH, &settings, "settings.regionMode"),
            ] {
                let body = body.to_string();
                let answer = http_send(&stage.server, &method, path, &JSON, body.as_bytes()).await;
                assert_problem(&answer.json(), "ENUM", field);
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_an_unknown_enum_value_in_a_stream_is_told_by_its_line_or_message() {
    beside_a_control_session("E6 streams", async |stage| {
        for value in unknown() {
            for field in ["unit", "ingest"] {
                let first = start(&json!({ field: value }));
                let lines = format!("\n{first}");
                let refused = LinePublisher::open(&stage.server, "subject", lines).await;
                let problem = refused.err().unwrap().json();
                assert_problem(&problem, "ENUM", &format!("start.{field}"));
                assert_eq!(problem["line"], 2, "{problem}");

                let publish = "frontalis.v1.publish+json";
                let problem = closed::<PublishResponse>(&stage.server, publish, &first).await;
                assert_problem(&problem, "ENUM", &format!("start.{field}"));
                assert_eq!(problem["message"], 1, "{problem}");
            }
            for field in ["delivery", "controlSpace"] {
                let first = json!({ "start": { field: value } });
                let subscribe = "frontalis.v1.subscribe+json";
                let problem = closed::<SubscribeResponse>(&stage.server, subscribe, &first).await;
                assert_problem(&problem, "ENUM", &format!("start.{field}"));
                assert_eq!(problem["message"], 1, "{problem}");
            }
        }
    })
    .await;
}

/// The problem of a socket whose first message is this.
async fn closed<M>(server: &TestServer, subprotocol: &str, first: &Value) -> Value
where
    M: prost::Message + Default + serde::de::DeserializeOwned + std::fmt::Debug,
{
    let mut socket = WebSocket::open(server, "subject", subprotocol)
        .await
        .unwrap();
    socket.send_raw(Message::text(first.to_string())).await;
    socket.next::<M>().await.unwrap_err().problem.unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_an_unknown_enum_value_in_a_query_is_told_by_its_parameter() {
    beside_a_control_session("E6 queries", async |stage| {
        for value in ["NOTHING", "77", "-1"] {
            for field in ["delivery", "controlSpace"] {
                let path = format!("{PATH}/events?{field}={value}");
                let refused = EventStream::open(&stage.server, &path, "").await;
                assert_problem(&refused.err().unwrap().json(), "ENUM", field);
            }
            let path = format!("/api/v1/actors/other?unit={value}");
            let kind = [("content-type", "application/zip")];
            let answer = http_send(&stage.server, &Method::PUT, &path, &kind, b"PK").await;
            assert_problem(&answer.json(), "ENUM", "unit");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_null_and_numbers_in_every_form_are_as_good_as_any() {
    beside_a_control_session("E6 forms", async |stage| {
        let nothing = json!({
            "settings": { "neutralFrames": null, "robust": null, "regionMode": null, "staleAfter": null },
            "actorRevision": null,
            "update_mask": null,
        });
        let settings = send(&stage.server, &nothing).await.json()["settings"].clone();
        assert_eq!(settings["neutralFrames"], 15);
        for number in ["2.0e1", "20.0", "\"20\"", "\"2e1\""] {
            let body = format!(r#"{{"settings":{{"neutral_frames":{number}}}}}"#);
            let answer = send(&stage.server, &serde_json::from_str(&body).unwrap()).await;
            assert_eq!(answer.json()["settings"]["neutralFrames"], 20, "{number}");
        }

        let defaults = json!({ "markerNames": null, "takeover": null, "image": null, "rateHz": 6e1 });
        let first = start(&defaults).to_string();
        let mut lines = LinePublisher::open(&stage.server, "subject", first).await.unwrap();
        let n_coordinates = stage.performance.frames(1..=1)[0].positions.len();
        let positions = vec![json!("NaN"); n_coordinates];
        let numbers = ["1.0", "0.2e1", "\"3\"", "\"4.0\"", "50e-1"];
        for number in numbers {
            let line = format!(
                r#"{{"frames":[{{"number":{number},"captureTimeNanos":1.3e1,"timecode":null,"crc32c":null,"source_frame":"9007199254740993","positions":{}}}],"clock":null}}"#,
                json!(positions)
            );
            lines.send_line(line).await;
        }
        lines.close();
        let mut last = PublishResponse::default();
        while let Some(answer) = lines.next().await {
            last = answer.unwrap();
            assert!(last.rejected.is_empty(), "{:?}", last.rejected);
        }
        assert_eq!(last.accepted_through, numbers.len() as u64);
        let status = stage.server.session(SUBJECT).await.status.unwrap();
        assert_eq!(status.last_frame, numbers.len() as u64);
        let listed = http_get(&stage.server, PATH).await.json();
        assert_eq!(listed["status"]["lastFrame"], "5", "64 bits are text");
    })
    .await;
}

async fn send(server: &TestServer, body: &Value) -> HttpAnswer {
    let body = body.to_string();
    let answer = http_send(server, &Method::PATCH, PATH, &JSON, body.as_bytes()).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    answer
}
