//! Row D13: options of the solver that cannot be.

use frontalis_proto::v1::SessionSettings;
use harness::{assert_refused, http_send};
use hyper::Method;
use serde_json::{Value, json};
use tonic::Code;

use super::{GOOD_FRAMES, SUBJECT, Stage, beside_a_control_session};

const PATH: &str = "/api/v1/sessions/subject";

/// What is asked for, and the field that is refused.
fn refused_options() -> Vec<(Value, &'static str)> {
    let strengths = ["smoothing", "sparsity", "symmetry"];
    let strengths = strengths.into_iter().flat_map(|field| {
        let values = [
            json!(-0.1),
            json!(1.1),
            json!(1e9),
            json!("NaN"),
            json!("Infinity"),
        ];
        values.map(|value| (json!({ field: value }), field))
    });
    let jaw = |lower: Value, upper: Value| json!({ "control": "jaw_rotation", "lower": lower, "upper": upper });
    let bounds = [
        json!([jaw(json!(0.6), json!(0.5))]),
        json!([jaw(json!(-0.1), json!(1))]),
        json!([jaw(json!(0), json!(2.5))]),
        json!([jaw(json!("NaN"), json!(1))]),
        json!([jaw(json!(0), json!("Infinity"))]),
        json!([jaw(json!(0), json!(1)), jaw(json!(0), json!(1))]),
        json!([{ "control": "<b>jaw</b>", "upper": 1 }]),
        json!([{}]),
    ];
    let pair = |first: &str, second: &str| json!({ "first": first, "second": second });
    let pairs = [
        json!([pair("jaw_rotation", "jaw_rotation")]),
        json!([pair("jaw_rotation", "<b>jaw</b>")]),
        json!([{}]),
        json!(vec![pair("jaw_rotation", "lips_pressor"); 17]),
    ];
    let plain = [
        json!({ "plain": true, "robust": true }),
        json!({ "plain": true, "smoothing": 0.1 }),
        json!({ "plain": true, "sparsity": 1 }),
        json!({ "plain": true, "symmetry": "NaN" }),
    ];
    let never_relaxed = json!({
        "bounds": [jaw(json!(0.1), json!(1))],
        "exclusivePairs": [pair("jaw_rotation", "lips_pressor")],
    });
    let mut all = vec![
        (json!({ "neutralFrames": 0 }), "neutralFrames"),
        (json!({ "neutralFrames": 1_000_000_000 }), "neutralFrames"),
        (json!({ "staleAfter": "0s" }), "staleAfter"),
        (json!({ "publisherTimeout": "-1s" }), "publisherTimeout"),
        (never_relaxed, "exclusivePairs"),
    ];
    all.extend(strengths);
    all.extend(bounds.map(|it| (json!({ "bounds": it }), "bounds")));
    all.extend(pairs.map(|it| (json!({ "exclusivePairs": it }), "exclusivePairs")));
    all.extend(plain.map(|it| (it, "plain")));
    all
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d13_options_that_cannot_be_are_refused_by_name_and_change_nothing() {
    beside_a_control_session("D13", async |stage| {
        let mut publisher = stage.publisher().await;
        let before = stage.server.session(SUBJECT).await.settings;
        let all = refused_options();
        for (options, field) in &all {
            let (status, problem) = update(stage, options).await;
            assert_eq!(
                (status, &problem["type"], &problem["field"]),
                (
                    400,
                    &json!("urn:frontalis:problem:SOLVER_OPTIONS"),
                    &json!(format!("settings.{field}"))
                ),
                "{options}: {problem}"
            );
            let detail = problem["detail"].as_str().unwrap();
            assert!(
                !detail.contains("<b>"),
                "a client's text is not repeated: {detail}"
            );
            let settings: SessionSettings = serde_json::from_value(options.clone()).unwrap();
            let refused = stage
                .server
                .create_session_with("other", "actors/reference", settings)
                .await
                .unwrap_err();
            assert_refused(&refused, Code::InvalidArgument, "SOLVER_OPTIONS");
        }
        println!("D13: {} options refused by name, twice each", all.len());
        assert_eq!(stage.server.session(SUBJECT).await.settings, before);
        let more = GOOD_FRAMES + 1..=GOOD_FRAMES + 30;
        publisher.publish(stage.performance.frames(more)).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d13_what_is_no_option_of_a_session_is_none() {
    beside_a_control_session("D13 unknown", async |stage| {
        for options in [
            json!({ "iterations": 1_000_000_000 }),
            json!({ "tolerance": 0 }),
            json!({ "weights": [0, 0, 0] }),
            json!({ "regions": ["upper", "upper"] }),
            json!({ "bounds": [{ "control": "jaw_rotation", "weight": -1 }] }),
        ] {
            let (status, problem) = update(stage, &options).await;
            assert_eq!(
                (status, &problem["type"]),
                (400, &json!("urn:frontalis:problem:JSON")),
                "{options}: {problem}"
            );
        }
    })
    .await;
}

/// Status and answer of an update over HTTP.
async fn update(stage: &Stage, settings: &Value) -> (u16, Value) {
    let kind = [("content-type", "application/json")];
    let body = json!({ "settings": settings }).to_string();
    let answer = http_send(&stage.server, &Method::PATCH, PATH, &kind, body.as_bytes()).await;
    (answer.status.as_u16(), answer.json())
}
