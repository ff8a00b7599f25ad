//! What goes wrong in one simulation, and when.

use std::time::Duration;

use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

/// Nothing goes wrong after this.
const LAST_FAULT: Duration = Duration::from_secs(8);

/// Time for everyone to notice that a connection is gone and to come back: the longest wait before an attempt is 5 s.
const BACK: Duration = Duration::from_secs(8);

/// Time to find out that a connection leads nowhere (D-25).
const HALF_OPEN: Duration = Duration::from_secs(17);

/// Between two faults, milliseconds.
const PAUSE_MILLIS: std::ops::Range<u64> = 150..1_800;

/// A client whose way to the server may suffer.
const CLIENTS: [&str; 3] = ["publisher", "subscriber", "operator"];

/// A thing that goes wrong, or right again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Nothing gets through between this client and the server; what is sent waits.
    Hold(&'static str),
    /// What waited is delivered.
    Release(&'static str),
    /// What is sent between this client and the server is lost.
    Partition(&'static str),
    /// No longer.
    Repair(&'static str),
    /// Messages take up to so long.
    Delay(Duration),
    /// Every connection is reset.
    Reset,
    /// The power of the server goes.
    Crash,
    /// It starts again.
    Restart,
}

/// What goes wrong for this seed, in time. Whatever breaks is mended.
pub fn schedule(seed: u64) -> Vec<(Duration, Fault)> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut faults = Vec::new();
    let mut now = Duration::ZERO;
    loop {
        now += Duration::from_millis(random.random_range(PAUSE_MILLIS));
        let lasts = Duration::from_millis(random.random_range(50..2_500));
        if now + lasts > LAST_FAULT {
            break;
        }
        let client = CLIENTS[random.random_range(0..CLIENTS.len())];
        let (fault, mended) = match random.random_range(0..8) {
            0 | 1 => (Fault::Hold(client), Some(Fault::Release(client))),
            2 => (Fault::Partition(client), Some(Fault::Repair(client))),
            3 => (Fault::Delay(lasts / 10), None),
            4 | 5 => (Fault::Reset, None),
            _ => (Fault::Crash, Some(Fault::Restart)),
        };
        faults.push((now, fault));
        if let Some(mended) = mended {
            // One at a time: what overlaps is another fault in the schedule of another seed.
            now += lasts;
            faults.push((now, mended));
        }
    }
    faults
}

/// From when on all is well again.
pub fn healed(faults: &[(Duration, Fault)]) -> Duration {
    let is_half_open = faults.iter().any(|it| matches!(it.1, Fault::Partition(_)));
    LAST_FAULT
        + BACK
        + if is_half_open {
            HALF_OPEN
        } else {
            Duration::ZERO
        }
}
