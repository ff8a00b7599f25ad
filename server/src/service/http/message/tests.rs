//! What publishers write as JSON, and what they are told when it cannot be read.

use super::*;
use crate::service::grpc::status::reason_of;

fn read(text: &str) -> Result<v1::PublishMarkersRequest, Status> {
    from_json(text.as_bytes())
}

#[track_caller]
fn assert_refused(text: &str, reason: &str, says: &str) {
    let status = read(text).unwrap_err();
    assert_eq!(status.code(), Code::InvalidArgument);
    assert_eq!(reason_of(&status).as_deref(), Some(reason));
    assert!(status.message().contains(says), "{}", status.message());
}

#[test]
fn a_coordinate_that_was_not_seen_is_nan_as_protobuf_json_spells_it() {
    let text = r#"{"frames":[{"number":"7","positions":["NaN","NaN","NaN",1.5,"-2.25",-0.0]}]}"#;
    let frame = read(text).unwrap().frames.remove(0);
    assert_eq!(frame.number, 7);
    assert!(frame.positions[..3].iter().all(|it| it.is_nan()));
    assert_eq!(frame.positions[3..5], [1.5, -2.25]);
    assert_eq!(frame.positions[5].to_bits(), (-0.0_f32).to_bits());
}

#[test]
fn a_null_coordinate_is_refused_and_the_refusal_says_how_to_write_it() {
    assert_refused(
        r#"{"frames":[{"number":"7","positions":[null,1,2]}]}"#,
        "JSON",
        r#"is "NaN""#,
    );
}

#[test]
fn what_is_not_the_message_is_refused_by_its_place_without_its_text() {
    for (text, says) in [
        (r#"{"frames":[}"#, "not JSON, from column 12"),
        (r#"{"frames":["#, "ends at column"),
        (r#"{"secret":1}"#, "a field that is unknown"),
        (r#"{"frames":[],"frames":[]}"#, "stands twice"),
        (r#"{"frames":[{"number":"secret"}]}"#, "does not fit"),
        (r#"{"frames":[]}{"secret":1}"#, "not JSON, from column 14"),
        (r#"{"frames":[{"positions":[1e400]}]}"#, "not JSON"),
    ] {
        assert_refused(text, "JSON", says);
        assert!(!read(text).unwrap_err().message().contains("secret"));
    }
    let deep = "[".repeat(100_000);
    assert_refused(&deep, "JSON", "");
}

#[test]
fn a_list_of_empty_frames_is_refused_before_it_is_built() {
    let text = format!(r#"{{"frames":[{}{{}}]}}"#, "{},".repeat(300_000));
    assert_refused(&text, "FRAME_COUNT", "300002 objects");
    let braces = format!(r#"{{"start":{{"publisher":"{}"}}}}"#, "{".repeat(1_000));
    assert!(read(&braces).is_ok(), "a brace in a string is no object");
}

#[test]
fn a_start_takes_its_session_from_the_path_and_may_not_name_another() {
    let mut message = read(r#"{"start":{"publisher":"a"}}"#).unwrap();
    message.place("sessions/one").unwrap();
    assert_eq!(message.start.as_ref().unwrap().session, "sessions/one");
    message.place("sessions/one").unwrap();
    let refused = message.place("sessions/two").unwrap_err();
    assert_eq!(reason_of(&refused).as_deref(), Some("SESSION_MISMATCH"));
}
