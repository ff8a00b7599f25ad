//! Rows I9 and I10: two publishers want one session, once and again and again.

use harness::{Publisher, assert_refused};
use tokio::time::Instant;
use tonic::Code;

use super::{GOOD_FRAMES, SUBJECT, beside_a_control_session};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i9_a_second_publisher_is_refused_or_takes_over() {
    beside_a_control_session("I9", async |stage| {
        let mut first = stage.publisher().await;
        let mut start = stage.performance.start(SUBJECT, "camera-2");
        let refused = Publisher::open(&stage.server, start.clone())
            .await
            .err()
            .unwrap();
        assert_refused(&refused, Code::FailedPrecondition, "SESSION_OWNED");

        start.takeover = true;
        let mut second = Publisher::open(&stage.server, start).await.unwrap();
        assert!(second.started.epoch > first.started.epoch);
        assert_eq!(second.started.next_expected, GOOD_FRAMES + 1);
        assert_eq!(second.started.run, first.started.run);

        // Both keep sending: what the first sends has no effect, and it is told why.
        let mut foreign = stage.performance.frame(GOOD_FRAMES + 1);
        foreign.positions[0] += 5.0;
        first.send(vec![foreign]).await;
        assert_refused(&first.broken_off().await, Code::Aborted, "PUBLISHER_FENCED");
        second
            .send(stage.performance.frames(GOOD_FRAMES + 1..=GOOD_FRAMES + 10))
            .await;
        second.accepted(GOOD_FRAMES + 10).await.unwrap();
        assert_eq!(second.report().rejections(), []);
        let samples = stage
            .subscriber()
            .await
            .samples_through(GOOD_FRAMES + 10)
            .await
            .unwrap();
        let sequences: Vec<_> = samples.iter().map(|it| it.sequence).collect();
        assert_eq!(
            sequences,
            (GOOD_FRAMES + 1..=GOOD_FRAMES + 10).collect::<Vec<_>>()
        );
    })
    .await;
}

/// Takeovers of a storm by two operators, one after the other as fast as they are answered.
const STORM: u64 = 100;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i10_of_a_storm_of_takeovers_one_a_second_is_granted() {
    beside_a_control_session("I10", async |stage| {
        let first = stage.publisher().await;
        let (mut epoch, mut n_granted) = (first.started.epoch, 0);
        let mut held = vec![first];
        let begun = Instant::now();
        for _ in 0..STORM {
            // Whoever has the session does not take it over.
            let challenger = if n_granted % 2 == 0 {
                "camera-2"
            } else {
                "camera-3"
            };
            let mut start = stage.performance.start(SUBJECT, challenger);
            start.takeover = true;
            match Publisher::open(&stage.server, start).await {
                Ok(publisher) => {
                    assert!(publisher.started.epoch > epoch, "one order of epochs");
                    epoch = publisher.started.epoch;
                    n_granted += 1;
                    // Its lease is not given back while the storm lasts.
                    held.push(publisher);
                }
                Err(refused) => {
                    assert_refused(&refused, Code::ResourceExhausted, "RATE_LIMIT");
                }
            }
        }
        // At once, and then after each whole second.
        let most = 1 + begun.elapsed().as_secs();
        assert!(n_granted >= 1 && n_granted <= most, "{n_granted} of {most}");
    })
    .await;
}
