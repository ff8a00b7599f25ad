//! Every operation of `/openapi.json`, and the plain pages.

use std::time::Duration;

use futures::{SinkExt as _, StreamExt as _};
use http_body_util::{BodyExt as _, Full};
use hyper::{
    Method, Request, Response,
    body::{Bytes, Incoming},
    client::conn::http1,
};
use hyper_util::rt::TokioIo;
use serde_json::Value;
use tokio_tungstenite::tungstenite::{self, client::IntoClientRequest as _};

use super::{
    Outcome, Stage,
    callers::Caller,
    messages::{PAGE_SIZE, Variant, publish_start, subscribe_start, variants},
    rules,
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
    variant: Variant,
}

/// All of them.
pub(super) async fn operations(stage: &Stage) -> Vec<Operation> {
    let document = document(stage).await;
    let mut operations: Vec<Operation> = Vec::new();
    for (path, item) in document["paths"].as_object().unwrap() {
        for (method, operation) in item.as_object().unwrap() {
            if method == "parameters" {
                continue;
            }
            let method = method.to_uppercase().parse::<Method>().unwrap();
            let behind = operation["x-grpc-method"].as_str().unwrap_or_default();
            // One path that is two methods is asked as each.
            for one in behind.split(", ") {
                for variant in variants(one) {
                    operations.push(Operation {
                        method: method.clone(),
                        path: path.clone(),
                        behind: (!one.is_empty()).then(|| one.to_owned()),
                        variant: *variant,
                    });
                }
            }
        }
    }
    for path in rules::plain_paths() {
        if !operations.iter().any(|it| it.path == path) {
            operations.push(Operation {
                method: Method::GET,
                path: path.to_owned(),
                behind: None,
                variant: Variant::Plain,
            });
        }
    }
    operations
}

async fn document(stage: &Stage) -> Value {
    let request = Request::get("/openapi.json").body(Full::default()).unwrap();
    let answer = send(stage, &stage.callers[0], request).await;
    let body = answer.into_body().collect().await.unwrap();
    serde_json::from_slice(&body.to_bytes()).unwrap()
}

/// Sends a request on a connection of its own, which lives as long as the answer.
async fn send(
    stage: &Stage,
    caller: &Caller,
    mut request: Request<Full<Bytes>>,
) -> Response<Incoming> {
    let address = stage.server.address();
    let stream = caller.connect(address).await;
    let (mut sender, connection) = http1::handshake(TokioIo::new(stream)).await.unwrap();
    tokio::spawn(connection);
    let headers = request.headers_mut();
    headers.insert("host", address.to_string().parse().unwrap());
    if let Some(value) = caller.authorization() {
        headers.insert("authorization", value.parse().unwrap());
    }
    sender.send_request(request).await.unwrap()
}

impl Operation {
    pub(super) fn name(&self) -> String {
        let behind = self.behind.as_deref().unwrap_or("plain");
        format!("{} {} ({behind})", self.method, self.path)
    }

    /// The name of its rule: that of the method behind it, or its path.
    pub(super) fn rule(&self) -> &str {
        self.behind.as_ref().unwrap_or(&self.path)
    }

    pub(super) fn variant(&self) -> Variant {
        self.variant
    }

    /// Asks for what has this id.
    pub(super) async fn call(&self, stage: &Stage, caller: &Caller, id: &str) -> Outcome {
        let path = self.path.replace("{id}", id);
        let asking = async {
            if path.ends_with("/stream") {
                self.converse(stage, caller, &path).await
            } else {
                self.ask(stage, caller, &path, id).await
            }
        };
        let answered = tokio::time::timeout(PATIENCE, asking).await;
        answered.unwrap_or_else(|_| panic!("{} gave no answer", self.name()))
    }

    async fn ask(&self, stage: &Stage, caller: &Caller, path: &str, id: &str) -> Outcome {
        let is_list = self.rule().contains("/List");
        let uri = if self.rule().ends_with("/ListTakes") {
            format!("{path}?pageSize={PAGE_SIZE}&session=sessions/{id}")
        } else if is_list {
            format!("{path}?pageSize={PAGE_SIZE}")
        } else {
            path.to_owned()
        };
        let mut request = Request::builder().method(self.method.clone()).uri(uri);
        let (kind, body) = self.body(stage, id);
        if let Some(kind) = kind {
            request = request.header("content-type", kind);
        }
        let request = request.body(Full::new(Bytes::from(body))).unwrap();
        let answer = send(stage, caller, request).await;
        let status = answer.status().as_u16();
        let kind = answer.headers().get("content-type");
        let is_problem = kind.is_some_and(|it| it == "application/problem+json");
        if is_problem || is_list {
            let whole = answer.into_body().collect().await.unwrap().to_bytes();
            return outcome(status, &whole);
        }
        // A stream that stays open has said what it had to.
        Outcome {
            code: status.to_string(),
            ..Outcome::default()
        }
    }

    fn body(&self, stage: &Stage, id: &str) -> (Option<&'static str>, Vec<u8>) {
        let name = self.behind.as_deref().unwrap_or_default();
        let json = Some("application/json");
        match name.rsplit('/').next().unwrap() {
            "CreateSession" => {
                let body = format!(
                    r#"{{"sessionId":"{id}","actor":"actors/own-1","kind":"CAPTURE_KIND_MARKERS"}}"#
                );
                (json, body.into_bytes())
            }
            "UpdateSession" | "RecenterSession" | "EndSession" | "StopTake" | "ResolveTake" => {
                (json, b"{}".to_vec())
            }
            "StartTake" => (
                json,
                format!(r#"{{"session":"sessions/{id}"}}"#).into_bytes(),
            ),
            "UpdateTake" => (json, br#"{"take":{"circled":true}}"#.to_vec()),
            "PublishMarkers" => {
                let start = publish_start(String::new(), self.variant);
                let start = serde_json::to_string(&start).unwrap();
                let line = format!("{{\"start\":{start}}}\n");
                (Some("application/x-ndjson"), line.into_bytes())
            }
            "ImportActor" => (Some("application/zip"), stage.package.clone()),
            _ => (None, Vec::new()),
        }
    }

    /// The WebSocket: a refusal before the upgrade, or the first message after it.
    async fn converse(&self, stage: &Stage, caller: &Caller, path: &str) -> Outcome {
        let address = stage.server.address();
        let mut request = format!("wss://{address}{path}")
            .into_client_request()
            .unwrap();
        let (subprotocol, start) = if self.rule().ends_with("/PublishMarkers") {
            let start = publish_start(String::new(), self.variant);
            ("frontalis.v1.publish+json", serde_json::to_value(&start))
        } else {
            let start = subscribe_start(String::new());
            ("frontalis.v1.subscribe+json", serde_json::to_value(&start))
        };
        let offered = caller.subprotocols(subprotocol);
        let headers = request.headers_mut();
        headers.insert("sec-websocket-protocol", offered.parse().unwrap());
        let stream = caller.connect(address).await;
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
        let Some(problem) = message.get("error") else {
            return outcome(200, first.as_bytes());
        };
        let status = problem["status"].as_u64().unwrap();
        let status = u16::try_from(status).unwrap();
        outcome(status, problem.to_string().as_bytes())
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
