//! The description of the HTTP door, `/openapi.json`: made from the routes and from the descriptors of the messages.
//!
//! Operations stand beside their handlers. Schemas follow the protobuf JSON mapping; where a message is read, they say
//! how wide it is read, so that what they allow is accepted and what they do not allow is refused.

mod limits;
mod messages;
mod own;
mod parameters;
mod refusals;
mod schema;

use std::{collections::BTreeSet, sync::Arc};

use axum::{
    Extension,
    http::{HeaderValue, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use serde_json::{Value, json};
use utoipa::openapi::OpenApi;

use messages::Messages;

pub(super) use parameters::{display_name, length_unit};
pub(super) use refusals::{BodyRefusals, ObjectRefusals, RangeRefusals, Refusals, StateRefusals};

/// How a schema of this document is named.
const SCHEMAS: &str = "#/components/schemas/";

/// The document as it is served.
#[derive(Clone)]
pub(super) struct Document {
    json: Bytes,
    index: Arc<str>,
}

impl Document {
    /// Describes `operations`; callers must prove who they are if `tokens`.
    pub fn new(operations: &OpenApi, tokens: bool) -> Self {
        let document = document(operations, tokens);
        Self {
            json: Bytes::from(document.to_string()),
            index: index(&document).into(),
        }
    }

    /// One line for each operation: its method, its path, and what its query may say.
    pub fn index(&self) -> &str {
        &self.index
    }
}

/// This document.
#[utoipa::path(
    get,
    path = "/openapi.json",
    operation_id = "describe",
    tag = "observation",
    security(()),
    responses((status = 200, description = "OpenAPI 3.1.", content_type = "application/json")),
)]
pub(super) async fn serve(Extension(document): Extension<Document>) -> Response {
    let kind = HeaderValue::from_static("application/json");
    ([(header::CONTENT_TYPE, kind)], document.json).into_response()
}

/// The whole document.
pub(super) fn document(operations: &OpenApi, tokens: bool) -> Value {
    let mut document = json!(operations);
    for operation in operations_of(&mut document["paths"]) {
        let parameters = operation.get_mut("parameters");
        let parameters = parameters.and_then(Value::as_array_mut);
        for parameter in parameters.into_iter().flatten() {
            forget_width(&mut parameter["schema"]);
        }
        if let Some(body) = operation.get_mut("requestBody") {
            let may_be_absent = references(body).iter().any(|it| limits::may_be_absent(it));
            body["required"] = json!(!may_be_absent);
        }
    }
    document["info"] = json!({
        "title": "Frontalis",
        "version": env!("CARGO_PKG_VERSION"),
        "license": { "name": "MIT OR Apache-2.0", "identifier": "MIT OR Apache-2.0" },
        "description": INTRODUCTION,
    });
    document["tags"] = json!(
        TAGS.map(|(name, description)| { json!({ "name": name, "description": description }) })
    );
    let token = json!({ "bearer": [] });
    document["security"] = if tokens {
        json!([token])
    } else {
        json!([{}, token])
    };
    document["components"] = json!({
        "schemas": schemas(&mut document["paths"]),
        "securitySchemes": {
            "bearer": {
                "type": "http",
                "scheme": "bearer",
                "description": "A token that `frontalis token create` made. Never in the query.",
            },
        },
    });
    document
}

fn index(document: &Value) -> String {
    let paths = document["paths"].as_object().into_iter().flatten();
    let mut lines = String::new();
    for (path, operations) in paths {
        for (method, operation) in operations.as_object().into_iter().flatten() {
            let parameters = operation["parameters"].as_array().into_iter().flatten();
            let query: Vec<_> = parameters
                .filter(|it| it["in"] == "query")
                .filter_map(|it| it["name"].as_str())
                .map(|it| format!("{it}="))
                .collect();
            let mark = if query.is_empty() { "" } else { "?" };
            let method = method.to_ascii_uppercase();
            lines.extend([&method, " ", path, mark, &query.join("&"), "\n"]);
        }
    }
    lines
}

/// `int32` and `int64` are signed, while every number of a query is not: its bounds say what it is.
fn forget_width(schema: &mut Value) {
    if schema["type"] == "integer"
        && let Some(schema) = schema.as_object_mut()
    {
        schema.remove("format");
    }
}

/// Everything that the paths refer to, and what that refers to.
fn schemas(paths: &mut Value) -> Value {
    let messages = Messages::of_the_protocol();
    let is_read = |it: &mut Value| {
        let mut read = references(&it["requestBody"]);
        read.extend(references(&it["x-reads"]));
        read
    };
    let read = operations_of(paths).flat_map(is_read).collect();
    let read = messages.closure(&read);
    let mut schemas = own::schemas();
    let mut wanted = references(paths);
    for schema in schemas.values() {
        wanted.extend(references(schema));
    }
    for name in messages.closure(&wanted) {
        if let Some(schema) = messages.schema(&name, read.contains(&name)) {
            schemas.insert(name, schema);
        }
    }
    Value::Object(schemas)
}

fn operations_of(paths: &mut Value) -> impl Iterator<Item = &mut Value> {
    let items = paths.as_object_mut().into_iter().flatten();
    let operations = items.filter_map(|(_, item)| item.as_object_mut()).flatten();
    operations.map(|(_, operation)| operation)
}

/// The names of the schemas that `value` refers to.
fn references(value: &Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    collect(value, &mut found);
    found
}

fn collect(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Array(items) => items.iter().for_each(|it| collect(it, found)),
        Value::Object(fields) => {
            let reference = fields.get("$ref").and_then(Value::as_str);
            let name = reference.and_then(|it| it.strip_prefix(SCHEMAS));
            found.extend(name.map(str::to_owned));
            fields.values().for_each(|it| collect(it, found));
        }
        _ => {}
    }
}

const TAGS: [(&str, &str); 7] = [
    ("server", "The server itself, and who asks."),
    (
        "actors",
        "The neutral face, the actuation basis and the marker layout of one person, in numbered revisions.",
    ),
    (
        "sessions",
        "One actor, one capture, any number of subscribers.",
    ),
    ("capture", "Frames in."),
    ("curves", "Curves out."),
    (
        "takes",
        "Recordings: frames as they came and samples as they went.",
    ),
    ("observation", "Health, figures, and this description."),
];

const INTRODUCTION: &str = "\
Facial motion capture in, muscle curves out.

Every operation is a method of the gRPC service that `x-grpc-method` names, with the same checks, rights and reasons. \
Bodies are the protobuf JSON mapping: fields in camel case (the names of the `.proto` files are read too), enums by \
name, numbers of 64 bits as text, fields with their default left out or null. Unknown and repeated fields are refused.

A refusal is `application/problem+json`; the end of its `type` is the reason, the same as over gRPC, and `field` is the \
path of what cannot be used.";

#[cfg(test)]
mod tests;
