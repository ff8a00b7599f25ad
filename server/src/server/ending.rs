//! What has to end before a server has stopped, and in which order.

use std::time::Duration;

use tokio::time::timeout;
use tokio_util::{sync::CancellationToken, task::TaskTracker};
use tonic_health::server::HealthReporter;

use crate::{
    service::{door, readiness::Readiness},
    session::SessionRegistry,
    shutdown::Phases,
    take::Recorder,
    telemetry::Metrics,
};

/// Time for the last events to reach the disk, after everything else has ended.
const LAST_WRITES: Duration = Duration::from_secs(1);

/// Time for the last takes to be put into their final form; what is not is so at the next start.
const LAST_TAKES: Duration = Duration::from_secs(3);

/// What has to end, in order.
pub(super) struct Ending {
    pub(super) grace: Duration,
    pub(super) phases: Phases,
    pub(super) readiness: Readiness,
    pub(super) health: HealthReporter,
    pub(super) registry: SessionRegistry,
    pub(super) connections: TaskTracker,
    pub(super) recorder: Recorder,
    pub(super) upkeep: TaskTracker,
    pub(super) drained: CancellationToken,
    pub(super) metrics: Metrics,
}

impl Ending {
    /// Drains within the grace, then cuts what is left. True: nothing had to be cut.
    pub(super) async fn run(mut self) -> bool {
        tracing::info!("draining");
        self.metrics.set_ready(false);
        self.phases.draining.cancel();
        let clean = timeout(self.grace, self.drain()).await.is_ok();
        if !clean {
            let n_connections = self.metrics.open_connections();
            tracing::warn!(
                n_connections,
                "the grace is over, what is still open is cut"
            );
        }
        self.phases.closing.cancel();
        self.phases.cut.cancel();
        self.connections.close();
        self.connections.wait().await;
        // Sessions are over, so their takes end by themselves.
        let recorded = timeout(LAST_TAKES, self.recorder.ended()).await.is_ok();
        self.drained.cancel();
        self.upkeep.close();
        // Only a session that did not finish within the grace can still hold these up.
        let written = timeout(LAST_WRITES, self.upkeep.wait()).await.is_ok();
        tracing::info!("stopped");
        clean && written && recorded
    }

    async fn drain(&mut self) {
        door::report(&self.health, &self.readiness).await;
        self.registry.drain().await;
        door::forget_health(&mut self.health).await;
        self.phases.closing.cancel();
        self.connections.close();
        self.connections.wait().await;
    }
}
