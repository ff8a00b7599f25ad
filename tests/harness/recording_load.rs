//! Many sessions recorded at once in real time: what is shed, and how far stable storage is behind.

use std::{
    collections::VecDeque, fmt, fs::OpenOptions, io::Write as _, path::Path, time::Duration,
};

use frontalis_proto::v1::{GetTakeRequest, Ingest, StartTakeRequest, StopTakeRequest, Take};
use prost::Message as _;
use tokio::time::{Instant, MissedTickBehavior, interval};

use crate::{Publisher, TestPerformance, TestServer, real_time::percentile};

/// Bytes of one flush of the disk that is measured beside: about those of a commit of one session.
const FLUSH_BYTES: usize = 4_096;
/// Time between two of those.
const FLUSH_EVERY: Duration = Duration::from_millis(50);
/// While all sessions begin at once, lags are those of that, and told apart.
const WARM_UP: Duration = Duration::from_secs(3);

/// How much is recorded.
#[derive(Clone, Copy, Debug)]
pub struct RecordingProfile {
    /// Sessions at 120 Hz.
    pub n_sessions: usize,
    /// For how long.
    pub duration: Duration,
}

/// What came of it.
#[derive(Clone, Debug, Default)]
pub struct RecordingReport {
    /// Frames published, all sessions.
    pub n_frames: u64,
    /// Frames taken and not solved.
    pub n_shed: u64,
    /// Frames that were published and are in no take.
    pub n_missing: u64,
    /// From the answer that took a frame to the one that says it is durable, milliseconds: median.
    pub lag_p50_millis: f64,
    /// The same: 99th percentile.
    pub lag_p99_millis: f64,
    /// The same: the worst.
    pub lag_max_millis: f64,
    /// The worst while all sessions began at once.
    pub lag_at_start_millis: f64,
    /// A flush of the disk by itself, measured meanwhile, milliseconds: 99th percentile.
    pub flush_p99_millis: f64,
    /// Bytes of a frame's message as it was sent.
    pub sent_bytes: f64,
    /// Bytes a frame of the files while they grow: frame, sample and all around them.
    pub growing_bytes: f64,
    /// Bytes a frame of the files in their final form.
    pub final_bytes: f64,
}

/// How long frames were taken and not yet durable.
#[derive(Default)]
struct Lags {
    millis: Vec<f64>,
    worst_at_start_millis: f64,
}

/// One session's part.
struct Recorded {
    n_frames: u64,
    n_shed: u64,
    lags: Lags,
    growing: Take,
    closed: Take,
}

impl RecordingProfile {
    /// Runs it on a server that has the reference face.
    pub async fn run(self, server: &TestServer) -> RecordingReport {
        let until = Instant::now() + self.duration;
        let beside = server.folder().join("flush-measured-beside");
        let flushing = tokio::spawn(flushes(beside.clone(), until));
        let sessions = (0..self.n_sessions).map(|it| record(server, format!("stage-{it}"), until));
        let recorded = futures::future::join_all(sessions).await;
        let mut flushes = flushing.await.unwrap();
        std::fs::remove_file(beside).unwrap();
        report(&recorded, &mut flushes)
    }
}

fn report(recorded: &[Recorded], flushes_millis: &mut [f64]) -> RecordingReport {
    let sum = |figure: fn(&Recorded) -> u64| recorded.iter().map(figure).sum::<u64>();
    let mut lags: Vec<f64> = recorded
        .iter()
        .flat_map(|it| it.lags.millis.clone())
        .collect();
    lags.sort_by(f64::total_cmp);
    flushes_millis.sort_by(f64::total_cmp);
    let n_frames = sum(|it| it.n_frames);
    let n_growing = sum(|it| it.growing.n_frames).max(1) as f64;
    RecordingReport {
        n_frames,
        n_shed: sum(|it| it.n_shed),
        n_missing: n_frames - sum(|it| it.closed.n_frames),
        lag_p50_millis: percentile(&lags, 50),
        lag_p99_millis: percentile(&lags, 99),
        lag_max_millis: percentile(&lags, 100),
        lag_at_start_millis: recorded
            .iter()
            .fold(0.0, |most, it| it.lags.worst_at_start_millis.max(most)),
        flush_p99_millis: percentile(flushes_millis, 99),
        sent_bytes: TestPerformance::reference().frame(500).encoded_len() as f64,
        growing_bytes: sum(|it| it.growing.n_bytes) as f64 / n_growing,
        final_bytes: sum(|it| it.closed.n_bytes) as f64 / n_frames.max(1) as f64,
    }
}

/// Records one session until then.
async fn record(server: &TestServer, id: String, until: Instant) -> Recorded {
    let session = server.create_session(&id, "actors/reference").await;
    let session = session.unwrap().name;
    let mut takes = server.takes().await;
    let request = StartTakeRequest {
        session: session.clone(),
        ..StartTakeRequest::default()
    };
    let take = takes.start_take(request).await.unwrap().into_inner().take;
    let name = take.unwrap().name;
    let performance = TestPerformance::reference();
    let mut start = performance.start(&session, &id);
    start.ingest = Ingest::Live.into();
    let mut publisher = Publisher::open(server, start).await.unwrap();
    let (n_frames, lags) = publish(&mut publisher, &performance, until).await;
    publisher.durable(n_frames).await.unwrap();
    let request = GetTakeRequest { name: name.clone() };
    let growing = takes.get_take(request).await.unwrap().into_inner().take;
    let request = StopTakeRequest { name };
    let closed = takes.stop_take(request).await.unwrap().into_inner().take;
    Recorded {
        n_frames,
        n_shed: publisher.report().shed_frames,
        lags,
        growing: growing.unwrap(),
        closed: closed.unwrap(),
    }
}

/// Publishes in real time; how many frames, and how long each was taken and not yet durable.
async fn publish(
    publisher: &mut Publisher,
    performance: &TestPerformance,
    until: Instant,
) -> (u64, Lags) {
    let mut ticks = interval(Duration::from_secs_f64(1.0 / performance.rate_hz));
    ticks.set_missed_tick_behavior(MissedTickBehavior::Burst);
    let (mut sent, mut lags) = (0, Lags::default());
    let warm = Instant::now() + WARM_UP;
    let mut waiting: VecDeque<(u64, Instant)> = VecDeque::new();
    while Instant::now() < until {
        tokio::select! {
            _ = ticks.tick() => {
                sent += 1;
                publisher.send(vec![performance.frame(sent)]).await;
            }
            answer = publisher.next() => {
                answer.unwrap().unwrap();
                let now = Instant::now();
                let (accepted, durable) =
                    (publisher.report().accepted_through, publisher.report().durable_through);
                if accepted > waiting.back().map_or(0, |it| it.0) {
                    waiting.push_back((accepted, now));
                }
                while let Some((_, taken)) = waiting.front().filter(|it| it.0 <= durable) {
                    lags.add((now - *taken).as_secs_f64() * 1e3, *taken >= warm);
                    waiting.pop_front();
                }
            }
        }
    }
    (sent, lags)
}

impl Lags {
    fn add(&mut self, millis: f64, is_warm: bool) {
        if is_warm {
            self.millis.push(millis);
        } else {
            self.worst_at_start_millis = self.worst_at_start_millis.max(millis);
        }
    }
}

/// How long the disk takes for a small write and its flush, by itself, milliseconds.
async fn flushes(file: std::path::PathBuf, until: Instant) -> Vec<f64> {
    let mut all = Vec::new();
    while Instant::now() < until {
        let file = file.clone();
        let flushed = tokio::task::spawn_blocking(move || flush(&file));
        all.push(flushed.await.unwrap());
        tokio::time::sleep(FLUSH_EVERY).await;
    }
    all
}

fn flush(file: &Path) -> f64 {
    let mut open = OpenOptions::new()
        .create(true)
        .append(true)
        .open(file)
        .unwrap();
    let start = Instant::now();
    open.write_all(&[0; FLUSH_BYTES]).unwrap();
    open.sync_data().unwrap();
    start.elapsed().as_secs_f64() * 1e3
}

impl RecordingReport {
    /// The most that stable storage may be behind, milliseconds: 20 ms and twice the disk's own flush.
    pub fn allowed_millis(&self) -> f64 {
        20.0 + 2.0 * self.flush_p99_millis
    }
}

impl fmt::Display for RecordingReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} frames, shed {}, not recorded {}; `durable_through` behind `accepted_through` p50 {:.1} ms, p99 {:.1} ms, \
             max {:.1} ms ({:.1} ms while all sessions began at once), allowed {:.1} ms (20 ms and twice the disk's own flush p99 of {:.1} ms); \
             bytes a frame: {:.0} sent, {:.0} in the growing file with its sample, {:.0} in the final form",
            self.n_frames,
            self.n_shed,
            self.n_missing,
            self.lag_p50_millis,
            self.lag_p99_millis,
            self.lag_max_millis,
            self.lag_at_start_millis,
            self.allowed_millis(),
            self.flush_p99_millis,
            self.sent_bytes,
            self.growing_bytes,
            self.final_bytes,
        )
    }
}
