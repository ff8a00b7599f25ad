//! Rows E1, E3, E4, E6, E7, E9 and F5: messages that are too long, unreadable, compressed, or never complete.

use std::time::Duration;

use frontalis_proto::v1::{
    CaptureKind, ControlSpace, CreateSessionRequest, Delivery, GetSessionRequest,
    ImportActorRequest, ImportActorStart, Ingest, LengthUnit, MarkerFrame, PublishMarkersRequest,
    PublishStart, ReadCurvesRequest, RegionMode, SessionSettings, SubscribeRequest, SubscribeStart,
    UpdateSessionRequest,
};
use harness::{Problem, RawConnection, assert_refused, encoded, every_frame, framed, prefixed};
use prost::Message;
use tonic::{Code, Status};

use super::{GOOD_FRAMES, SUBJECT, beside_a_control_session, beside_a_control_session_with};

const CREATE: &str = "/frontalis.v1.SessionService/CreateSession";
const GET: &str = "/frontalis.v1.SessionService/GetSession";
const UPDATE: &str = "/frontalis.v1.SessionService/UpdateSession";
const PUBLISH: &str = "/frontalis.v1.CaptureService/PublishMarkers";
const SUBSCRIBE: &str = "/frontalis.v1.CurveService/Subscribe";
const FOLLOW: &str = "/frontalis.v1.CurveService/Follow";
const READ: &str = "/frontalis.v1.CurveService/ReadCurves";
const IMPORT: &str = "/frontalis.v1.ActorService/ImportActor";
const HEALTH: &str = "/grpc.health.v1.Health/Check";
const REFLECTION: &str = "/grpc.reflection.v1.ServerReflection/ServerReflectionInfo";

/// One of every kind of call, and the longest message that it takes.
///
/// Reflection is not among them: it ends in peace whatever comes.
const CALLS: [(&str, usize); 7] = [
    (CREATE, 64 << 10),
    (GET, 64 << 10),
    (SUBSCRIBE, 64 << 10),
    (FOLLOW, 64 << 10),
    (HEALTH, 64 << 10),
    (PUBLISH, 1 << 20),
    (IMPORT, (1 << 20) + (4 << 10)),
];

/// The forms of a gRPC call that stand for the same.
const KINDS: [&str; 2] = ["application/grpc", "application/grpc-web+proto"];

/// The status of a call with these bytes as its whole request, in one of these forms.
async fn status_of(connection: &mut RawConnection, kind: &str, path: &str, bytes: &[u8]) -> Status {
    let mut call = connection.call(path, &[("content-type", kind)]).await;
    call.send(bytes).await;
    call.finish();
    call.answer().await.status()
}

/// Field 100, which no message has: a group's start and its end.
const GROUP: [[u8; 2]; 2] = [[0xa3, 0x06], [0xa4, 0x06]];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e1_a_message_above_the_limit_is_out_of_range_by_its_prefix_alone() {
    beside_a_control_session("E1", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        for (path, most_bytes) in CALLS {
            let length = u32::try_from(most_bytes + 1).unwrap();
            let lengths = [length, u32::MAX];
            for (length, kind) in lengths.iter().flat_map(|it| KINDS.map(|kind| (*it, kind))) {
                let mut call = connection.call(path, &[("content-type", kind)]).await;
                call.send(&prefixed(0, length, b"")).await;
                let refused = call.answer().await.status();
                assert_refused(&refused, Code::OutOfRange, "MESSAGE_SIZE");
                assert!(
                    refused.message().contains(&most_bytes.to_string()),
                    "{path}: {refused}"
                );
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e1_frames_acknowledged_before_a_message_above_the_limit_stay() {
    beside_a_control_session("E1 frames", async |stage| {
        let mut publisher = stage.publisher().await;
        let huge = MarkerFrame {
            number: GOOD_FRAMES + 1,
            positions: vec![0.0; 300_000],
            ..MarkerFrame::default()
        };
        publisher.send(vec![huge]).await;
        let refused = publisher.broken_off().await;
        assert_refused(&refused, Code::OutOfRange, "MESSAGE_SIZE");
        assert_eq!(publisher.report().accepted_through, GOOD_FRAMES);
        stage.subscriber().await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e3_bytes_that_are_no_protobuf_end_the_call() {
    beside_a_control_session("E3", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let unreadable: [(&str, &[u8]); 6] = [
            ("a varint of eleven bytes", &[0xff; 11]),
            ("another wire type", &[0x09, 1, 2, 3, 4, 5, 6, 7, 8]),
            ("a varint cut short", &[0x0a, 0x80]),
            ("a string cut short", &[0x0a, 0x05, b'x']),
            ("field number 0", &[0x02, 0x00]),
            ("a wire type that does not exist", &[0xa7, 0x06]),
        ];
        for (path, _) in CALLS {
            let forms = unreadable
                .iter()
                .flat_map(|it| KINDS.map(|kind| (kind, *it)));
            for (kind, (what, bytes)) in forms {
                let refused = status_of(&mut connection, kind, path, &framed(bytes)).await;
                let problem = Problem::of(&refused);
                assert_eq!(
                    (problem.code, problem.reason.as_str()),
                    (Code::Internal, "PROTOBUF"),
                    "{kind} {path}, {what}: {problem:?}"
                );
            }
        }
        assert_still_there(&mut connection).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e3_a_stream_that_ends_within_a_message_is_refused() {
    beside_a_control_session("E3 cut", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        for (path, _) in CALLS {
            for bytes in [&[0, 0][..], &[0, 0, 0, 0, 9], &[0, 0, 0, 0, 9, 0x0a]] {
                let refused = connection.answer(path, bytes).await.status();
                assert_refused(&refused, Code::InvalidArgument, "MESSAGE_CUT");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e4_groups_nested_a_hundred_thousand_deep_are_not_followed() {
    beside_a_control_session("E4", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let [start, end] = GROUP;
        let open = start.repeat(100_000);
        let closed = [start.repeat(100_000), end.repeat(100_000)].concat();
        for bytes in [&open, &closed] {
            for path in [PUBLISH, IMPORT] {
                let refused = connection.answer(path, &framed(bytes)).await.status();
                assert_refused(&refused, Code::Internal, "PROTOBUF");
            }
            let shorter = &bytes[..60_000];
            for path in [GET, SUBSCRIBE, FOLLOW, HEALTH] {
                let refused = connection.answer(path, &framed(shorter)).await.status();
                assert_refused(&refused, Code::Internal, "PROTOBUF");
            }
        }
        // A hundred deep is read, and ignored.
        let shallow = [start.repeat(90), end.repeat(90)].concat();
        let answer = connection.answer(PUBLISH, &framed(&shallow)).await.status();
        assert_refused(&answer, Code::FailedPrecondition, "PROTOCOL_ORDER");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e4_messages_nested_a_hundred_thousand_deep_are_not_followed() {
    beside_a_control_session("E4 messages", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let mut nested = Vec::new();
        for _ in 0..100_000 {
            let mut outer = Vec::new();
            prost::encoding::encode_varint(nested.len() as u64, &mut outer);
            // Built from the inside out, and backwards: appending to the front a hundred thousand times is slow.
            outer.reverse();
            nested.extend(outer);
            nested.extend([0x06, 0xa2]);
        }
        nested.reverse();
        let answer = connection.answer(PUBLISH, &framed(&nested)).await.status();
        assert_refused(&answer, Code::FailedPrecondition, "PROTOCOL_ORDER");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_unknown_fields_are_ignored() {
    beside_a_control_session("E6 fields", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let request = GetSessionRequest {
            name: SUBJECT.to_owned(),
        };
        let mut bytes = request.encode_to_vec();
        // Field 100 as a varint, 8 bytes, a string, a group and 4 bytes.
        bytes.extend([0xa0, 0x06, 0x07]);
        bytes.extend([0xa1, 0x06, 1, 2, 3, 4, 5, 6, 7, 8]);
        bytes.extend([0xa2, 0x06, 0x02, b'h', b'i']);
        bytes.extend(GROUP.concat());
        bytes.extend([0xa5, 0x06, 1, 2, 3, 4]);
        let answer = connection.answer(GET, &framed(&bytes)).await.status();
        assert_eq!(answer.code(), Code::Ok, "{answer:?}");
    })
    .await;
}

/// A number that no enum has.
const UNKNOWN: i32 = 77;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_unknown_enum_values_are_refused_where_their_meaning_is_needed() {
    beside_a_control_session("E6 enums", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        for (what, path, message) in enums(&stage.performance.start(SUBJECT, "camera-1")) {
            for number in [UNKNOWN, -1, i32::MAX] {
                let refused = connection.answer(path, &message(number)).await.status();
                let problem = Problem::of(&refused);
                assert_eq!(
                    (problem.code, problem.reason.as_str()),
                    (Code::InvalidArgument, "ENUM"),
                    "{what}: {problem:?}"
                );
            }
        }
    })
    .await;
}

type MakeMessage = Box<dyn Fn(i32) -> Vec<u8>>;

/// Every enum of a request: its field, its call, and the message with any number in it.
fn enums(publish: &PublishStart) -> Vec<(&'static str, &'static str, MakeMessage)> {
    let create = || CreateSessionRequest {
        session_id: "other".to_owned(),
        actor: "actors/reference".to_owned(),
        kind: CaptureKind::Markers.into(),
        ..CreateSessionRequest::default()
    };
    let start = |change: fn(&mut PublishStart, i32)| -> MakeMessage {
        let publish = publish.clone();
        Box::new(move |number| {
            let mut start = publish.clone();
            change(&mut start, number);
            encoded(&PublishMarkersRequest {
                start: Some(start),
                ..PublishMarkersRequest::default()
            })
        })
    };
    let subscribe = |change: fn(&mut SubscribeStart, i32)| -> MakeMessage {
        Box::new(move |number| {
            let mut start = every_frame(SUBJECT);
            change(&mut start, number);
            encoded(&SubscribeRequest {
                start: Some(start),
                credits: 0,
            })
        })
    };
    let region_mode = |region_mode| SessionSettings {
        region_mode,
        ..SessionSettings::default()
    };
    vec![
        (
            "kind",
            CREATE,
            Box::new(move |kind| encoded(&CreateSessionRequest { kind, ..create() })),
        ),
        (
            "region mode of a new session",
            CREATE,
            Box::new(move |number| {
                encoded(&CreateSessionRequest {
                    settings: Some(region_mode(number)),
                    ..create()
                })
            }),
        ),
        (
            "region mode of a session",
            UPDATE,
            Box::new(move |number| {
                encoded(&UpdateSessionRequest {
                    name: SUBJECT.to_owned(),
                    settings: Some(region_mode(number)),
                    ..UpdateSessionRequest::default()
                })
            }),
        ),
        ("unit", PUBLISH, start(|it, number| it.unit = number)),
        ("ingest", PUBLISH, start(|it, number| it.ingest = number)),
        (
            "delivery",
            SUBSCRIBE,
            subscribe(|it, number| it.delivery = number),
        ),
        (
            "control space",
            SUBSCRIBE,
            subscribe(|it, number| it.control_space = number),
        ),
        (
            "delivery of a follower",
            FOLLOW,
            Box::new(|delivery| {
                encoded(&SubscribeStart {
                    delivery,
                    ..every_frame(SUBJECT)
                })
            }),
        ),
        (
            "unit of a package",
            IMPORT,
            Box::new(|unit| {
                let start = ImportActorStart {
                    actor_id: "other".to_owned(),
                    unit,
                    ..ImportActorStart::default()
                };
                encoded(&ImportActorRequest {
                    start: Some(start),
                    chunk: Vec::new(),
                })
            }),
        ),
    ]
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e6_default_values_everywhere_are_as_good_as_absent() {
    beside_a_control_session("E6 defaults", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        // Written out, which no encoder does: every number 0, every text empty.
        let zeros =
            |fields: &[u8]| -> Vec<u8> { fields.iter().flat_map(|it| [it << 3, 0]).collect() };
        let texts =
            |fields: &[u8]| -> Vec<u8> { fields.iter().flat_map(|it| [it << 3 | 2, 0]).collect() };
        let nothing = [
            (CREATE, [texts(&[1, 2, 5]), zeros(&[3])].concat()),
            (GET, texts(&[1])),
            (READ, texts(&[1])),
            (FOLLOW, texts(&[1])),
        ];
        for (path, written_out) in nothing {
            let absent = connection.answer(path, &framed(b"")).await.status();
            let present = connection
                .answer(path, &framed(&written_out))
                .await
                .status();
            assert_eq!(Problem::of(&present), Problem::of(&absent), "{path}");
        }
        let quiet = SubscribeStart {
            delivery: Delivery::Unspecified.into(),
            control_space: ControlSpace::Unspecified.into(),
            ..every_frame(SUBJECT)
        };
        let read = ReadCurvesRequest {
            session: SUBJECT.to_owned(),
            ..ReadCurvesRequest::default()
        };
        let mode: i32 = RegionMode::Unspecified.into();
        assert_eq!(
            (
                mode,
                Ingest::Unspecified as i32,
                LengthUnit::Unspecified as i32
            ),
            (0, 0, 0)
        );
        assert_eq!(quiet.delivery, 0);
        let answer = connection.answer(READ, &encoded(&read)).await.status();
        assert_eq!(answer.code(), Code::Ok, "{answer:?}");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e7_text_that_is_no_utf_8_is_unreadable() {
    beside_a_control_session("E7", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        // Stray, overlong, a surrogate, cut short.
        let bad: [&[u8]; 4] = [
            &[0xff, 0xfe],
            &[0xc0, 0xaf],
            &[0xed, 0xa0, 0x80],
            &[b'a', 0xe2, 0x82],
        ];
        for text in bad {
            let length = u8::try_from(text.len()).unwrap();
            let field = [&[0x0a, length][..], text].concat();
            let inside = [&[0x0a, length + 2][..], &field].concat();
            let calls = [
                (GET, &field),
                (CREATE, &field),
                (FOLLOW, &field),
                (HEALTH, &field),
                (SUBSCRIBE, &inside),
                (PUBLISH, &inside),
                (IMPORT, &inside),
            ];
            for (path, bytes) in calls {
                let refused = connection.answer(path, &framed(bytes)).await.status();
                assert_refused(&refused, Code::Internal, "PROTOBUF");
                assert!(refused.message().is_ascii(), "{path}: {refused}");
            }
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e9_compressed_messages_are_not_taken() {
    beside_a_control_session("E9", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        // What says to inflate to a gigabyte is never inflated.
        let bomb = [&[0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3][..], &[0xff; 50]].concat();
        let length = u32::try_from(bomb.len()).unwrap();
        for (path, _) in CALLS {
            for (flag, kind) in [
                (1, KINDS[0]),
                (2, KINDS[0]),
                (0x80, KINDS[0]),
                (0xff, KINDS[0]),
                (1, KINDS[1]),
            ] {
                let bytes = prefixed(flag, length, &bomb);
                let refused = status_of(&mut connection, kind, path, &bytes).await;
                assert_refused(&refused, Code::Unimplemented, "COMPRESSION");
            }
            for encoding in ["gzip", "deflate", "zstd", "br", "snappy", "nothing", ""] {
                let mut call = connection.call(path, &[("grpc-encoding", encoding)]).await;
                call.send(&prefixed(1, length, &bomb)).await;
                call.finish();
                let answer = call.answer().await;
                assert_refused(&answer.status(), Code::Unimplemented, "COMPRESSION");
                assert_eq!(answer.headers["grpc-accept-encoding"], "identity");
            }
        }
        let request = GetSessionRequest {
            name: SUBJECT.to_owned(),
        };
        let mut call = connection.call(GET, &[("grpc-encoding", "identity")]).await;
        call.send(&encoded(&request)).await;
        call.finish();
        assert_eq!(call.answer().await.status().code(), Code::Ok);
    })
    .await;
}

/// The library that answers reflection swallows what is wrong with a request: the stream ends and says nothing.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e3_reflection_ends_in_peace() {
    beside_a_control_session("E3 reflection", async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let list = framed(&[0x3a, 0]);
        let long = prefixed(0, 4 << 20, b"");
        let bad = [framed(&[0xff; 11]), long, prefixed(1, 2, &[0x3a, 0])];
        for bytes in bad {
            let mut call = connection.call(REFLECTION, &[]).await;
            call.send(&[&list[..], &bytes].concat()).await;
            let answer = call.answer().await;
            assert_eq!(answer.status().code(), Code::Ok);
            assert!(!answer.body.is_empty(), "the good request was not answered");
        }
        assert_still_there(&mut connection).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn f5_a_message_that_comes_byte_by_byte_ends_its_call_and_no_other() {
    let hurried = |config: &mut frontalis_server::config::Config| {
        config.transport.message_deadline_secs = 1;
    };
    beside_a_control_session_with("F5", hurried, async |stage| {
        let mut connection = RawConnection::open(&stage.server).await;
        let start = PublishMarkersRequest {
            start: Some(stage.performance.start(SUBJECT, "camera-1")),
            frames: stage.performance.frames(1..=GOOD_FRAMES),
            clock: None,
        };
        let more = PublishMarkersRequest {
            frames: stage.performance.frames(GOOD_FRAMES + 1..=GOOD_FRAMES + 2),
            ..PublishMarkersRequest::default()
        };
        let mut call = connection.call(PUBLISH, &[]).await;
        call.send(&encoded(&start)).await;
        let mut ticks = tokio::time::interval(Duration::from_millis(50));
        // Many times more than the deadline: the stream is cut long before.
        for byte in &encoded(&more)[..60] {
            ticks.tick().await;
            call.send(&[*byte]).await;
        }
        let refused = call.answer().await.status();
        assert_refused(&refused, Code::DeadlineExceeded, "MESSAGE_DEADLINE");
        let samples = stage.subscriber().await;
        drop(samples);
        assert_still_there(&mut connection).await;
    })
    .await;
}

/// The connection goes on: only the call was ended.
async fn assert_still_there(connection: &mut RawConnection) {
    let request = GetSessionRequest {
        name: SUBJECT.to_owned(),
    };
    let answer: Status = connection.answer(GET, &encoded(&request)).await.status();
    assert_eq!(answer.code(), Code::Ok, "{answer:?}");
}
