//! Markers to contractions (Choe & Ko 2001, section 4.1).

pub mod alignment;
