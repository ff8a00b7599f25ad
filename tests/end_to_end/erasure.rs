//! Of an erased person no byte is left in the data directory, whatever step a crash comes between (CONTRACTS U-12, S-13, G15).

use std::{fs, path::Path};

use frontalis_access::AuditLine;
use frontalis_proto::{
    FieldMask,
    v1::{
        CreateSessionRequest, DeleteActorRequest, DeleteTakeRequest, ErasureReceipt,
        ImportActorStart, StartTakeRequest, Take, UpdateTakeRequest,
    },
};
use frontalis_server::{catalogue::Catalogue, name::ActorId, service::audit::FILE_NAME};
use harness::{
    Problem, Publisher, TestPerformance, TestServer, assert_eventually, reference_package,
};
use tonic::Code;

use crate::takes::{get, stop};

/// What people wrote of this person; each stands somewhere in the data directory before.
const PLANTED: [&str; 5] = [
    "Planted Actor Name",
    "Planted Session Name",
    "planted slate",
    "planted gesture",
    "planted notes",
];

const SESSION: &str = "sessions/anna-1";

/// Coordinates of a frame as they stand in a file that grows.
fn planted_positions() -> Vec<u8> {
    let positions = &TestPerformance::reference().frame(65).positions;
    positions[..6]
        .iter()
        .flat_map(|it| it.to_le_bytes())
        .collect()
}

fn patterns() -> Vec<Vec<u8>> {
    let texts = PLANTED.iter().map(|it| it.as_bytes().to_vec());
    texts.chain([planted_positions()]).collect()
}

/// Which of the patterns stand in files below `folder`.
fn found(folder: &Path) -> Vec<usize> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.push(fs::read(path).unwrap());
            }
        }
    }
    let stands = |pattern: &Vec<u8>| {
        let stands_in = |file: &Vec<u8>| file.windows(pattern.len()).any(|it| it == pattern);
        files.iter().any(stands_in)
    };
    let patterns = patterns();
    let indices = (0..patterns.len()).filter(|it| stands(&patterns[*it]));
    indices.collect()
}

/// A server with an actor of whom everything is written down, a session that ended, and two takes: one of them cut short.
async fn with_anna() -> TestServer {
    let server = TestServer::start().await;
    let start = ImportActorStart {
        actor_id: "anna".to_owned(),
        display_name: PLANTED[0].to_owned(),
        ..ImportActorStart::default()
    };
    server.import_as(start, &reference_package()).await.unwrap();
    let request = CreateSessionRequest {
        session_id: "anna-1".to_owned(),
        actor: "actors/anna".to_owned(),
        kind: frontalis_proto::v1::CaptureKind::Markers.into(),
        display_name: PLANTED[1].to_owned(),
        ..CreateSessionRequest::default()
    };
    server
        .sessions()
        .await
        .create_session(request)
        .await
        .unwrap();
    let take = record(&server, 1).await;
    let stopped = stop(&server, &take.name).await.unwrap();
    let changed = Take {
        name: stopped.name,
        notes: PLANTED[4].to_owned(),
        ..Take::default()
    };
    let request = UpdateTakeRequest {
        take: Some(changed),
        update_mask: Some(FieldMask {
            paths: vec!["notes".to_owned()],
        }),
    };
    server.takes().await.update_take(request).await.unwrap();
    record(&server, 61).await;
    assert_eq!(found(server.folder()).len(), patterns().len());
    server.end_session(SESSION).await;
    server
}

/// Starts a take and publishes sixty frames into it.
async fn record(server: &TestServer, first: u64) -> Take {
    let request = StartTakeRequest {
        session: SESSION.to_owned(),
        slate: PLANTED[2].to_owned(),
        gesture: PLANTED[3].to_owned(),
        ..StartTakeRequest::default()
    };
    let take = server.takes().await.start_take(request).await.unwrap();
    let performance = TestPerformance::reference();
    let start = performance.start(SESSION, "stage");
    let mut publisher = Publisher::open(server, start).await.unwrap();
    publisher.send(performance.frames(first..=first + 59)).await;
    publisher.durable(first + 59).await.unwrap();
    take.into_inner().take.unwrap()
}

async fn erase(server: &TestServer) -> ErasureReceipt {
    let request = DeleteActorRequest {
        name: "actors/anna".to_owned(),
        with_takes: true,
    };
    let answer = server.actors().await.delete_actor(request).await.unwrap();
    answer.into_inner().receipt.unwrap()
}

/// Event and result of every line of the audit log about this.
fn audited(folder: &Path, object: &str) -> Vec<(String, String)> {
    let text = fs::read_to_string(folder.join(FILE_NAME)).unwrap();
    let lines = text
        .lines()
        .map(|it| serde_json::from_str::<AuditLine>(it).unwrap());
    let lines = lines.filter(|it| it.object == object);
    lines.map(|it| (it.event, it.result)).collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_erased_person_leaves_no_byte_and_a_receipt() {
    let server = with_anna().await;
    let receipt = erase(&server).await;
    assert_eq!(found(server.folder()), Vec::<usize>::new());
    assert_eq!(
        (
            receipt.actor.as_str(),
            receipt.n_revisions,
            receipt.n_sessions,
            receipt.n_takes
        ),
        ("actors/anna", 1, 1, 2)
    );
    assert!(receipt.n_bytes > reference_package().len() as u64);
    let listed = server
        .takes()
        .await
        .list_takes(frontalis_proto::v1::ListTakesRequest::default())
        .await;
    assert_eq!(listed.unwrap().into_inner().takes, []);
    let folder = server.stop().await;
    let lines = audited(folder.path(), "actors/anna");
    assert!(
        lines.contains(&("actor_delete".to_owned(), "ok".to_owned())),
        "{lines:?}"
    );
    assert_eq!(found(folder.path()), Vec::<usize>::new());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_erasure_that_a_crash_cut_is_finished_at_the_next_start() {
    let server = with_anna().await;
    // All that the first step does: from here on the person is not seen any more.
    let doom = |folder: &Path| {
        let catalogue = Catalogue::open(folder).unwrap();
        catalogue
            .doom_actor(&ActorId::parse("anna").unwrap())
            .unwrap();
    };
    let server = server.restart_after(doom).await;
    assert_eventually!(found(server.folder()).is_empty());
    let request = frontalis_proto::v1::GetSessionRequest {
        name: SESSION.to_owned(),
    };
    let gone = server
        .sessions()
        .await
        .get_session(request)
        .await
        .unwrap_err();
    assert_eq!(Problem::of(&gone).code, Code::NotFound);
    let folder = server.stop().await;
    let lines = audited(folder.path(), "actors/anna");
    assert!(
        lines.iter().any(|it| it
            .1
            .starts_with("finished: 1 revisions, 1 sessions, 2 takes")),
        "{lines:?}"
    );
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_erased_take_leaves_no_byte_and_lines_in_the_audit_log() {
    let server = TestServer::with_session("stage").await;
    let take = crate::takes::start(&server, "sessions/stage", PLANTED[2])
        .await
        .unwrap();
    assert!(!crate::takes::export(&server, &take.name).await.is_empty());
    let request = DeleteTakeRequest {
        name: take.name.clone(),
    };
    server.takes().await.delete_take(request).await.unwrap();
    assert_eq!(
        Problem::of(&get(&server, &take.name).await.unwrap_err()).code,
        Code::NotFound
    );
    assert_eq!(found(server.folder()), Vec::<usize>::new());
    let folder = server.stop().await;
    let events: Vec<String> = audited(folder.path(), &take.name)
        .into_iter()
        .map(|it| it.0)
        .collect();
    assert_eq!(events, ["take_export", "take_delete"]);
}
