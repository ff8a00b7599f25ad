//! Files that are broken, cut or changed: each ends in an error that says where, or is another sound file.

use super::{C3dProblem as P, *};

fn file() -> Vec<u8> {
    written(&heading(), &frames())
}

/// A file after a change of some bytes.
fn changed(at: usize, bytes: &[u8]) -> C3dError {
    let mut file = file();
    file[at..][..bytes.len()].copy_from_slice(bytes);
    C3dTake::open(&file).unwrap_err()
}

/// Where the body of a parameter begins, behind its name and the way to the next.
fn body(file: &[u8], name: &str) -> usize {
    let length = u8::try_from(name.len()).unwrap();
    let is_it = |it: &[u8]| it[0] == length && &it[2..] == name.as_bytes();
    let start = file.windows(name.len() + 2).position(is_it).unwrap();
    start + 2 + name.len() + 2
}

/// The error after a change of a parameter's data.
fn parameter(name: &str, data: &[u8]) -> P {
    let at = body(&file(), name) + 2;
    changed(at, data).problem
}

#[test]
fn a_broken_header_is_refused_with_its_byte() {
    assert_eq!(changed(1, &[81]), P::NotC3d.at(1));
    assert_eq!(changed(0, &[0]), P::ParameterBlock { found: 0 }.at(0));
    assert_eq!(changed(0, &[1]), P::ParameterBlock { found: 1 }.at(0));
    assert_eq!(changed(0, &[200]).problem, P::HeaderEnds);
    assert_eq!(changed(515, &[83]), P::Processor { found: 83 }.at(515));
    assert_eq!(changed(16, &[1, 0]), P::DataBlock { found: 1 }.at(16));
    assert!(matches!(
        changed(2, &[3, 0]).problem,
        P::Contradiction {
            what: "points",
            header: 3,
            parameters: 2
        }
    ));
    assert!(matches!(
        changed(4, &[5, 0]).problem,
        P::Contradiction { header: 5, .. }
    ));
    assert_eq!(changed(12, &0.1_f32.to_le_bytes()).problem, P::Storage);
}

#[test]
fn a_broken_parameter_is_refused_by_name() {
    for rate in [0.0_f32, -60.0, f32::NAN, f32::INFINITY] {
        assert_eq!(parameter("RATE", &rate.to_le_bytes()), P::Rate);
    }
    for scale in [0.0_f32, f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(parameter("SCALE", &scale.to_le_bytes()), P::Scale);
    }
    let file = file();
    let unit = body(&file, "UNITS");
    assert_eq!(
        changed(unit + 3, b"in").problem.to_string(),
        "POINT:UNITS is in; mm, cm or m are known"
    );
    let labels = body(&file, "LABELS");
    let kind = body(&file, "RATE");
    assert!(matches!(
        changed(kind, &[3]).problem,
        P::Parameter {
            name: "POINT:RATE",
            ..
        }
    ));
    let dimensions = changed(labels + 2, &[255, 255]).problem;
    assert!(matches!(
        dimensions,
        P::Parameter {
            name: "POINT:LABELS",
            ..
        }
    ));
    assert!(matches!(
        changed(kind, &[0xff]).problem,
        P::Parameter { .. }
    ));
}

#[test]
fn a_chain_that_leads_nowhere_is_refused() {
    let way = body(&file(), "POINT") - 2;
    assert_eq!(changed(way, &[1, 0]), P::NextParameter.at(516));
    assert_eq!(changed(way, &[0xff, 0xff]), P::CutParameter.at(516));
    let mut endless = file()[..516].to_vec();
    for _ in 0..=MAX_PARAMETERS {
        endless.extend([1, 1, b'X', 2, 0]);
    }
    endless[16..18].copy_from_slice(&200_u16.to_le_bytes());
    endless.resize(200 * 512, 0);
    let error = C3dTake::open(&endless).unwrap_err();
    assert_eq!(error.problem, P::TooManyParameters);
}

#[test]
fn labels_that_their_numbers_do_not_tell_apart_are_refused() {
    let heading = C3dHeading {
        marker_names: ["a", "a", "a_1"].map(str::to_owned).to_vec(),
        ..heading()
    };
    let bytes = written(&heading, &[vec![None; 3], vec![None; 3]]);
    let error = C3dTake::open(&bytes).unwrap_err();
    let name = "a_1".to_owned();
    assert_eq!(error.problem, P::DuplicateName { name });
}

#[test]
fn takes_have_limits() {
    let heading = C3dHeading {
        n_frames: 30_000_000,
        ..heading()
    };
    let mut sink = Vec::new();
    C3dWriter::new(&mut sink, &heading).unwrap();
    assert_eq!(C3dTake::open(&sink).unwrap_err().problem, P::TooLong);
}

#[test]
fn an_infinite_coordinate_is_named() {
    let mut bytes = file();
    let start = C3dTake::open(&bytes).unwrap().layout.start;
    bytes[start + 32 + 16 + 4..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let take = C3dTake::open(&bytes).unwrap();
    let error = take.frames().nth(1).unwrap().unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "byte {}: y of marker chin is beyond the range of a coordinate",
            start + 48
        )
    );
}

#[test]
fn a_file_cut_at_any_byte_is_refused() {
    for processor in PROCESSORS {
        for bytes in [
            ByHand::new(processor, true).file(),
            ByHand::new(processor, false).file(),
            file(),
        ] {
            let take = C3dTake::open(&bytes).unwrap();
            let frames_end = take.layout.start + 2 * take.layout.frame_bytes();
            for end in 0..frames_end {
                let error = C3dTake::open(&bytes[..end]).expect_err("it is cut");
                assert!(error.offset <= bytes.len() && error.to_string().len() < 300);
            }
            let unfilled = C3dTake::open(&bytes[..frames_end]).unwrap();
            assert_same(&all(&unfilled), &all(&take));
        }
    }
}

/// Bytes that opening a small file and reading its frames may hold at once, whatever the file says: the names of 1,024
/// markers, one frame of them, and the parameters.
const MOST_BYTES: u64 = 1 << 20;

#[test]
fn no_flipped_bit_makes_it_panic_or_take_memory() {
    for bytes in [
        file(),
        ByHand::new(85, true).file(),
        ByHand::new(86, false).file(),
    ] {
        for bit in 0..8 * bytes.len() {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            let held = allocation_counter::measure(|| read_all(&flipped));
            assert!(held.bytes_max <= MOST_BYTES, "bit {bit}: {held:?}");
        }
    }
}

fn read_all(bytes: &[u8]) {
    if let Ok(take) = C3dTake::open(bytes) {
        assert!(take.heading().n_frames as usize <= MAX_POSITIONS);
        for frame in take.frames() {
            drop(frame);
        }
    }
}

/// The short form of the fuzz target: a take that is read is written and read again, but for its residuals' rounding.
fn assert_written_again(take: &C3dTake<'_>) {
    let Ok(frames) = take.frames().collect::<Result<Frames, _>>() else {
        return;
    };
    // A name may be too long, and a number too great, for what is written.
    let Ok(mut writer) = C3dWriter::new(Vec::new(), take.heading()) else {
        return;
    };
    for frame in &frames {
        writer.write_frame(frame).unwrap();
    }
    let written = writer.finish().unwrap();
    let again = C3dTake::open(&written).unwrap();
    assert_eq!(again.heading(), take.heading());
    let unmeasured = |frames: &Frames| -> Frames {
        let without = |it: &C3dPoint| C3dPoint {
            residual: 0.0,
            ..*it
        };
        let frame =
            |it: &Vec<Option<C3dPoint>>| it.iter().map(|it| it.as_ref().map(without)).collect();
        frames.iter().map(frame).collect()
    };
    assert_same(&unmeasured(&all(&again)), &unmeasured(&frames));
}

proptest! {
    #[test]
    fn no_change_of_a_few_bytes_makes_the_reader_panic(
        processor in prop::sample::select(PROCESSORS.to_vec()),
        is_integer in any::<bool>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        end in any::<prop::sample::Index>(),
    ) {
        let mut bytes = ByHand::new(processor, is_integer).file();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        read_all(&bytes);
        read_all(&bytes[..end.index(bytes.len())]);
        if let Ok(take) = C3dTake::open(&bytes) {
            assert_written_again(&take);
        }
    }

    #[test]
    fn no_bytes_make_the_reader_panic(mut bytes in prop::collection::vec(any::<u8>(), 0..2048)) {
        read_all(&bytes);
        for (at, byte) in [(0, 2), (1, KEY), (515, 84)] {
            if let Some(place) = bytes.get_mut(at) {
                *place = byte;
            }
        }
        read_all(&bytes);
    }
}
