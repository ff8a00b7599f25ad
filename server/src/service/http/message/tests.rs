//! What publishers write as JSON, and what they are told when it cannot be read.

use super::*;
use crate::service::grpc::status::reason_of;

fn read(text: &str) -> Result<v1::PublishMarkersRequest, Status> {
    from_json(text.as_bytes(), 7)
}

#[test]
fn a_message_that_cannot_be_read_is_told_by_its_line() {
    let status = read(r#"{"frames":[{"number":"7","positions":[null,1,2]}]}"#).unwrap_err();
    assert_eq!(reason_of(&status).as_deref(), Some("JSON"));
    let says = status.message();
    assert!(
        says.starts_with("line 7, column 42: frames[0].positions[0]"),
        "{says}"
    );
    assert!(says.contains(r#"is "NaN""#), "{says}");
}

#[test]
fn a_list_of_empty_frames_is_refused_before_it_is_built() {
    let text = format!(r#"{{"frames":[{}{{}}]}}"#, "{},".repeat(300_000));
    let status = read(&text).unwrap_err();
    assert_eq!(reason_of(&status).as_deref(), Some("FRAME_COUNT"));
    assert!(
        status.message().contains("more than 516 objects"),
        "{}",
        status.message()
    );
    let braces = format!(r#"{{"start":{{"publisher":"{}"}}}}"#, "{".repeat(1_000));
    assert!(read(&braces).is_ok(), "a brace in a string is no object");
}

#[test]
fn a_refusal_says_which_message_it_is_of_unless_it_is_of_none() {
    let taken = Taken::none("line");
    let broken = || {
        refuse(
            Code::FailedPrecondition,
            "PROTOCOL_ORDER",
            "start was sent twice",
        )
    };
    assert!(taken.problem(broken()).document("/")["line"].is_null());
    taken.take(3);
    taken.take_next();
    assert_eq!(taken.problem(broken()).document("/")["line"], 4);
    let ended = refuse(
        Code::FailedPrecondition,
        "SESSION_ENDED",
        "the session has ended",
    );
    assert!(taken.problem(ended).document("/")["line"].is_null());
    let unreadable = read("{").unwrap_err();
    assert_eq!(taken.problem(unreadable).document("/")["line"], 7);
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
