//! Every method of the descriptors, called with bytes: one message, then the end of the client's side.

use std::time::Duration;

use frontalis_access::Token;
use frontalis_proto::{FILE_DESCRIPTOR_SET, v1};
use harness::{Problem, TestServer};
use prost::Message;
use tonic::{
    Code, Request, Status,
    client::Grpc,
    codec::{BufferSettings, Codec, DecodeBuf, Decoder, EncodeBuf, Encoder},
};

use super::{
    Object, Outcome,
    rules::{May, Rule},
};

/// No answer takes longer.
const PATIENCE: Duration = Duration::from_secs(20);

/// How a method is called, where there is more than one way that matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variant {
    Plain,
    /// With `takeover`, which an operator may.
    Takeover,
}

impl Variant {
    pub(super) fn suffix(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Takeover => " (takeover)",
        }
    }

    pub(super) fn rule(self, rule: Rule) -> Rule {
        let mut rule = rule;
        if self == Self::Takeover {
            rule.may[0] = May::Everywhere;
        }
        rule
    }
}

pub(super) fn variants(method: &str) -> Vec<Variant> {
    match method {
        "frontalis.v1.CaptureService/PublishMarkers" => vec![Variant::Plain, Variant::Takeover],
        _ => vec![Variant::Plain],
    }
}

/// Every method, `frontalis.v1.Service/Method`; those that end or change what others ask for come last.
pub(super) fn methods() -> Vec<String> {
    let set = prost_types::FileDescriptorSet::decode(FILE_DESCRIPTOR_SET).unwrap();
    let mut methods = Vec::new();
    for file in &set.file {
        for service in &file.service {
            for method in &service.method {
                let (service, method) = (service.name(), method.name());
                methods.push(format!("{}.{service}/{method}", file.package()));
            }
        }
    }
    methods.sort_by_key(|it| it.ends_with("/EndSession"));
    methods
}

/// Whether the server knows a token by now.
pub(super) async fn is_known(server: &TestServer, token: &Token) -> bool {
    let method = "frontalis.v1.ServerService/GetServer";
    let outcome = call(server, Some(token), method, Variant::Plain, Object::Own).await;
    outcome.reason.is_empty()
}

/// Calls a method on an object and waits for its first answer.
pub(super) async fn call(
    server: &TestServer,
    token: Option<&Token>,
    method: &str,
    variant: Variant,
    object: Object,
) -> Outcome {
    let mut grpc = Grpc::new(server.bare_channel().await);
    grpc.ready().await.unwrap();
    let message = message(method, variant, object);
    let mut request = Request::new(tokio_stream::once(message));
    if let Some(token) = token {
        let value = format!("Bearer {}", token.reveal()).parse().unwrap();
        request.metadata_mut().insert("authorization", value);
    }
    let path = format!("/{method}").parse().unwrap();
    let asking = async {
        let mut answers = grpc.streaming(request, path, Bytes).await?.into_inner();
        answers.message().await
    };
    let answered = tokio::time::timeout(PATIENCE, asking).await;
    match answered.unwrap_or_else(|_| panic!("{method} gave no answer")) {
        Ok(answer) => Outcome {
            code: "OK".to_owned(),
            reason: String::new(),
            names: names(method, &answer.unwrap_or_default()),
            whole: Vec::new(),
        },
        Err(status) => refused(&status),
    }
}

fn refused(status: &Status) -> Outcome {
    let mut whole = status.message().as_bytes().to_vec();
    whole.extend_from_slice(status.details());
    Outcome {
        code: code(status.code()).to_owned(),
        reason: Problem::of(status).reason,
        whole,
        names: Vec::new(),
    }
}

fn code(code: Code) -> &'static str {
    match code {
        Code::Unauthenticated => "UNAUTHENTICATED",
        Code::PermissionDenied => "PERMISSION_DENIED",
        Code::NotFound => "NOT_FOUND",
        _ => "OTHER",
    }
}

fn names(method: &str, answer: &[u8]) -> Vec<String> {
    if method.ends_with("/ListSessions") {
        let list = v1::ListSessionsResponse::decode(answer).unwrap();
        return list.sessions.into_iter().map(|it| it.name).collect();
    }
    if method.ends_with("/ListActors") {
        let list = v1::ListActorsResponse::decode(answer).unwrap();
        return list.actors.into_iter().map(|it| it.name).collect();
    }
    Vec::new()
}

/// The one message of a call, as good as it takes for access to be what decides.
fn message(method: &str, variant: Variant, object: Object) -> Vec<u8> {
    let id = object.id();
    let (session, actor) = (format!("sessions/{id}"), format!("actors/{id}"));
    let take = format!("takes/{id}");
    let name = method.rsplit('/').next().unwrap();
    match name {
        "PublishMarkers" => v1::PublishMarkersRequest {
            start: Some(publish_start(session, variant)),
            ..v1::PublishMarkersRequest::default()
        }
        .encode_to_vec(),
        "Subscribe" => v1::SubscribeRequest {
            start: Some(subscribe_start(session)),
            credits: 0,
        }
        .encode_to_vec(),
        "Follow" => subscribe_start(session).encode_to_vec(),
        "ReadCurves" => v1::ReadCurvesRequest {
            session,
            ..v1::ReadCurvesRequest::default()
        }
        .encode_to_vec(),
        "CreateSession" => v1::CreateSessionRequest {
            session_id: object.new_id().to_owned(),
            actor: "actors/own-1".to_owned(),
            kind: v1::CaptureKind::Markers.into(),
            ..v1::CreateSessionRequest::default()
        }
        .encode_to_vec(),
        "StartTake" => v1::StartTakeRequest {
            session,
            ..v1::StartTakeRequest::default()
        }
        .encode_to_vec(),
        "ListTakes" => v1::ListTakesRequest {
            session,
            ..v1::ListTakesRequest::default()
        }
        .encode_to_vec(),
        "GetSession" | "RecenterSession" | "EndSession" | "UpdateSession" => {
            // The name is field 1 of each.
            v1::GetSessionRequest { name: session }.encode_to_vec()
        }
        "GetActor" | "ExportActor" | "DeleteActor" => {
            v1::GetActorRequest { name: actor }.encode_to_vec()
        }
        "StopTake" | "GetTake" | "DeleteTake" | "ExportTake" | "ResolveTake" => {
            v1::GetTakeRequest { name: take }.encode_to_vec()
        }
        "ListSessions" | "ListActors" | "GetServer" | "ImportActor" | "ImproveBasis"
        | "TrainRegions" | "PublishImages" | "UpdateTake" => Vec::new(),
        _ => panic!("{method} has no message"),
    }
}

pub(super) fn publish_start(session: String, variant: Variant) -> v1::PublishStart {
    v1::PublishStart {
        session,
        publisher: "matrix".to_owned(),
        takeover: variant == Variant::Takeover,
        unit: v1::LengthUnit::Millimeter.into(),
        rate_hz: 60.0,
        ingest: v1::Ingest::Live.into(),
        ..v1::PublishStart::default()
    }
}

pub(super) fn subscribe_start(session: String) -> v1::SubscribeStart {
    v1::SubscribeStart {
        session,
        delivery: v1::Delivery::EveryFrame.into(),
        ..v1::SubscribeStart::default()
    }
}

/// Messages as the bytes that they are.
#[derive(Clone, Copy, Debug, Default)]
struct Bytes;

impl Codec for Bytes {
    type Encode = Vec<u8>;
    type Decode = Vec<u8>;
    type Encoder = Self;
    type Decoder = Self;

    fn encoder(&mut self) -> Self {
        Self
    }

    fn decoder(&mut self) -> Self {
        Self
    }
}

impl Encoder for Bytes {
    type Item = Vec<u8>;
    type Error = Status;

    fn encode(&mut self, item: Vec<u8>, buffer: &mut EncodeBuf<'_>) -> Result<(), Status> {
        bytes::BufMut::put_slice(buffer, &item);
        Ok(())
    }

    fn buffer_settings(&self) -> BufferSettings {
        BufferSettings::default()
    }
}

impl Decoder for Bytes {
    type Item = Vec<u8>;
    type Error = Status;

    fn decode(&mut self, buffer: &mut DecodeBuf<'_>) -> Result<Option<Vec<u8>>, Status> {
        let n_bytes = bytes::Buf::remaining(buffer);
        let mut item = vec![0; n_bytes];
        bytes::Buf::copy_to_slice(buffer, &mut item);
        Ok(Some(item))
    }

    fn buffer_settings(&self) -> BufferSettings {
        BufferSettings::default()
    }
}
