//! A take in every format, while it grows and when it is over, and what cannot be exported.

use frontalis_analysis::{
    format::{c3d::C3dTake, trc},
    space::LengthUnit,
    synthesis::reference_face,
};
use frontalis_proto::v1::{
    CurveSample, Gap, GapCause, MarkerFrame, TakeEvent, TakeHeader, TakeSource, Timecode,
    take_event::Event,
};
use prost::Message as _;
use sha2::{Digest as _, Sha256};

use super::*;
use crate::{
    fs::MemFs,
    take::{
        Channel,
        chunk::{ChunkBuffer, Message},
        rewrite::rewrite,
    },
};

const DIR: &str = "/takes";
const NAME: &str = "stage-1.mcap";
const RATE_HZ: f64 = 120.0;

/// Everything that a take may hold: late frames, gaps, a second publisher with another order and unit, dropped samples.
fn messages() -> Vec<(Channel, Vec<u8>)> {
    let names = |names: [&str; 2]| names.map(str::to_owned).to_vec();
    let muscles = reference_face::actor().muscle_set().muscles().to_vec();
    let header = TakeHeader {
        controls: muscles.iter().map(|it| it.name.clone()).collect(),
        markers: names(["lid", "chin"]),
        ..TakeHeader::default()
    };
    let source = |marker_names, unit: frontalis_proto::v1::LengthUnit| TakeSource {
        marker_names,
        unit: unit.into(),
        rate_hz: RATE_HZ,
        ..TakeSource::default()
    };
    let event = |event| {
        let data = TakeEvent { event: Some(event) }.encode_to_vec();
        (Channel::Events, data)
    };
    let frame = |number: u64, positions: Vec<f32>| {
        let frame = MarkerFrame {
            number,
            capture_time_nanos: nanos(number),
            positions,
            timecode: Some(timecode(number)),
            ..MarkerFrame::default()
        };
        (Channel::Markers, frame.encode_to_vec())
    };
    let sample = |number: u64| {
        let sample = CurveSample {
            frame: number,
            capture_time_nanos: nanos(number),
            timecode: Some(timecode(number)),
            activations: vec![number as f32 / 16.0; muscles.len()],
            quality: 1,
            ..CurveSample::default()
        };
        (Channel::Curves, sample.encode_to_vec())
    };
    let gap = Gap {
        first: 13,
        last: 14,
        cause: GapCause::Rejected.into(),
    };
    vec![
        event(Event::Header(header)),
        event(Event::Source(source(
            names(["lid", "chin"]),
            frontalis_proto::v1::LengthUnit::Millimeter,
        ))),
        frame(10, vec![1.5, -2.0, 3.0, f32::NAN, f32::NAN, f32::NAN]),
        frame(11, vec![0.1, 0.2, 0.3, 4.0, f32::NAN, 6.0]),
        sample(10),
        sample(11),
        frame(12, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        event(Event::Gap(gap)),
        frame(9, vec![9.0; 6]),
        event(Event::Source(source(
            names(["chin", "=brow"]),
            frontalis_proto::v1::LengthUnit::Centimeter,
        ))),
        frame(15, vec![0.5, 0.25, 0.125, 1.0, 1.0, 1.0]),
        sample(12),
        sample(15),
    ]
}

fn nanos(number: u64) -> i64 {
    1_000_000_000 + i64::try_from(number).unwrap() * 8_000_000
}

/// 30 labels a second, four frames each; the first frame is at the last label of a minute that drops two.
fn timecode(number: u64) -> Timecode {
    let is_first = number < 12;
    Timecode {
        hours: 1,
        minutes: u32::from(!is_first),
        seconds: if is_first { 59 } else { 0 },
        frames: if is_first { 29 } else { 2 },
        rate_numerator: 30_000,
        rate_denominator: 1_001,
        drop_frame: true,
        ..Timecode::default()
    }
}

fn store(fs: &MemFs, messages: &[(Channel, Vec<u8>)]) {
    let mut file = fs.create(&PathBuf::from(DIR).join(NAME)).unwrap();
    file.append(crate::take::head::growing_head().unwrap())
        .unwrap();
    for (sequence, (channel, data)) in (0..).zip(messages) {
        let mut chunk = ChunkBuffer::default();
        chunk.add(&Message {
            channel: *channel,
            sequence,
            time_nanos: u64::from(sequence),
            data,
        });
        file.append(&chunk.take()).unwrap();
    }
    file.sync().unwrap();
}

fn source(fs: &MemFs) -> ExportSource {
    ExportSource {
        fs: Arc::new(fs.clone()),
        file: PathBuf::from(DIR).join(NAME),
        n_bytes: u64::MAX,
        take: v1::Take {
            name: "takes/stage-1".to_owned(),
            slate: "12A".to_owned(),
            number: 3,
            ..v1::Take::default()
        },
        actor: Some(Arc::new(reference_face::actor())),
    }
}

/// The bytes of an export, with its last words, which agree with them and with the first ones.
fn exported(source: ExportSource, format: TakeFormat) -> (Vec<u8>, v1::TakeExport) {
    rest(Export::start(source, format).unwrap())
}

/// How long the file is with so many of its messages, one a commit.
fn n_bytes_of(fs: &MemFs, n_messages: usize) -> u64 {
    let whole = fs.read(&source(fs).file).unwrap();
    let part = MemFs::default();
    store(&part, &messages()[..n_messages]);
    let n_bytes = part.read(&source(&part).file).unwrap().len();
    assert!(n_bytes < whole.len());
    n_bytes as u64
}

fn rest(mut export: Export) -> (Vec<u8>, v1::TakeExport) {
    let (mut first, mut last, mut bytes) = (None, None, Vec::new());
    loop {
        match export.step().unwrap() {
            Step::Working => {}
            Step::Over => break,
            Step::Piece(piece) => {
                let piece = *piece;
                assert!(piece.chunk.len() <= PIECE_BYTES);
                assert!(last.is_none(), "the last words are the last");
                bytes.extend(piece.chunk);
                match piece.export {
                    Some(told) if first.is_none() => first = Some(told),
                    told => last = told,
                }
            }
        }
    }
    let last = last.unwrap();
    assert_eq!(last.n_bytes, bytes.len() as u64);
    assert_eq!(last.sha256, format!("{:x}", Sha256::digest(&bytes)));
    let first = first.unwrap();
    let as_first = v1::TakeExport {
        n_bytes: first.n_bytes,
        sha256: String::new(),
        ..last.clone()
    };
    assert_eq!(as_first, first);
    (bytes, last)
}

fn text(format: TakeFormat) -> (String, v1::TakeExport) {
    let fs = MemFs::default();
    store(&fs, &messages());
    let (bytes, told) = exported(source(&fs), format);
    (String::from_utf8(bytes).unwrap(), told)
}

const FORMATS: [TakeFormat; 5] = [
    TakeFormat::Csv,
    TakeFormat::LiveLinkCsv,
    TakeFormat::Glb,
    TakeFormat::Trc,
    TakeFormat::C3d,
];

#[test]
fn a_take_that_grows_and_one_that_is_over_give_the_same_bytes() {
    let fs = MemFs::default();
    store(&fs, &messages());
    let mut growing = Vec::new();
    for format in FORMATS {
        growing.push(exported(source(&fs), format));
    }
    // One that was surveyed while the take was shorter, and then replaced, is what it was then.
    let shorter = ExportSource {
        n_bytes: n_bytes_of(&fs, 9),
        ..source(&fs)
    };
    let (expected, _) = exported(shorter.clone(), TakeFormat::Trc);
    let mut begun = Export::start(shorter, TakeFormat::Trc).unwrap();
    assert_eq!(begun.step().unwrap(), Step::Working);
    rewrite(&fs, DIR.as_ref(), NAME).unwrap();
    assert_eq!(rest(begun).0, expected);
    for (format, growing) in FORMATS.into_iter().zip(growing) {
        assert_eq!(exported(source(&fs), format), growing, "{format:?}");
    }
}

#[test]
fn a_table_of_muscles_has_a_row_a_sample() {
    let (text, told) = text(TakeFormat::Csv);
    let mut lines = text.lines();
    let heading = lines.next().unwrap();
    assert!(heading.starts_with("frame,capture_time_nanos,quality,timecode,"));
    assert_eq!(heading.split(',').count(), 4 + 16);
    let first = lines.next().unwrap();
    assert!(
        first.starts_with("10,1080000000,solved,01:00:59;29,0.625,"),
        "{first}"
    );
    assert_eq!(lines.count(), 3);
    assert_eq!(
        (told.first_frame, told.last_frame, told.n_frames),
        (10, 15, 4)
    );
    assert_eq!((told.n_gaps, told.n_missing_frames), (1, 2));
    assert_eq!(told.gaps[0].cause(), GapCause::Rejected);
    // The late one.
    assert_eq!(told.n_dropped_frames, 1);
    assert_eq!(told.start_timecode, Some(timecode(10)));
    assert_eq!(told.file_name, "12A_3.csv");
}

#[test]
fn live_link_rows_have_times_that_grow_inside_of_a_timecode() {
    let (text, told) = text(TakeFormat::LiveLinkCsv);
    let times: Vec<_> = text.lines().skip(1).map(|it| &it[..15]).collect();
    let expected = [
        "01:00:59:29.000",
        "01:00:59:29.239",
        "01:01:00:02.000",
        "01:01:00:02.719",
    ];
    assert_eq!(times, expected);
    assert!(text.lines().all(|it| it.split(',').count() == 63));
    assert_eq!(told.file_name, "12A_3_Frontalis.csv");
    assert_eq!(told.undriven_shapes.len(), 52 - 23);
}

#[test]
fn markers_of_all_publishers_stand_in_one_table_in_one_unit() {
    let (text, told) = text(TakeFormat::Trc);
    let take = trc::parse(text.as_bytes()).unwrap();
    assert_eq!(take.unit, LengthUnit::Millimeter);
    assert_eq!(take.marker_names, ["lid", "chin", "'=brow"]);
    assert_eq!(take.start_timecode.unwrap().to_string(), "01:00:59;29");
    let numbers: Vec<_> = take.frames.iter().map(|it| it.number).collect();
    assert_eq!(numbers, [10, 11, 12, 15]);
    assert!((take.frames[3].time_s - 0.04).abs() < 1e-12);
    let last = &take.frames[3].positions;
    assert!(last[0][0].is_nan());
    assert_eq!(
        last[1].map(f32::to_bits),
        [5.0, 2.5, 1.25].map(f32::to_bits)
    );
    assert_eq!(told.n_dropped_frames, 1);
    assert!(
        text.lines()
            .next()
            .unwrap()
            .ends_with("frames=10-15\tgaps=1\tmissing=2\tdropped=1")
    );
}

#[test]
fn a_c3d_has_a_place_for_every_number() {
    let fs = MemFs::default();
    store(&fs, &messages());
    let (bytes, told) = exported(source(&fs), TakeFormat::C3d);
    let take = C3dTake::open(&bytes).unwrap();
    let heading = take.heading();
    assert_eq!((heading.first_frame, heading.n_frames), (10, 6));
    assert_eq!(heading.marker_names, ["lid", "chin", "=brow"]);
    assert_eq!(heading.unit, Some(LengthUnit::Millimeter));
    assert_eq!(heading.start_timecode.unwrap().to_string(), "01:00:59;29");
    let frames: Vec<_> = take.frames().map(Result::unwrap).collect();
    assert!(frames[3].iter().chain(&frames[4]).all(Option::is_none));
    assert!(frames[1][1].is_none(), "one coordinate is missing");
    let chin = frames[5][1].unwrap().position;
    assert_eq!(chin.map(f32::to_bits), [5.0, 2.5, 1.25].map(f32::to_bits));
    assert_eq!((told.n_frames, told.n_missing_frames), (4, 2));
}

#[test]
fn a_face_moves_as_the_samples_say() {
    let fs = MemFs::default();
    store(&fs, &messages());
    let (bytes, _) = exported(source(&fs), TakeFormat::Glb);
    // 16 weights a sample at the end, of the last sample all 15/16.
    let last = &bytes[bytes.len() - 16 * 4..];
    let weights = last
        .chunks(4)
        .map(|it| f32::from_le_bytes(it.try_into().unwrap()));
    assert!(
        weights
            .into_iter()
            .all(|it| it.to_bits() == 0.9375_f32.to_bits())
    );
    let json = String::from_utf8_lossy(&bytes[..bytes.len() / 2]).into_owned();
    assert!(json.contains(r#""timecode":"01:00:59;29""#));
    assert!(json.contains(r#""missingFrames":2"#));
}

#[test]
fn the_stored_file_is_exported_as_far_as_it_is_on_stable_storage() {
    let fs = MemFs::default();
    store(&fs, &messages());
    let whole = fs.read(&source(&fs).file).unwrap();
    let n_bytes = whole.len() as u64 - 7;
    let part = ExportSource {
        n_bytes,
        ..source(&fs)
    };
    let (bytes, told) = exported(part, TakeFormat::Mcap);
    assert_eq!(bytes, whole[..whole.len() - 7]);
    assert_eq!((told.first_frame, told.last_frame), (10, 15));
}

#[test]
fn whatever_a_file_is_its_bytes_can_be_had_and_nothing_is_made_of_it() {
    let fs = MemFs::default();
    let nonsense = b"no take at all";
    fs.write_and_sync(&source(&fs).file, nonsense).unwrap();
    let (bytes, told) = exported(source(&fs), TakeFormat::Mcap);
    assert_eq!((bytes.as_slice(), told.n_frames), (&nonsense[..], 0));
    for format in FORMATS {
        let error = failure(source(&fs), format);
        assert!(!error.is_of_the_format(), "{format:?}: {error}");
    }
}

#[test]
fn a_take_without_rows_is_refused_where_a_format_needs_one() {
    let fs = MemFs::default();
    store(&fs, &messages()[..2]);
    for format in [TakeFormat::Glb, TakeFormat::C3d] {
        let error = failure(source(&fs), format);
        assert!(
            matches!(error, ExportError::Empty { .. }),
            "{format:?}: {error}"
        );
    }
    let (table, told) = exported(source(&fs), TakeFormat::Csv);
    assert_eq!(
        (
            String::from_utf8(table).unwrap().lines().count(),
            told.n_frames
        ),
        (1, 0)
    );
}

#[test]
fn a_jump_that_would_make_an_endless_c3d_is_refused_and_costs_nothing() {
    let fs = MemFs::default();
    let mut messages = messages();
    let far = MarkerFrame {
        number: 1 << 40,
        ..MarkerFrame::default()
    };
    messages.push((Channel::Markers, far.encode_to_vec()));
    store(&fs, &messages);
    let error = failure(source(&fs), TakeFormat::C3d);
    assert!(
        matches!(error, ExportError::LongC3d { last, .. } if last == 1 << 40),
        "{error}"
    );
    let (_, told) = exported(source(&fs), TakeFormat::Trc);
    assert_eq!(told.n_missing_frames, (1 << 40) - 10 + 1 - 5);
}

fn failure(source: ExportSource, format: TakeFormat) -> ExportError {
    let mut export = match Export::start(source, format) {
        Ok(export) => export,
        Err(error) => return error,
    };
    loop {
        match export.step() {
            Ok(Step::Over) => panic!("{format:?} was made"),
            Ok(_) => {}
            Err(error) => return error,
        }
    }
}
