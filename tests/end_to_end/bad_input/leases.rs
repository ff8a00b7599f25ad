//! Row I9: two publishers want one session.

use harness::{Publisher, assert_refused};
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
