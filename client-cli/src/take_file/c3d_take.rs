//! A C3D as the marker take that a TRC is: the same frames give the same bits.

use frontalis_analysis::{
    format::{
        c3d::{C3dError, C3dPoint, C3dTake},
        trc::{TrcFrame, TrcTake},
    },
    space::LengthUnit,
};

/// The second byte of every C3D.
const KEY: u8 = 80;

/// Whether a file is a C3D: no TRC has such a second byte.
pub(super) fn is_c3d(bytes: &[u8]) -> bool {
    bytes.get(1) == Some(&KEY)
}

/// Why a C3D is no take.
#[derive(Debug, thiserror::Error)]
pub enum C3dTakeError {
    /// It cannot be read.
    #[error(transparent)]
    Format(#[from] C3dError),
    /// A wrong guess would be off by a factor of ten.
    #[error("the file states no unit (POINT:UNITS): give --unit mm, cm or m")]
    NoUnit,
    /// Two units.
    #[error("the file's unit (POINT:UNITS) is {}, --unit says {}", stated.symbol(), wanted.symbol())]
    OtherUnit {
        /// In the file.
        stated: LengthUnit,
        /// By the person.
        wanted: LengthUnit,
    },
}

/// The take in a C3D; `unit` is that of a file that states none.
pub(super) fn read(bytes: &[u8], unit: Option<LengthUnit>) -> Result<TrcTake, C3dTakeError> {
    let take = C3dTake::open(bytes)?;
    let heading = take.heading();
    let unit = match (heading.unit, unit) {
        (Some(stated), Some(wanted)) if stated != wanted => {
            return Err(C3dTakeError::OtherUnit { stated, wanted });
        }
        (Some(unit), _) | (None, Some(unit)) => unit,
        (None, None) => return Err(C3dTakeError::NoUnit),
    };
    let first_frame = u64::from(heading.first_frame);
    let frames = (0_u64..).zip(take.frames()).map(|(index, points)| {
        let position = |it: Option<_>| it.map_or([f32::NAN; 3], |it: C3dPoint| it.position);
        Ok(TrcFrame {
            number: first_frame + index,
            time_s: index as f64 / heading.rate_hz,
            positions: points?.into_iter().map(position).collect(),
        })
    });
    Ok(TrcTake {
        rate_hz: heading.rate_hz,
        unit,
        marker_names: heading.marker_names.clone(),
        frames: frames.collect::<Result<_, C3dError>>()?,
        start_timecode: heading.start_timecode,
    })
}
