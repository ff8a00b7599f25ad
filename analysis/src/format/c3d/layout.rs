//! Where the frames lie and how they are stored.

use super::number::Processor;

/// Words of a point: x, y, z, and residual with cameras.
pub(super) const WORDS_A_POINT: usize = 4;

/// What is needed to take a frame out of the bytes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) processor: Processor,
    pub(super) storage: Storage,
    /// The first byte of the first frame.
    pub(super) start: usize,
    pub(super) n_points: usize,
    /// Values of all channels in one frame.
    pub(super) n_analog: usize,
}

/// How a coordinate is stored.
#[derive(Clone, Copy, Debug)]
pub(super) enum Storage {
    /// An integer, to be multiplied by the scale.
    Integer {
        /// Positive.
        scale: f32,
    },
    /// A real in the take's unit; the scale is for the residual alone.
    Real {
        /// Positive.
        residual_scale: f32,
    },
}

impl Storage {
    fn word_bytes(self) -> usize {
        match self {
            Self::Integer { .. } => 2,
            Self::Real { .. } => 4,
        }
    }
}

impl Layout {
    pub(super) fn point_bytes(&self) -> usize {
        WORDS_A_POINT * self.storage.word_bytes()
    }

    pub(super) fn frame_bytes(&self) -> usize {
        self.n_points * self.point_bytes() + self.n_analog * self.storage.word_bytes()
    }
}
