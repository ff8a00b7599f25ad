//! The bystander: a session at 120 Hz with four subscribers of every frame, which must not notice what a test does.

use tokio_util::sync::CancellationToken;

use crate::{
    TestServer,
    real_time::{self, RunningSession},
};

const N_SUBSCRIBERS: usize = 4;

/// A running control session.
pub struct ControlSession {
    stop: CancellationToken,
    running: RunningSession,
}

/// What the control session saw.
#[derive(Clone, Copy, Debug)]
pub struct ControlReport {
    /// Frames published; every subscriber got a sample of each.
    pub n_frames: u64,
    /// 99th percentile over all samples from publish to receipt, microseconds.
    pub p99_micros: f64,
}

impl ControlSession {
    /// Starts to publish on `server`; the reference face must be there.
    pub async fn start(server: &TestServer) -> Self {
        let stop = CancellationToken::new();
        let running = RunningSession::start(server, "control", N_SUBSCRIBERS, stop.clone()).await;
        Self { stop, running }
    }

    /// Ends the session, and fails if anything was lost.
    pub async fn finish(self, server: &TestServer) -> ControlReport {
        self.stop.cancel();
        let outcome = self.running.finish(server).await;
        assert_eq!(
            (outcome.n_missing, outcome.n_shed),
            (0, 0),
            "the control session lost frames"
        );
        let mut latencies = outcome.latencies_micros;
        latencies.sort_by(f64::total_cmp);
        ControlReport {
            n_frames: outcome.n_frames,
            p99_micros: real_time::percentile(&latencies, 99),
        }
    }
}
