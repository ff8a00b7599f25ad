//! Files of six programs, beside what two independent readers found in them.

use serde_json::Value;

use super::*;
use crate::format::{shared_data, trc};

fn close(found: f64, expected: f64) -> bool {
    // The expected values have five places.
    (found - expected).abs() <= 2e-5 + 2e-7 * expected.abs()
}

fn xyz(expected: &Value) -> [f64; 3] {
    std::array::from_fn(|axis| expected[axis].as_f64().unwrap())
}

fn index(expected: &Value) -> usize {
    usize::try_from(expected.as_u64().unwrap()).unwrap()
}

fn check(path: &str, bytes: &[u8], expected: &Value) {
    let take = C3dTake::open(bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
    let heading = take.heading();
    assert_eq!(
        heading.n_frames as usize,
        index(&expected["frames"]),
        "{path}"
    );
    assert_eq!(
        heading.marker_names.len(),
        index(&expected["points"]),
        "{path}"
    );
    assert!(
        close(heading.rate_hz, expected["rate"].as_f64().unwrap()),
        "{path}"
    );
    let labels = expected["labels_first"].as_array().unwrap();
    for (number, (label, expected)) in (1..).zip(heading.marker_names.iter().zip(labels)) {
        // One file cuts its labels to eight letters, so that two points share one.
        let expected = expected.as_str().unwrap();
        let numbered = format!("{expected}_{number}");
        assert!(label == expected || *label == numbered, "{path}: {label}");
    }
    let frames = all(&take);
    let unseen = frames.iter().flatten().filter(|it| it.is_none()).count();
    assert_eq!(unseen, index(&expected["invalid"]), "{path}");
    let [frame, marker] = [0, 1].map(|it| index(&expected["first_valid"][it]));
    let first = frames[frame][marker].unwrap().position;
    let expected_first = xyz(&expected["xyz"]);
    let seen: Vec<_> = frames.iter().flatten().flatten().collect();
    let expected_mean = xyz(&expected["nanmean_xyz"]);
    for axis in 0..3 {
        assert!(
            close(f64::from(first[axis]), expected_first[axis]),
            "{path}: {first:?}"
        );
        let sum: f64 = seen.iter().map(|it| f64::from(it.position[axis])).sum();
        let mean = sum / seen.len() as f64;
        assert!(close(mean, expected_mean[axis]), "{path}: {mean}");
    }
}

#[test]
fn real_files_hold_what_independent_readers_found() {
    let test = "real_files_hold_what_independent_readers_found";
    let Some(expected) = shared_data::read("c3d/expected_values.json", test) else {
        return;
    };
    let expected: serde_json::Map<String, Value> = serde_json::from_slice(&expected).unwrap();
    for (path, readers) in &expected {
        let Some(bytes) = shared_data::read(&format!("c3d/{path}"), test) else {
            continue;
        };
        // ezc3d refuses MIPS, and counts 673 gaps in the one file without ANALOG:RATE, where a point every 632 bytes with
        // residual −1 makes 1,232; py-c3d reads all files.
        check(path, &bytes, &readers["py-c3d"]);
        let units = readers["ezc3d"]["units"].as_array();
        let unit = units.map(|it| (!it.is_empty()).then_some(LengthUnit::Millimeter));
        let take = C3dTake::open(&bytes).unwrap();
        assert!(unit.is_none_or(|it| it == take.heading().unit), "{path}");
        let again = written(take.heading(), &all(&take));
        check(path, &again, &readers["py-c3d"]);
    }
}

#[test]
fn six_files_of_one_take_differ_by_their_rounding_alone() {
    let test = "six_files_of_one_take_differ_by_their_rounding_alone";
    let mut takes = Vec::new();
    for kind in ["pi", "pr", "si", "sr", "vi", "vr"] {
        let path = format!("c3d/btk__C3DSamples__c3d.org__sample01__Eb015{kind}.c3d");
        let Some(bytes) = shared_data::read(&path, test) else {
            return;
        };
        takes.push(all(&C3dTake::open(&bytes).unwrap()));
    }
    let (first, others) = takes.split_first().unwrap();
    for other in others {
        let pairs = first.iter().flatten().zip(other.iter().flatten());
        for (a, b) in pairs {
            assert_eq!(a.is_some(), b.is_some());
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!(a.cameras, b.cameras);
            assert!((a.residual - b.residual).abs() < 1e-4);
            let error = (0..3).map(|axis| (a.position[axis] - b.position[axis]).abs());
            assert!(error.fold(0.0, f32::max) < 1e-3, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_take_is_the_same_as_c3d_and_as_trc() {
    let test = "a_take_is_the_same_as_c3d_and_as_trc";
    for name in ["Jaw", "Eyebrows"] {
        let read = |kind: &str| {
            shared_data::read(
                &format!("optical_face/animface_{name}_41m_60Hz.{kind}"),
                test,
            )
        };
        let (Some(c3d), Some(table)) = (read("c3d"), read("trc")) else {
            return;
        };
        let (take, table) = (C3dTake::open(&c3d).unwrap(), trc::parse(&table).unwrap());
        assert_eq!(take.heading().marker_names, table.marker_names);
        assert_eq!(take.heading().unit, Some(table.unit));
        assert_eq!(take.frames().len(), table.frames.len());
        for (frame, row) in all(&take).iter().zip(&table.frames) {
            for (point, expected) in frame.iter().zip(&row.positions) {
                let point = point.map_or([f32::NAN; 3], |it| it.position);
                let is_same = |axis: usize| {
                    (point[axis] - expected[axis]).abs() < 1e-3
                        || point[axis].is_nan() && expected[axis].is_nan()
                };
                assert!((0..3).all(is_same), "{point:?} {expected:?}");
            }
        }
    }
}
