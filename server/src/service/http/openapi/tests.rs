//! The document is whole.

use super::*;
use crate::service::http::api;

fn whole() -> Value {
    let (_, operations) = api();
    document(&operations, false)
}

#[test]
fn every_schema_that_is_named_is_there() {
    let document = whole();
    let defined = document["components"]["schemas"].as_object().unwrap();
    for name in references(&document) {
        assert!(defined.contains_key(&name), "{name}");
    }
    for known in ["Session", "CurveSample", "SessionState", "Problem"] {
        assert!(defined.contains_key(known), "{known}");
    }
}

#[test]
fn comments_of_the_protocol_are_the_descriptions() {
    let schemas = &whole()["components"]["schemas"];
    let neutral = &schemas["SessionSettings"]["properties"]["neutralFrames"]["description"];
    assert!(
        neutral
            .as_str()
            .unwrap()
            .starts_with("frames registered rigidly")
    );
    let state = schemas["SessionState"]["description"].as_str().unwrap();
    assert!(
        state.contains("- `SESSION_STATE_STALE`: was live"),
        "{state}"
    );
}

#[test]
fn what_is_written_has_one_form_and_what_is_read_has_all() {
    let schemas = &whole()["components"]["schemas"];
    let run = &schemas["SessionStatus"]["properties"]["run"];
    assert_eq!(run["type"], "string");
    let revision = &schemas["UpdateSessionRequest"]["properties"]["actorRevision"];
    assert_eq!(revision["type"], json!(["integer", "string"]));
    let update = schemas["UpdateSessionRequest"]["properties"].as_object();
    assert!(!update.unwrap().contains_key("name"));
}

#[test]
fn callers_must_say_who_they_are_where_tokens_are_asked_for() {
    let (_, operations) = api();
    let security = |tokens| document(&operations, tokens)["security"].clone();
    assert_eq!(security(true), json!([{ "bearer": [] }]));
    assert_eq!(security(false), json!([{}, { "bearer": [] }]));
}
