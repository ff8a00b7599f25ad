//! The doors of the server: gRPC and plain HTTP.

pub mod calls;
pub mod door;
pub mod grpc;
pub mod http;
pub mod keeper;
pub mod listener;
pub mod sessions;
