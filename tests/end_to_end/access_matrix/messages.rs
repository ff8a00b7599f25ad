//! What is sent to each method: enough for it to succeed where it may be called.

use frontalis_proto::v1;
use prost::Message as _;

/// Enough for every session and actor that the matrix makes.
pub(super) const PAGE_SIZE: u32 = 500;

/// `list_services` of a `ServerReflectionRequest`: field 7, an empty text.
const LIST_SERVICES: [u8; 2] = [0x3a, 0];

/// How a method is called, where there is more than one way that matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variant {
    Plain,
    /// With `takeover`.
    Takeover,
}

/// The ways in which a method is called.
pub(super) fn variants(method: &str) -> &'static [Variant] {
    match method {
        "frontalis.v1.CaptureService/PublishMarkers" => &[Variant::Plain, Variant::Takeover],
        _ => &[Variant::Plain],
    }
}

/// The messages of a call that names the session, actor or take `id`.
pub(super) fn messages(method: &str, variant: Variant, id: &str, package: &[u8]) -> Vec<Vec<u8>> {
    if method.ends_with("/ImportActor") {
        return import(id, package);
    }
    vec![message(method, variant, id)]
}

fn import(id: &str, package: &[u8]) -> Vec<Vec<u8>> {
    let start = v1::ImportActorStart {
        actor_id: id.to_owned(),
        ..v1::ImportActorStart::default()
    };
    let first = v1::ImportActorRequest {
        start: Some(start),
        chunk: Vec::new(),
    };
    let second = v1::ImportActorRequest {
        start: None,
        chunk: package.to_vec(),
    };
    vec![first.encode_to_vec(), second.encode_to_vec()]
}

fn message(method: &str, variant: Variant, id: &str) -> Vec<u8> {
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
            session_id: id.to_owned(),
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
        // The size of a page is field 1 of both.
        "ListSessions" | "ListActors" => v1::ListActorsRequest {
            page_size: PAGE_SIZE,
            ..v1::ListActorsRequest::default()
        }
        .encode_to_vec(),
        // The name is field 1 of each.
        "GetSession" | "RecenterSession" | "EndSession" | "UpdateSession" => {
            v1::GetSessionRequest { name: session }.encode_to_vec()
        }
        "GetActor" | "ExportActor" | "DeleteActor" => {
            v1::GetActorRequest { name: actor }.encode_to_vec()
        }
        "StopTake" | "GetTake" | "DeleteTake" | "ExportTake" | "ResolveTake" => {
            v1::GetTakeRequest { name: take }.encode_to_vec()
        }
        "ServerReflectionInfo" => LIST_SERVICES.to_vec(),
        "UpdateTake" => v1::UpdateTakeRequest {
            take: Some(v1::Take {
                name: take,
                circled: true,
                ..v1::Take::default()
            }),
            ..v1::UpdateTakeRequest::default()
        }
        .encode_to_vec(),
        "GetServer" | "ImproveBasis" | "TrainRegions" | "PublishImages" | "Check" | "Watch" => {
            Vec::new()
        }
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
