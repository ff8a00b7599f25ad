//! Schemas of what is no message: problems, packages, lines of progress.

use serde_json::{Map, Value, json};

/// By name.
pub(super) fn schemas() -> Map<String, Value> {
    [
        ("Problem", problem()),
        ("Package", package()),
        ("TakeFile", take_file()),
        ("ImportActorLine", import_line()),
        ("CurveEvent", curve_event()),
    ]
    .into_iter()
    .map(|(name, schema)| (name.to_owned(), schema))
    .collect()
}

fn problem() -> Value {
    json!({
        "type": "object",
        "description": "Why a request was refused (RFC 9457), with figures that a program can read.",
        "required": ["type", "title", "status", "detail", "instance"],
        "properties": {
            "type": {
                "type": "string",
                "pattern": "^urn:frontalis:problem:[A-Z][A-Z0-9_]*$",
                "description": "Ends with the reason, as `google.rpc.ErrorInfo` has it.",
            },
            "title": { "type": "string", "description": "The reason as a person reads it." },
            "status": { "type": "integer", "minimum": 400, "maximum": 599 },
            "detail": { "type": "string", "description": "What is wrong with this request." },
            "instance": { "type": "string", "description": "The path of the request." },
            "field": { "type": "string", "description": "The field or parameter that cannot be used: its path in JSON, such as `settings.regionMode`." },
            "line": { "type": "integer", "minimum": 1, "description": "The line of the body that cannot be used; of a message of a WebSocket, the line in it." },
            "column": { "type": "integer", "minimum": 0, "description": "How far in that line it could be read." },
            "message": { "type": "integer", "minimum": 1, "description": "The message of a WebSocket that cannot be used, from 1." },
            "limit": { "type": "string", "description": "The limit that was reached." },
            "value": { "type": "integer", "description": "Its value." },
        },
        "additionalProperties": { "type": ["string", "integer"] },
        "examples": [{
            "type": "urn:frontalis:problem:SESSION",
            "title": "There is no such session",
            "status": 404,
            "detail": "no such session",
            "instance": "/api/v1/sessions/take-1",
        }],
    })
}

fn package() -> Value {
    json!({
        "type": "string",
        "format": "binary",
        "description": "A GLB or a ZIP: see ACTOR_PACKAGE in the documentation.",
    })
}

fn take_file() -> Value {
    json!({
        "type": "string",
        "format": "binary",
        "description": "A take in the format that was asked for.",
    })
}

fn import_line() -> Value {
    let count = || json!({ "type": "string", "pattern": "^[0-9]+$" });
    json!({
        "description": "One line; the last one has `result` or `error`.",
        "oneOf": [
            {
                "type": "object",
                "required": ["progress"],
                "additionalProperties": false,
                "properties": {
                    "progress": {
                        "type": "object",
                        "required": ["stage", "receivedBytes"],
                        "additionalProperties": false,
                        "properties": {
                            "stage": { "type": "string", "enum": ["RECEIVING", "READING", "STORING"] },
                            "receivedBytes": count(),
                            "totalBytes": count(),
                        },
                    },
                },
            },
            {
                "type": "object",
                "required": ["result"],
                "additionalProperties": false,
                "properties": { "result": { "$ref": "#/components/schemas/ImportActorResponse" } },
            },
            {
                "type": "object",
                "required": ["error"],
                "additionalProperties": false,
                "properties": { "error": { "$ref": "#/components/schemas/Problem" } },
            },
        ],
    })
}

fn curve_event() -> Value {
    json!({
        "type": "object",
        "description": "One event, as its fields are sent.",
        "required": ["data"],
        "additionalProperties": false,
        "properties": {
            "id": {
                "type": "string",
                "pattern": "^[0-9]+:[0-9]+(:end)?$",
                "description": "`run:sequence` of the last sample in it; `run:sequence:end` with `end`.",
            },
            "event": {
                "type": "string",
                "enum": ["message", "problem"],
                "description": "`problem`: why the stream ends; `data` is a Problem. Else it is a SubscribeResponse.",
            },
            "retry": { "type": "integer", "description": "When to come back, milliseconds." },
            "data": {
                "type": "string",
                "contentMediaType": "application/json",
                "contentSchema": {
                    "oneOf": [
                        { "$ref": "#/components/schemas/SubscribeResponse" },
                        { "$ref": "#/components/schemas/Problem" },
                    ],
                },
            },
        },
    })
}
