//! Many sessions at once, each with its own subscriber of every frame: what is lost, and how long a sample takes.

use std::{fmt, time::Duration};

use tokio_util::sync::CancellationToken;

use crate::{
    TestServer,
    real_time::{RunningSession, percentile},
};

/// How much is asked of a server.
#[derive(Clone, Copy, Debug)]
pub struct LoadProfile {
    /// Sessions at 120 Hz, one subscriber of every frame each.
    pub n_sessions: usize,
    /// For how long.
    pub duration: Duration,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct LoadReport {
    /// What was asked.
    pub profile: LoadProfile,
    /// Frames published, all sessions.
    pub n_frames: u64,
    /// Frames taken and not solved.
    pub n_shed: u64,
    /// Samples that a subscriber did not get.
    pub n_missing: u64,
    /// From publish to receipt, microseconds: median.
    pub p50_micros: f64,
    /// From publish to receipt, microseconds: 99th percentile.
    pub p99_micros: f64,
    /// From publish to receipt, microseconds: the worst.
    pub max_micros: f64,
}

impl LoadProfile {
    /// Runs the profile on a server that has the reference face.
    pub async fn run(self, server: &TestServer) -> LoadReport {
        let stop = CancellationToken::new();
        let mut running = Vec::new();
        for session in 0..self.n_sessions {
            let id = format!("load-{session}");
            running.push(RunningSession::start(server, &id, 1, stop.clone()).await);
        }
        tokio::time::sleep(self.duration).await;
        stop.cancel();
        let mut report = LoadReport {
            profile: self,
            n_frames: 0,
            n_shed: 0,
            n_missing: 0,
            p50_micros: 0.0,
            p99_micros: 0.0,
            max_micros: 0.0,
        };
        let mut latencies = Vec::new();
        for session in running {
            let outcome = session.finish(server).await;
            report.n_frames += outcome.n_frames;
            report.n_shed += outcome.n_shed;
            report.n_missing += outcome.n_missing;
            latencies.extend(outcome.latencies_micros);
        }
        latencies.sort_by(f64::total_cmp);
        report.p50_micros = percentile(&latencies, 50);
        report.p99_micros = percentile(&latencies, 99);
        report.max_micros = percentile(&latencies, 100);
        report
    }
}

impl fmt::Display for LoadReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} sessions x 120 Hz x 1 subscriber of every frame, {:.0} s: {} frames, shed {}, missing {}, \
             publish to receipt p50 {:.0} us, p99 {:.0} us, max {:.0} us",
            self.profile.n_sessions,
            self.profile.duration.as_secs_f64(),
            self.n_frames,
            self.n_shed,
            self.n_missing,
            self.p50_micros,
            self.p99_micros,
            self.max_micros,
        )
    }
}
