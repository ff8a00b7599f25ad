//! Takes are listed, corrected and erased.

use frontalis_proto::{
    FieldMask,
    v1::{DeleteTakeRequest, ListTakesRequest, Take, UpdateTakeRequest},
};
use harness::{Problem, TestServer};
use tonic::Code;

use super::{SESSION, export, get, start, stop};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn takes_are_listed_by_session_actor_and_slate() {
    let server = TestServer::with_session("stage").await;
    server
        .create_session("other", "actors/reference")
        .await
        .unwrap();
    let mut names = Vec::new();
    for (session, slate) in [(SESSION, "1"), (SESSION, "2"), ("sessions/other", "1")] {
        let take = start(&server, session, slate).await.unwrap();
        names.push(stop(&server, &take.name).await.unwrap().name);
    }
    let listed = async |request: ListTakesRequest| {
        let answer = server.takes().await.list_takes(request).await.unwrap();
        let takes = answer.into_inner().takes;
        takes.into_iter().map(|it| it.name).collect::<Vec<_>>()
    };
    let of_session = ListTakesRequest {
        session: SESSION.to_owned(),
        ..ListTakesRequest::default()
    };
    assert_eq!(listed(of_session).await, names[..2]);
    let of_slate = ListTakesRequest {
        slate: "2".to_owned(),
        ..ListTakesRequest::default()
    };
    assert_eq!(listed(of_slate).await, names[1..2]);
    let of_actor = ListTakesRequest {
        actor: "actors/reference".to_owned(),
        ..ListTakesRequest::default()
    };
    assert_eq!(listed(of_actor).await.len(), 3);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_is_said_of_a_take_is_corrected_later() {
    let server = TestServer::with_session("stage").await;
    let take = start(&server, SESSION, "12A").await.unwrap();
    stop(&server, &take.name).await.unwrap();
    let update = |paths: &[&str], take: Take| UpdateTakeRequest {
        take: Some(take),
        update_mask: Some(FieldMask {
            paths: paths.iter().map(|it| (*it).to_owned()).collect(),
        }),
    };
    let changed = Take {
        name: take.name.clone(),
        circled: true,
        notes: "the one".to_owned(),
        ..Take::default()
    };
    let request = update(&["circled", "notes"], changed);
    let answer = server.takes().await.update_take(request).await.unwrap();
    let found = answer.into_inner().take.unwrap();
    assert_eq!(
        (found.circled, found.notes.as_str(), found.slate.as_str()),
        (true, "the one", "12A")
    );
    let unknown = update(&["n_frames"], found);
    let refused = server.takes().await.update_take(unknown).await.unwrap_err();
    assert_eq!(Problem::of(&refused).reason, "FIELD_MASK");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_erased_take_is_gone_from_the_disk() {
    let server = TestServer::with_session("stage").await;
    let take = start(&server, SESSION, "").await.unwrap();
    let is_take = |name: &str| name.contains(".mcap");
    assert!(server.disk_bytes(is_take) > 0);
    assert!(!export(&server, &take.name).await.is_empty());
    let request = DeleteTakeRequest {
        name: take.name.clone(),
    };
    server.takes().await.delete_take(request).await.unwrap();
    assert_eq!(server.disk_bytes(is_take), 0);
    let gone = get(&server, &take.name).await.unwrap_err();
    assert_eq!(Problem::of(&gone).code, Code::NotFound);
}
