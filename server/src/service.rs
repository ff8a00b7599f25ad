//! The doors of the server: gRPC and plain HTTP.

pub mod grpc;
