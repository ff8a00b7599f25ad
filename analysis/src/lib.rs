//! The mathematics of Frontalis: marker frames in, muscle contractions out.
//!
//! Everything here is a pure function of the actor, the frames and the state of one session.
//! The crate knows no network, no async, no clock and no files: frames, bytes and times are handed in, values come back.
//!
//! | Room | Holds |
//! | --- | --- |
//! | [`space`] | performance and model points, the similarity between them, units |
//! | [`face`] | markers, muscles, regions, mesh, actuation basis, actor |
//! | [`numeric`] | box QP, similarity fit: knows no faces |
//! | [`marker_analysis`] | alignment, displacement, contraction (Choe & Ko 2001, section 4.1) |
//! | [`analyzer`] | the state of one session: frame in, sample out |
//! | [`curve`] | the sample that comes out |
//! | [`synthesis`] | E = E₀ + Σ xᵢeᵢ, the reference face and its pseudo-muscles (Hung & Huang), expressions |
//! | [`stage`] | cameras and triangulation |
//! | [`timecode`] | SMPTE labels of frames |
//! | [`mod@format`] | bytes to types and back: actor packages, OBJ, GLB with its animation, C3D, TRC, curves as CSV and for Live Link |

pub mod analyzer;
pub mod curve;
pub mod face;
pub mod format;
pub mod marker_analysis;
pub mod numeric;
pub mod space;
pub mod stage;
pub mod synthesis;
pub mod timecode;
