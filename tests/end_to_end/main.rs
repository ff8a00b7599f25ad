//! The promises of the service, each kept by a real server, a real client and real gRPC; one module a promise.
#![expect(clippy::unwrap_used, reason = "a failing test is its own report")]

mod layering;
