//! Starts and frames of every kind, good and bad.

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
fn a21_number_zero_is_refused_for_what_it_is() {
    let zero = v1::MarkerFrame {
        number: 0,
        ..sent(&[0.0; 6])
    };
    let rejection = frame(&zero, &shape(LengthUnit::Centimeter)).unwrap_err();
    assert_eq!(rejection.reason, "FRAME_NUMBER");
    assert_eq!(rejection.detail, "frame numbers start at 1");
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
fn a28_a_wrong_checksum_is_refused_and_a_right_one_is_not() {
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
