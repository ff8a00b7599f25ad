//! What the end-to-end tests stand on: a real server on port 0, a performance with known curves, and plain clients.
//!
//! The clients are the generated stubs with a little memory, not the client library: a test must be able to break the
//! contract that the library keeps.
#![expect(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "a test that fails here is its own report"
)]

pub mod accuracy;
mod client_files;
mod control_session;
mod cost;
mod doors;
mod drains;
mod eventually;
mod http;
mod issuer;
mod keys;
mod kills;
mod load;
mod package;
mod performance;
mod problem;
mod programs;
mod protection;
mod publisher;
mod raw_grpc;
pub mod raw_http2;
mod real_time;
mod recorded;
mod recording_load;
mod recovery_load;
mod report;
mod resolve_speed;
mod server;
mod server_program;
mod shared_data;
mod stall;
mod subscriber;
mod take_calls;
mod tls;
mod vanishing;

pub use client_files::ClientFiles;
pub use control_session::{ControlReport, ControlSession};
pub use cost::Cost;
pub use doors::{
    Closed, DoorCosts, Event, EventStream, GrpcWeb, LinePublisher, Received, SocketFrame,
    SocketFrames, StalledDoors, WebSocket,
};
pub use drains::{DrainProfile, DrainReport};
pub use http::{HttpAnswer, http_get, http_send};
pub use issuer::TestIssuer;
pub use keys::{Bearer, Keys, now};
pub use kills::{KillProfile, KillReport};
pub use load::{LoadProfile, LoadReport};
pub use package::{PackageFiles, glb, reference_package, toy_files, toy_glb, toy_json, zip};
pub use performance::TestPerformance;
pub use problem::{Problem, assert_refused};
pub use programs::program;
pub use protection::Protection;
pub use publisher::{PublishReport, Publisher};
pub use raw_grpc::{RawAnswer, RawCall, RawConnection, encoded, framed, prefixed};
pub use recorded::RecordedTake;
pub use recording_load::{RecordingProfile, RecordingReport};
pub use recovery_load::{RecoveryProfile, RecoveryReport, head_of, many_takes};
pub use report::write_section;
pub use resolve_speed::{ResolveProfile, ResolveReport};
pub use server::{TestChannel, TestServer};
pub use server_program::ServerProgram;
pub use shared_data::data_dir;
pub use stall::{StallProfile, StallReport};
pub use subscriber::{Heard, Subscriber, every_frame, latest};
pub use take_calls::{export_mcap, take_in_order};
pub use tls::{ClientCert, TestAuthority, TestTls};
pub use vanishing::Vanishing;
