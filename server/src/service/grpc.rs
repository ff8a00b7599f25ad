//! The gRPC services of `frontalis.v1`.

pub mod capture;
pub mod curves;
pub mod status;
