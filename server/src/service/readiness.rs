//! What the server is ready for: new sessions, and new takes (CONTRACTS O-12).

use tokio::sync::watch;
use tonic::{Code, Status};

use super::grpc::status::{Refusal, refuse};
use crate::{shutdown::Phases, take::DiskRoom};

/// The service whose health is that of recording.
pub const RECORDING: &str = "frontalis.v1.TakeService";

/// Cheap to clone.
#[derive(Clone, Debug)]
pub struct Readiness {
    /// Whether the server drains.
    pub phases: Phases,
    /// Why the server only shows what there is; `None`: it does everything.
    pub rescue: Option<String>,
    /// The room on the disk of takes, looked at now and then.
    pub disk: watch::Receiver<DiskRoom>,
}

impl Readiness {
    /// Whether new sessions are accepted.
    ///
    /// # Errors
    ///
    /// `DRAINING` or `RESCUE_MODE`.
    pub fn check(&self) -> Result<(), Status> {
        if self.phases.is_draining() {
            let message = "the server is shutting down";
            return Err(refuse(Code::Unavailable, "DRAINING", message));
        }
        self.check_rescue()
    }

    /// Whether new takes may start.
    ///
    /// # Errors
    ///
    /// As [`Self::check`], or `DISK_LOW` with both figures.
    pub fn check_recording(&self) -> Result<(), Status> {
        self.check()?;
        let room = *self.disk.borrow();
        if room.is_enough() {
            return Ok(());
        }
        Err(disk_low(room))
    }

    /// Whether anything may be changed.
    ///
    /// # Errors
    ///
    /// `RESCUE_MODE`.
    pub fn check_rescue(&self) -> Result<(), Status> {
        let Some(why) = &self.rescue else {
            return Ok(());
        };
        let message = format!("{why}; this server only shows the takes that it found");
        Err(refuse(Code::Unavailable, "RESCUE_MODE", message))
    }
}

/// The disk has no room for a new take.
pub fn disk_low(room: DiskRoom) -> Status {
    let DiskRoom {
        free_bytes,
        needed_bytes,
    } = room;
    let message = format!("{free_bytes} bytes are free, a take needs {needed_bytes}");
    Refusal::new(Code::ResourceExhausted, "DISK_LOW", message)
        .with("free_bytes", &free_bytes)
        .with("needed_bytes", &needed_bytes)
        .into_status()
}
