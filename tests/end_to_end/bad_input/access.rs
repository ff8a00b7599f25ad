//! Rows I1 to I4: callers who cannot say who they are, who may not, who ask for what is not theirs, and whose proof ends.

mod certificates;
mod proofs;
mod stalled;
mod streams;
mod timing;

use std::time::Duration;

use frontalis_access::{NewToken, Role, Scope, Token, UnixTime};
use frontalis_proto::v1::{
    CreateSessionRequest, GetServerRequest, GetSessionRequest, ReadCurvesRequest,
    curve_service_client::CurveServiceClient, server_service_client::ServerServiceClient,
    session_service_client::SessionServiceClient,
};
use harness::{
    HttpAnswer, Keys, TestIssuer, TestServer, assert_eventually, assert_refused, http_send, now,
};
use hyper::Method;
use tonic::{Code, Request, Status};

use super::{Stage, beside_a_control_session_of};
use proofs::Proof;
use streams::Open;

/// A server whose failures are not limited: a row asks for many of them in a moment.
async fn guarded() -> TestServer {
    TestServer::start_guarded(|config| config.limits.auth_failures_per_minute = 60_000).await
}

fn request<T>(authorization: Option<&str>, message: T) -> Request<T> {
    let mut request = Request::new(message);
    if let Some(value) = authorization {
        let value = value.parse().unwrap();
        request.metadata_mut().insert("authorization", value);
    }
    request
}

async fn get_server(server: &TestServer, authorization: Option<&str>) -> Result<String, Status> {
    let mut client = ServerServiceClient::new(server.bare_channel().await);
    let request = request(authorization, GetServerRequest {});
    let answer = client.get_server(request).await?.into_inner();
    Ok(answer.server.unwrap().caller.unwrap().name)
}

async fn http_get_as(server: &TestServer, path: &str, authorization: Option<&str>) -> HttpAnswer {
    let header = authorization.map(|it| ("authorization", it));
    http_send(server, &Method::GET, path, header.as_slice(), b"").await
}

fn bearer(token: &Token) -> String {
    format!("Bearer {}", token.reveal())
}

/// What a client could tell refusals apart by.
fn refusal(status: &Status) -> (Code, String, Vec<u8>) {
    (
        status.code(),
        status.message().to_owned(),
        status.details().to_vec(),
    )
}

fn http_refusal(answer: &HttpAnswer) -> (u16, Vec<u8>, Vec<u8>) {
    let challenge = answer.headers.get("www-authenticate");
    (
        answer.status.as_u16(),
        challenge.map_or_else(Vec::new, |it| it.as_bytes().to_vec()),
        answer.body.to_vec(),
    )
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i1_whatever_proves_nothing_is_answered_alike_through_every_door() {
    let mut server = guarded().await;
    let issuer = TestIssuer::new();
    let revoked = server.keys().grant(Role::Operator, "*");
    let id = server.keys().file().tokens().last().unwrap().id.clone();
    server.keys().file().revoke(&id).unwrap();
    let text = server.keys().file().to_toml() + &issuer.entry(&[Role::Renderer]);
    server.keys().write_text(&text);
    server.reload();
    let good = proofs::good(&issuer);
    assert_eventually!(get_server(&server, Some(&good)).await.is_ok());

    let mut proofs = proofs::bad(&issuer);
    proofs.push(Proof::header("revoked", bearer(&revoked)));
    let operator = server.operator_token().to_owned();
    proofs.push(Proof {
        what: "a good token in the query",
        authorization: None,
        query: format!("?access_token={operator}&authorization=Bearer%20{operator}"),
    });
    beside_a_control_session_of("I1", server, async |stage| {
        let server = &stage.server;
        let expected = refusal(&get_server(server, None).await.unwrap_err());
        assert_eq!(expected.0, Code::Unauthenticated);
        let http_expected = http_refusal(&http_get_as(server, "/api/v1/server", None).await);
        assert_eq!(
            (http_expected.0, http_expected.1.as_slice()),
            (401, b"Bearer".as_slice())
        );
        for proof in &proofs {
            let authorization = proof.authorization.as_deref();
            let status = get_server(server, authorization).await.unwrap_err();
            assert_eq!(refusal(&status), expected, "{}", proof.what);
            let path = format!("/api/v1/server{}", proof.query);
            let answer = http_get_as(server, &path, authorization).await;
            assert_eq!(http_refusal(&answer), http_expected, "{}", proof.what);
        }
        // What is longer than all headers may be does not come as far as the check.
        let huge = format!("Bearer {}", "a".repeat(1 << 20));
        get_server(server, Some(&huge)).await.unwrap_err();
        println!("I1: {} kinds of proof, one answer", proofs.len() + 2);
        get_server(server, Some(&good)).await.unwrap();

        let right = format!("Bearer {operator}");
        let mut kinds = vec![
            ("a right token", Some(right.as_str())),
            ("a right signed token", Some(good.as_str())),
            ("no token", None),
        ];
        let bad = proofs.iter().filter(|it| it.authorization.is_some());
        kinds.extend(bad.map(|it| (it.what, it.authorization.as_deref())));
        timing::print_medians(server, &kinds).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i2_a_good_token_of_the_wrong_role_is_denied() {
    let mut server = guarded().await;
    let renderer = server.keys().grant(Role::Renderer, "*");
    server.keys().save();
    server.reload();
    let authorization = bearer(&renderer);
    assert_eventually!(get_server(&server, Some(&authorization)).await.is_ok());
    beside_a_control_session_of("I2", server, async |stage| {
        let server = &stage.server;
        let mut sessions = SessionServiceClient::new(server.channel_as(&renderer).await);
        let create = CreateSessionRequest {
            session_id: "mine".to_owned(),
            actor: "actors/reference".to_owned(),
            ..CreateSessionRequest::default()
        };
        let refused = sessions.create_session(create).await.unwrap_err();
        assert_refused(&refused, Code::PermissionDenied, "ROLE");
        let headers = [
            ("authorization", authorization.as_str()),
            ("content-type", "application/json"),
        ];
        let path = "/api/v1/sessions/subject/end";
        let answer = http_send(server, &Method::POST, path, &headers, b"{}").await;
        assert_eq!(answer.status, 403);
        assert_eq!(answer.json()["type"], "urn:frontalis:problem:ROLE");
        let publish = Open::publish(server, &renderer, super::SUBJECT).await;
        assert_refused(&publish.err().unwrap(), Code::PermissionDenied, "ROLE");
    })
    .await;
}

/// Status, headers and body.
type Whole = (u16, Vec<(String, Vec<u8>)>, Vec<u8>);

/// Everything of an answer but when it was made.
fn whole(answer: &HttpAnswer) -> Whole {
    let headers = answer.headers.iter();
    let headers = headers.filter(|it| it.0 != "date");
    (
        answer.status.as_u16(),
        headers
            .map(|it| (it.0.to_string(), it.1.as_bytes().to_vec()))
            .collect(),
        answer.body.to_vec(),
    )
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i3_a_foreign_session_is_answered_like_a_missing_one_to_the_byte() {
    let mut server = guarded().await;
    let renderer = server.keys().grant(Role::Renderer, "own-*");
    server.keys().save();
    server.reload();
    let authorization = bearer(&renderer);
    assert_eventually!(get_server(&server, Some(&authorization)).await.is_ok());
    beside_a_control_session_of("I3", server, async |stage| {
        let missing = ask_for(stage, &renderer, "foreign").await;
        stage
            .server
            .create_session("foreign", "actors/reference")
            .await
            .unwrap();
        let foreign = ask_for(stage, &renderer, "foreign").await;
        assert_eq!(foreign, missing);
        // One that is missing although the scope would hold it says the same, too.
        let own = ask_for(stage, &renderer, "own-none").await;
        assert_eq!(own.0, missing.0);
        assert_refused_as_missing(&own.0);
    })
    .await;
}

type Answers = (Vec<(Code, String, Vec<u8>)>, Vec<Whole>);

/// What every way to name a session answers, over gRPC and over HTTP.
async fn ask_for(stage: &Stage, token: &Token, id: &str) -> Answers {
    let server = &stage.server;
    let name = format!("sessions/{id}");
    let mut sessions = SessionServiceClient::new(server.channel_as(token).await);
    let mut curves = CurveServiceClient::new(server.channel_as(token).await);
    let get = GetSessionRequest { name: name.clone() };
    let read = ReadCurvesRequest {
        session: name.clone(),
        ..ReadCurvesRequest::default()
    };
    let statuses = [
        sessions.get_session(get).await.unwrap_err(),
        curves.read_curves(read).await.unwrap_err(),
        Open::subscribe(server, token, &name).await.err().unwrap(),
    ];
    let mut answers = Vec::new();
    for rest in ["", "/curves", "/events"] {
        let path = format!("/api/v1/sessions/{id}{rest}");
        let answer = http_get_as(server, &path, Some(&bearer(token))).await;
        assert_eq!(answer.status, 404, "{path}");
        answers.push(whole(&answer));
    }
    (statuses.iter().map(refusal).collect(), answers)
}

fn assert_refused_as_missing(refusals: &[(Code, String, Vec<u8>)]) {
    for (code, message, _) in refusals {
        assert_eq!(*code, Code::NotFound, "{message}");
    }
}

/// A publisher's and a renderer's token that are good until `expire_time`, and are known to the server by now.
async fn streaming(
    server: &TestServer,
    keys: &mut Keys,
    expire_time: Option<UnixTime>,
) -> [Token; 2] {
    let tokens = [Role::Publisher, Role::Renderer].map(|role| {
        let new = NewToken {
            expire_time,
            ..NewToken::new("streaming", role, Scope::all())
        };
        keys.file().create(new, now()).unwrap()
    });
    keys.save();
    server.reload();
    let authorization = bearer(&tokens[1]);
    assert_eventually!(get_server(server, Some(&authorization)).await.is_ok());
    tokens
}

/// Every stream ends, and is told why, within 30 s.
async fn assert_ended(open: Vec<Open>, what: &str, since: UnixTime) {
    for stream in open {
        let (kind, code, reason) = stream.end().await;
        let after_secs = now().secs() - since.secs();
        println!("I4: {kind} ended {after_secs} s after the token {what}");
        assert_eq!(
            (code.as_str(), reason.as_str()),
            ("UNAUTHENTICATED", "UNAUTHENTICATED"),
            "{kind}"
        );
        assert!((0..30).contains(&after_secs), "{kind}: {after_secs} s");
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i4_a_stream_ends_when_its_callers_token_is_revoked() {
    let mut server = guarded().await;
    let mut keys = server.keys().clone();
    beside_a_control_session_of("I4 revoked", server, async |stage| {
        let [publisher, renderer] = streaming(&stage.server, &mut keys, None).await;
        let open = Open::every_kind(&stage.server, &publisher, &renderer).await;
        let tokens = keys.file().tokens().iter();
        let streaming = tokens.filter(|it| it.name == "streaming");
        let ids: Vec<String> = streaming.map(|it| it.id.clone()).collect();
        for id in &ids {
            keys.file().revoke(id).unwrap();
        }
        let revoked_at = now();
        // Nobody tells the server: it looks by itself.
        keys.save();
        assert_ended(open, "was revoked", revoked_at).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i4_a_stream_ends_when_its_callers_token_expires() {
    let mut server = guarded().await;
    let mut keys = server.keys().clone();
    beside_a_control_session_of("I4 expired", server, async |stage| {
        let expire_time = now().after(Duration::from_secs(10));
        let tokens = streaming(&stage.server, &mut keys, Some(expire_time)).await;
        let [publisher, renderer] = tokens;
        let open = Open::every_kind(&stage.server, &publisher, &renderer).await;
        assert_ended(open, "expired", expire_time).await;
    })
    .await;
}
