//! How a server stops: in phases, each of which everybody can see (CONTRACTS O-13).
//!
//! Draining: not ready, nothing new is accepted, streams close with `DRAINING`. Closing: connections finish what they
//! have begun. Cut: what is still open is dropped.

use std::io;

use tokio::signal::unix::{Signal, SignalKind, signal};
use tokio_util::sync::CancellationToken;

/// The phases as tokens; cheap to clone, clones share them.
#[derive(Clone, Debug, Default)]
pub struct Phases {
    /// Not ready; sessions finish and close their streams.
    pub draining: CancellationToken,
    /// No connection is accepted; open ones finish.
    pub closing: CancellationToken,
    /// Open connections are dropped.
    pub cut: CancellationToken,
}

impl Phases {
    /// Whether the server is on its way out.
    pub fn is_draining(&self) -> bool {
        self.draining.is_cancelled()
    }
}

/// SIGTERM and SIGINT of this process.
pub struct StopSignals {
    terminate: Signal,
    interrupt: Signal,
}

impl StopSignals {
    /// Takes both signals over; from now on they no longer end the process by themselves.
    ///
    /// # Errors
    ///
    /// As the system says.
    pub fn take() -> io::Result<Self> {
        Ok(Self {
            terminate: signal(SignalKind::terminate())?,
            interrupt: signal(SignalKind::interrupt())?,
        })
    }

    /// Waits for the next of either; its name.
    pub async fn next(&mut self) -> &'static str {
        tokio::select! {
            _ = self.terminate.recv() => "SIGTERM",
            _ = self.interrupt.recv() => "SIGINT",
        }
    }
}

/// SIGHUP of this process, which asks to look at files again.
pub struct ReloadSignal(Signal);

impl ReloadSignal {
    /// Takes the signal over; from now on it no longer ends the process.
    ///
    /// # Errors
    ///
    /// As the system says.
    pub fn take() -> io::Result<Self> {
        signal(SignalKind::hangup()).map(Self)
    }

    /// Waits for the next.
    pub async fn next(&mut self) {
        self.0.recv().await;
    }
}
