//! A TRC or C3D file as frames to publish or to solve.
//!
//! Coordinates stay `f32` in the file's unit, as the wire carries them; `capture_time_nanos` is the file's time × 10⁹
//! rounded; numbers and rate are the file's. A C3D counts its frames from its first and has no times: they are those of
//! its rate. Frame numbers start at 1 (capture.proto: a session expects 1 first), so a file with a frame 0 is refused
//! unless its frames are numbered anew. `frontalis publish` and `frontalis solve` read through this one file, so that both
//! see the same bits.

mod c3d_take;

use std::{io, path::Path};

use frontalis_analysis::{
    format::trc::{self, TrcError, TrcFrame, TrcTake},
    space::LengthUnit,
    timecode::{Counting, Timecode},
};

pub use c3d_take::C3dTakeError;

use crate::proto;

/// Larger files are refused before they are read: an hour of 60 markers at 120 Hz takes 900 MB.
const MAX_FILE_BYTES: u64 = 2 << 30;

/// Why a file is not a take.
#[derive(Debug, thiserror::Error)]
pub enum TakeFileError {
    /// The file cannot be read.
    #[error("cannot read {path}")]
    Io {
        /// The file.
        path: String,
        /// Why.
        #[source]
        source: io::Error,
    },
    /// The file is larger than a take may be.
    #[error("{path} has {bytes} bytes, a take at most {MAX_FILE_BYTES}")]
    TooLarge {
        /// The file.
        path: String,
        /// Its size.
        bytes: u64,
    },
    /// The file is a C3D that cannot be used.
    #[error("{path} is not a usable C3D file")]
    C3d {
        /// The file.
        path: String,
        /// What is wrong, and at which byte.
        #[source]
        source: C3dTakeError,
    },
    /// The file is neither C3D nor TRC.
    #[error("{path} is no C3D and not a usable TRC file")]
    Trc {
        /// The file.
        path: String,
        /// What is wrong, and in which line.
        #[source]
        source: TrcError,
    },
    /// There is nothing in it.
    #[error("{path} has no frames")]
    Empty {
        /// The file.
        path: String,
    },
    /// A frame has a number that no session takes.
    #[error(
        "{path} has a frame number 0, time {time_s} s, row {row} of its frames; frame numbers start at 1: \
         give --renumber, or number the file's frames from 1"
    )]
    FrameZero {
        /// The file.
        path: String,
        /// Which of the file's frames, from 1.
        row: usize,
        /// The frame's time, seconds.
        time_s: f64,
    },
}

/// Reads a take whose frame numbers are to be kept; `unit` is that of a C3D that states none.
///
/// # Errors
///
/// When the file cannot be read, is too large, is neither TRC nor C3D, has no frames, or has a frame number 0.
pub fn read(file: &Path, unit: Option<LengthUnit>) -> Result<TrcTake, TakeFileError> {
    let take = read_any_numbers(file, unit)?;
    match take.frames.iter().position(|it| it.number == 0) {
        Some(idx) => Err(TakeFileError::FrameZero {
            path: file.display().to_string(),
            row: idx + 1,
            time_s: take.frames[idx].time_s,
        }),
        None => Ok(take),
    }
}

/// Reads a take and numbers its frames from 1 in their order, as a new session would.
///
/// # Errors
///
/// As [`read_any_numbers`].
pub fn read_renumbered(file: &Path, unit: Option<LengthUnit>) -> Result<TrcTake, TakeFileError> {
    let mut take = read_any_numbers(file, unit)?;
    for (frame, number) in take.frames.iter_mut().zip(1..) {
        frame.number = number;
    }
    Ok(take)
}

/// Reads a take for somebody who numbers its frames anew.
///
/// # Errors
///
/// When the file cannot be read, is too large, is neither TRC nor C3D, or has no frames.
pub fn read_any_numbers(file: &Path, unit: Option<LengthUnit>) -> Result<TrcTake, TakeFileError> {
    let path = file.display().to_string();
    let bytes = match std::fs::metadata(file).map(|it| it.len()) {
        Ok(bytes) if bytes > MAX_FILE_BYTES => return Err(TakeFileError::TooLarge { path, bytes }),
        Ok(_) => std::fs::read(file),
        Err(error) => Err(error),
    };
    let bytes = match bytes {
        Ok(bytes) => bytes,
        Err(source) => return Err(TakeFileError::Io { path, source }),
    };
    let take = if c3d_take::is_c3d(&bytes) {
        c3d_take::read(&bytes, unit).map_err(|source| TakeFileError::C3d {
            path: path.clone(),
            source,
        })?
    } else {
        trc::parse(&bytes).map_err(|source| TakeFileError::Trc {
            path: path.clone(),
            source,
        })?
    };
    if take.frames.is_empty() {
        return Err(TakeFileError::Empty { path });
    }
    Ok(take)
}

/// The unit's name on the wire.
pub fn wire_unit(unit: LengthUnit) -> proto::LengthUnit {
    match unit {
        LengthUnit::Millimeter => proto::LengthUnit::Millimeter,
        LengthUnit::Centimeter => proto::LengthUnit::Centimeter,
        LengthUnit::Meter => proto::LengthUnit::Meter,
    }
}

/// The frame as it is published, with the take's timecode counted on to it.
pub fn wire_frame(take: &TrcTake, frame: &TrcFrame) -> proto::MarkerFrame {
    proto::MarkerFrame {
        number: frame.number,
        capture_time_nanos: frame.capture_time_nanos(),
        timecode: timecode(take, frame).as_ref().map(wire_timecode),
        positions: frame.positions.as_flattened().to_vec(),
        ..proto::MarkerFrame::default()
    }
}

/// The timecode at the frame's time, where the take has one.
fn timecode(take: &TrcTake, frame: &TrcFrame) -> Option<Timecode> {
    /// Times in a TRC are rounded to microseconds: so little before a frame of the timecode is that frame.
    const SLACK_FRAMES: f64 = 1e-4;
    let start = take.start_timecode?;
    let elapsed_s = frame.time_s - take.frames.first()?.time_s;
    #[expect(clippy::cast_possible_truncation, reason = "the cast saturates")]
    let elapsed = (elapsed_s * start.rate().hz() + SLACK_FRAMES).floor() as i64;
    Some(start.plus_frames(elapsed))
}

fn wire_timecode(timecode: &Timecode) -> proto::Timecode {
    let (label, rate) = (timecode.label(), timecode.rate());
    proto::Timecode {
        hours: label.hours,
        minutes: label.minutes,
        seconds: label.seconds,
        frames: label.frames,
        rate_numerator: rate.numerator(),
        rate_denominator: rate.denominator(),
        drop_frame: rate.counting() == Counting::Drop,
        sub_frame: timecode.sub_frame(),
        user_bits: timecode.user_bits(),
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

    use frontalis_analysis::format::c3d::{C3dHeading, C3dPoint, C3dWriter};

    use super::*;

    const TAKE: &str = "PathFileType\t4\t(X/Y/Z)\ttoy.trc
DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames
60\t60\t2\t2\tmm\t60\t1\t2
Frame#\tTime\tchin\t\t\tnose_tip
\t\tX1\tY1\tZ1\tX2\tY2\tZ2

1\t0.000000\t1.5\t-2.25\t3\t4\t5\t6
2\t0.016667\t\t\t\t4\t5\t6
";

    fn read_text(text: &str) -> Result<TrcTake, TakeFileError> {
        read_text_by(|file| read(file, None), text)
    }

    fn read_text_by<T>(read: impl Fn(&Path) -> T, text: &str) -> T {
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("toy.trc");
        std::fs::write(&file, text).unwrap();
        read(&file)
    }

    #[test]
    fn a_frame_number_0_is_refused_by_name_unless_the_frames_are_renumbered() {
        let from_zero = TAKE
            .replace("\n1\t0.000000", "\n0\t0.000000")
            .replace("\n2\t0.016667", "\n1\t0.016667");
        let error = read_text(&from_zero).unwrap_err();
        assert!(matches!(error, TakeFileError::FrameZero { row: 1, .. }));
        let error = error.to_string();
        for part in ["toy.trc", "frame number 0", "start at 1", "--renumber"] {
            assert!(error.contains(part), "{error}");
        }
        let renumbered = read_text_by(|file| read_renumbered(file, None), &from_zero).unwrap();
        // The same frames under the numbers that a new session gives them.
        assert_eq!(
            renumbered.frames[0].positions,
            read_text(TAKE).unwrap().frames[0].positions
        );
        let numbers: Vec<_> = renumbered.frames.iter().map(|it| it.number).collect();
        assert_eq!(numbers, [1, 2]);
        let kept = read_text_by(|file| read_any_numbers(file, None), &from_zero).unwrap();
        assert_eq!(kept.frames[0].number, 0);
    }

    #[test]
    fn a_frame_goes_out_with_the_files_number_time_and_unit() {
        let take = read_text(TAKE).unwrap();
        assert_eq!(wire_unit(take.unit), proto::LengthUnit::Millimeter);
        let first = wire_frame(&take, &take.frames[0]);
        assert_eq!((first.number, first.capture_time_nanos), (1, 0));
        assert_eq!(first.positions, [1.5, -2.25, 3.0, 4.0, 5.0, 6.0]);
        let second = wire_frame(&take, &take.frames[1]);
        assert_eq!((second.number, second.capture_time_nanos), (2, 16_667_000));
        assert!(second.positions[..3].iter().all(|it| it.is_nan()));
    }

    #[test]
    fn a_file_that_is_no_take_is_named_with_what_is_wrong() {
        let missing = read(Path::new("/no/such/take.trc"), None).unwrap_err();
        assert!(missing.to_string().contains("/no/such/take.trc"));
        let error = read_text("not a take\n").unwrap_err();
        assert!(error.to_string().contains("toy.trc") && error.source().is_some());
        let no_frames = TAKE
            .split("\n1\t")
            .next()
            .unwrap()
            .replace("60\t60\t2", "60\t60\t0");
        assert!(read_text(&no_frames).is_err());
    }

    fn c3d(unit: Option<LengthUnit>) -> Vec<u8> {
        let heading = C3dHeading {
            rate_hz: 60.0,
            unit,
            first_frame: 5,
            n_frames: 3,
            marker_names: vec!["chin".to_owned(), "nose_tip".to_owned()],
            start_timecode: Some(Timecode::parse_at("00:00:59;29", "30000/1001").unwrap()),
        };
        let point = |x| {
            Some(C3dPoint {
                position: [x, -2.25, 3.0],
                residual: 0.0,
                cameras: 0,
            })
        };
        let mut writer = C3dWriter::new(Vec::new(), &heading).unwrap();
        for x in [0.5, 1.5, 2.5] {
            writer.write_frame(&[point(x), None]).unwrap();
        }
        writer.finish().unwrap()
    }

    fn read_c3d(bytes: &[u8], unit: Option<LengthUnit>) -> Result<TrcTake, TakeFileError> {
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("toy.c3d");
        std::fs::write(&file, bytes).unwrap();
        read(&file, unit)
    }

    #[test]
    fn a_c3d_goes_out_with_gaps_occluded_and_its_timecode_counted_on() {
        let take = read_c3d(&c3d(Some(LengthUnit::Millimeter)), None).unwrap();
        assert_eq!(
            (take.unit, take.rate_hz.to_bits()),
            (LengthUnit::Millimeter, 60.0_f64.to_bits())
        );
        let frames: Vec<_> = take.frames.iter().map(|it| wire_frame(&take, it)).collect();
        let numbers: Vec<_> = frames.iter().map(|it| it.number).collect();
        assert_eq!(numbers, [5, 6, 7]);
        assert_eq!(frames[1].capture_time_nanos, 16_666_667);
        assert_eq!(frames[1].positions[..3], [1.5, -2.25, 3.0]);
        assert!(frames[1].positions[3..].iter().all(|it| it.is_nan()));
        let labels: Vec<_> = frames.iter().map(|it| it.timecode.unwrap()).collect();
        let at = |it: &proto::Timecode| (it.minutes, it.seconds, it.frames, it.drop_frame);
        let labels: Vec<_> = labels.iter().map(at).collect();
        // At 60 frames a second a timecode of 29.97 lasts two; the labels 0 and 1 of the minute do not occur.
        assert_eq!(
            labels,
            [(0, 59, 29, true), (0, 59, 29, true), (0, 59, 29, true)]
        );
        let last = TrcFrame {
            time_s: 2.0 * 1_001.0 / 60_000.0,
            ..take.frames[2].clone()
        };
        assert_eq!(
            at(&wire_frame(&take, &last).timecode.unwrap()),
            (1, 0, 2, true)
        );
    }

    #[test]
    fn a_c3d_without_a_unit_needs_one_and_another_one_is_refused() {
        let none = c3d(None);
        let error = read_c3d(&none, None).unwrap_err();
        let cause = error.source().unwrap().to_string();
        assert!(
            cause.contains("POINT:UNITS") && cause.contains("--unit"),
            "{cause}"
        );
        let meters = read_c3d(&none, Some(LengthUnit::Meter)).unwrap();
        assert_eq!(meters.unit, LengthUnit::Meter);
        let stated = c3d(Some(LengthUnit::Millimeter));
        let error = read_c3d(&stated, Some(LengthUnit::Meter)).unwrap_err();
        assert!(
            error
                .source()
                .unwrap()
                .to_string()
                .contains("is mm, --unit says m")
        );
        let cut = read_c3d(&stated[..stated.len() - 512], None).unwrap_err();
        assert!(cut.to_string().contains("toy.c3d") && cut.source().is_some());
    }
}
