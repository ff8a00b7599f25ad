//! A session that is published in real time and heard by subscribers of every frame, with the latency of every sample.

use std::time::Duration;

use frontalis_proto::v1::Ingest;
use tokio::{
    task::JoinHandle,
    time::{Instant, MissedTickBehavior},
};
use tokio_util::sync::CancellationToken;

use crate::{Heard, Publisher, Subscriber, TestPerformance, TestServer, every_frame};

/// Least length of a run: enough to tell a percentile.
const MIN_FRAMES: u64 = 120;
/// The first frames wait for the alignment that they give, so their latency is not that of the service.
const ALIGNING_FRAMES: u64 = 20;

/// One session with its publisher and its subscribers, all at work.
pub struct RunningSession {
    name: String,
    publishing: JoinHandle<(u64, u64)>,
    listening: Vec<JoinHandle<Listened>>,
}

/// What came of a session in real time.
#[derive(Clone, Debug)]
pub struct SessionOutcome {
    /// Frames published.
    pub n_frames: u64,
    /// Frames taken and not solved.
    pub n_shed: u64,
    /// Samples that a subscriber did not get, over all of them.
    pub n_missing: u64,
    /// From publish to receipt, every sample of every subscriber but those of the neutral frames, microseconds.
    pub latencies_micros: Vec<f64>,
}

impl RunningSession {
    /// Creates the session `id` of the reference face and publishes live at 120 Hz until `stop`.
    pub async fn start(
        server: &TestServer,
        id: &str,
        n_subscribers: usize,
        stop: CancellationToken,
    ) -> Self {
        let name = server
            .create_session(id, "actors/reference")
            .await
            .unwrap()
            .name;
        let performance = TestPerformance::reference();
        let mut start = performance.start(&name, id);
        start.ingest = Ingest::Live.into();
        let publisher = Publisher::open(server, start).await.unwrap();
        let epoch = Instant::now();
        let mut listening = Vec::new();
        for _ in 0..n_subscribers {
            let subscriber = Subscriber::open(server, every_frame(&name)).await.unwrap();
            listening.push(tokio::spawn(listen(subscriber, epoch)));
        }
        let publishing = tokio::spawn(publish(publisher, performance, epoch, stop));
        Self {
            name,
            publishing,
            listening,
        }
    }

    /// Waits until the publisher has stopped, ends the session and counts.
    pub async fn finish(self, server: &TestServer) -> SessionOutcome {
        let (n_frames, n_shed) = self.publishing.await.unwrap();
        server.end_session(&self.name).await;
        let mut latencies_micros = Vec::new();
        let mut n_missing = 0;
        for listener in self.listening {
            let received = listener.await.unwrap();
            n_missing += n_frames - received.n_samples;
            latencies_micros.extend(received.latencies_micros);
        }
        SessionOutcome {
            n_frames,
            n_shed,
            n_missing,
            latencies_micros,
        }
    }
}

/// A percentile of sorted values.
pub fn percentile(sorted: &[f64], percent: usize) -> f64 {
    sorted[(sorted.len() - 1) * percent / 100]
}

/// Publishes in real time until told to stop; returns the number of frames and of those shed.
async fn publish(
    mut publisher: Publisher,
    performance: TestPerformance,
    epoch: Instant,
    stop: CancellationToken,
) -> (u64, u64) {
    let mut ticks = tokio::time::interval(Duration::from_secs_f64(1.0 / performance.rate_hz));
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut number = 0;
    while !stop.is_cancelled() || number < MIN_FRAMES {
        ticks.tick().await;
        number += 1;
        let mut frame = performance.frame(number);
        frame.capture_time_nanos = nanos_since(epoch);
        publisher.send(vec![frame]).await;
    }
    let report = publisher.finish().await.unwrap();
    assert_eq!(report.accepted_through, number);
    assert_eq!(report.rejected, []);
    (number, report.shed_frames)
}

/// What one subscriber received.
#[derive(Default)]
struct Listened {
    n_samples: u64,
    latencies_micros: Vec<f64>,
}

/// Reads to the end of the session.
async fn listen(mut subscriber: Subscriber, epoch: Instant) -> Listened {
    let mut listened = Listened::default();
    while let Some(heard) = subscriber.next().await.unwrap() {
        let Heard::Sample(sample) = heard else {
            continue;
        };
        listened.n_samples += 1;
        assert_eq!(
            sample.sequence, listened.n_samples,
            "a hole in the sequence"
        );
        assert!(sample.activations.iter().all(|it| it.is_finite()));
        if sample.frame > ALIGNING_FRAMES {
            let latency_nanos = nanos_since(epoch) - sample.capture_time_nanos;
            listened.latencies_micros.push(latency_nanos as f64 / 1e3);
        }
    }
    listened
}

fn nanos_since(epoch: Instant) -> i64 {
    i64::try_from(epoch.elapsed().as_nanos()).unwrap()
}
