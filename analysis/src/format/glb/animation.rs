//! Writing a mesh whose morph targets move: the neutral face, and an animation of its weights.
//!
//! The weights are written frame by frame behind everything else, so that an export never holds the whole take; what a
//! GLB states before its bytes (their number, and the first and last time) is handed in first.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::{
    MAGIC, MorphMesh,
    write::{FLOAT, Parts, face},
};
use crate::timecode::Timecode;

/// Container version, and the types of its two chunks.
const VERSION: u32 = 2;
const JSON_CHUNK: [u8; 4] = *b"JSON";
const BINARY_CHUNK: [u8; 4] = *b"BIN\0";
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;

/// Why an animation cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum AnimationError {
    /// The sink cannot take more.
    #[error("the GLB cannot be written")]
    Io(#[from] io::Error),
    /// No frames, or nothing that moves.
    #[error("an animation needs a frame and a morph target; {frames} and {targets} are there")]
    Empty {
        /// Times.
        frames: usize,
        /// Morph targets of the mesh.
        targets: usize,
    },
    /// glTF wants finite times that grow, from 0 on.
    #[error(
        "the time of frame {frame} (counted from 0) is negative, not finite, or not after the one before"
    )]
    Time {
        /// Index of the time.
        frame: usize,
    },
    /// A GLB counts its bytes in 32 bits.
    #[error("the file would have {found} bytes; a GLB has less than 4 GiB")]
    TooLong {
        /// Bytes of the whole file.
        found: u64,
    },
    /// More or fewer frames than times.
    #[error("{found} frames were written; {expected} times were stated")]
    FrameCount {
        /// Times.
        expected: usize,
        /// Up to now.
        found: usize,
    },
    /// A frame of another number of weights, or one of them not finite.
    #[error("a frame has {found} finite weights; {expected} are expected")]
    Weights {
        /// Morph targets.
        expected: usize,
        /// In the frame.
        found: usize,
    },
}

/// Writes an animation frame by frame.
#[derive(Debug)]
pub struct AnimationWriter<W> {
    out: W,
    n_targets: usize,
    expected: usize,
    written: usize,
    row: Vec<u8>,
}

impl<W: Write> AnimationWriter<W> {
    /// Writes the mesh as [`super::write()`] does, and the animation's times: seconds, growing, from 0 on.
    ///
    /// Weights between two times are interpolated linearly.
    /// `start_timecode` is the first frame's; it stands in the animation's `extras` as `timecode`, with its `rate`.
    ///
    /// # Errors
    ///
    /// Times that glTF does not admit, a file that would be too long, or a sink that cannot take it.
    pub fn new(
        mut out: W,
        mesh: &MorphMesh,
        extras: Map<String, Value>,
        times_s: &[f32],
        start_timecode: Option<&Timecode>,
    ) -> Result<Self, AnimationError> {
        let (frames, targets) = (times_s.len(), mesh.targets.len());
        if frames == 0 || targets == 0 {
            return Err(AnimationError::Empty { frames, targets });
        }
        check_times(times_s)?;
        let mut file = Parts::default();
        let face = face(&mut file, mesh, extras);
        let weight_bytes = frames as u64 * targets as u64 * 4;
        let animation = animation(&mut file, times_s, targets, start_timecode);
        let n_bytes = file.bytes.len() as u64 + weight_bytes;
        let mut document = file.document(&face, n_bytes);
        document["animations"] = json!([animation]);
        let mut document = document.to_string().into_bytes();
        document.resize(document.len().next_multiple_of(4), b' ');
        write_container(&mut out, &document, n_bytes)?;
        out.write_all(&file.bytes)?;
        Ok(Self {
            out,
            n_targets: targets,
            expected: frames,
            written: 0,
            row: Vec::new(),
        })
    }

    /// Writes the weights of the next time, one a target.
    ///
    /// # Errors
    ///
    /// A frame that is not the mesh's, one too many, or a sink that cannot take it.
    pub fn write_frame(&mut self, weights: &[f32]) -> Result<(), AnimationError> {
        let n_finite = weights.iter().filter(|it| it.is_finite()).count();
        if weights.len() != self.n_targets || n_finite != self.n_targets {
            return Err(AnimationError::Weights {
                expected: self.n_targets,
                found: n_finite,
            });
        }
        if self.written == self.expected {
            return Err(self.frame_count(1));
        }
        self.row.clear();
        self.row
            .extend(weights.iter().flat_map(|it| it.to_le_bytes()));
        self.out.write_all(&self.row)?;
        self.written += 1;
        Ok(())
    }

    /// Hands the sink back, flushed.
    ///
    /// # Errors
    ///
    /// Fewer frames than times, or a sink that cannot take them.
    pub fn finish(mut self) -> Result<W, AnimationError> {
        if self.written != self.expected {
            return Err(self.frame_count(0));
        }
        self.out.flush()?;
        Ok(self.out)
    }

    fn frame_count(&self, more: usize) -> AnimationError {
        AnimationError::FrameCount {
            expected: self.expected,
            found: self.written + more,
        }
    }
}

fn check_times(times_s: &[f32]) -> Result<(), AnimationError> {
    let mut before = None;
    for (frame, &time) in times_s.iter().enumerate() {
        let is_later = before.is_none_or(|before| time > before);
        if !time.is_finite() || time < 0.0 || !is_later {
            return Err(AnimationError::Time { frame });
        }
        before = Some(time);
    }
    Ok(())
}

/// The one animation of the one node; the bytes of its weights follow all others.
fn animation(
    file: &mut Parts,
    times_s: &[f32],
    n_targets: usize,
    start_timecode: Option<&Timecode>,
) -> Value {
    let n_frames = times_s.len();
    let view = file.view(times_s.iter().flat_map(|it| it.to_le_bytes()), None);
    let input = file.accessor(json!({
        "bufferView": view, "componentType": FLOAT, "count": n_frames, "type": "SCALAR",
        "min": times_s.first().as_slice(), "max": times_s.last().as_slice(),
    }));
    let n_weights = n_frames as u64 * n_targets as u64;
    let view = file.view_of_bytes_to_come(4 * n_weights);
    let output = file.accessor(json!({
        "bufferView": view, "componentType": FLOAT, "count": n_weights, "type": "SCALAR",
    }));
    let mut animation = json!({
        "name": "take",
        "samplers": [{ "input": input, "output": output, "interpolation": "LINEAR" }],
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
    });
    if let Some(timecode) = start_timecode {
        let rate = timecode.rate().to_string();
        animation["extras"] = json!({ "timecode": timecode.to_string(), "rate": rate });
    }
    animation
}

/// Header, the JSON chunk, and the head of the binary chunk; all parts are multiples of four bytes.
fn write_container(out: &mut impl Write, json: &[u8], n_bytes: u64) -> Result<(), AnimationError> {
    let around = (HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + json.len()) as u64;
    let found = around + n_bytes;
    let too_long = |_| AnimationError::TooLong { found };
    let length = u32::try_from(found).map_err(too_long)?;
    let json_length = u32::try_from(json.len()).map_err(too_long)?;
    let binary_length = u32::try_from(n_bytes).map_err(too_long)?;
    out.write_all(&MAGIC)?;
    for word in [VERSION, length, json_length] {
        out.write_all(&word.to_le_bytes())?;
    }
    out.write_all(&JSON_CHUNK)?;
    out.write_all(json)?;
    out.write_all(&binary_length.to_le_bytes())?;
    out.write_all(&BINARY_CHUNK)?;
    Ok(())
}

#[cfg(test)]
mod tests;
