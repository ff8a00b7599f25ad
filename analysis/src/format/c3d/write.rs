//! Writing a C3D frame by frame: reals of an Intel processor, without analog values.

mod entries;

use std::io::{self, Write};

use super::{BLOCK_BYTES, C3dHeading, C3dPoint, KEY, number::Processor};
use crate::{face::actor::MAX_MARKERS, format::quoted};
use entries::Entries;

/// The block behind the header's.
const PARAMETER_BLOCK: u8 = 2;
/// The unit of the residual's byte, in the take's unit; its sign says that coordinates are reals.
const SCALE: f32 = -0.1;
/// Of the word that says residual and cameras, where a point was not seen.
const NOT_SEEN: f32 = -1.0;
/// Samples of an analog channel in a frame, though there is no channel: some readers want the ratio of the two rates.
const ANALOG_SAMPLES: u16 = 1;
/// What the words of the header can say of a frame's number.
const MOST_OF_A_WORD: u32 = 0xffff;

/// Why a C3D cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum C3dWriteError {
    /// The sink cannot take more.
    #[error("the C3D cannot be written")]
    Io(#[from] io::Error),
    /// No markers, or more than the limit.
    #[error("{found} markers; between 1 and {MAX_MARKERS} are expected")]
    MarkerCount {
        /// In the heading.
        found: usize,
    },
    /// Longer than a dimension that every reader understands.
    #[error("marker name {name} has more than {limit} bytes", limit = entries::MAX_NAME_BYTES)]
    NameTooLong {
        /// The name, escaped and shortened.
        name: String,
    },
    /// No frames: a C3D counts from its first frame to its last.
    #[error("no frames; a C3D has at least one")]
    NoFrames,
    /// The last frame's number is beyond 32 bits.
    #[error("{n_frames} frames from {first_frame} on go beyond frame number {limit}", limit = u32::MAX)]
    FrameNumbers {
        /// In the heading.
        first_frame: u32,
        /// In the heading.
        n_frames: u32,
    },
    /// More or fewer frames than the heading states, which stands before them.
    #[error("{found} frames were written; the heading states {expected}")]
    FrameCount {
        /// In the heading.
        expected: u32,
        /// Up to now.
        found: u64,
    },
    /// A frame of another number of points.
    #[error("a frame has {found} points; {expected} are expected")]
    PointCount {
        /// Markers of the heading.
        expected: usize,
        /// In the frame.
        found: usize,
    },
    /// A coordinate is no finite number.
    #[error("marker {marker} (counted from 0) of a frame has a coordinate that is not finite")]
    NonFinite {
        /// Index of the marker.
        marker: usize,
    },
}

/// Writes a take frame by frame, so that an export never holds the whole of it.
///
/// What is written reads back to the same bits, the residual to a tenth of the take's unit (25.5 at most).
#[derive(Debug)]
pub struct C3dWriter<W> {
    out: W,
    n_points: usize,
    expected: u32,
    written: u32,
    ending: Ending,
    row: Vec<u8>,
}

/// What stands behind the frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ending {
    /// The last block is filled up.
    WholeBlock,
    /// Nothing: where the header's words cannot say the last frame, some readers read on to the file's end, and would take
    /// what fills the block for frames.
    LastFrame,
}

impl<W: Write> C3dWriter<W> {
    /// Writes header and parameters.
    ///
    /// # Errors
    ///
    /// A heading that the format cannot say, or a sink that cannot take it.
    pub fn new(out: W, heading: &C3dHeading) -> Result<Self, C3dWriteError> {
        Self::with_remarks(out, heading, &[])
    }

    /// The same, with what else is to be said of the take: names in capitals and texts, cut at 127 bytes, in a group
    /// `REMARKS`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn with_remarks(
        mut out: W,
        heading: &C3dHeading,
        remarks: &[(&str, String)],
    ) -> Result<Self, C3dWriteError> {
        let parameters = parameters(heading, remarks)?;
        out.write_all(&header(heading, parameters.len())?)?;
        out.write_all(&parameters)?;
        Ok(Self {
            out,
            n_points: heading.marker_names.len(),
            expected: heading.n_frames,
            written: 0,
            ending: if last_frame(heading)? < MOST_OF_A_WORD {
                Ending::WholeBlock
            } else {
                Ending::LastFrame
            },
            row: Vec::new(),
        })
    }

    /// Writes the next frame: one entry a marker, `None` for one that was not seen.
    ///
    /// # Errors
    ///
    /// A frame that is not the heading's, one too many, or a sink that cannot take it.
    pub fn write_frame(&mut self, points: &[Option<C3dPoint>]) -> Result<(), C3dWriteError> {
        if points.len() != self.n_points {
            return Err(C3dWriteError::PointCount {
                expected: self.n_points,
                found: points.len(),
            });
        }
        if self.written == self.expected {
            return Err(self.frame_count(1));
        }
        self.row.clear();
        for (marker, point) in points.iter().enumerate() {
            let words = words(point.as_ref()).ok_or(C3dWriteError::NonFinite { marker })?;
            self.row
                .extend(words.iter().flat_map(|it| it.to_le_bytes()));
        }
        self.out.write_all(&self.row)?;
        self.written += 1;
        Ok(())
    }

    /// Ends the file and hands the sink back, flushed.
    ///
    /// # Errors
    ///
    /// Fewer frames than the heading states, or a sink that cannot take them.
    pub fn finish(mut self) -> Result<W, C3dWriteError> {
        if self.written != self.expected {
            return Err(self.frame_count(0));
        }
        let bytes = u64::from(self.written) * self.n_points as u64 * 16;
        let over = bytes % BLOCK_BYTES as u64;
        if over > 0 && self.ending == Ending::WholeBlock {
            let filling = [0; BLOCK_BYTES];
            #[expect(clippy::cast_possible_truncation, reason = "below a block")]
            self.out.write_all(&filling[over as usize..])?;
        }
        self.out.flush()?;
        Ok(self.out)
    }

    fn frame_count(&self, more: u64) -> C3dWriteError {
        C3dWriteError::FrameCount {
            expected: self.expected,
            found: u64::from(self.written) + more,
        }
    }
}

/// x, y, z, and residual with cameras; nothing if a coordinate is not finite.
fn words(point: Option<&C3dPoint>) -> Option<[f32; 4]> {
    let Some(point) = point else {
        return Some([0.0, 0.0, 0.0, NOT_SEEN]);
    };
    let [x, y, z] = point.position;
    let is_finite = [x, y, z].iter().all(|it| it.is_finite());
    let residual = (point.residual / SCALE.abs()).round().clamp(0.0, 255.0);
    is_finite.then(|| [x, y, z, residual + 256.0 * f32::from(point.cameras & 0x7f)])
}

/// The first block.
fn header(heading: &C3dHeading, parameter_bytes: usize) -> Result<Vec<u8>, C3dWriteError> {
    let mut header = Vec::with_capacity(BLOCK_BYTES);
    let n_points = u16_of(heading.marker_names.len());
    let last = last_frame(heading)?;
    let data_block = usize::from(PARAMETER_BLOCK) + parameter_bytes / BLOCK_BYTES;
    header.extend([PARAMETER_BLOCK, KEY]);
    for word in [
        n_points,
        0,
        saturated(heading.first_frame),
        saturated(last),
        0,
    ] {
        header.extend(word.to_le_bytes());
    }
    header.extend(SCALE.to_le_bytes());
    header.extend(u16_of(data_block).to_le_bytes());
    header.extend(ANALOG_SAMPLES.to_le_bytes());
    header.extend(rate(heading).to_le_bytes());
    header.resize(BLOCK_BYTES, 0);
    Ok(header)
}

fn last_frame(heading: &C3dHeading) -> Result<u32, C3dWriteError> {
    let (first_frame, n_frames) = (heading.first_frame, heading.n_frames);
    let others = n_frames.checked_sub(1).ok_or(C3dWriteError::NoFrames)?;
    let last = first_frame.checked_add(others);
    last.ok_or(C3dWriteError::FrameNumbers {
        first_frame,
        n_frames,
    })
}

fn saturated(number: u32) -> u16 {
    u16_of(number.min(MOST_OF_A_WORD) as usize)
}

fn u16_of(number: usize) -> u16 {
    u16::try_from(number).expect("invariant: counts and blocks have been checked")
}

#[expect(clippy::cast_possible_truncation, reason = "C3D keeps rates as f32")]
fn rate(heading: &C3dHeading) -> f32 {
    heading.rate_hz as f32
}

/// The parameter section in whole blocks.
fn parameters(heading: &C3dHeading, remarks: &[(&str, String)]) -> Result<Vec<u8>, C3dWriteError> {
    let names = &heading.marker_names;
    if !(1..=MAX_MARKERS).contains(&names.len()) {
        let found = names.len();
        return Err(C3dWriteError::MarkerCount { found });
    }
    let mut entries = Entries::default();
    let point = entries.group("POINT");
    entries.words(point, "USED", &[u16_of(names.len())]);
    entries.real(point, "SCALE", SCALE);
    entries.real(point, "RATE", rate(heading));
    entries.words(point, "FRAMES", &[saturated(heading.n_frames)]);
    if heading.n_frames > MOST_OF_A_WORD {
        entries.real(point, "LONG_FRAMES", heading.n_frames as f32);
    }
    if let Some(unit) = heading.unit {
        entries.text(point, "UNITS", unit.symbol());
    }
    labels(&mut entries, point, names)?;
    let analog = entries.group("ANALOG");
    entries.words(analog, "USED", &[0]);
    entries.real(analog, "RATE", rate(heading));
    let trial = entries.group("TRIAL");
    let (first, last) = (heading.first_frame, last_frame(heading)?);
    entries.words(trial, "ACTUAL_START_FIELD", &low_high(first));
    entries.words(trial, "ACTUAL_END_FIELD", &low_high(last));
    if let Some(timecode) = heading.start_timecode {
        let group = entries.group("TIMECODE");
        entries.text(group, "START", &timecode.to_string());
        entries.text(group, "RATE", &timecode.rate().to_string());
    }
    if !remarks.is_empty() {
        let group = entries.group("REMARKS");
        for (name, text) in remarks {
            entries.text(group, name, shortened(text));
        }
    }
    Ok(entries.finish(point, PARAMETER_BLOCK, Processor::INTEL_CODE))
}

/// As much of a text as a parameter holds.
fn shortened(text: &str) -> &str {
    let end = (0..=entries::MAX_NAME_BYTES.min(text.len())).rev();
    let end = end.into_iter().find(|&it| text.is_char_boundary(it));
    &text[..end.unwrap_or(0)]
}

fn low_high(number: u32) -> [u16; 2] {
    [number & MOST_OF_A_WORD, number >> 16].map(|it| u16_of(it as usize))
}

/// `LABELS`, `LABELS2` and so on, 255 names in each.
fn labels(entries: &mut Entries, group: u8, names: &[String]) -> Result<(), C3dWriteError> {
    let is_long = |it: &&String| it.len() > entries::MAX_NAME_BYTES;
    if let Some(name) = names.iter().find(is_long) {
        let name = quoted(name);
        return Err(C3dWriteError::NameTooLong { name });
    }
    for (number, names) in (1..).zip(names.chunks(255)) {
        let name = if number == 1 {
            "LABELS".to_owned()
        } else {
            format!("LABELS{number}")
        };
        entries.texts(group, &name, names);
    }
    Ok(())
}
