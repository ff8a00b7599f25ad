//! What an abuse costs a server of its own process: memory at its peak, and processor time.

use std::{fmt, time::Duration};

use crate::ServerProgram;

/// From the start of a measurement to its end; the control session's share is in it.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Resident memory at its peak, above what it was, bytes.
    pub grown_bytes: u64,
    /// Processor time.
    pub cpu: Duration,
}

impl Cost {
    /// Measures while `what` runs.
    pub async fn of<T>(program: &ServerProgram, what: impl Future<Output = T>) -> (T, Self) {
        program.forget_peak();
        let (bytes, nanos) = (program.resident_bytes(), program.cpu_nanos());
        let outcome = what.await;
        let cost = Self {
            grown_bytes: program.peak_resident_bytes().saturating_sub(bytes),
            cpu: Duration::from_nanos(program.cpu_nanos().saturating_sub(nanos)),
        };
        (outcome, cost)
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kib, millis) = (self.grown_bytes / 1024, self.cpu.as_millis());
        write!(
            f,
            "{kib} KiB more at the peak, {millis} ms of processor time"
        )
    }
}
