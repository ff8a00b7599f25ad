//! A take in an exchange format, made while it is sent: its figures are headers, its checksum stands behind it.

use axum::{
    http::{HeaderMap, HeaderName, HeaderValue, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1::{self, TakeFormat, take_service_server::TakeService as _};
use futures::{StreamExt as _, stream};
use tonic::{Request, Status};

use super::{
    body::{Piece, paced},
    file::disposition,
};
use crate::service::http::{Doors, problem::Problem};

const BYTES: HeaderName = HeaderName::from_static("frontalis-bytes");
const SHA256: HeaderName = HeaderName::from_static("frontalis-sha256");

pub(super) async fn response(
    doors: &Doors,
    request: Request<v1::ExportTakeRequest>,
) -> Result<Response, Problem> {
    let response = doors.services.takes.export_take(request).await?;
    let mut responses = response.into_inner();
    let first = match responses.next().await {
        Some(first) => first?,
        None => return Err(Status::internal("the export has no beginning").into()),
    };
    let told = first.export.unwrap_or_default();
    let pieces = responses.flat_map(|next| match next {
        Ok(next) => stream::iter(frames(next).map(Ok).collect::<Vec<_>>()),
        Err(status) => stream::iter(vec![Err(status)]),
    });
    let mut answer = paced(pieces).into_response();
    *answer.headers_mut() = headers(&told);
    Ok(answer)
}

/// A piece; the last one is the trailers.
fn frames(next: v1::ExportTakeResponse) -> impl Iterator<Item = Piece> {
    let data = (!next.chunk.is_empty()).then(|| Piece::data(Bytes::from(next.chunk)));
    let trailers = next.export.map(|it| Piece::trailers(trailers(&it)));
    data.into_iter().chain(trailers)
}

fn headers(told: &v1::TakeExport) -> HeaderMap {
    let kind = match told.format() {
        TakeFormat::Csv | TakeFormat::LiveLinkCsv => "text/csv; charset=utf-8",
        TakeFormat::Trc => "text/tab-separated-values; charset=utf-8",
        TakeFormat::Glb => "model/gltf-binary",
        TakeFormat::C3d | TakeFormat::Mcap | TakeFormat::Unspecified => "application/octet-stream",
    };
    let mut headers = HeaderMap::new();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(kind));
    headers.insert(header::CONTENT_DISPOSITION, disposition(&told.file_name));
    headers.insert(header::ACCEPT_RANGES, HeaderValue::from_static("none"));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    let trailer = HeaderValue::from_static("frontalis-bytes, frontalis-sha256");
    headers.insert(header::TRAILER, trailer);
    for (name, figure) in [
        ("frontalis-first-frame", told.first_frame),
        ("frontalis-last-frame", told.last_frame),
        ("frontalis-frames", told.n_frames),
        ("frontalis-gaps", told.n_gaps),
        ("frontalis-missing-frames", told.n_missing_frames),
        ("frontalis-dropped-frames", told.n_dropped_frames),
    ] {
        headers.insert(HeaderName::from_static(name), figure.into());
    }
    headers
}

fn trailers(told: &v1::TakeExport) -> HeaderMap {
    let mut trailers = HeaderMap::new();
    trailers.insert(BYTES, told.n_bytes.into());
    trailers.extend(HeaderValue::try_from(&told.sha256).map(|it| (SHA256, it)));
    trailers
}
