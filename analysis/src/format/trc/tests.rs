//! Takes that are read, and the lines with which others are refused.

use proptest::prelude::*;

use super::*;
use crate::{format::shared_data, timecode::Timecode};

const TAKE: &str = "PathFileType\t4\t(X/Y/Z)\ttake.trc
DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames
60\t60\t2\t2\tmm\t60\t1\t2
Frame#\tTime\tlid\t\t\tchin\t\t
\t\tX1\tY1\tZ1\tX2\tY2\tZ2

1\t0.000000\t1.5\t-2\t3e1\t4\t5\t6
2\t0.016667\t\t\t\t4\t\t6.25
";

fn take() -> TrcTake {
    TrcTake {
        rate_hz: 60.0,
        unit: LengthUnit::Millimeter,
        marker_names: vec!["lid".to_owned(), "chin".to_owned()],
        frames: vec![
            TrcFrame {
                number: 1,
                time_s: 0.0,
                positions: vec![[1.5, -2.0, 30.0], [4.0, 5.0, 6.0]],
            },
            TrcFrame {
                number: 2,
                time_s: 0.016_667,
                positions: vec![[f32::NAN; 3], [4.0, f32::NAN, 6.25]],
            },
        ],
        start_timecode: None,
    }
}

#[test]
fn timecode_and_remarks_stand_in_the_first_line_and_no_cell_is_a_formula() {
    let written = |text, rate| {
        let start_timecode = Some(Timecode::parse_at(text, rate).unwrap());
        let names = ["=lid".to_owned(), "chin".to_owned()];
        let take = take();
        let heading = TrcHeading {
            name: "-12A",
            rate_hz: take.rate_hz,
            unit: take.unit,
            marker_names: &names,
            first_frame: 1,
            n_frames: 2,
            start_timecode,
            remarks: &["frames=1-2".to_owned(), "@gaps".to_owned()],
        };
        let mut writer = TrcWriter::new(Vec::new(), &heading).unwrap();
        for frame in &take.frames {
            writer.write_frame(frame).unwrap();
        }
        let text = String::from_utf8(writer.finish().unwrap()).unwrap();
        assert_eq!(accepted(&text).start_timecode, start_timecode);
        text
    };
    let drop = written("01:02:03;04", "30000/1001");
    let first =
        "PathFileType\t4\t(X/Y/Z)\t'-12A\ttimecode=01:02:03;04@30000/1001\tframes=1-2\t'@gaps\n";
    assert!(drop.starts_with(first), "{drop}");
    assert!(drop.contains("\t'=lid\t"), "{drop}");
    written("23:59:59:24", "25/1");
    let odd = drop.replace("30000/1001", "30/0");
    assert_eq!(accepted(&odd).start_timecode, None);
}

/// Equal to the bit, where NaN equals NaN.
fn assert_same(a: &TrcTake, b: &TrcTake) {
    let bits = |take: &TrcTake| -> Vec<_> {
        let frames = take.frames.iter();
        frames
            .map(|it| {
                let positions = it.positions.iter().map(|it| it.map(f32::to_bits));
                (
                    it.number,
                    it.time_s.to_bits(),
                    positions.collect::<Vec<_>>(),
                )
            })
            .collect()
    };
    assert_eq!(a.rate_hz.to_bits(), b.rate_hz.to_bits());
    assert_eq!((a.unit, &a.marker_names), (b.unit, &b.marker_names));
    assert_eq!(bits(a), bits(b));
}

fn accepted(text: &str) -> TrcTake {
    parse(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn refused(from: &str, to: &str) -> (usize, TrcProblem) {
    assert!(TAKE.contains(from), "{from:?}");
    let error = parse(TAKE.replacen(from, to, 1).as_bytes()).unwrap_err();
    (error.line, error.problem)
}

#[test]
fn a_take_is_read_with_markers_that_were_not_seen() {
    assert_same(&accepted(TAKE), &take());
}

#[test]
fn line_ends_commas_a_byte_order_mark_and_trailing_separators_make_no_difference() {
    for variant in [
        TAKE.replace('\n', "\r\n"),
        TAKE.replace('\t', ","),
        format!("\u{feff}{TAKE}"),
        TAKE.replace("\n\n", "\n\t\t\t\n").replace('\n', "\t\t\n"),
        TAKE.replace("Z2\n\n", "Z2\n"),
        TAKE.replace("\tlid\t", "\t lid \t"),
        TAKE.trim_end().to_owned(),
        TAKE.replace("60\t60", "60.00\t 60.0"),
        TAKE.replace("\tmm\t", "\tMM\t"),
        format!("{TAKE}\t\t\t\n\n"),
    ] {
        assert_same(&accepted(&variant), &take());
    }
}

#[test]
fn cells_that_an_editor_dropped_from_a_lines_end_are_empty() {
    let read = accepted(&TAKE.replace("4\t\t6.25\n", "4\n"));
    assert!(read.frames[1].positions[1][0] > 3.0);
    assert!(read.frames[1].positions[1][1].is_nan() && read.frames[1].positions[1][2].is_nan());
}

#[test]
fn units_are_those_of_the_file() {
    for unit in [
        LengthUnit::Millimeter,
        LengthUnit::Centimeter,
        LengthUnit::Meter,
    ] {
        let text = TAKE.replace("\tmm\t", &format!("\t{}\t", unit.symbol()));
        assert_eq!(accepted(&text).unit, unit);
    }
    let (line, problem) = refused("\tmm\t", "\tin\t");
    assert_eq!(
        (line, problem.to_string().as_str()),
        (3, "Units is in; mm, cm or m are known")
    );
}

#[test]
fn times_are_rounded_to_nanoseconds() {
    let nanos: Vec<_> = take()
        .frames
        .iter()
        .map(TrcFrame::capture_time_nanos)
        .collect();
    assert_eq!(nanos, [0, 16_667_000]);
    let late = TrcFrame {
        number: 1,
        time_s: 1e300,
        positions: Vec::new(),
    };
    assert_eq!(late.capture_time_nanos(), i64::MAX);
}

#[test]
fn a_broken_header_is_refused_with_its_line() {
    use TrcProblem as P;
    assert_eq!(refused("PathFileType", "Path"), (1, P::NotTrc));
    assert_eq!(
        refused("NumMarkers", "Markers"),
        (3, P::MissingKey("NumMarkers"))
    );
    assert_eq!(refused("Units", "Unit"), (3, P::MissingKey("Units")));
    for rate in ["0", "-60", "nan", "inf", "x", ""] {
        assert_eq!(
            refused("60\t60\t2", &format!("{rate}\t60\t2")),
            (3, P::Rate)
        );
    }
    for count in ["0", "-1", "1025", "4000000000", "2.5", ""] {
        assert_eq!(
            refused("60\t2\t2\t", &format!("60\t2\t{count}\t")),
            (3, P::MarkerCount)
        );
    }
    assert_eq!(
        refused("\tchin", "\t"),
        (
            4,
            P::NameCount {
                expected: 2,
                found: 1
            }
        )
    );
    assert_eq!(
        refused("\tlid", "\t"),
        (
            4,
            P::NameCount {
                expected: 2,
                found: 0
            }
        )
    );
    assert_eq!(
        refused("60\t2\t2\t", "60\t2\t1\t"),
        (
            4,
            P::NameCount {
                expected: 1,
                found: 2
            }
        )
    );
    assert_eq!(
        refused("\tchin\t\t", "\tchin\t\t\t\t\t\tnose"),
        (
            4,
            P::NameCount {
                expected: 2,
                found: 3
            }
        )
    );
    assert_eq!(
        refused("\tchin", "\tlid"),
        (
            4,
            P::DuplicateName {
                name: "lid".to_owned()
            }
        )
    );
    assert_eq!(
        parse(b"").unwrap_err(),
        TrcError {
            line: 1,
            problem: P::HeaderEnds
        }
    );
}

#[test]
fn a_broken_row_is_refused_with_its_line_and_cell() {
    use TrcProblem as P;
    for number in ["", "-1", "1.5", "x", "18446744073709551616"] {
        assert_eq!(
            refused("\n2\t0", &format!("\n{number}\t0")),
            (8, P::FrameNumber)
        );
    }
    for time in ["", "nan", "inf", "0,5"] {
        assert_eq!(refused("0.016667", time), (8, P::Time));
    }
    let chin = || "chin".to_owned();
    assert_eq!(
        refused("6.25", "6,25"),
        (
            8,
            P::NotANumber {
                marker: chin(),
                axis: 'z'
            }
        )
    );
    for value in ["inf", "-Infinity", "1e39"] {
        assert_eq!(
            refused("\t5\t", &format!("\t{value}\t")),
            (
                7,
                P::NonFinite {
                    marker: chin(),
                    axis: 'y'
                }
            )
        );
    }
    assert_eq!(
        refused("6.25", "6.25\t7"),
        (8, P::TooManyCells { expected: 2 })
    );
    assert_eq!(refused("\t4\t\t6.25\n", "\t4"), (8, P::CutRow));
}

#[test]
fn lines_and_takes_have_limits() {
    let long = format!("PathFileType\t{}\n", "x".repeat(MAX_LINE_BYTES));
    assert_eq!(
        parse(long.as_bytes()).unwrap_err().problem,
        TrcProblem::LineTooLong
    );
    let names: String = (0..1_024).fold(String::new(), |names, it| names + &format!("\tm{it}\t\t"));
    let header = TAKE
        .replace("60\t2\t2\t", "60\t2\t1024\t")
        .replace("\tlid\t\t\tchin\t\t", &names);
    let header = &header[..header.find("1\t0.0").unwrap()];
    let rows = "1\t0\n".repeat(MAX_POSITIONS / 1_024 + 1);
    let error = parse(format!("{header}{rows}").as_bytes()).unwrap_err();
    assert_eq!(error.problem, TrcProblem::TooLong);
}

#[test]
fn real_takes_are_read_whole_and_written_back_to_the_same_bits() {
    let test = "real_takes_are_read_whole_and_written_back_to_the_same_bits";
    for (path, rate_hz, n_markers, n_frames) in [
        ("takes/ns164_muscle16_27_moving.trc", 60.0, 27, 930),
        ("takes/facegood_speech_muscle16_27_still.trc", 30.0, 27, 930),
        ("takes/llv_facs30_60_moving.trc", 60.0, 60, 210),
        ("trc/btk__TRCSamples__Anto.trc", 100.0, 34, 128),
        ("trc/btk__TRCSamples__Knee.trc", 200.0, 71, 200),
        ("trc/btk__TRCSamples__MOTEK__T.trc", 30.0, 41, 89),
        // Says 652 frames and has 93.
        ("trc/pyomeca__markers.trc", 100.0, 51, 93),
        ("optical_face/animface_Jaw_41m_60Hz.trc", 60.0, 41, 1_590),
    ] {
        let Some(bytes) = shared_data::read(path, test) else {
            continue;
        };
        let take = parse(&bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
        let unseen = take
            .frames
            .iter()
            .flat_map(|it| &it.positions)
            .filter(|it| it[0].is_nan())
            .count();
        println!(
            "{path}: {} frames, {unseen} positions not seen",
            take.frames.len()
        );
        assert!((take.rate_hz - rate_hz).abs() < 1e-9, "{path}");
        assert_eq!(
            (take.marker_names.len(), take.frames.len()),
            (n_markers, n_frames),
            "{path}"
        );
        assert_same(&accepted(&write(&take, "again")), &take);
    }
}

#[test]
fn the_first_row_of_a_real_take_is_what_the_file_says() {
    let Some(bytes) = shared_data::read(
        "takes/llv_muscle16_27_moving.trc",
        "the_first_row_of_a_real_take_is_what_the_file_says",
    ) else {
        return;
    };
    let take = parse(&bytes).unwrap();
    assert_eq!(take.marker_names[0], "brow_17");
    let first = &take.frames[0];
    let expected = [-147.4522_f32, 12.8664, 284.3014].map(f32::to_bits);
    assert_eq!((first.number, first.capture_time_nanos()), (1, 0));
    assert_eq!(first.positions[0].map(f32::to_bits), expected);
    let times: Vec<_> = take
        .frames
        .iter()
        .map(TrcFrame::capture_time_nanos)
        .collect();
    assert!(times.is_sorted_by(|a, b| a < b));
}

#[test]
fn rows_that_are_not_the_headings_are_refused() {
    let take = take();
    let heading = TrcHeading {
        name: "take",
        rate_hz: take.rate_hz,
        unit: take.unit,
        marker_names: &take.marker_names,
        first_frame: 1,
        n_frames: 1,
        start_timecode: None,
        remarks: &[],
    };
    let mut writer = TrcWriter::new(Vec::new(), &heading).unwrap();
    let short = TrcFrame {
        positions: vec![[0.0; 3]],
        ..take.frames[0].clone()
    };
    let error = writer.write_frame(&short).unwrap_err();
    assert_eq!(error.to_string(), "a row has 1 positions; 2 are expected");
    writer.write_frame(&take.frames[0]).unwrap();
    let error = writer.write_frame(&take.frames[1]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "2 rows were written; the heading states 1"
    );
    let writer = TrcWriter::new(Vec::new(), &heading).unwrap();
    let error = writer.finish().unwrap_err();
    assert_eq!(
        error.to_string(),
        "0 rows were written; the heading states 1"
    );
}

#[test]
fn a_take_cut_at_any_byte_is_read_up_to_there_or_refused() {
    for end in 0..TAKE.len() {
        if let Ok(read) = parse(&TAKE.as_bytes()[..end]) {
            assert_eq!(read.marker_names, take().marker_names);
            assert!(read.frames.len() <= 2);
        }
    }
}

proptest! {
    #[test]
    fn what_is_written_reads_back_to_the_same_bits(
        rate_hz in 1.0..1000.0,
        frames in prop::collection::vec((any::<u64>(), -1e4..1e4, prop::array::uniform3(prop::option::of(-1e5f32..1e5))), 0..9),
    ) {
        let frames = frames.into_iter().map(|(number, time_s, position)| TrcFrame {
            number,
            time_s,
            positions: vec![position.map(|it| it.unwrap_or(f32::NAN)), [0.0, -0.0, 1e-40]],
        });
        let written = TrcTake { rate_hz, frames: frames.collect(), ..take() };
        assert_same(&accepted(&write(&written, "name\twith\ntraps")), &written);
    }

    #[test]
    fn no_change_of_a_few_bytes_makes_the_reader_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
    ) {
        let mut bytes = TAKE.as_bytes().to_vec();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        match parse(&bytes) {
            Err(error) => prop_assert!(error.line <= 10 && error.to_string().len() < 1_000),
            // The short form of the fuzz target; control characters in a name become `_`.
            Ok(take) => {
                let names = take.marker_names.iter().map(|it| it.replace(char::is_control, "_"));
                let marker_names = names.collect();
                assert_same(&accepted(&write(&take, "again")), &TrcTake { marker_names, ..take });
            }
        }
    }
}
