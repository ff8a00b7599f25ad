//! The sections of the page, in order.

pub mod calibration;
pub mod reading;
pub mod strengths;
pub mod synthetic;
pub mod takes;
pub mod wrong_bases;
