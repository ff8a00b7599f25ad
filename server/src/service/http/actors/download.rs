//! `GET /api/v1/actors/{id}/model.glb` and `/package`: an actor's revision as bytes.
//!
//! A revision never changes, so its bytes are cached for as long as its tag is right; an actor that was erased and
//! imported anew has other tags. A reader that takes nothing for 30 s is cut, and its export's place is free.

use std::{convert::Infallible, time::Duration};

use axum::{
    body::Body,
    extract::State,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1::{self, actor_service_server::ActorService as _};
use futures::{StreamExt as _, stream};
use serde::Deserialize;
use tokio::sync::mpsc;
use tonic::Status;
use utoipa::IntoParams;

use super::super::{
    Doors,
    call::Call,
    openapi::{ObjectRefusals, Refusals},
    problem::Problem,
    query::ActorPath,
};

/// Bytes that are handed to the connection at once.
const PIECE_BYTES: usize = 64 * 1024;

/// A reader must take a piece within this time.
const PIECE_DEADLINE: Duration = Duration::from_secs(30);

/// Which revision.
#[derive(Deserialize, IntoParams)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(in crate::service::http) struct RevisionQuery {
    /// 0: the newest.
    #[serde(default)]
    #[param(required = false, maximum = 4_294_967_295_u64)]
    revision: u32,
}

/// What the client has.
#[derive(IntoParams)]
#[into_params(parameter_in = Header)]
#[expect(dead_code, reason = "only describes the header")]
struct TagsHeader {
    /// Tags of what the client has, or `*`.
    #[param(rename = "if-none-match", required = false)]
    tags: String,
}

/// The face with its actuation basis as a GLB, in meters, one morph target a muscle; a stored ZIP is converted.
#[utoipa::path(
    get,
    path = "/api/v1/actors/{id}/model.glb",
    operation_id = "downloadModel",
    tag = "actors",
    params(
        ActorPath,
        RevisionQuery,
        TagsHeader,
    ),
    responses(
        (
            status = 200,
            description = "The model.",
            body = ref("#/components/schemas/Package"),
            content_type = "model/gltf-binary",
            headers(
                ("etag" = String, description = "Changes with the revision."),
                ("content-disposition" = String, description = "A name for the file."),
            ),
        ),
        (status = 304, description = "The client has it."),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ActorService/ExportActor"))),
)]
pub(in crate::service::http) async fn model(
    State(doors): State<Doors>,
    call: Call<RevisionQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let wanted = Wanted::find(&doors, &call, "glb").await?;
    if wanted.is_held(&headers) {
        return Ok(wanted.not_modified());
    }
    let (package, rest) = export(&doors, &call, wanted.revision).await?;
    let model = doors.services.actors.to_glb(package).await?;
    Ok(wanted.send(model, "model/gltf-binary", "glb", rest))
}

/// The package as it was uploaded.
#[utoipa::path(
    get,
    path = "/api/v1/actors/{id}/package",
    operation_id = "downloadPackage",
    tag = "actors",
    params(
        ActorPath,
        RevisionQuery,
        TagsHeader,
    ),
    responses(
        (
            status = 200,
            description = "The package.",
            content(
                (ref("#/components/schemas/Package") = "application/zip"),
                (ref("#/components/schemas/Package") = "model/gltf-binary"),
            ),
            headers(
                ("etag" = String, description = "Changes with the revision."),
                ("content-disposition" = String, description = "A name for the file."),
            ),
        ),
        (status = 304, description = "The client has it."),
        Refusals,
        ObjectRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ActorService/ExportActor"))),
)]
pub(in crate::service::http) async fn package(
    State(doors): State<Doors>,
    call: Call<RevisionQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let wanted = Wanted::find(&doors, &call, "package").await?;
    if wanted.is_held(&headers) {
        return Ok(wanted.not_modified());
    }
    let (package, rest) = export(&doors, &call, wanted.revision).await?;
    let (kind, extension) = if package.starts_with(b"PK") {
        ("application/zip", "zip")
    } else {
        ("model/gltf-binary", "glb")
    };
    Ok(wanted.send(package, kind, extension, rest))
}

/// The export's stream, which holds its place until it is dropped.
type Place = Box<dyn Send>;

async fn export(
    doors: &Doors,
    call: &Call<RevisionQuery>,
    revision: u32,
) -> Result<(Vec<u8>, Place), Problem> {
    let request = call.request(v1::ExportActorRequest {
        name: call.name("actors"),
        revision,
    });
    let response = doors.services.actors.export_actor(request).await?;
    let mut chunks = response.into_inner();
    let mut package = Vec::new();
    while let Some(chunk) = chunks.next().await {
        package.extend_from_slice(&chunk?.chunk);
    }
    Ok((package, Box::new(chunks)))
}

/// One revision's bytes, known by a tag.
struct Wanted {
    id: String,
    revision: u32,
    tag: String,
    /// The tag stands for bytes that are there.
    exists: bool,
}

impl Wanted {
    async fn find(doors: &Doors, call: &Call<RevisionQuery>, form: &str) -> Result<Self, Status> {
        let name = call.name("actors");
        let request = call.request(v1::GetActorRequest { name });
        let actor = doors.services.actors.get_actor(request).await?;
        let actor = actor.into_inner().actor.unwrap_or_default();
        let revision = match call.query.revision {
            0 => actor.revision,
            revision => revision,
        };
        let created = actor.create_time.unwrap_or_default();
        let (seconds, nanos) = (created.seconds, created.nanos);
        Ok(Self {
            id: call.id().to_owned(),
            revision,
            tag: format!("\"{form}-{revision}-{seconds:x}.{nanos:x}\""),
            exists: revision <= actor.revision,
        })
    }

    fn is_held(&self, headers: &HeaderMap) -> bool {
        let same = |it: &str| {
            let it = it.trim();
            it == "*" || it.strip_prefix("W/").unwrap_or(it) == self.tag
        };
        let names = |it: &HeaderValue| it.to_str().is_ok_and(|it| it.split(',').any(same));
        self.exists && headers.get_all(header::IF_NONE_MATCH).iter().any(names)
    }

    fn not_modified(&self) -> Response {
        (StatusCode::NOT_MODIFIED, self.caching()).into_response()
    }

    fn caching(&self) -> [(header::HeaderName, String); 2] {
        [
            (header::ETAG, self.tag.clone()),
            // Whoever may read it is asked again each time, the bytes are not sent again.
            (header::CACHE_CONTROL, "private, no-cache".to_owned()),
        ]
    }

    fn send(&self, bytes: Vec<u8>, kind: &str, extension: &str, place: Place) -> Response {
        let file = format!("{}-r{}.{extension}", self.id, self.revision);
        let headers = [
            (header::CONTENT_TYPE, kind.to_owned()),
            (header::CONTENT_LENGTH, bytes.len().to_string()),
            (
                header::CONTENT_DISPOSITION,
                format!("attachment; filename=\"{file}\""),
            ),
        ];
        let body = paced(bytes, place);
        (self.caching(), headers, body).into_response()
    }
}

/// Hands out `bytes` for as long as they are taken. The task ends with them, with the reader, or at the deadline.
fn paced(bytes: Vec<u8>, place: Place) -> Body {
    let (pieces, taken) = mpsc::channel::<Bytes>(1);
    tokio::spawn(async move {
        let _place = place;
        for start in (0..bytes.len()).step_by(PIECE_BYTES) {
            let end = bytes.len().min(start + PIECE_BYTES);
            // A copy, so that a piece that nobody takes does not keep the whole.
            let piece = Bytes::copy_from_slice(&bytes[start..end]);
            let sent = pieces.send_timeout(piece, PIECE_DEADLINE);
            if sent.await.is_err() {
                return;
            }
        }
    });
    let pieces = stream::unfold(taken, |mut taken| async {
        let piece = taken.recv().await?;
        Some((Ok::<_, Infallible>(piece), taken))
    });
    Body::from_stream(pieces)
}
