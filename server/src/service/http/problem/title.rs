//! What a person reads of each reason: the `title` of a problem, the same for every problem of that reason.

/// The title of a reason.
pub(super) fn title(reason: &str) -> &'static str {
    TITLES
        .iter()
        .find(|(it, _)| *it == reason)
        .map_or("The request was refused", |(_, title)| title)
}

const TITLES: &[(&str, &str)] = &[
    // Who asks, and what for.
    ("UNAUTHENTICATED", "A valid token is needed"),
    ("ROLE", "Your role does not allow this"),
    ("SCOPE", "Your token is for other sessions"),
    ("TAKEOVER", "Another principal owns the session"),
    ("HOST", "This server has another name"),
    ("ORIGIN", "Pages of this origin may not ask"),
    ("RATE_LIMIT", "Too much was asked in a minute"),
    // What is there.
    ("ACTOR", "There is no such actor"),
    ("ACTOR_HAS_TAKES", "There are takes of the actor"),
    ("ACTOR_IN_USE", "A session uses the actor"),
    ("LAYOUT_CHANGED", "The actor has other muscles or markers"),
    ("TAKE", "There is no such take"),
    ("ACTOR_BEING_ERASED", "The actor is being erased"),
    ("TAKE_RECOVERING", "The take is being brought into order"),
    ("TAKE_FORMAT", "A newer server wrote the take"),
    ("TAKE_EXISTS", "A take of this id exists"),
    ("TAKE_UNREADABLE", "The take's file cannot be read"),
    ("EXPORT_FORMAT", "The format cannot hold the take"),
    ("RANGE", "There is no such part of the file"),
    ("TAKE_RECORDING", "The session is being recorded"),
    ("RESCUE_MODE", "The server only shows its takes"),
    ("DISK_LOW", "The disk is almost full"),
    ("TAKE_DAMAGED", "The take cannot be gone through again"),
    (
        "STATE_VERSION",
        "Another version of the server wrote the take",
    ),
    ("ALIGNMENT", "The take's neutral face cannot be read"),
    ("RESOLVES", "Too many takes are being solved again"),
    ("SESSION", "There is no such session"),
    ("SESSION_BUSY", "The session is busy"),
    ("SESSION_ENDED", "The session has ended"),
    ("SESSION_EXISTS", "There is a session of this id"),
    ("SESSION_FAILED", "The session has failed"),
    (
        "SESSION_MISMATCH",
        "Path and message name different sessions",
    ),
    ("SESSION_OWNED", "Another publisher owns the session"),
    (
        "PUBLISHER_FENCED",
        "Another publisher took the session over",
    ),
    ("NEW_RUN", "The session has started over"),
    ("SEQUENCE", "The sample is not kept"),
    ("SUBSCRIBER_LAGGED", "The subscriber fell too far behind"),
    ("DRAINING", "The server is shutting down"),
    // How much there may be.
    ("CALLS", "There is no room for another call"),
    ("BODIES", "There is no room for another large body"),
    ("IMPORTS", "There is no room for another import"),
    ("EXPORTS", "There is no room for another export"),
    ("SESSIONS", "There is no room for another session"),
    ("SUBSCRIBERS", "There is no room for another subscriber"),
    ("LIMIT", "That is too much at once"),
    ("BASIS_SIZE", "The package is too large"),
    ("BODY_SIZE", "The body is too large"),
    ("CHUNK_SIZE", "A piece of the package is too large"),
    ("HEADER_SIZE", "The headers are too large"),
    ("MESSAGE_SIZE", "The message is too large"),
    ("URI_SIZE", "Path and query are too long"),
    ("FRAME_COUNT", "The message has too many frames"),
    ("MESSAGE_PARTS", "The message has too many parts"),
    ("DEADLINE", "The client's deadline has passed"),
    ("MESSAGE_DEADLINE", "The message did not come in time"),
    ("START_TIMEOUT", "The stream did not begin in time"),
    // What a request says.
    ("QUERY", "The query cannot be used"),
    ("JSON", "The JSON cannot be used"),
    ("PROTOBUF", "The protobuf message cannot be read"),
    ("UTF8", "The text is not UTF-8"),
    ("BASE64", "The text is not base64"),
    ("BODY", "The body is not complete"),
    ("EVENT_ID", "The id of the last event cannot be used"),
    ("ENUM", "There is no such value"),
    ("NAME", "A name cannot be used"),
    ("MISSING_FIELD", "A field must be given"),
    ("SOLVER_OPTIONS", "A setting is out of range"),
    ("FIELD_MASK", "The mask names no field"),
    ("PAGE_TOKEN", "The page token is not from this server"),
    ("RATE", "The rate is out of range"),
    ("UNIT", "The unit must be given"),
    ("UNIT_MISMATCH", "The package is in another unit"),
    ("MARKER_COUNT", "There are too many markers"),
    ("DUPLICATE_MARKER", "A marker is named twice"),
    ("NOT_IMPLEMENTED", "This version cannot do that"),
    ("PROTOCOL_ORDER", "A message is out of order"),
    // What frames show.
    ("UNKNOWN_MARKERS", "The actor has none of the markers"),
    (
        "TOO_MANY_REJECTS",
        "Too many frames in a row cannot be used",
    ),
    ("MIRRORED", "The face is mirrored"),
    ("UNITS_SUSPECT", "The coordinates are in another unit"),
    ("NEUTRAL_INCOMPLETE", "The neutral face is not complete"),
    ("DEGENERATE_POSE", "The markers show no pose"),
    // What a package holds.
    ("BARYCENTRIC", "A marker does not lie on the mesh"),
    ("BASIS_RANK", "The muscles cannot be told apart"),
    ("COMPRESSION", "Compressed content is not accepted"),
    ("EXTERNAL_REFERENCE", "The package points outside of itself"),
    ("FACE_INDEX", "A face names vertices that are not there"),
    ("GLTF", "The glTF cannot be used"),
    ("GLTF_EXTENSION", "The glTF needs an extension"),
    ("NON_FINITE", "A number is not finite"),
    ("PARSE", "A file of the package cannot be read"),
    ("VERTEX_COUNT", "The shapes have different meshes"),
    // How a door is used.
    ("ROUTE", "There is no such path"),
    ("HTTP_METHOD", "The path has no such method"),
    ("HTTP_VERSION", "Another version of HTTP is needed"),
    ("METHOD", "There is no such gRPC method"),
    ("CONTENT_TYPE", "Another content type is needed"),
    ("HANDSHAKE", "The WebSocket handshake is not complete"),
    ("MESSAGE_CUT", "The stream ended within a message"),
    ("MESSAGE_FORM", "The message has the other form"),
    ("NO_PONG", "The client did not answer pings"),
    ("PING_FLOOD", "The client sent too many pings"),
    ("SUBPROTOCOL", "The WebSocket needs a subprotocol"),
    ("UPGRADE", "The path is a WebSocket"),
    ("WEBSOCKET", "The WebSocket protocol was broken"),
    // What went wrong here.
    ("CANCELLED", "The call was cancelled"),
    ("ENCODING", "The server made a mistake"),
    ("ENTROPY", "The server has no random numbers"),
    ("INTERNAL", "The server made a mistake"),
    ("PANIC", "The server made a mistake"),
    ("STORAGE", "The server cannot use its storage"),
    ("NOT_ALIGNED", "The session has no neutral face yet"),
    ("QUIETEST_FRAMES", "The quietest frames cannot be taken"),
    // What has no reason of its own is called by its code.
    ("ABORTED", "The call was given up"),
    ("ALREADY_EXISTS", "There is one already"),
    ("DATA_LOSS", "Data are lost"),
    ("FAILED_PRECONDITION", "The state does not allow it"),
    ("INVALID_ARGUMENT", "The request is not valid"),
    ("NOT_FOUND", "There is no such object"),
    ("OK", "Nothing is wrong"),
    ("PERMISSION_DENIED", "The caller may not do this"),
    ("RESOURCE_EXHAUSTED", "A limit is reached"),
    ("UNAVAILABLE", "The server cannot answer now"),
    ("UNKNOWN", "The cause is not known"),
];

#[cfg(test)]
mod tests {
    use std::{collections::BTreeSet, fs, path::Path};

    use super::*;

    /// Behind each of these stands a reason, first or after the name of a field.
    const MAKERS: [&str; 8] = [
        "refuse(Code::",
        "Refusal::new(",
        "Problem::new(",
        "unusable(",
        "limit(",
        "too_large(",
        "Found::field(",
        "Found::text(",
    ];

    /// And behind an arm of a match, where it gives reasons and nothing else.
    const ARM: &str = "=> ";

    #[test]
    fn every_reason_in_the_sources_has_a_title_of_its_own_words() {
        let mut reasons = BTreeSet::new();
        let server = Path::new(env!("CARGO_MANIFEST_DIR"));
        let with_arms = [&MAKERS[..], &[ARM]].concat();
        collect(&server.join("src/service"), &MAKERS, &mut reasons);
        collect(&server.join("src/service/grpc"), &with_arms, &mut reasons);
        collect(
            &server.join("src/wire/invalid.rs"),
            &with_arms,
            &mut reasons,
        );
        collect(&server.join("src/wire"), &MAKERS, &mut reasons);
        let analysis = server.join("../analysis/src");
        for errors in ["format", "face/actor/error.rs"] {
            collect(&analysis.join(errors), &with_arms, &mut reasons);
        }
        assert!(reasons.len() > 80, "{reasons:?}");
        for reason in &reasons {
            let known = TITLES.iter().find(|(it, _)| it == reason);
            let (_, title) = known.unwrap_or_else(|| panic!("{reason} has no title"));
            assert!(title.contains(' '), "{reason}: {title}");
        }
    }

    fn collect(path: &Path, makers: &[&str], reasons: &mut BTreeSet<String>) {
        if path.is_dir() {
            for entry in fs::read_dir(path).unwrap() {
                collect(&entry.unwrap().path(), makers, reasons);
            }
        } else if path.extension().is_some_and(|it| it == "rs") && !path.ends_with("tests.rs") {
            let text = fs::read_to_string(path).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap();
            for maker in makers {
                let calls = code.split(*maker).skip(1);
                reasons.extend(calls.filter_map(reason).map(str::to_owned));
            }
        }
    }

    /// The first or second literal of a call, if one of them is a reason.
    fn reason(call: &str) -> Option<&str> {
        if call.starts_with("json!") {
            return None;
        }
        let end = call.find([';', '}']).unwrap_or(call.len());
        let mut literals = call[..end].split('"').skip(1).step_by(2).take(2);
        let is_upper = |it: &u8| it.is_ascii_uppercase() || it.is_ascii_digit() || *it == b'_';
        literals.find(|it| it.len() > 2 && it.as_bytes().iter().all(&is_upper))
    }
}
