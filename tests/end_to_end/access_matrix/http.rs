//! Every operation of `/openapi.json`, and the plain pages.

use std::time::Duration;

use frontalis_access::Token;
use futures::{SinkExt as _, StreamExt as _};
use harness::{TestServer, http_get};
use http_body_util::{BodyExt as _, Full};
use hyper::{Method, Request, body::Bytes, client::conn::http1};
use hyper_util::rt::TokioIo;
use serde_json::Value;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::{self, client::IntoClientRequest as _};

use super::{
    Object, Outcome,
    grpc::{Variant, publish_start, subscribe_start},
    rules::{self, Rule},
};

/// No answer takes longer.
const PATIENCE: Duration = Duration::from_secs(20);

/// One operation.
#[derive(Clone, Debug)]
pub(super) struct Operation {
    method: Method,
    path: String,
    /// The gRPC method behind it; none for a plain page.
    behind: Option<String>,
}

/// All of them; those that end or delete come last.
pub(super) async fn operations(server: &TestServer) -> Vec<Operation> {
    let document = http_get(server, "/openapi.json").await.json();
    let mut operations: Vec<Operation> = Vec::new();
    for (path, item) in document["paths"].as_object().unwrap() {
        for (method, operation) in item.as_object().unwrap() {
            let Ok(method) = method.to_uppercase().parse::<Method>() else {
                continue;
            };
            if method.as_str() == "PARAMETERS" {
                continue;
            }
            let behind = operation["x-grpc-method"].as_str().unwrap_or_default();
            // One path that is two methods is asked as each.
            for one in behind.split(", ") {
                operations.push(Operation {
                    method: method.clone(),
                    path: path.clone(),
                    behind: (!one.is_empty()).then(|| one.to_owned()),
                });
            }
        }
    }
    for path in rules::plain_paths() {
        if !operations.iter().any(|it| it.path == path) {
            operations.push(Operation {
                method: Method::GET,
                path: path.to_owned(),
                behind: None,
            });
        }
    }
    operations.sort_by_key(|it| it.path.ends_with("/end"));
    operations
}

impl Operation {
    pub(super) fn name(&self) -> String {
        let behind = self.behind.as_deref().unwrap_or("plain");
        format!("{} {} ({behind})", self.method, self.path)
    }

    pub(super) fn rule(&self) -> Rule {
        match &self.behind {
            Some(method) => rules::of(method),
            None => rules::plain(&self.path),
        }
    }

    pub(super) async fn call(
        &self,
        server: &TestServer,
        token: Option<&Token>,
        object: Object,
    ) -> Outcome {
        let path = self.path.replace("{id}", object.id());
        let asking = async {
            if path.ends_with("/stream") {
                self.converse(server, token, &path).await
            } else {
                self.ask(server, token, &path, object).await
            }
        };
        let answered = tokio::time::timeout(PATIENCE, asking).await;
        answered.unwrap_or_else(|_| panic!("{} gave no answer", self.name()))
    }

    async fn ask(
        &self,
        server: &TestServer,
        token: Option<&Token>,
        path: &str,
        object: Object,
    ) -> Outcome {
        let stream = TcpStream::connect(server.address()).await.unwrap();
        let (mut sender, connection) = http1::handshake(TokioIo::new(stream)).await.unwrap();
        let connection = tokio::spawn(async move { drop(connection.await) });
        let (kind, body) = self.body(object);
        let mut request = Request::builder()
            .method(self.method.clone())
            .uri(path)
            .header("host", server.address().to_string());
        if let Some(kind) = kind {
            request = request.header("content-type", kind);
        }
        if let Some(token) = token {
            request = request.header("authorization", format!("Bearer {}", token.reveal()));
        }
        let request = request.body(Full::new(Bytes::from(body))).unwrap();
        let answer = sender.send_request(request).await.unwrap();
        let status = answer.status().as_u16();
        let is_problem = answer
            .headers()
            .get("content-type")
            .is_some_and(|it| it == "application/problem+json");
        let is_list =
            matches!(path, "/api/v1/sessions" | "/api/v1/actors") && self.method == Method::GET;
        let outcome = if is_problem || is_list {
            let whole = answer.into_body().collect().await.unwrap().to_bytes();
            outcome(status, &whole)
        } else {
            // A stream that stays open has said what it had to.
            Outcome {
                code: status.to_string(),
                reason: String::new(),
                whole: Vec::new(),
                names: Vec::new(),
            }
        };
        connection.abort();
        outcome
    }

    fn body(&self, object: Object) -> (Option<&'static str>, String) {
        let id = object.new_id();
        let name = self.behind.as_deref().unwrap_or_default();
        let json = Some("application/json");
        match name.rsplit('/').next().unwrap() {
            "CreateSession" => {
                let body = format!(
                    r#"{{"sessionId":"{id}","actor":"actors/own-1","kind":"CAPTURE_KIND_MARKERS"}}"#
                );
                (json, body)
            }
            "UpdateSession" | "RecenterSession" | "EndSession" => (json, "{}".to_owned()),
            "PublishMarkers" => {
                let start = publish_start(String::new(), Variant::Plain);
                let line = format!(r#"{{"start":{}}}"#, serde_json::to_string(&start).unwrap());
                (Some("application/x-ndjson"), line + "\n")
            }
            "ImportActor" => (Some("application/zip"), "PK".to_owned()),
            _ => (None, String::new()),
        }
    }

    /// The WebSocket: a refusal before the upgrade, or the first message after it.
    async fn converse(&self, server: &TestServer, token: Option<&Token>, path: &str) -> Outcome {
        let publishes = self
            .behind
            .as_deref()
            .is_some_and(|it| it.ends_with("/PublishMarkers"));
        let url = format!("ws://{}{path}", server.address());
        let mut request = url.into_client_request().unwrap();
        let headers = request.headers_mut();
        let (subprotocol, start) = if publishes {
            let start = publish_start(String::new(), Variant::Plain);
            ("frontalis.v1.publish+json", serde_json::to_value(&start))
        } else {
            let start = subscribe_start(String::new());
            ("frontalis.v1.subscribe+json", serde_json::to_value(&start))
        };
        let mut offered = subprotocol.to_owned();
        if let Some(token) = token {
            // As a browser does it.
            offered = format!("{offered}, frontalis.bearer.{}", token.reveal());
        }
        headers.insert("sec-websocket-protocol", offered.parse().unwrap());
        let stream = TcpStream::connect(server.address()).await.unwrap();
        let mut socket = match tokio_tungstenite::client_async(request, stream).await {
            Ok((socket, answer)) => {
                let spoken = answer.headers()["sec-websocket-protocol"].clone();
                assert_eq!(spoken, subprotocol, "a token is never echoed");
                socket
            }
            Err(tungstenite::Error::Http(answer)) => {
                let body = answer.body().clone().unwrap_or_default();
                return outcome(answer.status().as_u16(), &body);
            }
            Err(error) => panic!("{}: {error}", self.name()),
        };
        let start = serde_json::json!({ "start": start.unwrap() }).to_string();
        socket.send(start.into()).await.unwrap();
        let first = socket.next().await.unwrap().unwrap().into_text().unwrap();
        let message: Value = serde_json::from_str(&first).unwrap();
        match message.get("error") {
            Some(problem) => {
                let status = problem["status"].as_u64().unwrap();
                outcome(
                    u16::try_from(status).unwrap(),
                    problem.to_string().as_bytes(),
                )
            }
            None => outcome(200, first.as_bytes()),
        }
    }
}

fn outcome(status: u16, body: &[u8]) -> Outcome {
    let json: Value = serde_json::from_slice(body).unwrap_or_default();
    let reason = json["type"].as_str().unwrap_or_default();
    let listed = json["sessions"].as_array().or(json["actors"].as_array());
    let names = listed.into_iter().flatten();
    Outcome {
        code: status.to_string(),
        reason: reason
            .trim_start_matches("urn:frontalis:problem:")
            .to_owned(),
        whole: without_instance(&json),
        names: names
            .map(|it| it["name"].as_str().unwrap_or_default().to_owned())
            .collect(),
    }
}

/// The instance is the path that was asked for, which differs by its id.
fn without_instance(json: &Value) -> Vec<u8> {
    let mut json = json.clone();
    if let Some(problem) = json.as_object_mut() {
        problem.remove("instance");
    }
    json.to_string().into_bytes()
}
