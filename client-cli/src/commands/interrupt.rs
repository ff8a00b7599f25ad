//! The wish to stop: Ctrl-C, SIGTERM from whoever started this program, or SIGHUP when its terminal is closed.

use std::{fs, io};

use tokio::signal::unix::{Signal, SignalKind, signal};

/// Listens for the signals from its creation on.
pub struct Interrupt {
    ctrl_c: Signal,
    terminate: Signal,
    /// Absent when `nohup` asked to outlive the terminal.
    hangup: Option<Signal>,
}

impl Interrupt {
    pub fn listen() -> io::Result<Self> {
        let hangup = if is_hangup_ignored() {
            None
        } else {
            Some(signal(SignalKind::hangup())?)
        };
        Ok(Self {
            ctrl_c: signal(SignalKind::interrupt())?,
            terminate: signal(SignalKind::terminate())?,
            hangup,
        })
    }

    /// Waits for any of them. Safe to cancel.
    pub async fn wait(&mut self) {
        let hangup = async {
            match &mut self.hangup {
                Some(hangup) => hangup.recv().await,
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            _ = self.ctrl_c.recv() => {}
            _ = self.terminate.recv() => {}
            _ = hangup => {}
        }
    }
}

/// Whether SIGHUP was ignored when this program was started; where that cannot be told, it was not.
fn is_hangup_ignored() -> bool {
    fs::read_to_string("/proc/self/status").is_ok_and(|it| ignores_hangup(&it))
}

/// `SigIgn` of proc(5): a mask in hexadecimal, the lowest bit SIGHUP's.
fn ignores_hangup(status: &str) -> bool {
    status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| mask & 1 == 1)
}

#[cfg(test)]
mod tests {
    use std::{future::Future, pin::pin, time::Duration};

    use rustix::process::{Signal, getpid, kill_process};

    use super::*;

    async fn ends(waiting: impl Future<Output = ()>) -> bool {
        let waiting = pin!(waiting);
        tokio::time::timeout(Duration::from_secs(5), waiting)
            .await
            .is_ok()
    }

    #[tokio::test]
    async fn a_closed_terminal_is_a_wish_to_stop() {
        let mut interrupt = Interrupt {
            hangup: Some(signal(SignalKind::hangup()).unwrap()),
            ..Interrupt::listen().unwrap()
        };
        // Sent before anybody waits, it still counts.
        kill_process(getpid(), Signal::HUP).unwrap();
        assert!(ends(interrupt.wait()).await);
    }

    #[test]
    fn nohup_is_read_from_the_mask_of_ignored_signals() {
        assert!(ignores_hangup("SigBlk:\t0\nSigIgn:\t0000000000001001\n"));
        assert!(!ignores_hangup("SigIgn:\t0000000000001000\nSigCgt:\t1\n"));
        assert!(!ignores_hangup(""));
    }
}
