//! `capture.proto` to frames: what a publisher declares, and each frame, valid or with the reason why not.
//!
//! Rows A1 to A11, A25 and A28 of the bad-input table. Counts are checked before anything is reserved.

use std::{
    collections::HashSet,
    hash::{DefaultHasher, Hasher},
};

use frontalis_analysis::space::{LengthUnit, PerformancePoint};
use frontalis_proto::v1;

use super::{
    common,
    invalid::{FieldError, FieldProblem},
};
use crate::{
    hub::SampleTag,
    name::{PublisherId, SessionId},
    session::{IncomingFrame, Ingest, Rejection, StreamShape},
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
    let reject = |reason, detail: String| Rejection {
        number: sent.number,
        reason,
        detail,
    };
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
            timecode_invalid: sent.timecode.is_some() && timecode.is_none(),
            time_non_monotonic: false,
        },
        content_hash: content_hash(sent),
        n_partial_markers,
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
                "marker {idx} ({name}): {} lies more than 10 m from the origin",
                AXES[axis]
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
fn content_hash(sent: &v1::MarkerFrame) -> u64 {
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

/// A rejection on the wire.
pub fn rejection_to_wire(rejection: Rejection) -> v1::RejectedFrame {
    v1::RejectedFrame {
        number: rejection.number,
        reason: rejection.reason.to_owned(),
        detail: rejection.detail,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn shape(unit: LengthUnit) -> StreamShape {
        StreamShape {
            unit,
            marker_names: vec!["chin".to_owned(), "corner_left".to_owned()],
        }
    }

    fn sent(positions: &[f32]) -> v1::MarkerFrame {
        v1::MarkerFrame {
            number: 7,
            positions: positions.to_vec(),
            ..v1::MarkerFrame::default()
        }
    }

    fn reason(positions: &[f32]) -> &'static str {
        frame(&sent(positions), &shape(LengthUnit::Centimeter))
            .unwrap_err()
            .reason
    }

    fn a_start() -> v1::PublishStart {
        v1::PublishStart {
            session: "sessions/one".to_owned(),
            publisher: "stage".to_owned(),
            unit: 1,
            rate_hz: 60.0,
            ..v1::PublishStart::default()
        }
    }

    #[test]
    fn a_missing_marker_is_occluded_in_one_or_all_coordinates() {
        let nan = f32::NAN;
        let all = frame(
            &sent(&[nan, nan, nan, 1.0, 2.0, 3.0]),
            &shape(LengthUnit::Centimeter),
        )
        .unwrap();
        assert_eq!(all.positions[0], None);
        assert_eq!(all.n_partial_markers, 0);
        let one = frame(
            &sent(&[1.0, nan, 3.0, 1.0, 2.0, 3.0]),
            &shape(LengthUnit::Centimeter),
        )
        .unwrap();
        assert_eq!(one.positions[0], None);
        assert_eq!(one.n_partial_markers, 1);
    }

    #[test]
    fn an_infinite_coordinate_is_named_without_its_value() {
        let bad = sent(&[1.0, 2.0, 3.0, f32::NEG_INFINITY, f32::NAN, 0.0]);
        let rejection = frame(&bad, &shape(LengthUnit::Meter)).unwrap_err();
        assert_eq!(rejection.reason, "NON_FINITE");
        assert_eq!(rejection.detail, "marker 1 (corner_left): x is infinite");
    }

    #[test]
    fn the_volume_is_ten_meters_in_every_unit() {
        for (unit, limit) in [
            (LengthUnit::Millimeter, 10_000.0),
            (LengthUnit::Centimeter, 1_000.0),
            (LengthUnit::Meter, 10.0),
        ] {
            let inside = sent(&[limit, -limit, 0.0, 0.0, -0.0, f32::MIN_POSITIVE / 2.0]);
            assert!(frame(&inside, &shape(unit)).is_ok());
            let outside = sent(&[0.0, 0.0, 0.0, 0.0, 0.0, limit * 1.01]);
            assert_eq!(
                frame(&outside, &shape(unit)).unwrap_err().reason,
                "OUT_OF_VOLUME"
            );
        }
        assert_eq!(reason(&[1e30, 0.0, 0.0, 0.0, 0.0, 0.0]), "OUT_OF_VOLUME");
    }

    #[test]
    fn the_number_of_coordinates_is_none_or_all() {
        assert!(
            frame(&sent(&[]), &shape(LengthUnit::Meter))
                .unwrap()
                .positions
                .is_empty()
        );
        assert_eq!(reason(&[0.0; 3]), "MARKER_COUNT");
        assert_eq!(reason(&[0.0; 7]), "MARKER_COUNT");
        assert_eq!(reason(&vec![0.0; 240_000]), "MARKER_COUNT");
    }

    #[test]
    fn a_wrong_checksum_is_refused_and_a_right_one_is_not() {
        let mut it = sent(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let bytes: Vec<u8> = it
            .positions
            .iter()
            .flat_map(|it| it.to_le_bytes())
            .collect();
        it.crc32c = Some(crc32c::crc32c(&bytes));
        assert!(frame(&it, &shape(LengthUnit::Centimeter)).is_ok());
        it.positions[0] = 1.5;
        assert_eq!(
            frame(&it, &shape(LengthUnit::Centimeter))
                .unwrap_err()
                .reason,
            "CHECKSUM"
        );
    }

    #[test]
    fn content_differs_by_every_field_but_the_number() {
        let base = sent(&[1.0; 6]);
        let same = v1::MarkerFrame {
            number: 8,
            ..base.clone()
        };
        assert_eq!(content_hash(&base), content_hash(&same));
        let others = [
            v1::MarkerFrame {
                capture_time_nanos: 1,
                ..base.clone()
            },
            v1::MarkerFrame {
                source_frame: 1,
                ..base.clone()
            },
            v1::MarkerFrame {
                timecode: Some(v1::Timecode::default()),
                ..base.clone()
            },
            sent(&[1.0, 1.0, 1.0, 1.0, 1.0, 1.5]),
        ];
        for other in others {
            assert_ne!(content_hash(&base), content_hash(&other));
        }
    }

    #[test]
    fn a_broken_time_of_day_costs_the_frame_nothing_else() {
        let bad = v1::MarkerFrame {
            timecode: Some(v1::Timecode {
                hours: 25,
                ..v1::Timecode::default()
            }),
            ..sent(&[])
        };
        let frame = frame(&bad, &shape(LengthUnit::Meter)).unwrap();
        assert!(frame.tag.timecode_invalid);
        assert!(frame.tag.timecode.is_none());
    }

    #[test]
    fn a_start_names_what_is_wrong_with_it() {
        let check = |change: fn(&mut v1::PublishStart), reason: &str| {
            let mut sent = a_start();
            change(&mut sent);
            assert_eq!(start(sent).unwrap_err().reason(), reason);
        };
        assert!(start(a_start()).is_ok());
        check(|it| it.session = "one".to_owned(), "NAME");
        check(|it| it.publisher = "a b".to_owned(), "NAME");
        check(|it| it.unit = 0, "UNIT");
        check(|it| it.unit = 9, "ENUM");
        check(|it| it.ingest = 9, "ENUM");
        check(|it| it.rate_hz = f64::NAN, "RATE");
        check(|it| it.rate_hz = 0.0, "RATE");
        check(|it| it.rate_hz = 10_001.0, "RATE");
        check(
            |it| it.marker_names = vec!["a".into(), "b".into(), "a".into()],
            "DUPLICATE_MARKER",
        );
        check(
            |it| it.marker_names = (0..1_025).map(|it| it.to_string()).collect(),
            "MARKER_COUNT",
        );
    }

    proptest! {
        /// Whatever floats are sent: a taken frame is finite and inside the volume, a refused one says why.
        #[test]
        fn any_coordinates_are_taken_or_named(bits in prop::collection::vec(any::<u32>(), 6)) {
            let positions: Vec<f32> = bits.into_iter().map(f32::from_bits).collect();
            match frame(&sent(&positions), &shape(LengthUnit::Centimeter)) {
                Ok(frame) => for point in frame.positions.iter().flatten() {
                    prop_assert!(point.0.iter().all(|it| it.abs() <= MAX_COORDINATE_CM));
                },
                Err(rejection) => prop_assert!(
                    ["NON_FINITE", "OUT_OF_VOLUME"].contains(&rejection.reason)
                ),
            }
        }
    }
}
