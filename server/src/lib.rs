//! The Frontalis server: capture streams in, muscle curves out.
//!
//! Layers, each of which names only what stands to its right: `service → wire → session → hub`, all on
//! `frontalis_analysis`; [`catalogue`] keeps what survives a restart.
//! [`run`] joins them: configuration and a bound port in, a [`Server`] out that stops when it is told to.

pub mod catalogue;
pub mod clock;
pub mod config;
pub mod executor;
pub mod fs;
pub mod hub;
pub mod name;
pub mod reload;
pub mod service;
pub mod session;
pub mod shutdown;
pub mod take;
pub mod telemetry;
pub mod wire;

mod server;

pub use server::{Ground, RunError, Server, run, run_on};
