//! `capture.proto` to frames: what a publisher declares, and each frame, valid or with the reason why not.
//!
//! Rows A1 to A11, A25 and A28 of the bad-input table. Counts are checked before anything is reserved.

use std::{
    collections::HashSet,
    hash::{DefaultHasher, Hasher},
};

use bytes::Bytes;
use frontalis_analysis::space::{LengthUnit, PerformancePoint};
use frontalis_proto::v1;
use prost::Message as _;

use super::{
    actor::finite,
    common,
    invalid::{FieldError, FieldProblem},
};
use crate::{
    hub::SampleTag,
    name::{PublisherId, SessionId},
    session::{ClockExchange, ClockReport, IncomingFrame, Ingest, Rejection, StreamShape},
};

/// Most markers in a stream.
pub const MAX_MARKERS: usize = 1_024;
/// Most frames in one message.
pub const MAX_FRAMES_PER_MESSAGE: usize = 256;
/// Fastest declared rate.
const MAX_RATE_HZ: f64 = 10_000.0;
/// Farthest a coordinate may lie from the origin of performance space: 10 m.
const MAX_COORDINATE_CM: f64 = 1_000.0;
/// Longest marker name, bytes.
const MAX_MARKER_NAME_BYTES: usize = 128;

/// What a publisher asks for, checked.
#[derive(Clone, Debug)]
pub struct StartRequest {
    /// Into which session.
    pub session: SessionId,
    /// Who publishes.
    pub publisher: PublisherId,
    /// Order of the coordinates; empty: the actor's.
    pub marker_names: Vec<String>,
    /// Unit of the coordinates.
    pub unit: LengthUnit,
    /// Whether it may push another publisher out.
    pub takeover: bool,
    /// What happens when the session cannot keep up.
    pub ingest: Ingest,
    /// Finite, positive, at most 10,000.
    pub rate_hz: f64,
}

/// Checks a start.
///
/// # Errors
///
/// [`FieldError`] names the first field that is wrong.
pub fn start(sent: v1::PublishStart) -> Result<StartRequest, FieldError> {
    let session =
        SessionId::from_resource(&sent.session).map_err(FieldError::name("start.session"))?;
    let publisher =
        PublisherId::parse(&sent.publisher).map_err(FieldError::name("start.publisher"))?;
    let unit = common::length_unit("start.unit", sent.unit)?;
    check_rate(sent.rate_hz)?;
    check_marker_names(&sent.marker_names)?;
    Ok(StartRequest {
        session,
        publisher,
        marker_names: sent.marker_names,
        unit,
        takeover: sent.takeover,
        ingest: ingest(sent.ingest)?,
        rate_hz: sent.rate_hz,
    })
}

fn ingest(number: i32) -> Result<Ingest, FieldError> {
    match v1::Ingest::try_from(number) {
        Ok(v1::Ingest::Unspecified | v1::Ingest::Live) => Ok(Ingest::Live),
        Ok(v1::Ingest::Lossless) => Ok(Ingest::Lossless),
        Err(_unknown) => Err(FieldError::new(
            "start.ingest",
            FieldProblem::UnknownEnum(number),
        )),
    }
}

fn check_rate(rate_hz: f64) -> Result<(), FieldError> {
    // Written so that NaN fails.
    if rate_hz > 0.0 && rate_hz <= MAX_RATE_HZ {
        return Ok(());
    }
    let detail = "the frame rate must be above 0 and at most 10,000 Hz";
    Err(FieldError::unusable("start.rate_hz", "RATE", detail))
}

fn check_marker_names(names: &[String]) -> Result<(), FieldError> {
    const FIELD: &str = "start.marker_names";
    if names.len() > MAX_MARKERS {
        let detail = format!("{} names, at most {MAX_MARKERS} are taken", names.len());
        return Err(FieldError::unusable(FIELD, "MARKER_COUNT", detail));
    }
    let is_bad = |it: &String| {
        it.is_empty() || it.len() > MAX_MARKER_NAME_BYTES || it.chars().any(char::is_control)
    };
    if let Some(idx) = names.iter().position(is_bad) {
        let detail =
            format!("name {idx} is empty, longer than 128 bytes, or has a control character");
        return Err(FieldError::unusable(FIELD, "NAME", detail));
    }
    let mut seen = HashSet::new();
    if let Some(idx) = names.iter().position(|it| !seen.insert(it)) {
        let detail = format!("name {idx} stands twice");
        return Err(FieldError::unusable(FIELD, "DUPLICATE_MARKER", detail));
    }
    Ok(())
}

/// Checks a frame against what the publisher declared.
///
/// # Errors
///
/// [`Rejection`] with the reason of the bad-input table; the stream goes on.
pub fn frame(sent: &v1::MarkerFrame, shape: &StreamShape) -> Result<IncomingFrame, Rejection> {
    Ok(IncomingFrame {
        content_hash: content_hash(sent),
        sent: sent.encode_to_vec().into(),
        ..recorded_frame(sent, shape)?
    })
}

/// The same of a frame that is neither compared with others nor recorded again.
///
/// # Errors
///
/// [`Rejection`] as of [`frame`].
pub fn recorded_frame(
    sent: &v1::MarkerFrame,
    shape: &StreamShape,
) -> Result<IncomingFrame, Rejection> {
    let reject = |reason, detail: String| Rejection {
        number: sent.number,
        reason,
        detail,
    };
    if sent.number == 0 {
        let detail = "frame numbers start at 1".to_owned();
        return Err(reject("FRAME_NUMBER", detail));
    }
    let n_expected = shape.marker_names.len() * 3;
    let n_found = sent.positions.len();
    if n_found != 0 && n_found != n_expected {
        let detail = format!("expected {n_expected} coordinates, got {n_found}");
        return Err(reject("MARKER_COUNT", detail));
    }
    if sent
        .crc32c
        .is_some_and(|it| it != checksum(&sent.positions))
    {
        let detail = "crc32c does not match the positions".to_owned();
        return Err(reject("CHECKSUM", detail));
    }
    let mut positions = Vec::with_capacity(n_found / 3);
    let mut n_partial_markers = 0;
    for (idx, coordinates) in sent.positions.as_chunks::<3>().0.iter().enumerate() {
        let position = marker(*coordinates, shape.unit)
            .map_err(|it| reject(it.reason(), it.detail(idx, shape)))?;
        let n_missing = coordinates.iter().filter(|it| it.is_nan()).count();
        n_partial_markers += usize::from(n_missing == 1 || n_missing == 2);
        positions.push(position);
    }
    let timecode = sent.timecode.as_ref().and_then(common::timecode);
    Ok(IncomingFrame {
        number: sent.number,
        capture_time_nanos: sent.capture_time_nanos,
        positions,
        tag: SampleTag {
            source_frame: sent.source_frame,
            timecode,
            capture_time_server_nanos: None,
            timecode_invalid: sent.timecode.is_some() && timecode.is_none(),
            time_non_monotonic: false,
        },
        content_hash: 0,
        n_partial_markers,
        sent: Bytes::new(),
    })
}

/// What is wrong with one marker's coordinates.
#[derive(Clone, Copy)]
enum BadCoordinate {
    Infinite { axis: usize },
    OutOfVolume { axis: usize },
}

impl BadCoordinate {
    fn reason(self) -> &'static str {
        match self {
            Self::Infinite { .. } => "NON_FINITE",
            Self::OutOfVolume { .. } => "OUT_OF_VOLUME",
        }
    }

    /// Names marker and axis, never the coordinate.
    fn detail(self, idx: usize, shape: &StreamShape) -> String {
        let name = shape.marker_names.get(idx).map_or("", String::as_str);
        match self {
            Self::Infinite { axis } => format!("marker {idx} ({name}): {} is infinite", AXES[axis]),
            Self::OutOfVolume { axis } => format!(
                "marker {idx} ({name}): {} lies more than 10 m from the origin, read in {}",
                AXES[axis],
                shape.unit.symbol()
            ),
        }
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// The point, or nothing when a coordinate is missing.
fn marker(
    coordinates: [f32; 3],
    unit: LengthUnit,
) -> Result<Option<PerformancePoint>, BadCoordinate> {
    if let Some(axis) = coordinates.iter().position(|it| it.is_infinite()) {
        return Err(BadCoordinate::Infinite { axis });
    }
    if coordinates.iter().any(|it| it.is_nan()) {
        return Ok(None);
    }
    let [x, y, z] = coordinates;
    let point = unit.performance_point(x, y, z);
    let is_outside = |it: &f64| it.abs() > MAX_COORDINATE_CM;
    match point.0.iter().position(is_outside) {
        Some(axis) => Err(BadCoordinate::OutOfVolume { axis }),
        None => Ok(Some(point)),
    }
}

/// CRC-32C of the little-endian bytes.
fn checksum(positions: &[f32]) -> u32 {
    positions
        .iter()
        .fold(0, |crc, it| crc32c::crc32c_append(crc, &it.to_le_bytes()))
}

/// Hash of all that was sent but the checksum. The number is compared on its own.
pub fn content_hash(sent: &v1::MarkerFrame) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write_i64(sent.capture_time_nanos);
    hasher.write_u64(sent.source_frame);
    if let Some(it) = &sent.timecode {
        let fields = [it.hours, it.minutes, it.seconds, it.frames];
        let rate = [it.rate_numerator, it.rate_denominator];
        let rest = [
            u32::from(it.drop_frame),
            it.sub_frame.to_bits(),
            it.user_bits,
        ];
        for field in fields.into_iter().chain(rest).chain(rate) {
            hasher.write_u32(field);
        }
    }
    for coordinate in &sent.positions {
        hasher.write_u32(coordinate.to_bits());
    }
    hasher.finish()
}

/// An exchange with the publisher's clock, whose answer came at `now_nanos`.
pub fn clock_exchange(echo: &v1::ClockEcho, now_nanos: i64) -> ClockExchange {
    ClockExchange {
        server_send: echo.server_send_nanos,
        client_receive: echo.client_receive_nanos,
        client_send: echo.client_send_nanos,
        server_receive: now_nanos,
    }
}

/// How a publisher's clock stands, on the wire.
pub fn clock_report(report: &ClockReport) -> v1::ClockReport {
    v1::ClockReport {
        offset_nanos: report.offset_nanos,
        round_trip_nanos: report.round_trip_nanos,
        uncertainty_nanos: report.uncertainty_nanos,
        drift_ppm: finite(report.drift_ppm),
    }
}

/// What a take says of its publisher's clock.
pub fn recorded_clock(recorded: &v1::TakeClock) -> Option<ClockReport> {
    let clock = recorded.clock?;
    Some(ClockReport {
        offset_nanos: clock.offset_nanos,
        server_time_nanos: recorded.server_time_nanos,
        drift_ppm: clock.drift_ppm,
        round_trip_nanos: clock.round_trip_nanos,
        uncertainty_nanos: clock.uncertainty_nanos,
    })
}

/// A rejection on the wire.
pub fn rejection_to_wire(rejection: Rejection) -> v1::RejectedFrame {
    v1::RejectedFrame {
        number: rejection.number,
        reason: rejection.reason.to_owned(),
        detail: rejection.detail,
    }
}

#[cfg(test)]
mod tests;
