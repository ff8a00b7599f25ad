//! Markers to contractions (Choe & Ko 2001, section 4.1).

pub mod alignment;
pub mod contraction;
mod diagnosis;
mod estimate;
mod estimated;
mod evidence;
mod head_motion;
mod marker_model;
pub mod neutral;
pub mod neutral_watch;
mod noise;
pub mod objective;
mod plain_uncertainty;
pub(crate) mod positions_on_tape;
pub mod range;
mod reproduction;
pub mod settings;
mod still_problem;
