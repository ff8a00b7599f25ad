//! Accuracy against contractions that are known: takes, what is done to them, how they are solved, how far off the curves are.
//!
//! The report of `make accuracy` and the tests that keep its marks share all of this.

pub mod actors;
pub mod blink;
pub mod capture;
pub mod condition;
pub mod corruption;
pub mod coverage;
pub mod curves;
pub mod errors;
pub mod lag;
pub mod marks;
pub mod performance;
mod random;
pub mod real_take;
pub mod settings;
pub mod take;
pub mod wrong_basis;
pub mod wrong_case;
