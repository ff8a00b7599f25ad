//! Every method of the descriptors of every service that the server has, called with bytes: the messages, then the end
//! of the client's side.

use std::{collections::BTreeSet, time::Duration};

use frontalis_proto::v1;
use harness::Problem;
use prost::Message as _;
use prost_types::{FileDescriptorProto, FileDescriptorSet};
use tonic::{Code, Request, Status, client::Grpc, transport::Channel};
use tonic_reflection::pb::v1::{
    ServerReflectionResponse, server_reflection_response::MessageResponse,
};

use super::{
    Outcome, Stage,
    bytes::Bytes,
    callers::Caller,
    messages::{Variant, messages},
};

/// No answer takes longer.
const PATIENCE: Duration = Duration::from_secs(20);

const DESCRIPTORS: [&[u8]; 4] = [
    frontalis_proto::FILE_DESCRIPTOR_SET,
    tonic_health::pb::FILE_DESCRIPTOR_SET,
    tonic_reflection::pb::v1::FILE_DESCRIPTOR_SET,
    tonic_reflection::pb::v1alpha::FILE_DESCRIPTOR_SET,
];

/// Every method, `package.Service/Method`.
pub(super) fn methods() -> Vec<String> {
    let sets = DESCRIPTORS.map(|it| FileDescriptorSet::decode(it).unwrap());
    let files = sets.iter().flat_map(|it| &it.file);
    files.flat_map(methods_of).collect()
}

fn methods_of(file: &FileDescriptorProto) -> Vec<String> {
    let mut methods = Vec::new();
    for service in &file.service {
        for method in &service.method {
            let (service, method) = (service.name(), method.name());
            methods.push(format!("{}.{service}/{method}", file.package()));
        }
    }
    methods
}

/// Whether the server knows a caller by now.
pub(super) async fn is_known(stage: &Stage, caller: &Caller) -> bool {
    let channel = caller.channel(&stage.server).await;
    let method = "frontalis.v1.ServerService/GetServer";
    let call = Call {
        method,
        variant: Variant::Plain,
        id: "",
        package: b"",
    };
    call.outcome(channel, caller).await.is_success()
}

/// The services that the server says it has.
pub(super) async fn services(stage: &Stage, caller: &Caller) -> BTreeSet<String> {
    let mut services = BTreeSet::new();
    for version in ["v1", "v1alpha"] {
        let method = format!("grpc.reflection.{version}.ServerReflection/ServerReflectionInfo");
        let call = Call {
            method: &method,
            variant: Variant::Plain,
            id: "",
            package: b"",
        };
        let answer = call.ask(caller.channel(&stage.server).await, caller).await;
        let answer = ServerReflectionResponse::decode(answer.unwrap().as_slice()).unwrap();
        let Some(MessageResponse::ListServicesResponse(list)) = answer.message_response else {
            panic!("{method} does not list the services: {answer:?}");
        };
        services.extend(list.service.into_iter().map(|it| it.name));
    }
    services
}

/// One call.
#[derive(Clone, Copy)]
pub(super) struct Call<'a> {
    pub(super) method: &'a str,
    pub(super) variant: Variant,
    /// Of what it names.
    pub(super) id: &'a str,
    pub(super) package: &'a [u8],
}

impl Call<'_> {
    /// Calls, and waits for the first answer.
    pub(super) async fn outcome(self, channel: Channel, caller: &Caller) -> Outcome {
        match self.ask(channel, caller).await {
            Ok(answer) => Outcome {
                code: "OK".to_owned(),
                names: names(self.method, &answer),
                ..Outcome::default()
            },
            Err(status) => refused(&status),
        }
    }

    async fn ask(self, channel: Channel, caller: &Caller) -> Result<Vec<u8>, Status> {
        let messages = messages(self.method, self.variant, self.id, self.package);
        let mut request = Request::new(tokio_stream::iter(messages));
        if let Some(value) = caller.authorization() {
            let value = value.parse().unwrap();
            request.metadata_mut().insert("authorization", value);
        }
        let path = format!("/{}", self.method).parse().unwrap();
        let asking = async {
            let mut grpc = Grpc::new(channel);
            grpc.ready().await.unwrap();
            let mut answers = grpc.streaming(request, path, Bytes).await?.into_inner();
            Ok(answers.message().await?.unwrap_or_default())
        };
        let answered = tokio::time::timeout(PATIENCE, asking).await;
        answered.unwrap_or_else(|_| panic!("{} gave no answer", self.method))
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
