//! `GET /api/v1/takes/{id}/file`: a take in a format, or parts of its stored file.
//!
//! The stored file of a take that is over never changes: it has a tag, is cached for as long as the tag is right, and is
//! handed out in ranges, so that a download that broke off goes on.

use std::ops::Range;

use axum::{
    extract::State,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1::{self, TakeFormat};
use futures::{Stream, stream};
use serde::Deserialize;
use tonic::Status;
use utoipa::IntoParams;

use super::{
    body::{Piece, paced},
    exported,
    range::{self, Unsatisfiable},
};
use crate::{
    service::{
        access::Caller,
        http::{
            Doors,
            call::Call,
            openapi::{ObjectRefusals, Refusals, StateRefusals},
            problem::Problem,
            query::{TakePath, Word},
        },
        take_exports::OpenTakeFile,
    },
    wire::take as wire,
};

/// Bytes that are read at once.
const PIECE_BYTES: usize = 64 * 1024;

/// In which format.
#[derive(Deserialize, IntoParams)]
#[serde(default, rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
#[derive(Default)]
pub(in crate::service::http) struct FileQuery {
    /// `mcap`, which is the default and the stored file, or `csv`, `live_link_csv`, `glb`, `trc`, `c3d`.
    #[param(required = false, value_type = String, pattern = "^((TAKE_FORMAT_)?(MCAP|CSV|LIVE_LINK_CSV|GLB|TRC|C3D)|mcap|csv|live_link_csv|glb|trc|c3d|)$", example = "csv")]
    format: Word,
}

/// What the client has, and what it lacks.
#[derive(IntoParams)]
#[into_params(parameter_in = Header)]
#[expect(dead_code, reason = "only describes the headers")]
struct PartHeaders {
    /// Tags of what the client has, or `*`; of the stored file of a take that is over.
    #[param(rename = "if-none-match", required = false)]
    tags: String,
    /// One range of bytes, likewise.
    #[param(
        rename = "range",
        required = false,
        pattern = "^bytes=([0-9]{1,15}-[0-9]{0,15}|-[0-9]{1,15})$",
        example = "bytes=0-99"
    )]
    range: String,
    /// The tag of the file that the range is wanted of; of another, all is sent.
    #[param(
        rename = "if-range",
        required = false,
        pattern = "^\"[0-9a-z.-]{1,64}\"$"
    )]
    if_range: String,
}

/// A take in a format: the stored MCAP with everything, or made as it is sent.
///
/// What is made has `frontalis-first-frame`, `-last-frame`, `-frames`, `-gaps`, `-missing-frames` and `-dropped-frames` as
/// headers, and `frontalis-bytes` and `frontalis-sha256` as trailers, which clients get that ask for them (`TE: trailers`).
#[utoipa::path(
    get,
    path = "/api/v1/takes/{id}/file",
    operation_id = "downloadTake",
    tag = "takes",
    params(TakePath, FileQuery, PartHeaders),
    responses(
        (
            status = 200,
            description = "The file.",
            content(
                (ref("#/components/schemas/TakeFile") = "application/octet-stream"),
                (ref("#/components/schemas/TakeFile") = "text/csv"),
                (ref("#/components/schemas/TakeFile") = "text/tab-separated-values"),
                (ref("#/components/schemas/TakeFile") = "model/gltf-binary"),
            ),
            headers(
                ("etag" = String, description = "Of the stored file of a take that is over."),
                ("content-disposition" = String, description = "A name for the file."),
            ),
        ),
        (
            status = 206,
            description = "Part of the stored file.",
            content((ref("#/components/schemas/TakeFile") = "application/octet-stream")),
            headers(("content-range" = String, description = "Which part.")),
        ),
        (status = 304, description = "The client has it."),
        (
            status = 416,
            description = "No such part; `content-range` says how long the file is.",
            body = ref("#/components/schemas/Problem"),
            content_type = "application/problem+json",
        ),
        Refusals,
        ObjectRefusals,
        StateRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.TakeService/ExportTake"))),
)]
pub(in crate::service::http) async fn download(
    State(doors): State<Doors>,
    call: Call<FileQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let format = call.query.format.number("format", "TakeFormat")?;
    let request = call.request(v1::ExportTakeRequest {
        name: call.name("takes"),
        format,
    });
    match TakeFormat::try_from(format) {
        Ok(TakeFormat::Unspecified | TakeFormat::Mcap) => {
            let caller = Caller::of(call.extensions());
            let opened = doors.services.takes.open_file(request).await?;
            Ok(stored(opened, &headers, &caller))
        }
        _ => exported::response(&doors, request).await,
    }
}

/// A name for the saved file; older clients read the first form, which is ASCII.
pub(super) fn disposition(name: &str) -> HeaderValue {
    let plain = |it: char| if it.is_ascii() { it } else { '_' };
    let ascii: String = name.chars().map(plain).collect();
    let encoded: String = form_urlencoded::byte_serialize(name.as_bytes()).collect();
    // A form writes a blank as a plus; a name has neither.
    let value = format!("attachment; filename=\"{ascii}\"; filename*=UTF-8''{encoded}");
    HeaderValue::try_from(value).unwrap_or(HeaderValue::from_static("attachment"))
}

fn stored(file: OpenTakeFile, headers: &HeaderMap, caller: &Caller) -> Response {
    let n_bytes = file.stored.n_bytes;
    let tag = file.is_final().then(|| tag(&file));
    let wanted = match &tag {
        Some(tag) if is_held(headers, tag) => {
            return (StatusCode::NOT_MODIFIED, caching(tag)).into_response();
        }
        Some(tag) => range::wanted(headers, tag, n_bytes),
        None => Ok(None),
    };
    let part = match wanted {
        Ok(part) => part,
        Err(Unsatisfiable) => return unsatisfiable(n_bytes),
    };
    let mut answer = StatusCode::OK.into_response();
    *answer.headers_mut() = headers_of(&file, tag.as_deref());
    if let Some(part) = &part {
        *answer.status_mut() = StatusCode::PARTIAL_CONTENT;
        let (first, last) = (part.start, part.end - 1);
        let place = format!("bytes {first}-{last}/{n_bytes}");
        let place = HeaderValue::try_from(place).map(|it| (header::CONTENT_RANGE, it));
        answer.headers_mut().extend(place);
    }
    let part = part.unwrap_or(0..n_bytes);
    let length = part.end - part.start;
    answer
        .headers_mut()
        .insert(header::CONTENT_LENGTH, length.into());
    *answer.body_mut() = paced(caller.while_valid(pieces(file, part)));
    answer
}

/// What is said of the file, whole or in part.
fn headers_of(file: &OpenTakeFile, tag: Option<&str>) -> HeaderMap {
    let mut headers = tag.map_or_else(HeaderMap::new, caching);
    let (ranges, caching) = match tag {
        Some(_) => ("bytes", None),
        None => ("none", Some("no-store")),
    };
    headers.insert(header::ACCEPT_RANGES, HeaderValue::from_static(ranges));
    headers.extend(caching.map(|it| (header::CACHE_CONTROL, HeaderValue::from_static(it))));
    let kind = HeaderValue::from_static("application/octet-stream");
    headers.insert(header::CONTENT_TYPE, kind);
    let name = frontalis_proto::export_file_name(&wire::take(&file.row), TakeFormat::Mcap);
    headers.insert(header::CONTENT_DISPOSITION, disposition(&name));
    headers
}

fn pieces(
    file: OpenTakeFile,
    part: Range<u64>,
) -> impl Stream<Item = Result<Piece, Status>> + Send + 'static {
    stream::try_unfold((file, part), |(file, part)| async move {
        let n_left = usize::try_from(part.end - part.start).unwrap_or(usize::MAX);
        if n_left == 0 {
            return Ok(None);
        }
        let (file, bytes) = file.read(part.start, n_left.min(PIECE_BYTES)).await?;
        if bytes.is_empty() {
            return Err(Status::data_loss("the take's file is shorter than it was"));
        }
        let rest = part.start + bytes.len() as u64..part.end;
        Ok(Some((Piece::data(Bytes::from(bytes)), (file, rest))))
    })
}

/// A file that is over never changes, so when it ended and its length are enough to tell it.
fn tag(file: &OpenTakeFile) -> String {
    let ended = file.row.stop_time_nanos.unwrap_or_default();
    format!("\"{ended:x}-{:x}\"", file.stored.n_bytes)
}

fn is_held(headers: &HeaderMap, tag: &str) -> bool {
    let same = |it: &str| {
        let it = it.trim();
        it == "*" || it.strip_prefix("W/").unwrap_or(it) == tag
    };
    let names = |it: &HeaderValue| it.to_str().is_ok_and(|it| it.split(',').any(same));
    headers.get_all(header::IF_NONE_MATCH).iter().any(names)
}

fn caching(tag: &str) -> HeaderMap {
    let mut headers = HeaderMap::new();
    headers.extend(HeaderValue::try_from(tag).map(|it| (header::ETAG, it)));
    // Whoever may read it is asked again each time, the bytes are not sent again.
    let private = HeaderValue::from_static("private, no-cache");
    headers.insert(header::CACHE_CONTROL, private);
    headers
}

fn unsatisfiable(n_bytes: u64) -> Response {
    let detail = format!("one range of bytes within the {n_bytes} of the file can be had");
    let problem = Problem::new(StatusCode::RANGE_NOT_SATISFIABLE, "RANGE", &detail);
    let mut answer = problem.into_response();
    let value = HeaderValue::try_from(format!("bytes */{n_bytes}"));
    answer
        .headers_mut()
        .extend(value.map(|it| (header::CONTENT_RANGE, it)));
    answer
}
