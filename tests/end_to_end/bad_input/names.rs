//! Row I5: names that are paths, control codes, tricks of writing, or too long.

use frontalis_proto::v1::{
    CaptureKind, CreateSessionRequest, GetActorRequest, GetSessionRequest, ImportActorStart,
};
use harness::{assert_refused, toy_files, zip};
use tonic::Code;

use super::beside_a_control_session;

const BAD_IDS: &[&str] = &[
    "../x",
    "..%2f",
    "/etc",
    "C:\\",
    "nul\0",
    "new\nline",
    "\u{1b}[31mred",
    "\u{202e}drawkcab",
    ".",
    "..",
    "-first",
    "_first",
    "Upper",
    "dot.dot",
    "sp ace",
    "\u{1f642}",
    "cafe\u{301}",
    "caf\u{e9}",
    "\u{430}dmin",
];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i5_an_id_that_is_not_a_plain_name_is_refused() {
    beside_a_control_session("I5 ids", async |stage| {
        let long = "a".repeat(64);
        let endless = "a".repeat(50_000);
        let package = zip(&toy_files());
        let more = [long.as_str(), endless.as_str()];
        for id in BAD_IDS.iter().copied().chain(more) {
            let refused = stage
                .server
                .create_session(id, "actors/reference")
                .await
                .unwrap_err();
            assert_refused(&refused, Code::InvalidArgument, "NAME");
            assert_plain(refused.message());
            let refused = stage.server.import(id, &package).await.unwrap_err();
            assert_refused(&refused, Code::InvalidArgument, "NAME");
            assert_plain(refused.message());
        }
        let refused = stage.server.import("", &package).await.unwrap_err();
        assert_refused(&refused, Code::InvalidArgument, "NAME");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i5_a_resource_name_that_is_not_plain_is_refused() {
    beside_a_control_session("I5 resources", async |stage| {
        for name in [
            "",
            "sessions",
            "sessions/",
            "sessions/../x",
            "subject",
            "actors/subject",
        ] {
            let name = name.to_owned();
            let request = GetSessionRequest { name };
            let refused = stage
                .server
                .sessions()
                .await
                .get_session(request)
                .await
                .unwrap_err();
            assert_refused(&refused, Code::InvalidArgument, "NAME");
        }
        for name in [
            "",
            "actors/",
            "actors/../x",
            "reference",
            "sessions/reference",
        ] {
            let name = name.to_owned();
            let request = GetActorRequest { name };
            let refused = stage
                .server
                .actors()
                .await
                .get_actor(request)
                .await
                .unwrap_err();
            assert_refused(&refused, Code::InvalidArgument, "NAME");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i5_display_names_are_normalized_and_limited() {
    beside_a_control_session("I5 display names", async |stage| {
        let create = |id: &str, display_name: &str| CreateSessionRequest {
            session_id: id.to_owned(),
            actor: "actors/reference".to_owned(),
            kind: CaptureKind::Markers.into(),
            settings: None,
            display_name: display_name.to_owned(),
        };
        let mut sessions = stage.server.sessions().await;
        let request = create("cafe", "Cafe\u{301} <b>1</b>");
        let answer = sessions.create_session(request).await.unwrap().into_inner();
        assert_eq!(answer.session.unwrap().display_name, "Caf\u{e9} <b>1</b>");
        let long = "x".repeat(129);
        let flood = format!("a{}", "\u{301}".repeat(200));
        for name in [
            "a\u{202e}b",
            "a\nb",
            "a\0b",
            "\u{1b}[31m",
            long.as_str(),
            flood.as_str(),
        ] {
            let request = create("other", name);
            let refused = sessions.create_session(request).await.unwrap_err();
            assert_refused(&refused, Code::InvalidArgument, "NAME");
            assert_plain(refused.message());
        }
        let start = ImportActorStart {
            actor_id: "toy".to_owned(),
            display_name: "a\u{202e}b".to_owned(),
            ..ImportActorStart::default()
        };
        let refused = stage
            .server
            .import_as(start, &zip(&toy_files()))
            .await
            .unwrap_err();
        assert_refused(&refused, Code::InvalidArgument, "NAME");
    })
    .await;
}

/// Error texts never echo what could write to a terminal, and stay short.
fn assert_plain(message: &str) {
    assert!(message.len() < 1_000, "{} bytes of message", message.len());
    assert!(
        !message
            .chars()
            .any(|it| it.is_control() || it == '\u{202e}'),
        "{message:?}"
    );
}
