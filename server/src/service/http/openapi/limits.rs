//! What the server asks of fields beyond their type: the same limits that `wire` enforces, as schemas say them.

use frontalis_analysis::marker_analysis::objective::{LARGEST_BOUND, MAX_EXCLUSIVE_PAIRS};
use frontalis_proto::v1;
use serde_json::{Value, json};

use crate::{
    service::http::call::BodyMessage,
    wire::take::{MAX_LABEL, MAX_NOTES},
};

/// What a take may begin with: up to ten seconds.
const PRE_ROLL: &str = r"^([0-9](\.[0-9]{1,9})?|10)s$";

/// `actors/ID`.
const ACTOR: &str = "^actors/[a-z0-9][a-z0-9_-]{0,62}$";
/// An id, or none.
const OPTIONAL_ID: &str = "^([a-z0-9][a-z0-9_-]{0,62})?$";
/// Nothing that moves a cursor or turns text around.
pub(super) const DISPLAY_NAME: &str = concat!(
    r"^[^\u0000-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028\u2029",
    r"\u202a-\u202e\u2066-\u2069]*$"
);
/// In code points.
pub(super) const DISPLAY_NAME_LENGTH: usize = 128;
/// 10 ms to 1 h.
const DURATION: &str = concat!(
    r"^(0\.(0[1-9][0-9]{0,7}|[1-9][0-9]{0,8})",
    r"|([1-9]|[1-9][0-9]|[1-9][0-9]{2}|[12][0-9]{3}|3[0-5][0-9]{2})(\.[0-9]{1,9})?",
    r"|3600(\.0{1,9})?)s$"
);
/// 0 to 1.
const STRENGTH: &str = r"^(0(\.[0-9]{1,9})?|1(\.0{1,9})?)$";
/// 0 to 2.
const BOUND: &str = r"^([01](\.[0-9]{1,9})?|2(\.0{1,9})?)$";
/// Paths of `SessionSettings`.
const MASK: &str = concat!(
    r"^((settings\.)?(neutralFrames|allowExaggeration|smoothing|sparsity|robust|stabilizeHead|staleAfter",
    r"|publisherTimeout|record|regionMode|plain|alignOnRequest|recordImages|symmetry|bounds|exclusivePairs)(,|$))*$"
);

/// Slate and gesture: no control characters.
const TAKE_LABEL: &str = r"^[^\u0000-\u001f\u007f-\u009f]*$";
/// Notes: none but the end of a line.
const TAKE_TEXT: &str = r"^[^\u0000-\u0009\u000b-\u001f\u007f-\u009f]*$";
/// Paths of `Take` that may change.
const TAKE_MASK: &str = r"^((take\.)?(slate|number|gesture|circled|notes)(,|$))*$";
/// `sessions/ID`.
const SESSION: &str = "^sessions/[a-z0-9][a-z0-9_-]{0,62}$";

/// Fields that the path of the operation says, and its body therefore must not.
pub(super) fn in_path(message: &str) -> &'static [&'static str] {
    match message {
        "UpdateSessionRequest" => v1::UpdateSessionRequest::IN_PATH,
        "RecenterSessionRequest" => v1::RecenterSessionRequest::IN_PATH,
        "EndSessionRequest" => v1::EndSessionRequest::IN_PATH,
        "StopTakeRequest" => v1::StopTakeRequest::IN_PATH,
        "ResolveTakeRequest" => v1::ResolveTakeRequest::IN_PATH,
        _ => &[],
    }
}

/// Whether a body may be left out.
pub(super) fn may_be_absent(message: &str) -> bool {
    match message {
        "RecenterSessionRequest" => v1::RecenterSessionRequest::MAY_BE_ABSENT,
        "EndSessionRequest" => v1::EndSessionRequest::MAY_BE_ABSENT,
        "StopTakeRequest" => v1::StopTakeRequest::MAY_BE_ABSENT,
        "ResolveTakeRequest" => v1::ResolveTakeRequest::MAY_BE_ABSENT,
        _ => false,
    }
}

/// Fields without which a message is refused.
pub(super) fn required(message: &str) -> &'static [&'static str] {
    match message {
        "CreateSessionRequest" => &["actor", "kind"],
        "StartTakeRequest" => &["session"],
        "ControlBounds" => &["control"],
        "ControlPair" => &["first", "second"],
        _ => &[],
    }
}

/// Most entries of a list.
pub(super) fn max_items(message: &str, field: &str) -> Option<usize> {
    match (message, field) {
        ("SessionSettings", "exclusive_pairs") => Some(MAX_EXCLUSIVE_PAIRS),
        _ => None,
    }
}

/// The limit of a field, beside or in place of its type's schema.
pub(super) fn of(message: &str, field: &str) -> Option<Value> {
    let limit = match (message, field) {
        ("CreateSessionRequest", "session_id") => json!({ "pattern": OPTIONAL_ID }),
        ("CreateSessionRequest", "actor") => json!({ "pattern": ACTOR }),
        // This version takes no images.
        ("CreateSessionRequest", "kind") => json!({ "enum": ["CAPTURE_KIND_MARKERS", 1] }),
        ("CreateSessionRequest", "display_name") => {
            json!({ "maxLength": DISPLAY_NAME_LENGTH, "pattern": DISPLAY_NAME })
        }
        ("UpdateSessionRequest", "update_mask") => json!({ "pattern": MASK }),
        ("SessionSettings", "neutral_frames") => json!({
            "minimum": 1,
            "maximum": 256,
            "pattern": "^([1-9][0-9]?|1[0-9]{2}|2[0-4][0-9]|25[0-6])$",
        }),
        ("SessionSettings", "smoothing" | "sparsity" | "symmetry") => {
            json!({ "minimum": 0, "maximum": 1, "pattern": STRENGTH })
        }
        ("ControlBounds", "lower" | "upper") => {
            json!({ "minimum": 0, "maximum": LARGEST_BOUND, "pattern": BOUND })
        }
        ("SessionSettings", "stale_after" | "publisher_timeout") => json!({ "pattern": DURATION }),
        ("StartTakeRequest", "pre_roll") => json!({ "pattern": PRE_ROLL }),
        ("StartTakeRequest", "session") => json!({ "pattern": SESSION }),
        ("StartTakeRequest" | "Take", "slate" | "gesture") => {
            json!({ "maxLength": MAX_LABEL, "pattern": TAKE_LABEL })
        }
        ("Take", "notes") => json!({ "maxLength": MAX_NOTES, "pattern": TAKE_TEXT }),
        ("UpdateTakeRequest", "update_mask") => json!({ "pattern": TAKE_MASK }),
        _ => return None,
    };
    Some(limit)
}
