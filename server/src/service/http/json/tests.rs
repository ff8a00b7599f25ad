//! The mapping as it is read, and what is said of a text that is not the message.

use frontalis_proto::v1;
use tonic::Status;

use super::{
    schema::{Kind, MessageType},
    *,
};
use crate::service::grpc::status::{metadata_of, reason_of};

fn rules() -> Rules {
    Rules {
        in_path: &["name"],
        max_objects: 16,
    }
}

fn update(text: &str) -> v1::UpdateSessionRequest {
    read(text.as_bytes(), rules()).unwrap_or_else(|fault| panic!("{text}: {fault:?}"))
}

fn publish(text: &str) -> v1::PublishMarkersRequest {
    read(text.as_bytes(), rules()).unwrap_or_else(|fault| panic!("{text}: {fault:?}"))
}

fn refused<M: Message + Name + Default + std::fmt::Debug>(text: &str) -> Status {
    read::<M>(text.as_bytes(), rules()).unwrap_err().into()
}

/// Reason, field and text.
fn said(status: &Status) -> (String, String, String) {
    let figures = metadata_of(status);
    let field = figures.into_iter().find(|(key, _)| key == "field");
    (
        reason_of(status).unwrap_or_default(),
        field.map_or_else(String::new, |(_, field)| field),
        status.message().to_owned(),
    )
}

#[track_caller]
fn assert_update_refused(text: &str, reason: &str, field: &str, says: &str) {
    let status = refused::<v1::UpdateSessionRequest>(text);
    let expected = (reason.to_owned(), field.to_owned(), says.to_owned());
    assert_eq!(said(&status), expected, "{text}");
}

#[test]
fn a_field_is_read_by_both_of_its_names() {
    for text in [r#"{"actorRevision":3}"#, r#"{"actor_revision":3}"#] {
        assert_eq!(update(text).actor_revision, 3);
    }
    assert_update_refused(
        r#"{"actorRevision":3,"actor_revision":3}"#,
        "JSON",
        "actorRevision",
        "line 1, column 35: actorRevision stands twice",
    );
}

#[test]
fn null_is_the_default_of_every_field() {
    let nothing = update(r#"{"settings":null,"actorRevision":null,"updateMask":null}"#);
    assert_eq!(nothing, v1::UpdateSessionRequest::default());
    let settings = update(
        r#"{"settings":{"neutralFrames":null,"smoothing":null,"robust":null,"staleAfter":null,"regionMode":null}}"#,
    );
    assert_eq!(settings.settings, Some(v1::SessionSettings::default()));
    let frames = publish(r#"{"start":{"markerNames":null},"frames":null,"clock":null}"#);
    assert_eq!(frames.start, Some(v1::PublishStart::default()));
    assert!(frames.frames.is_empty());
    let frame =
        &publish(r#"{"frames":[{"number":null,"positions":null,"crc32c":null}]}"#).frames[0];
    assert_eq!(*frame, v1::MarkerFrame::default());
}

#[test]
fn null_that_stands_for_a_field_counts_as_the_field() {
    assert_update_refused(
        r#"{"actorRevision":null,"actorRevision":3}"#,
        "JSON",
        "actorRevision",
        "line 1, column 37: actorRevision stands twice",
    );
    assert_update_refused(
        r#"{"name":null}"#,
        "JSON",
        "name",
        "line 1, column 7: name is said by the path already",
    );
}

#[test]
fn a_default_that_is_written_is_there() {
    let settings = update(r#"{"settings":{"robust":false,"smoothing":0,"neutralFrames":0}}"#);
    let settings = settings.settings.unwrap();
    assert_eq!(settings.robust, Some(false));
    assert_eq!(settings.smoothing, Some(0.0));
    assert_eq!(settings.neutral_frames, Some(0));
    assert_eq!(settings.record, None);
}

#[test]
fn whole_numbers_are_read_in_every_form() {
    for number in ["13", "13.0", "1.3e1", "\"13\"", "\"13.0\"", "\"1.3e1\""] {
        let frame = format!(
            r#"{{"frames":[{{"number":{number},"captureTimeNanos":{number},"timecode":{{"hours":{number}}},"crc32c":{number}}}]}}"#
        );
        let frame = &publish(&frame).frames[0];
        assert_eq!(
            (frame.number, frame.capture_time_nanos, frame.crc32c),
            (13, 13, Some(13)),
            "{number}"
        );
        assert_eq!(frame.timecode.unwrap().hours, 13, "{number}");
    }
    let most = r#"{"frames":[{"number":"18446744073709551615","captureTimeNanos":"-9223372036854775808"}]}"#;
    let frame = &publish(most).frames[0];
    assert_eq!(
        (frame.number, frame.capture_time_nanos),
        (u64::MAX, i64::MIN)
    );
}

#[test]
fn a_number_that_the_field_cannot_hold_is_refused() {
    for number in [
        "-1",
        "1.5",
        "4294967296",
        "\"1e300\"",
        "\"\"",
        "\" 1\"",
        "true",
        "{}",
        "[1]",
    ] {
        let status =
            refused::<v1::UpdateSessionRequest>(&format!(r#"{{"actorRevision":{number}}}"#));
        let (reason, field, says) = said(&status);
        assert_eq!(
            (reason.as_str(), field.as_str()),
            ("JSON", "actorRevision"),
            "{number}"
        );
        let due = "actorRevision must be a whole number from 0 to 4294967295";
        assert!(says.ends_with(due), "{number}: {says}");
    }
    assert_update_refused(
        r#"{"settings":{"smoothing":1e39}}"#,
        "JSON",
        "settings.smoothing",
        "line 1, column 29: settings.smoothing must be a number, or \"NaN\"",
    );
    assert_update_refused(
        r#"{"settings":{"smoothing":1e400}}"#,
        "JSON",
        "settings.smoothing",
        "line 1, column 30: a number that no field can hold",
    );
}

#[test]
fn coordinates_are_read_to_the_last_bit() {
    let text =
        r#"{"frames":[{"positions":["NaN",1.5,"-2.25",-0.0,"-0",1e-45,16777217,"Infinity",0.1]}]}"#;
    let positions = &publish(text).frames[0].positions;
    let bits: Vec<u32> = positions.iter().map(|it| it.to_bits()).collect();
    let expected = [
        f32::NAN,
        1.5,
        -2.25,
        -0.0,
        -0.0,
        1e-45,
        16_777_216.0,
        f32::INFINITY,
        0.1,
    ];
    assert_eq!(bits, expected.map(f32::to_bits));
}

#[test]
fn an_enum_is_read_by_name_or_number_and_any_other_is_refused_with_the_names() {
    for mode in ["\"REGION_MODE_SPLIT\"", "2", "2.0"] {
        let read = update(&format!(r#"{{"settings":{{"regionMode":{mode}}}}}"#));
        assert_eq!(
            read.settings.unwrap().region_mode(),
            v1::RegionMode::Split,
            "{mode}"
        );
    }
    for mode in [
        "\"secret\"",
        "\"2\"",
        "\"region_mode_split\"",
        "7",
        "-1",
        "1.5",
        "1e300",
        "true",
    ] {
        let text = format!(r#"{{"settings":{{"regionMode":{mode}}}}}"#);
        let (reason, field, says) = said(&refused::<v1::UpdateSessionRequest>(&text));
        assert_eq!(
            (reason.as_str(), field.as_str()),
            ("ENUM", "settings.regionMode"),
            "{mode}"
        );
        let due = "settings.regionMode must be one of REGION_MODE_UNSPECIFIED, REGION_MODE_JOINT, REGION_MODE_SPLIT";
        assert!(says.ends_with(due), "{mode}: {says}");
    }
}

#[test]
fn what_has_a_form_of_its_own_is_read_in_it() {
    let read = update(r#"{"settings":{"staleAfter":"1.5s"},"updateMask":"staleAfter,regionMode"}"#);
    let stale_after = read.settings.unwrap().stale_after.unwrap();
    assert_eq!((stale_after.seconds, stale_after.nanos), (1, 500_000_000));
    assert_eq!(
        read.update_mask.unwrap().paths,
        ["stale_after", "region_mode"]
    );
    assert_update_refused(
        r#"{"settings":{"staleAfter":1.5}}"#,
        "JSON",
        "settings.staleAfter",
        "line 1, column 29: settings.staleAfter must be a duration in seconds, such as \"1.5s\"",
    );
    for text in [
        r#"{"settings":{"staleAfter":"soon"}}"#,
        r#"{"updateMask":"stale_after"}"#,
    ] {
        let (reason, _, _) = said(&refused::<v1::UpdateSessionRequest>(text));
        assert_eq!(reason, "JSON", "{text}");
    }
}

#[test]
fn what_is_wrong_and_where_is_said_without_repeating_it() {
    let cases = [
        ("", "", "line 1, column 0: the JSON ends too early"),
        ("{", "", "line 1, column 1: the JSON ends too early"),
        (
            "{} x",
            "",
            "line 1, column 4: no JSON, or more after its end",
        ),
        ("[]", "", "line 1, column 2: the message must be an object"),
        (
            "null",
            "",
            "line 1, column 4: the message must be an object",
        ),
        (
            "{\n\"secret\":1}",
            "",
            "line 2, column 8: a field that UpdateSessionRequest does not have",
        ),
        (
            r#"{"settings":{"secret":1}}"#,
            "settings",
            "line 1, column 21: a field that SessionSettings does not have",
        ),
        (
            r#"{"settings":{"robust":true,"robust":true}}"#,
            "settings.robust",
            "line 1, column 35: settings.robust stands twice",
        ),
        (
            r#"{"settings":[]}"#,
            "settings",
            "line 1, column 14: settings must be an object",
        ),
        (
            r#"{"settings":{"robust":"secret"}}"#,
            "settings.robust",
            "line 1, column 30: settings.robust must be true or false",
        ),
        (
            r#"{"settings":{"smoothing":"\ud800"}}"#,
            "settings.smoothing",
            "line 1, column 33: no JSON, or more after its end",
        ),
    ];
    for (text, field, says) in cases {
        assert_update_refused(text, "JSON", field, says);
    }
    let (open, close) = ("[".repeat(100_000), "]".repeat(100_000));
    let deep = format!(r#"{{"settings":{{"smoothing":{open}{close}}}}}"#);
    let (reason, field, _) = said(&refused::<v1::UpdateSessionRequest>(&deep));
    assert_eq!(
        (reason.as_str(), field.as_str()),
        ("JSON", "settings.smoothing")
    );
}

#[test]
fn a_place_in_a_list_is_said() {
    let cases = [
        (
            r#"{"frames":[{"positions":[0,1,2]},{"positions":[0,null]}]}"#,
            "frames[1].positions[1]",
        ),
        (r#"{"frames":[{},7]}"#, "frames[1]"),
        (r#"{"frames":[null]}"#, "frames[0]"),
        (r#"{"frames":{}}"#, "frames"),
        (
            r#"{"frames":[{"timecode":{"hours":-1}}]}"#,
            "frames[0].timecode.hours",
        ),
        (
            r#"{"start":{"markerNames":["a",1]}}"#,
            "start.markerNames[1]",
        ),
        (
            r#"{"start":{"markerNames":[["a"]]}}"#,
            "start.markerNames[0]",
        ),
        (r#"{"start":{"markerNames":"a"}}"#, "start.markerNames"),
    ];
    for (text, expected) in cases {
        let (reason, field, says) = said(&refused::<v1::PublishMarkersRequest>(text));
        assert_eq!(
            (reason.as_str(), field.as_str()),
            ("JSON", expected),
            "{text}"
        );
        assert!(
            says.contains(&format!("{expected} must be ")),
            "{text}: {says}"
        );
    }
}

#[test]
fn what_was_written_reads_back() {
    let message = v1::PublishMarkersRequest {
        start: Some(v1::PublishStart {
            session: "sessions/one".into(),
            publisher: "rig \"1\" ☺".into(),
            marker_names: vec!["a".into(), String::new()],
            unit: v1::LengthUnit::Millimeter.into(),
            takeover: true,
            ingest: v1::Ingest::Lossless.into(),
            image: Some(v1::ImageFormat::default()),
            rate_hz: 29.97,
        }),
        frames: vec![
            v1::MarkerFrame {
                number: u64::MAX,
                capture_time_nanos: i64::MIN,
                timecode: Some(v1::Timecode {
                    sub_frame: 0.1,
                    user_bits: u32::MAX,
                    drop_frame: true,
                    ..v1::Timecode::default()
                }),
                positions: vec![0.1, f32::MIN_POSITIVE, f32::MAX, -1e-45],
                source_frame: 1 << 53,
                crc32c: Some(0),
            },
            v1::MarkerFrame::default(),
        ],
        clock: Some(v1::ClockEcho {
            server_send_nanos: -1,
            client_receive_nanos: i64::MAX,
            client_send_nanos: 0,
        }),
    };
    assert_eq!(publish(&serde_json::to_string(&message).unwrap()), message);
}

/// Bytes have no place in what is read as JSON, and a list in a list would be one.
#[test]
fn every_field_of_what_is_read_can_be_said() {
    fn check(message: &'static MessageType) {
        for field in message.fields() {
            match &field.kind {
                Kind::Unread => panic!("{}.{}", message.name, field.json_name),
                Kind::Message(name) => check(schema::message(name)),
                _ => {}
            }
        }
    }
    for name in [
        v1::CreateSessionRequest::NAME,
        v1::UpdateSessionRequest::NAME,
        v1::RecenterSessionRequest::NAME,
        v1::EndSessionRequest::NAME,
        v1::PublishMarkersRequest::NAME,
        v1::SubscribeRequest::NAME,
    ] {
        check(schema::message(name));
    }
}
