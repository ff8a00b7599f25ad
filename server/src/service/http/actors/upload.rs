//! `PUT /api/v1/actors/{id}`: a package in, and how far it has come.
//!
//! The bytes go through the same import as those of gRPC: refused while they still come, compressed ones always
//! (BAD_INPUT D7, D11). An upload may take longer than other calls, but not stand still: 16 KiB must come within the
//! import's deadline for a message (BAD_INPUT F5).

mod progress;

use axum::{
    Json,
    body::Body,
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use bytes::{Bytes, BytesMut};
use frontalis_proto::v1;
use futures::{Stream, StreamExt as _, stream};
use serde::Deserialize;
use tonic::{Code, Status};
use utoipa::IntoParams;

use super::super::{
    Doors,
    call::{Call, check_encoding, media_type},
    openapi::{self, BodyRefusals, ObjectRefusals, Refusals, StateRefusals},
    problem::Problem,
    query::{ActorPath, Word},
};
use crate::service::grpc::status::refuse;

/// Fewest bytes that go on to the import at once, except at the end.
const BLOCK_BYTES: usize = 16 * 1024;

/// What a package may be sent as.
const MEDIA_TYPES: [&str; 3] = [
    "application/zip",
    "model/gltf-binary",
    "application/octet-stream",
];

/// What is said of a package beside its bytes.
#[derive(Deserialize, IntoParams)]
#[serde(rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(in crate::service::http) struct ImportQuery {
    /// In place of the package's own name for people.
    #[serde(default)]
    #[param(required = false, schema_with = openapi::display_name)]
    display_name: String,
    /// The package must be in this unit; a GLB is in meters.
    #[serde(default)]
    #[param(required = false, value_type = String, schema_with = openapi::length_unit)]
    unit: Word,
    /// Accept a rank-deficient basis and report it.
    #[serde(default)]
    #[param(required = false)]
    regularize: bool,
}

/// Takes a package as a new actor, or as the next revision of one with the same muscles and markers.
///
/// With `Accept: application/x-ndjson` the answer is a stream of lines that say how far it is; the last line is
/// `{"result": ...}` or `{"error": ...}`.
#[utoipa::path(
    put,
    path = "/api/v1/actors/{id}",
    operation_id = "importActor",
    tag = "actors",
    params(ActorPath, ImportQuery),
    request_body(
        description = "An actor package: a GLB with morph targets, or a ZIP of `actor.json` and OBJ files.",
        content(
            (ref("#/components/schemas/Package") = "application/zip"),
            (ref("#/components/schemas/Package") = "model/gltf-binary"),
            (ref("#/components/schemas/Package") = "application/octet-stream"),
        ),
    ),
    responses(
        (
            status = 200,
            description = "The actor as its newest revision.",
            content(
                (ref("#/components/schemas/ImportActorResponse") = "application/json"),
                (ref("#/components/schemas/ImportActorLine") = "application/x-ndjson"),
            ),
        ),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        BodyRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.ActorService/ImportActor"))),
)]
pub(in crate::service::http) async fn import(
    State(doors): State<Doors>,
    call: Call<ImportQuery>,
    request: Request,
) -> Result<Response, Problem> {
    let actors = &doors.services.actors;
    let place = actors.admit_import(call.extensions())?;
    let start = v1::ImportActorStart {
        actor_id: call.id().to_owned(),
        display_name: call.query.display_name.clone(),
        unit: call.query.unit.number("unit", "LengthUnit")?,
        regularize: call.query.regularize,
    };
    let import = actors.begin_import(place, start)?;
    let (parts, body) = request.into_parts();
    check_media_type(&parts.headers)?;
    check_encoding(&parts.headers)?;
    let total_bytes = content_length(&parts.headers);
    import.check_size(total_bytes.unwrap_or(0))?;
    let chunks = blocks(body).boxed();
    if wants_lines(&parts.headers) {
        let instance = parts.uri.path().to_owned();
        return Ok(progress::lines(import, chunks, total_bytes, instance));
    }
    let imported = import.run(chunks, |_progress| {}).await?;
    Ok(Json(imported).into_response())
}

fn check_media_type(headers: &HeaderMap) -> Result<(), Problem> {
    let kind = media_type(headers);
    if kind.is_some_and(|it| MEDIA_TYPES.contains(&it.as_str())) {
        return Ok(());
    }
    let detail =
        "the content type must be application/zip, model/gltf-binary or application/octet-stream";
    Err(Problem::new(
        StatusCode::UNSUPPORTED_MEDIA_TYPE,
        "CONTENT_TYPE",
        detail,
    ))
}

fn content_length(headers: &HeaderMap) -> Option<u64> {
    headers
        .get(header::CONTENT_LENGTH)?
        .to_str()
        .ok()?
        .parse()
        .ok()
}

fn wants_lines(headers: &HeaderMap) -> bool {
    let accepts = |it: &HeaderValue| {
        it.to_str()
            .is_ok_and(|it| it.contains("application/x-ndjson"))
    };
    headers.get_all(header::ACCEPT).iter().any(accepts)
}

/// The body in blocks, so that a deadline for each of them is one for the rate too.
fn blocks(body: Body) -> impl Stream<Item = Result<Bytes, Status>> + Send {
    let source = Some(body.into_data_stream());
    stream::unfold(source, |source| async {
        let mut source = source?;
        let mut block = BytesMut::new();
        while block.len() < BLOCK_BYTES {
            match source.next().await {
                Some(Ok(bytes)) if block.is_empty() && bytes.len() >= BLOCK_BYTES => {
                    return Some((Ok(bytes), Some(source)));
                }
                Some(Ok(bytes)) => block.extend_from_slice(&bytes),
                Some(Err(_cut)) => return Some((Err(cut()), None)),
                None if block.is_empty() => return None,
                None => return Some((Ok(block.freeze()), None)),
            }
        }
        Some((Ok(block.freeze()), Some(source)))
    })
}

fn cut() -> Status {
    let message = "the body ended before it was complete";
    refuse(Code::InvalidArgument, "BODY", message)
}
