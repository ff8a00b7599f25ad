//! One frame out of the bytes.

use super::{
    C3dError, C3dPoint, C3dProblem, C3dTake,
    layout::{Storage, WORDS_A_POINT},
};
use crate::format::quoted;

const AXES: [char; 3] = ['x', 'y', 'z'];

impl C3dTake<'_> {
    /// Opening has made sure that every frame lies in the bytes.
    pub(super) fn frame(&self, frame: usize) -> Result<Vec<Option<C3dPoint>>, C3dError> {
        let point_bytes = self.layout.point_bytes();
        let start = self.layout.start + frame * self.layout.frame_bytes();
        let points = (0..self.layout.n_points).map(|index| {
            let offset = start + index * point_bytes;
            let point = self.point(&self.bytes[offset..][..point_bytes]);
            point.map_err(|axis| {
                let marker = quoted(&self.heading.marker_names[index]);
                C3dProblem::NonFinite { marker, axis }.at(offset)
            })
        });
        points.collect()
    }

    /// A point, or the axis whose coordinate is infinite.
    fn point(&self, bytes: &[u8]) -> Result<Option<C3dPoint>, char> {
        let ([x, y, z], mask, scale) = match self.layout.storage {
            Storage::Integer { scale } => {
                let [position @ .., mask] = self.integers(bytes).map(f32::from);
                (position.map(|it| it * scale), mask, scale)
            }
            Storage::Real { residual_scale } => {
                let [position @ .., mask] = self.reals(bytes);
                (position, mask, residual_scale)
            }
        };
        let position = [x, y, z];
        // −1 is a gap; programs of our days write it beside coordinates that are no numbers, or those alone.
        let is_seen = mask >= 0.0 && !position.iter().any(|it| it.is_nan());
        if !is_seen {
            return Ok(None);
        }
        if let Some(axis) = position.iter().position(|it| it.is_infinite()) {
            return Err(AXES[axis]);
        }
        let (residual, cameras) = residual(mask);
        Ok(Some(C3dPoint {
            position,
            residual: f32::from(residual) * scale,
            cameras,
        }))
    }

    fn integers(&self, bytes: &[u8]) -> [i16; WORDS_A_POINT] {
        std::array::from_fn(|word| {
            let bytes = [bytes[2 * word], bytes[2 * word + 1]];
            self.layout.processor.word(bytes).cast_signed()
        })
    }

    fn reals(&self, bytes: &[u8]) -> [f32; WORDS_A_POINT] {
        std::array::from_fn(|word| {
            let bytes = std::array::from_fn(|byte| bytes[4 * word + byte]);
            self.layout.processor.real(bytes)
        })
    }
}

/// The low byte is the residual, seven bits above it the cameras; reals hold the same integer as a number.
fn residual(mask: f32) -> (u8, u8) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is not negative, and the cast saturates"
    )]
    let [_, _, cameras, residual] = (mask as u32).to_be_bytes();
    (residual, cameras & 0x7f)
}
