//! Tokens in use: limits of failures and creations, a token file that changes, leases of principals.

mod role_first;

use frontalis_access::{Role, Token};
use frontalis_proto::v1::{
    CaptureKind, CreateSessionRequest, GetServerRequest, Ingest, LengthUnit, PublishMarkersRequest,
    PublishResponse, PublishStart, Session, capture_service_client::CaptureServiceClient,
    server_service_client::ServerServiceClient, session_service_client::SessionServiceClient,
};
use futures::{StreamExt as _, stream};
use harness::{TestServer, assert_eventually, assert_refused, http_send};
use hyper::Method;
use tonic::{Code, Status, Streaming};

/// A server with the reference face and a token of each of these roles and scopes.
async fn guarded<const N: usize>(roles: [(Role, &str); N]) -> (TestServer, [Token; N]) {
    let mut server = TestServer::start_guarded(|_| {}).await;
    let tokens = roles.map(|(role, scope)| server.keys().grant(role, scope));
    server.keys().save();
    server.reload();
    for token in &tokens {
        assert_eventually!(server.metrics_text().contains("token_file_reloads_total"));
        who(&server, token).await.unwrap();
    }
    server.import_reference().await;
    (server, tokens)
}

async fn who(server: &TestServer, token: &Token) -> Result<String, Status> {
    let mut client = ServerServiceClient::new(server.channel_as(token).await);
    let answer = client.get_server(GetServerRequest {}).await?;
    let server = answer.into_inner().server.unwrap();
    assert!(server.tokens);
    Ok(server.caller.unwrap().name)
}

async fn create(server: &TestServer, token: &Token, id: &str) -> Result<Session, Status> {
    let mut client = SessionServiceClient::new(server.channel_as(token).await);
    let request = CreateSessionRequest {
        session_id: id.to_owned(),
        actor: "actors/reference".to_owned(),
        kind: CaptureKind::Markers.into(),
        ..CreateSessionRequest::default()
    };
    let answer = client.create_session(request).await?;
    Ok(answer.into_inner().session.unwrap())
}

async fn publish(
    server: &TestServer,
    token: &Token,
    takeover: bool,
) -> Result<Streaming<PublishResponse>, Status> {
    let start = PublishStart {
        session: "sessions/s".to_owned(),
        publisher: "camera".to_owned(),
        takeover,
        unit: LengthUnit::Millimeter.into(),
        rate_hz: 60.0,
        ingest: Ingest::Live.into(),
        ..PublishStart::default()
    };
    let request = PublishMarkersRequest {
        start: Some(start),
        ..PublishMarkersRequest::default()
    };
    let requests = stream::once(async { request }).chain(stream::pending());
    let mut client = CaptureServiceClient::new(server.channel_as(token).await);
    let mut answers = client.publish_markers(requests).await?.into_inner();
    answers.message().await?;
    Ok(answers)
}

#[tokio::test]
async fn after_ten_failures_in_a_minute_an_address_must_wait_and_a_good_token_still_passes() {
    let (server, [viewer]) = guarded([(Role::Viewer, "*")]).await;
    let bad = Token::generate().unwrap();
    for _ in 0..10 {
        let refused = who(&server, &bad).await.unwrap_err();
        assert_refused(&refused, Code::Unauthenticated, "UNAUTHENTICATED");
    }
    let refused = who(&server, &bad).await.unwrap_err();
    assert_refused(&refused, Code::ResourceExhausted, "RATE_LIMIT");
    let answer = http_send(&server, &Method::GET, "/api/v1/server", &[], b"").await;
    assert_eq!(answer.status, 429);
    assert!(answer.headers.contains_key("retry-after"));
    assert_eq!(who(&server, &viewer).await.unwrap(), "viewer");
    server.stop().await;
}

#[tokio::test]
async fn a_publishers_token_creates_thirty_sessions_a_minute_and_an_operators_more() {
    let (server, [publisher, operator]) =
        guarded([(Role::Publisher, "p-*"), (Role::Operator, "*")]).await;
    for n in 0..30 {
        create(&server, &publisher, &format!("p-{n}"))
            .await
            .unwrap();
    }
    let refused = create(&server, &publisher, "p-30").await.unwrap_err();
    assert_refused(&refused, Code::ResourceExhausted, "RATE_LIMIT");
    create(&server, &operator, "p-30").await.unwrap();
    server.stop().await;
}

#[tokio::test]
async fn a_session_without_an_id_is_made_inside_of_the_callers_prefix() {
    let (server, [one, two]) =
        guarded([(Role::Publisher, "stage-a-*"), (Role::Publisher, "a-*,b-*")]).await;
    let made = create(&server, &one, "").await.unwrap();
    assert!(made.name.starts_with("sessions/stage-a-"), "{}", made.name);
    let refused = create(&server, &two, "").await.unwrap_err();
    assert_refused(&refused, Code::PermissionDenied, "SCOPE");
    server.stop().await;
}

#[tokio::test]
async fn a_token_file_that_is_wrong_changes_nothing_and_is_counted() {
    let (mut server, [viewer]) = guarded([(Role::Viewer, "*")]).await;
    server.keys().write_text("[[token]]\nid = 3\n");
    server.reload();
    let refused = "frontalis_token_file_reloads_total{taken=\"no\"} 1";
    assert_eventually!(server.metrics_text().contains(refused));
    who(&server, &viewer).await.unwrap();
    let id = server.keys().file().tokens().last().unwrap().id.clone();
    server.keys().file().revoke(&id).unwrap();
    server.keys().save();
    server.reload();
    assert_eventually!(who(&server, &viewer).await.is_err());
    server.stop().await;
}

#[tokio::test]
async fn the_same_publisher_of_another_principal_is_another_publisher() {
    let roles = [
        (Role::Publisher, "*"),
        (Role::Publisher, "*"),
        (Role::Operator, "*"),
    ];
    let (server, [first, second, operator]) = guarded(roles).await;
    create(&server, &operator, "s").await.unwrap();
    let mut held = publish(&server, &first, false).await.unwrap();
    let refused = publish(&server, &second, false).await.err().unwrap();
    assert_refused(&refused, Code::FailedPrecondition, "SESSION_OWNED");
    let refused = publish(&server, &second, true).await.err().unwrap();
    assert_refused(&refused, Code::PermissionDenied, "TAKEOVER");
    let refused = publish(&server, &operator, false).await.err().unwrap();
    assert_refused(&refused, Code::PermissionDenied, "ROLE");
    let _taken = publish(&server, &operator, true).await.unwrap();
    let fenced = loop {
        if let Err(status) = held.message().await {
            break status;
        }
    };
    assert_refused(&fenced, Code::Aborted, "PUBLISHER_FENCED");
    server.stop().await;
}
