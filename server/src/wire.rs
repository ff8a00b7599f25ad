//! Protobuf messages to domain types and back: checked once here, never again below.

pub mod capture;
pub mod common;
pub mod curve;
