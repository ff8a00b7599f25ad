//! JSON as a message in the protobuf JSON mapping, or what is wrong with it and where.
//!
//! The parser's own texts hold keys that the client sent, so only their kind is told (BAD_INPUT, header).

mod numbers;

use std::fmt;

use axum::http::StatusCode;
use serde::{
    Deserializer,
    de::{DeserializeOwned, IgnoredAny, MapAccess, Visitor},
};
use serde_json::error::Category;

use super::Problem;

/// Reads a message that does not say what the path says, `in_path`.
pub(super) fn message<T: DeserializeOwned>(
    bytes: &[u8],
    in_path: &'static [&'static str],
) -> Result<T, Problem> {
    let bytes = &numbers::whole(bytes);
    let mut keys = serde_json::Deserializer::from_slice(bytes);
    keys.deserialize_any(Keys { in_path })
        .map_err(|error| problem(&error))?;
    serde_json::from_slice(bytes).map_err(|error| problem(&error))
}

fn problem(error: &serde_json::Error) -> Problem {
    let (line, column) = (error.line(), error.column());
    let detail = format!("line {line}, column {column}: {}", what(error));
    Problem::new(StatusCode::BAD_REQUEST, "JSON", &detail)
}

fn what(error: &serde_json::Error) -> &'static str {
    const KINDS: [(&str, &str); 6] = [
        ("in the path", "a field that the path says already"),
        ("unknown field", "a field that this message does not have"),
        ("duplicate field", "a field that was there before"),
        ("unknown variant", "a value that this enum does not have"),
        ("recursion limit", "more than 128 levels"),
        ("number out of range", "a number that no field can hold"),
    ];
    let text = error.to_string();
    let known = KINDS.iter().find(|(start, _)| text.starts_with(start));
    if let Some((_, what)) = known {
        return what;
    }
    match error.classify() {
        Category::Eof => "the JSON ends too early",
        Category::Syntax => "no JSON, or more after its end",
        Category::Data | Category::Io => "a value of another kind than this field has",
    }
}

/// Passes over an object and refuses keys that do not belong into it.
struct Keys {
    in_path: &'static [&'static str],
}

impl<'de> Visitor<'de> for Keys {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<std::borrow::Cow<'de, str>>()? {
            if self.in_path.contains(&key.as_ref()) {
                return Err(serde::de::Error::custom("in the path"));
            }
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use frontalis_proto::v1;

    use super::*;

    fn detail(body: &str) -> String {
        let refused = message::<v1::UpdateSessionRequest>(body.as_bytes(), &["name"]);
        let problem = refused.unwrap_err().document("/");
        assert_eq!(problem["type"], "urn:frontalis:problem:JSON");
        problem["detail"].as_str().unwrap().to_owned()
    }

    #[test]
    fn what_is_wrong_and_where_is_said_without_repeating_it() {
        let (open, close) = ("[".repeat(100_000), "]".repeat(100_000));
        let deep = format!("{{\"settings\":{{\"smoothing\":{open}{close}}}}}");
        let cases = [
            ("", "line 1, column 0: the JSON ends too early"),
            ("{", "line 1, column 1: the JSON ends too early"),
            ("{} x", "line 1, column 4: no JSON, or more after its end"),
            (
                "{\n\"secret\":1}",
                "line 2, column 8: a field that this message does not have",
            ),
            (
                "{\"settings\":{\"robust\":true,\"robust\":true}}",
                "line 1, column 35: a field that was there before",
            ),
            (
                "{\"settings\":{\"smoothing\":1e400}}",
                "line 1, column 30: a number that no field can hold",
            ),
            (
                "{\"settings\":{\"regionMode\":\"SECRET\"}}",
                "line 1, column 34: a value that this enum does not have",
            ),
            (
                "{\"name\":\"sessions/a\"}",
                "line 1, column 7: a field that the path says already",
            ),
            (
                "[]",
                "line 1, column 2: a value of another kind than this field has",
            ),
            (
                "{\"settings\":{\"smoothing\":\"\\ud800\"}}",
                "line 1, column 33: no JSON, or more after its end",
            ),
        ];
        for (body, expected) in cases {
            assert_eq!(detail(body), expected, "{body}");
        }
        assert!(detail(&deep).ends_with("more than 128 levels"));
    }

    #[test]
    fn both_spellings_of_a_field_are_read() {
        for key in ["actorRevision", "actor_revision"] {
            let body = format!("{{\"{key}\": 3}}");
            let read: v1::UpdateSessionRequest = message(body.as_bytes(), &["name"]).unwrap();
            assert_eq!(read.actor_revision, 3);
        }
    }
}
