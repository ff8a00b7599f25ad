//! The client of Frontalis: a capture stage's way in, a renderer's way out.
//!
//! | Room | Holds |
//! | --- | --- |
//! | [`connection`] | one HTTP/2 connection to a server, with TLS and a token where they are asked for, and pings that find a dead peer |
//! | [`capture_client`] | publishes marker frames; reconnects and resumes so that every frame takes effect once |
//! | [`curve_client`] | follows a session's curves, newest first or every frame without a hole |
//! | [`error`] | what a server refused, its reason, and what to do about it |
//! | [`backoff`] | how long to wait before trying again |
//! | [`simulated_stage`] | an actor, cameras and a performance, for a stage without a studio |
//! | [`recorded_take`] | what a take recorded, message after message |
//! | [`take_difference`] | where the curves of two takes differ |
//! | [`picture`] | drawings as SVG |
//! | [`take_file`] | a TRC or C3D file as frames to publish or to solve |
//! | [`solve`] | the same analysis without a server |
//! | [`csv`] | samples as rows of a table, the same bytes from a server and from a file |

pub mod backoff;
pub mod capture_client;
pub mod connection;
pub mod csv;
pub mod curve_client;
pub mod error;
#[cfg(test)]
mod fake_server;
pub mod picture;
pub mod recorded_take;
pub mod simulated_stage;
pub mod solve;
pub mod take_difference;
pub mod take_file;

/// The wire types that the clients speak.
pub use frontalis_proto::v1 as proto;
