//! The doors of the server: gRPC and plain HTTP.

pub mod access;
pub mod audit;
pub mod calls;
pub mod deadline;
pub mod door;
pub mod erasure;
pub mod grpc;
pub mod guard;
pub mod http;
pub mod keeper;
pub mod listener;
pub mod panics;
pub mod peer;
pub mod readiness;
pub mod replay;
pub mod rescue;
pub mod retention;
pub mod sessions;
pub mod take_exports;
pub mod takes;
