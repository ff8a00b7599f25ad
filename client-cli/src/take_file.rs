//! A TRC file as frames to publish or to solve.
//!
//! Coordinates stay `f32` in the file's unit, as the wire carries them; `capture_time_nanos` is the file's time × 10⁹
//! rounded; numbers and rate are the file's. Frame numbers start at 1 (capture.proto: a session expects 1 first), so a
//! file with a frame 0 is refused unless its frames are numbered anew. `frontalis publish` and `frontalis solve` read through this one file, so
//! that both see the same bits.

use std::{io, path::Path};

use frontalis_analysis::{
    format::trc::{self, TrcError, TrcFrame, TrcTake},
    space::LengthUnit,
};

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
    /// The file is no TRC file.
    #[error("{path} is not a usable TRC file")]
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

/// Reads a TRC file whose frame numbers are to be kept.
///
/// # Errors
///
/// When the file cannot be read, is too large, is not TRC, has no frames, or has a frame number 0.
pub fn read(file: &Path) -> Result<TrcTake, TakeFileError> {
    let take = read_any_numbers(file)?;
    match take.frames.iter().position(|it| it.number == 0) {
        Some(idx) => Err(TakeFileError::FrameZero {
            path: file.display().to_string(),
            row: idx + 1,
            time_s: take.frames[idx].time_s,
        }),
        None => Ok(take),
    }
}

/// Reads a TRC file and numbers its frames from 1 in the order of the rows, as a new session would.
///
/// # Errors
///
/// As [`read_any_numbers`].
pub fn read_renumbered(file: &Path) -> Result<TrcTake, TakeFileError> {
    let mut take = read_any_numbers(file)?;
    for (frame, number) in take.frames.iter_mut().zip(1..) {
        frame.number = number;
    }
    Ok(take)
}

/// Reads a TRC file for somebody who numbers its frames anew.
///
/// # Errors
///
/// When the file cannot be read, is too large, is not TRC, or has no frames.
pub fn read_any_numbers(file: &Path) -> Result<TrcTake, TakeFileError> {
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
    match trc::parse(&bytes) {
        Ok(take) if take.frames.is_empty() => Err(TakeFileError::Empty { path }),
        Ok(take) => Ok(take),
        Err(source) => Err(TakeFileError::Trc { path, source }),
    }
}

/// The unit's name on the wire.
pub fn wire_unit(unit: LengthUnit) -> proto::LengthUnit {
    match unit {
        LengthUnit::Millimeter => proto::LengthUnit::Millimeter,
        LengthUnit::Centimeter => proto::LengthUnit::Centimeter,
        LengthUnit::Meter => proto::LengthUnit::Meter,
    }
}

/// The frame as it is published.
pub fn wire_frame(frame: &TrcFrame) -> proto::MarkerFrame {
    proto::MarkerFrame {
        number: frame.number,
        capture_time_nanos: frame.capture_time_nanos(),
        positions: frame.positions.as_flattened().to_vec(),
        ..proto::MarkerFrame::default()
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error as _;

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
        read_text_by(read, text)
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
        let renumbered = read_text_by(read_renumbered, &from_zero).unwrap();
        // The same frames under the numbers that a new session gives them.
        assert_eq!(
            renumbered.frames[0].positions,
            read_text(TAKE).unwrap().frames[0].positions
        );
        let numbers: Vec<_> = renumbered.frames.iter().map(|it| it.number).collect();
        assert_eq!(numbers, [1, 2]);
        let kept = read_text_by(read_any_numbers, &from_zero).unwrap();
        assert_eq!(kept.frames[0].number, 0);
    }

    #[test]
    fn a_frame_goes_out_with_the_files_number_time_and_unit() {
        let take = read_text(TAKE).unwrap();
        assert_eq!(wire_unit(take.unit), proto::LengthUnit::Millimeter);
        let first = wire_frame(&take.frames[0]);
        assert_eq!((first.number, first.capture_time_nanos), (1, 0));
        assert_eq!(first.positions, [1.5, -2.25, 3.0, 4.0, 5.0, 6.0]);
        let second = wire_frame(&take.frames[1]);
        assert_eq!((second.number, second.capture_time_nanos), (2, 16_667_000));
        assert!(second.positions[..3].iter().all(|it| it.is_nan()));
    }

    #[test]
    fn a_file_that_is_no_take_is_named_with_what_is_wrong() {
        let missing = read(Path::new("/no/such/take.trc")).unwrap_err();
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
}
