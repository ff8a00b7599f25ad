//! The capture stage: cameras that see markers, and where the markers are by what the cameras saw.

pub mod camera;
pub mod rig;
pub mod triangulation;
