//! A recording server that is told to stop and started again, with clients that come back by themselves (CONTRACTS G10).

use std::{fmt, net::SocketAddr, time::Duration};

use frontalis_client::{
    capture_client::{CaptureClient, CaptureSettings},
    connection::lazy_channel,
};
use frontalis_proto::v1::{GetTakeRequest, Ingest, LengthUnit, StartTakeRequest, TakeState};
use tokio::time::{Instant, interval};
use tokio_util::sync::CancellationToken;

use crate::{TestPerformance, TestServer};

const SESSION: &str = "sessions/stage";
/// How long a server records before it is told to stop.
const LIFE: Duration = Duration::from_millis(300);
/// How often is looked whether frames flow again.
const LOOK_EVERY: Duration = Duration::from_millis(5);

/// How often.
#[derive(Clone, Copy, Debug)]
pub struct DrainProfile {
    /// Cycles of recording, stopping and starting.
    pub n_cycles: usize,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct DrainReport {
    /// Cycles.
    pub n_cycles: usize,
    /// Frames that were acknowledged as durable.
    pub n_durable: u64,
    /// Of them, those that their take does not have.
    pub n_lost: u64,
    /// Takes that were not closed by the drain.
    pub n_open: usize,
    /// From SIGTERM to the end of the process, the longest, milliseconds.
    pub exit_millis: f64,
    /// From the port to the next accepted frame, the longest, milliseconds.
    pub flowing_millis: f64,
}

impl DrainProfile {
    /// Runs it on a server of its own.
    pub async fn run(self) -> DrainReport {
        let port = free_port();
        let mut server = TestServer::start_program(|config| config.listen = port).await;
        server.import_reference().await;
        let created = server.create_session("stage", "actors/reference").await;
        created.unwrap();
        let channel = lazy_channel(&server.url()).unwrap();
        let performance = TestPerformance::reference();
        let publisher = CaptureClient::start(channel, settings(&performance)).await;
        let publisher = publisher.unwrap();
        let stop = CancellationToken::new();
        let mut report = DrainReport::default();
        let cycles = async {
            for _ in 0..self.n_cycles {
                server = report.cycle(server, &publisher).await;
            }
            stop.cancel();
            server
        };
        let (_server, ()) = tokio::join!(cycles, perform(&publisher, &performance, &stop));
        report
    }
}

/// Sends at the performance's rate until `stop`.
async fn perform(
    publisher: &CaptureClient,
    performance: &TestPerformance,
    stop: &CancellationToken,
) {
    let mut ticks = interval(Duration::from_secs_f64(1.0 / performance.rate_hz));
    for number in 1.. {
        tokio::select! {
            _ = ticks.tick() => {}
            () = stop.cancelled() => return,
        }
        publisher.send(performance.frame(number)).await.unwrap();
    }
}

impl DrainReport {
    /// Whether nothing was lost.
    pub fn is_clean(&self) -> bool {
        self.n_lost == 0 && self.n_open == 0
    }

    async fn cycle(&mut self, server: TestServer, publisher: &CaptureClient) -> TestServer {
        let request = StartTakeRequest {
            session: SESSION.to_owned(),
            ..StartTakeRequest::default()
        };
        let take = server.takes().await.start_take(request).await.unwrap();
        let name = take.into_inner().take.unwrap().name;
        tokio::time::sleep(LIFE).await;
        let told = Instant::now();
        let stopped = server.terminate().await;
        self.exit_millis = self.exit_millis.max(millis_since(told));
        let durable_through = publisher.report().durable_through;
        let accepted_through = publisher.report().accepted_through;
        let server = stopped.start_again().await;
        let ready = Instant::now();
        while publisher.report().accepted_through <= accepted_through {
            tokio::time::sleep(LOOK_EVERY).await;
        }
        self.flowing_millis = self.flowing_millis.max(millis_since(ready));
        let answer = server.takes().await.get_take(GetTakeRequest { name }).await;
        let take = answer.unwrap().into_inner().take.unwrap();
        self.n_open += usize::from(take.state() != TakeState::Closed);
        let n_frames = (durable_through + 1).saturating_sub(take.first_frame);
        self.n_durable += n_frames;
        // Frames of one publisher come in order, so that the last stands for all before it.
        let is_whole = take.n_frames == take.last_frame + 1 - take.first_frame;
        let n_behind = durable_through.saturating_sub(take.last_frame);
        self.n_lost += if is_whole { n_behind } else { n_frames };
        self.n_cycles += 1;
        server
    }
}

fn settings(performance: &TestPerformance) -> CaptureSettings {
    CaptureSettings {
        session: SESSION.to_owned(),
        publisher: "stage".to_owned(),
        marker_names: performance.marker_names().to_vec(),
        unit: LengthUnit::Millimeter,
        rate_hz: performance.rate_hz,
        ingest: Ingest::Lossless,
        takeover: false,
    }
}

/// A port that nobody listens on, so that a server finds it again after a restart.
fn free_port() -> SocketAddr {
    let listener = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    listener.local_addr().unwrap()
}

fn millis_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

impl fmt::Display for DrainReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} cycles, {} frames acknowledged as durable: lost {}, takes that were not closed {}; \
             from SIGTERM to the end at most {:.0} ms, frames accepted again at most {:.0} ms after the port was open",
            self.n_cycles,
            self.n_durable,
            self.n_lost,
            self.n_open,
            self.exit_millis,
            self.flowing_millis,
        )
    }
}
