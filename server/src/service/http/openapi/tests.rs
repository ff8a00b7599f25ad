//! The document is whole.

use frontalis_proto::FILE_DESCRIPTOR_SET;
use prost::Message as _;

use super::*;
use crate::{service::http::api, telemetry::Metrics};

fn whole() -> Value {
    let (_, operations) = api(&Metrics::new("0"));
    document(&operations, false)
}

/// Methods of later versions.
const NOT_BUILT: [&str; 3] = ["ImproveBasis", "TrainRegions", "PublishImages"];

#[test]
fn every_built_method_of_the_protocol_has_an_operation() {
    let document = whole();
    let mut operations = document["paths"].clone();
    let methods: String = operations_of(&mut operations)
        .filter_map(|it| it["x-grpc-method"].as_str().map(|it| format!("{it}, ")))
        .collect();
    let set = prost_types::FileDescriptorSet::decode(FILE_DESCRIPTOR_SET).unwrap();
    let services = set.file.iter().flat_map(|file| &file.service);
    let mut n_found = 0;
    for service in services.filter(|it| it.name() != "TakeService") {
        for method in &service.method {
            let name = format!("frontalis.v1.{}/{}, ", service.name(), method.name());
            let is_built = !NOT_BUILT.contains(&method.name());
            assert_eq!(methods.contains(&name), is_built, "{name}");
            n_found += usize::from(is_built);
        }
    }
    assert!(n_found >= 15, "{n_found}");
}

#[test]
fn every_operation_says_what_it_is_and_who_may_call_it() {
    let document = whole();
    let mut operations = document["paths"].clone();
    let mut ids = BTreeSet::new();
    for operation in operations_of(&mut operations) {
        let id = operation["operationId"].as_str().unwrap().to_owned();
        assert!(operation["summary"].is_string(), "{id}");
        assert!(operation["tags"].is_array(), "{id}");
        let fields = operation.as_object().unwrap();
        assert!(fields.values().all(|it| !it.is_null()), "{id}");
        let responses = operation["responses"].as_object().unwrap();
        let asks_who = operation.get("security").is_none();
        assert_eq!(responses.contains_key("401"), asks_who, "{id}");
        let is_call = operation["x-grpc-method"].is_string();
        assert!(asks_who || !is_call, "{id}");
        assert!(ids.insert(id));
    }
}

/// Only the pages of `/docs` are put beside the description.
#[test]
fn no_route_is_added_past_the_description() {
    let sources = [include_str!("../../http.rs"), include_str!("../streams.rs")];
    let added = sources.iter().flat_map(|it| it.lines());
    let added = added.filter(|it| it.contains(".route("));
    for line in added {
        assert!(line.contains(".route(\"/docs"), "{line}");
    }
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
    // null is the default, as in every field that may be left out.
    let forms = &revision["oneOf"];
    assert_eq!(forms[0]["type"], "null", "{revision}");
    assert_eq!(forms[1]["type"], json!(["integer", "string"]));
    let update = schemas["UpdateSessionRequest"]["properties"].as_object();
    assert!(!update.unwrap().contains_key("name"));
}

#[test]
fn callers_must_say_who_they_are_where_tokens_are_asked_for() {
    let (_, operations) = api(&Metrics::new("0"));
    let security = |tokens| document(&operations, tokens)["security"].clone();
    assert_eq!(security(true), json!([{ "bearer": [] }]));
    assert_eq!(security(false), json!([{}, { "bearer": [] }]));
}
