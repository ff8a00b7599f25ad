//! The gRPC services of `frontalis.v1`.

pub mod actors;
pub mod capture;
pub mod curves;
mod ending;
pub mod messages;
mod opening;
pub mod reasons;
#[cfg(test)]
mod recorded_tests;
pub(super) mod refusal;
pub mod server;
pub mod sessions;
#[cfg(test)]
pub(in crate::service) mod stage;
pub mod status;
pub mod takes;
