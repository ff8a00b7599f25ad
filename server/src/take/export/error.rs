//! Why a take cannot be exported.

use frontalis_analysis::format::{
    c3d::{self, C3dWriteError},
    glb::AnimationError,
    trc::TrcWriteError,
};

use crate::take::TakeFileError;

/// Why there is no export, or no more of it.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The file cannot be read.
    #[error("the take's file cannot be read")]
    File(#[from] TakeFileError),
    /// A message in it is none.
    #[error("message {sequence} of {channel} in the take's file cannot be read")]
    Message {
        /// Where it stands.
        channel: &'static str,
        /// Its number there, from 0.
        sequence: u32,
        /// Why.
        #[source]
        source: prost::DecodeError,
    },
    /// Nothing says what the take is of.
    #[error("the take's file has no header, which would name its muscles and markers")]
    NoHeader,
    /// Nothing says how frames are to be read.
    #[error("frame {frame} came before anything that says its unit and markers")]
    NoSource {
        /// Its number.
        frame: u64,
    },
    /// Nothing that the format could hold.
    #[error("the take has no {what} yet; a file of this format has at least one")]
    Empty {
        /// `frame` or `sample`.
        what: &'static str,
    },
    /// A sample of other muscles.
    #[error("the sample of frame {frame} has {found} activations; the take has {expected} muscles")]
    Activations {
        /// Its frame.
        frame: u64,
        /// In the take's header.
        expected: usize,
        /// In the sample.
        found: usize,
    },
    /// More markers than any format takes.
    #[error("the take's publishers named {found} markers in all; at most {limit} are exported")]
    Markers {
        /// In all.
        found: usize,
        /// The most.
        limit: usize,
    },
    /// More rows than an animation may have.
    #[error("the take has more than {limit} samples, the most that go into one animation")]
    LongAnimation {
        /// The most.
        limit: usize,
    },
    /// A C3D has a place for every number between the first frame and the last.
    #[error(
        "frames {first} to {last} of {n_markers} markers are more than the {limit} positions that a C3D is written with, gaps included",
        limit = c3d::MAX_POSITIONS
    )]
    LongC3d {
        /// First frame.
        first: u64,
        /// Last frame.
        last: u64,
        /// Markers.
        n_markers: usize,
    },
    /// The actor of a GLB is not there.
    #[error("a GLB shows the actor's face, which is not there any more")]
    NoActor,
    /// The format cannot say it.
    #[error(transparent)]
    Trc(#[from] TrcWriteError),
    /// The format cannot say it.
    #[error(transparent)]
    C3d(#[from] C3dWriteError),
    /// The format cannot say it.
    #[error(transparent)]
    Animation(#[from] AnimationError),
    /// The system failed.
    #[error("the export could not be written")]
    Io(#[from] std::io::Error),
}

impl ExportError {
    /// Whether the take is at fault, which other formats may be able to say.
    pub fn is_of_the_format(&self) -> bool {
        !matches!(
            self,
            Self::File(_) | Self::Message { .. } | Self::NoHeader | Self::Io(_)
        )
    }
}
