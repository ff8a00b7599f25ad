//! Protobuf messages to domain types and back: checked once here, never again below.

pub mod actor;
pub mod analysis_state;
pub mod capture;
pub mod common;
pub mod curve;
pub mod invalid;
pub mod page;
pub mod parts;
pub mod session;
pub mod take;
