//! The answers that refuse, in groups that operations have in common (BAD_INPUT, "Status mapping").

use std::collections::BTreeMap;

use utoipa::{
    IntoResponses,
    openapi::{ContentBuilder, Ref, RefOr, Response, ResponseBuilder},
};

use crate::service::http::problem;

/// Every operation.
pub struct Refusals;
/// Operations on something that must exist.
pub struct ObjectRefusals;
/// Operations that not every state allows.
pub struct StateRefusals;
/// Operations with a body.
pub struct BodyRefusals;
/// Operations that name a position in a stream.
pub struct RangeRefusals;

const ALWAYS: &[(&str, &str)] = &[
    (
        "400",
        "Something in the path, the query, a header or the body cannot be used.",
    ),
    ("401", "The server asks who you are."),
    (
        "403",
        "Your role does not allow it, or the page of another site asked.",
    ),
    ("421", "This server has another name."),
    (
        "429",
        "A limit was reached; `retry-after` says when there may be room.",
    ),
    ("500", "The server made a mistake."),
    ("501", "Known, but this version cannot do it."),
    ("503", "The server is shutting down."),
    ("504", "Not done in time."),
];

const OBJECT: &[(&str, &str)] = &[("404", "It does not exist, or you may not know of it.")];

const STATE: &[(&str, &str)] = &[("409", "Its state does not allow it.")];

const BODY: &[(&str, &str)] = &[
    ("413", "The body is too large."),
    (
        "415",
        "The body's content type is another than the described ones.",
    ),
];

const RANGE: &[(&str, &str)] = &[(
    "416",
    "The position is in another run, or no longer kept; the problem names the first that is.",
)];

type Responses = BTreeMap<String, RefOr<Response>>;

fn responses(table: &[(&str, &str)]) -> Responses {
    let response = |&(status, description): &(&str, &str)| {
        let schema = Ref::new("#/components/schemas/Problem");
        let content = ContentBuilder::new().schema(Some(schema)).build();
        let response = ResponseBuilder::new()
            .description(description)
            .content(problem::MEDIA_TYPE, content)
            .build();
        (status.to_owned(), response.into())
    };
    table.iter().map(response).collect()
}

impl IntoResponses for Refusals {
    fn responses() -> Responses {
        responses(ALWAYS)
    }
}

impl IntoResponses for ObjectRefusals {
    fn responses() -> Responses {
        responses(OBJECT)
    }
}

impl IntoResponses for StateRefusals {
    fn responses() -> Responses {
        responses(STATE)
    }
}

impl IntoResponses for BodyRefusals {
    fn responses() -> Responses {
        responses(BODY)
    }
}

impl IntoResponses for RangeRefusals {
    fn responses() -> Responses {
        responses(RANGE)
    }
}
