//! A renderer that sleeps while samples pass it by, and a recorder beside it that reads on.

use std::{fmt, time::Duration};

use tokio::time::MissedTickBehavior;

use crate::{Publisher, Subscriber, TestPerformance, TestServer, every_frame, latest};

const SESSION: &str = "sessions/late";
/// Frames before the renderer falls asleep.
const BEFORE: u64 = 40;
/// Frames published together where real time does not matter.
const BATCH: u64 = 8;

/// How a renderer stalls.
#[derive(Clone, Copy, Debug)]
pub struct StallProfile {
    /// What the renderer grants.
    pub credits: u32,
    /// Frames that it does not read.
    pub n_frames: u64,
    /// Publish at the performance's rate instead of as fast as the server takes it.
    pub real_time: bool,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct StallReport {
    /// Samples that the renderer got before the newest one.
    pub n_stale: usize,
    /// The frame that it got then.
    pub last_frame: u64,
    /// Samples that reached the renderer plus those that it was told it skipped.
    pub n_accounted: u64,
    /// Samples that the recorder did not get in order.
    pub n_missing: u64,
}

impl StallProfile {
    /// Runs it on a session of the reference face.
    pub async fn run(self, server: &TestServer) -> StallReport {
        server
            .create_session("late", "actors/reference")
            .await
            .unwrap();
        let mut renderer = Subscriber::open(server, latest(SESSION, self.credits))
            .await
            .unwrap();
        let mut recorder = Subscriber::open(server, every_frame(SESSION))
            .await
            .unwrap();
        let performance = TestPerformance::reference();
        let mut publisher = Publisher::open(server, performance.start(SESSION, "camera-1"))
            .await
            .unwrap();
        publish(&mut publisher, &performance, 1, BEFORE).await;
        let n_before = read_through(&mut renderer, BEFORE).await;

        let last_frame = BEFORE + self.n_frames;
        let recording =
            tokio::spawn(async move { recorder.samples_through(last_frame).await.unwrap() });
        if self.real_time {
            publish_paced(&mut publisher, &performance, BEFORE + 1, last_frame).await;
        } else {
            publish(&mut publisher, &performance, BEFORE + 1, last_frame).await;
        }
        let recorded = recording.await.unwrap();
        let in_order = recorded.iter().zip(1..).filter(|(it, n)| it.sequence == *n);

        let n_after = read_through(&mut renderer, last_frame).await;
        StallReport {
            n_stale: n_after - 1,
            last_frame,
            n_accounted: renderer.skipped_samples + (n_before + n_after) as u64,
            n_missing: last_frame - in_order.count() as u64,
        }
    }
}

impl fmt::Display for StallReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} stale samples, then the newest of {}; the recorder of every frame missed {}",
            self.n_stale, self.last_frame, self.n_missing
        )
    }
}

async fn publish(publisher: &mut Publisher, performance: &TestPerformance, first: u64, last: u64) {
    let step = usize::try_from(BATCH).unwrap();
    for number in (first..=last).step_by(step) {
        let until = (number + BATCH - 1).min(last);
        publisher.send(performance.frames(number..=until)).await;
    }
    publisher.accepted(last).await.unwrap();
}

async fn publish_paced(
    publisher: &mut Publisher,
    performance: &TestPerformance,
    first: u64,
    last: u64,
) {
    let mut ticks = tokio::time::interval(Duration::from_secs_f64(1.0 / performance.rate_hz));
    ticks.set_missed_tick_behavior(MissedTickBehavior::Burst);
    for number in first..=last {
        ticks.tick().await;
        publisher.send(vec![performance.frame(number)]).await;
    }
    publisher.accepted(last).await.unwrap();
}

/// Reads and returns credits until the sample of `frame` is there; how many samples that took.
async fn read_through(renderer: &mut Subscriber, frame: u64) -> usize {
    let mut n_read = 0;
    loop {
        let sample = renderer.sample().await.unwrap();
        renderer.grant(1).await;
        n_read += 1;
        if sample.frame == frame {
            return n_read;
        }
    }
}
