//! Every action is there over HTTP too, and answers what gRPC answers.

mod packages;
mod refusals;

use frontalis_proto::v1;
use harness::{HttpAnswer, TestServer, http_get, http_send};
use hyper::Method;
use serde_json::{Value, json};

/// A request with a body of JSON.
async fn send(server: &TestServer, method: Method, path: &str, body: &Value) -> HttpAnswer {
    let kind = [("content-type", "application/json")];
    http_send(server, &method, path, &kind, body.to_string().as_bytes()).await
}

/// An action without a body.
async fn act(server: &TestServer, method: Method, path: &str) -> HttpAnswer {
    http_send(server, &method, path, &[], b"").await
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_session_lives_over_http_as_it_does_over_grpc() {
    let server = TestServer::start().await;
    server.import_reference().await;
    let asked = json!({
        "sessionId": "stage",
        "actor": "actors/reference",
        "kind": "CAPTURE_KIND_MARKERS",
        "displayName": "Ame\u{301}lie",
        "settings": { "neutralFrames": 7, "staleAfter": "0.250s" },
    });
    let created = send(&server, Method::POST, "/api/v1/sessions", &asked).await;
    assert_eq!(created.status, 201, "{}", created.text());
    assert_eq!(created.headers["location"], "/api/v1/sessions/stage");
    let over_grpc = server.session("sessions/stage").await;
    assert_eq!(over_grpc.display_name, "Am\u{e9}lie");
    assert_eq!(created.json(), json!(over_grpc));

    let got = http_get(&server, "/api/v1/sessions/stage").await;
    assert_eq!((got.status.as_u16(), got.json()), (200, json!(over_grpc)));

    let change = json!({ "settings": { "regionMode": "REGION_MODE_SPLIT" }, "actorRevision": 1 });
    let changed = send(&server, Method::PATCH, "/api/v1/sessions/stage", &change).await;
    assert_eq!(changed.status, 200, "{}", changed.text());
    let settings = server.session("sessions/stage").await.settings.unwrap();
    assert_eq!(settings.region_mode(), v1::RegionMode::Split);
    assert_eq!(settings.neutral_frames, Some(7));

    let reset = json!({ "updateMask": "neutralFrames,settings.regionMode", "settings": {} });
    let reset = send(&server, Method::PATCH, "/api/v1/sessions/stage", &reset).await;
    assert_eq!(reset.json()["settings"]["neutralFrames"], 15);
    assert_eq!(reset.json(), json!(server.session("sessions/stage").await));

    let recentered = act(&server, Method::POST, "/api/v1/sessions/stage/recenter").await;
    assert_eq!(recentered.status, 200, "{}", recentered.text());
    for _ in 0..2 {
        let ended = act(&server, Method::POST, "/api/v1/sessions/stage/end").await;
        assert_eq!(ended.status, 200, "{}", ended.text());
        assert_eq!(ended.json()["status"]["state"], "SESSION_STATE_ENDED");
    }
    assert_eq!(
        http_get(&server, "/api/v1/sessions/stage").await.json(),
        json!(server.session("sessions/stage").await)
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn lists_have_the_pages_of_grpc() {
    let server = TestServer::start().await;
    server.import_reference().await;
    for id in ["a", "b", "c"] {
        server.create_session(id, "actors/reference").await.unwrap();
    }
    let mut token = String::new();
    let mut names = Vec::new();
    loop {
        let path = format!("/api/v1/sessions?pageSize=2&pageToken={token}");
        let over_http = http_get(&server, &path).await.json();
        let request = v1::ListSessionsRequest {
            page_size: 2,
            page_token: token,
        };
        let over_grpc = server.sessions().await.list_sessions(request).await;
        assert_eq!(over_http, json!(over_grpc.unwrap().into_inner()));
        let sessions = over_http["sessions"].as_array().unwrap();
        names.extend(sessions.iter().map(|it| it["name"].clone()));
        // The last page's token is empty, and left out.
        let Some(next) = over_http.get("nextPageToken") else {
            break;
        };
        token = next.as_str().unwrap().to_owned();
    }
    assert_eq!(names, ["sessions/a", "sessions/b", "sessions/c"]);
    let actors = http_get(&server, "/api/v1/actors").await.json();
    let request = v1::ListActorsRequest::default();
    let over_grpc = server.actors().await.list_actors(request).await.unwrap();
    assert_eq!(actors, json!(over_grpc.into_inner()));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_actor_is_read_and_erased_over_http() {
    let server = TestServer::with_session("stage").await;
    let path = "/api/v1/actors/reference";
    let request = v1::GetActorRequest {
        name: "actors/reference".into(),
    };
    let over_grpc = server.actors().await.get_actor(request).await.unwrap();
    let actor = over_grpc.into_inner().actor.unwrap();
    assert_eq!(http_get(&server, path).await.json(), json!(actor));

    let in_use = act(&server, Method::DELETE, path).await;
    assert_eq!(in_use.status, 409);
    assert_eq!(in_use.json()["type"], "urn:frontalis:problem:ACTOR_IN_USE");
    server.end_session("sessions/stage").await;
    let erased = act(&server, Method::DELETE, &format!("{path}?withTakes=true")).await;
    assert_eq!(erased.status, 200, "{}", erased.text());
    assert_eq!(erased.json()["receipt"]["actor"], "actors/reference");
    assert_eq!(http_get(&server, path).await.status, 404);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_server_says_what_it_is_and_who_asks() {
    let server = TestServer::start().await;
    let told = http_get(&server, "/api/v1/server").await;
    assert_eq!(told.status, 200);
    assert_eq!(told.json()["version"], env!("CARGO_PKG_VERSION"));
    let head = act(&server, Method::HEAD, "/api/v1/server").await;
    assert_eq!((head.status.as_u16(), head.body.len()), (200, 0));
    server.stop().await;
}
