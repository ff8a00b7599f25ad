//! Takes of three processors and two kinds of storage, what is written and read again, and what is refused.

mod by_hand;
mod real_files;
mod refused;

use proptest::prelude::*;

use super::*;
use crate::timecode::{Counting, TimecodeRate};
use by_hand::{ByHand, PROCESSORS};

fn heading() -> C3dHeading {
    C3dHeading {
        rate_hz: 120.0,
        unit: Some(LengthUnit::Millimeter),
        first_frame: 1,
        n_frames: 2,
        marker_names: vec!["lid".to_owned(), "chin".to_owned()],
        start_timecode: None,
    }
}

fn point(x: f32, y: f32, z: f32) -> C3dPoint {
    C3dPoint {
        position: [x, y, z],
        residual: 0.0,
        cameras: 0,
    }
}

type Frames = Vec<Vec<Option<C3dPoint>>>;

fn frames() -> Frames {
    let seen = C3dPoint {
        residual: 7.0 * 0.1,
        cameras: 0b101_0001,
        ..point(1.5, -2.25, 30.0)
    };
    vec![
        vec![Some(seen), None],
        vec![Some(point(0.0, -0.0, 1e-40)), Some(point(4.0, 5.0, 1e30))],
    ]
}

fn written(heading: &C3dHeading, frames: &[Vec<Option<C3dPoint>>]) -> Vec<u8> {
    let mut writer = C3dWriter::new(Vec::new(), heading).unwrap();
    for frame in frames {
        writer.write_frame(frame).unwrap();
    }
    writer.finish().unwrap()
}

fn all(take: &C3dTake<'_>) -> Frames {
    take.frames().map(Result::unwrap).collect()
}

/// Equal to the bit.
fn assert_same(found: &Frames, expected: &Frames) {
    let bits = |frames: &Frames| -> Vec<Vec<_>> {
        let point = |it: &C3dPoint| {
            (
                it.position.map(f32::to_bits),
                it.residual.to_bits(),
                it.cameras,
            )
        };
        let frame =
            |it: &Vec<Option<C3dPoint>>| it.iter().map(|it| it.as_ref().map(point)).collect();
        frames.iter().map(frame).collect()
    };
    assert_eq!(bits(found), bits(expected));
}

#[test]
fn what_is_written_is_read() {
    let bytes = written(&heading(), &frames());
    assert_eq!(bytes.len() % 512, 0);
    let take = C3dTake::open(&bytes).unwrap();
    assert_eq!(take.heading(), &heading());
    assert_same(&all(&take), &frames());
}

#[test]
fn the_first_frames_timecode_survives() {
    for text in ["01:02:03;04", "23:59:59;29"] {
        let timecode = Timecode::parse(text, TimecodeRate::NTSC_DROP).unwrap();
        let heading = C3dHeading {
            start_timecode: Some(timecode),
            ..heading()
        };
        let bytes = written(&heading, &frames());
        assert_eq!(C3dTake::open(&bytes).unwrap().heading(), &heading);
    }
}

#[test]
fn takes_go_beyond_65_535_frames() {
    for first_frame in [1, 100_000] {
        let heading = C3dHeading {
            first_frame,
            n_frames: 70_000,
            marker_names: vec!["chin".to_owned()],
            ..heading()
        };
        let numbered = |frame: u32| point(frame as f32, 0.0, 0.0);
        let frames: Frames = (0..70_000).map(|it| vec![Some(numbered(it))]).collect();
        let bytes = written(&heading, &frames);
        let take = C3dTake::open(&bytes).unwrap();
        assert_eq!(take.heading(), &heading);
        assert_same(&all(&take), &frames);
        // Readers that know the header alone read on to the end, which must be that of the last frame.
        let frames_end = take.layout.start + 70_000 * take.layout.frame_bytes();
        assert_eq!(bytes.len(), frames_end);
    }
}

#[test]
fn labels_go_beyond_the_255th_point() {
    for n_markers in [255, 256, 600, 1_024] {
        let heading = C3dHeading {
            n_frames: 1,
            marker_names: (0..n_markers).map(|it| format!("marker_{it}")).collect(),
            ..heading()
        };
        let frame: Vec<_> = (0..n_markers)
            .map(|it| Some(point(it as f32, 1.0, 2.0)))
            .collect();
        let bytes = written(&heading, std::slice::from_ref(&frame));
        let take = C3dTake::open(&bytes).unwrap();
        assert_eq!(take.heading(), &heading);
        assert_same(&all(&take), &vec![frame]);
    }
}

#[test]
fn the_most_and_longest_names_fit() {
    let heading = C3dHeading {
        n_frames: 70_000,
        marker_names: (0..1_024).map(|it| format!("{it:0127}")).collect(),
        start_timecode: Some(Timecode::from_frame_count(
            0,
            TimecodeRate::new(u32::MAX, u32::MAX, Counting::NonDrop).unwrap(),
        )),
        ..heading()
    };
    let mut bytes = Vec::new();
    C3dWriter::new(&mut bytes, &heading).unwrap();
    let error = C3dTake::open(&bytes).unwrap_err();
    assert_eq!(error.problem, C3dProblem::TooLong);
}

#[test]
fn labels_that_are_the_same_are_told_apart_by_number() {
    let heading = C3dHeading {
        marker_names: ["lid", "chin", "lid"].map(str::to_owned).to_vec(),
        n_frames: 1,
        ..heading()
    };
    let bytes = written(&heading, &[vec![None; 3]]);
    let take = C3dTake::open(&bytes).unwrap();
    assert_eq!(take.heading().marker_names, ["lid_1", "chin", "lid_3"]);
}

#[test]
fn every_processor_and_storage_gives_the_same_take() {
    for processor in PROCESSORS {
        for is_integer in [false, true] {
            let bytes = ByHand::new(processor, is_integer).file();
            let take = C3dTake::open(&bytes).unwrap_or_else(|error| panic!("{processor}: {error}"));
            let expected = C3dHeading {
                rate_hz: 59.5,
                unit: Some(LengthUnit::Centimeter),
                first_frame: 5,
                n_frames: 2,
                marker_names: vec!["lid".to_owned(), "unlabeled_2".to_owned()],
                start_timecode: None,
            };
            assert_eq!(take.heading(), &expected);
            let seen = C3dPoint {
                residual: 0.5,
                cameras: 0b101,
                ..point(-12.5, 100.0, 0.25)
            };
            let expected = vec![
                vec![Some(seen), None],
                vec![Some(point(3.0, 0.0, -0.5)), Some(point(1.0, 2.0, 3.0))],
            ];
            assert_same(&all(&take), &expected);
        }
    }
}

#[test]
fn a_gap_is_a_negative_residual_or_a_coordinate_that_is_no_number() {
    for (place, value) in [(3, -1.0_f32), (0, f32::NAN), (2, f32::NAN), (3, f32::NAN)] {
        let mut bytes = written(&heading(), &frames());
        let data = C3dTake::open(&bytes).unwrap().layout.start;
        bytes[data + 4 * place..][..4].copy_from_slice(&value.to_le_bytes());
        assert_eq!(all(&C3dTake::open(&bytes).unwrap())[0], vec![None, None]);
    }
}

#[test]
fn a_heading_that_cannot_be_written_is_refused() {
    let refused =
        |heading: &C3dHeading| C3dWriter::new(Vec::new(), heading).unwrap_err().to_string();
    let none = C3dHeading {
        marker_names: Vec::new(),
        ..heading()
    };
    assert_eq!(refused(&none), "0 markers; between 1 and 1024 are expected");
    let long = C3dHeading {
        marker_names: vec!["m".repeat(128)],
        ..heading()
    };
    assert!(refused(&long).ends_with("has more than 127 bytes"));
    let empty = C3dHeading {
        n_frames: 0,
        ..heading()
    };
    assert_eq!(refused(&empty), "no frames; a C3D has at least one");
    let late = C3dHeading {
        first_frame: u32::MAX,
        ..heading()
    };
    assert!(refused(&late).contains("go beyond frame number"));
}

#[test]
fn frames_that_are_not_the_headings_are_refused() {
    let mut writer = C3dWriter::new(Vec::new(), &heading()).unwrap();
    let error = writer.write_frame(&[None]).unwrap_err();
    assert_eq!(error.to_string(), "a frame has 1 points; 2 are expected");
    let error = writer.write_frame(&[None, Some(point(0.0, f32::NAN, 0.0))]);
    assert!(error.unwrap_err().to_string().starts_with("marker 1 "));
    writer.write_frame(&[None, None]).unwrap();
    writer.write_frame(&[None, None]).unwrap();
    let error = writer.write_frame(&[None, None]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "3 frames were written; the heading states 2"
    );
    let writer = C3dWriter::new(Vec::new(), &heading()).unwrap();
    let error = writer.finish().unwrap_err();
    assert_eq!(
        error.to_string(),
        "0 frames were written; the heading states 2"
    );
}

fn any_point() -> impl Strategy<Value = Option<C3dPoint>> {
    let finite = || any::<f32>().prop_filter("finite", |it| it.is_finite());
    let point = (prop::array::uniform3(finite()), any::<u8>(), 0_u8..128);
    let point = point.prop_map(|(position, residual, cameras)| C3dPoint {
        position,
        residual: f32::from(residual) * 0.1,
        cameras,
    });
    prop::option::of(point)
}

proptest! {
    #[test]
    fn whatever_is_written_reads_back_to_the_same_bits(
        rate_hz in 1.0_f32..1000.0,
        first_frame in any::<u32>(),
        unit in prop::sample::select(vec![None, Some(LengthUnit::Millimeter), Some(LengthUnit::Meter)]),
        frames in prop::collection::vec(prop::collection::vec(any_point(), 2), 1..9),
    ) {
        let n_frames = u32::try_from(frames.len()).unwrap();
        let first_frame = first_frame.min(u32::MAX - n_frames);
        let heading = C3dHeading { rate_hz: f64::from(rate_hz), first_frame, unit, n_frames, ..heading() };
        let bytes = written(&heading, &frames);
        let take = C3dTake::open(&bytes).unwrap();
        prop_assert_eq!(take.heading(), &heading);
        assert_same(&all(&take), &frames);
    }
}
