//! A server that is killed at random instants while it records, and what its takes hold afterwards (CONTRACTS G1).

use std::{fmt, time::Duration};

use frontalis_proto::v1::{StartTakeRequest, TakeState};
use futures::future::join_all;
use rand::{Rng as _, RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;
use tokio::time::Instant;

use crate::{
    Publisher, RecordedTake, TestPerformance, TestServer,
    take_calls::{export_mcap, take_in_order},
};

/// Frames that a publisher has on their way.
const AHEAD: u64 = 64;
/// Frames of one message.
const BATCH: u64 = 4;
/// Longest life of a server under load, milliseconds.
const MAX_LIFE_MILLIS: u64 = 400;
/// Longest life of one that is killed while it recovers, milliseconds.
const MAX_RECOVERY_MILLIS: u64 = 40;

/// How often, and how much is recorded meanwhile.
#[derive(Clone, Copy, Debug)]
pub struct KillProfile {
    /// Servers that are killed under load.
    pub n_kills: usize,
    /// Sessions that are recorded at once.
    pub n_sessions: usize,
    /// Of the instants.
    pub seed: u64,
}

/// What was found after all kills.
#[derive(Clone, Debug, Default)]
pub struct KillReport {
    /// Kills under load.
    pub n_kills: usize,
    /// Kills while takes were recovered.
    pub n_kills_in_recovery: usize,
    /// Takes that were open.
    pub n_takes: usize,
    /// Frames that were acknowledged as durable.
    pub n_durable: u64,
    /// Of them, frames that were not in their take.
    pub n_lost: u64,
    /// Frames that stood twice in their take.
    pub n_doubled: u64,
    /// Frames that stood behind a later one.
    pub n_reordered: u64,
    /// Frames that are not those that were sent.
    pub n_wrong: u64,
    /// Takes that do not open, or are not said to be recovered.
    pub n_unopenable: usize,
    /// From start to the port, the longest, milliseconds.
    pub ready_millis: f64,
    /// From the port to the last take in order, the longest, milliseconds.
    pub recovered_millis: f64,
}

/// A take that was under way, and what was acknowledged of it.
struct Killed {
    take: String,
    durable_through: u64,
}

impl KillProfile {
    /// Runs it on a server of its own.
    pub async fn run(self) -> KillReport {
        let mut random = Pcg64::seed_from_u64(self.seed);
        let mut server = TestServer::start_program(|_| {}).await;
        server.import_reference().await;
        for id in self.session_ids() {
            let created = server.create_session(&id, "actors/reference").await;
            created.unwrap();
        }
        let mut report = KillReport::default();
        for kill in 0..self.n_kills {
            let life = Duration::from_millis(random.random_range(0..MAX_LIFE_MILLIS));
            let recording = self.session_ids().map(|id| record(&server, id));
            let recording: Vec<_> = join_all(recording).await;
            tokio::time::sleep(life).await;
            let started = Instant::now();
            server = server.kill_and_restart().await;
            report.ready_millis = report.ready_millis.max(millis_since(started));
            let killed = join_all(recording).await;
            if random.next_u32().is_multiple_of(4) {
                let life = random.random_range(0..MAX_RECOVERY_MILLIS);
                tokio::time::sleep(Duration::from_millis(life)).await;
                server = server.kill_and_restart().await;
                report.n_kills_in_recovery += 1;
            }
            let ready = Instant::now();
            for it in killed {
                report.check(&server, &it.unwrap()).await;
            }
            report.recovered_millis = report.recovered_millis.max(millis_since(ready));
            report.n_kills += 1;
            if (kill + 1).is_multiple_of(20) {
                println!("{report}");
            }
        }
        report
    }

    fn session_ids(self) -> impl Iterator<Item = String> {
        (0..self.n_sessions).map(|it| format!("stage-{it}"))
    }
}

fn millis_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

/// Starts a take of a session and publishes into it until the server is gone.
async fn record(server: &TestServer, id: String) -> tokio::task::JoinHandle<Killed> {
    let session = format!("sessions/{id}");
    let request = StartTakeRequest {
        session: session.clone(),
        ..StartTakeRequest::default()
    };
    let take = server.takes().await.start_take(request).await.unwrap();
    let take = take.into_inner().take.unwrap().name;
    let performance = TestPerformance::reference();
    let start = performance.start(&session, &id);
    let publisher = Publisher::open(server, start).await.unwrap();
    tokio::spawn(publish(publisher, performance, take))
}

async fn publish(mut publisher: Publisher, performance: TestPerformance, take: String) -> Killed {
    let mut sent = 0;
    loop {
        while sent < publisher.report().durable_through + AHEAD {
            publisher
                .send(performance.frames(sent + 1..=sent + BATCH))
                .await;
            sent += BATCH;
        }
        if let Ok(Some(_)) = publisher.next().await {
        } else {
            let durable_through = publisher.report().durable_through;
            return Killed {
                take,
                durable_through,
            };
        }
    }
}

impl KillReport {
    /// Whether nothing was lost.
    pub fn is_clean(&self) -> bool {
        let n_bad = self.n_lost + self.n_doubled + self.n_reordered + self.n_wrong;
        n_bad == 0 && self.n_unopenable == 0
    }

    async fn check(&mut self, server: &TestServer, killed: &Killed) {
        self.n_takes += 1;
        self.n_durable += killed.durable_through;
        let take = take_in_order(server, &killed.take).await;
        if take.state() != TakeState::Closed || !take.recovered {
            eprintln!("{take:?}");
            self.n_unopenable += 1;
            return;
        }
        let recorded = RecordedTake::read(&export_mcap(server, &take.name).await);
        let performance = TestPerformance::reference();
        let mut last = 0;
        for frame in &recorded.frames {
            let number = frame.number;
            self.n_doubled += u64::from(number == last);
            self.n_reordered += u64::from(number < last);
            self.n_wrong += u64::from(*frame != performance.frame(number));
            last = number;
        }
        let is_there = |number: &u64| recorded.frames.iter().any(|it| it.number == *number);
        let durable = 1..=killed.durable_through;
        let n_found = durable.filter(is_there).count() as u64;
        self.n_lost += killed.durable_through - n_found;
    }
}

impl fmt::Display for KillReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} kills under load and {} during recovery, {} takes, {} frames acknowledged as durable: \
             lost {}, doubled {}, out of order {}, wrong {}, takes that do not open {}; \
             listening again after at most {:.0} ms, all takes in order and read {:.0} ms later",
            self.n_kills,
            self.n_kills_in_recovery,
            self.n_takes,
            self.n_durable,
            self.n_lost,
            self.n_doubled,
            self.n_reordered,
            self.n_wrong,
            self.n_unopenable,
            self.ready_millis,
            self.recovered_millis,
        )
    }
}
