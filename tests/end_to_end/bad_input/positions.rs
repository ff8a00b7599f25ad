//! Rows I11 and I12: positions that do not exist, credits that nobody can read.

use frontalis_proto::v1::SubscribeStart;
use frontalis_server::config::Config;
use harness::{Heard, Problem, Subscriber, TestServer, every_frame, latest};
use tonic::{Code, Status};

use super::{GOOD_FRAMES, SUBJECT, beside_a_control_session, beside_a_control_session_with};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i11_a_position_beyond_the_newest_sample_names_what_there_is() {
    beside_a_control_session("I11 beyond", async |stage| {
        let _publisher = stage.publisher().await;
        stage.subscriber().await;
        for sequence in [GOOD_FRAMES + 2, u64::MAX] {
            let refused = refused_from(&stage.server, sequence).await;
            assert_out_of_range(&refused, &["1", &GOOD_FRAMES.to_string()]);
        }
        // The next sample is a position: it will come.
        let next = SubscribeStart {
            from_sequence: GOOD_FRAMES + 1,
            from_oldest: false,
            ..every_frame(SUBJECT)
        };
        Subscriber::open(&stage.server, next).await.unwrap();
    })
    .await;
}

/// Frames whose samples do not fit the smallest window.
const TOO_MANY_FRAMES: u64 = 12_000;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i11_a_position_that_is_no_longer_kept_names_the_first_that_is() {
    let little = |config: &mut Config| config.limits.window_mib = 1;
    beside_a_control_session_with("I11 below", little, async |stage| {
        let mut publisher = stage.publisher().await;
        for first in (GOOD_FRAMES + 1..=TOO_MANY_FRAMES).step_by(50) {
            publisher
                .send(stage.performance.frames(first..=first + 49))
                .await;
        }
        publisher.accepted(TOO_MANY_FRAMES).await.unwrap();
        // What is taken is yet to be solved: until then the window moves on, faster than a subscriber may read it.
        let mut newest = Subscriber::open(&stage.server, latest(SUBJECT, 32))
            .await
            .unwrap();
        while newest.sample().await.unwrap().frame < TOO_MANY_FRAMES {
            newest.grant(1).await;
        }
        let mut subscriber = Subscriber::open(&stage.server, every_frame(SUBJECT))
            .await
            .unwrap();
        let oldest = subscriber.sample().await.unwrap().sequence;
        assert!(oldest > 1, "everything fits the window");
        let refused = refused_from(&stage.server, 1).await;
        assert_out_of_range(&refused, &[&oldest.to_string()]);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i12_credits_beyond_32_are_clamped() {
    beside_a_control_session("I12", async |stage| {
        let mut greedy = Subscriber::open(&stage.server, latest(SUBJECT, u32::MAX))
            .await
            .unwrap();
        for _ in 0..50 {
            greedy.grant(u32::MAX).await;
        }
        // Two heartbeats later the server has read all of them.
        for _ in 0..3 {
            let heard = greedy.next().await.unwrap().unwrap();
            assert!(matches!(heard, Heard::State(_)), "{heard:?}");
        }
        let mut publisher = stage.publisher().await;
        for number in GOOD_FRAMES + 1..=GOOD_FRAMES + 300 {
            publisher.send(vec![stage.performance.frame(number)]).await;
        }
        publisher.accepted(GOOD_FRAMES + 300).await.unwrap();
        let (mut received, mut newest, mut silent) = (0, 0, 0);
        while silent < 2 {
            match greedy.next().await.unwrap().unwrap() {
                Heard::Sample(sample) => {
                    (received, newest, silent) = (received + 1, sample.frame, 0);
                }
                // A change of state, then heartbeats: nothing has been sent for half a second.
                Heard::State(_) => silent += 1,
                other => panic!("{other:?}"),
            }
            assert!(received <= 32, "{received} samples in flight");
        }
        // What it gets for one more credit is the newest, unless it has that already.
        if newest < GOOD_FRAMES + 300 {
            greedy.grant(1).await;
            newest = greedy.sample().await.unwrap().frame;
        }
        assert_eq!(newest, GOOD_FRAMES + 300);
        let skipped = greedy.skipped_samples;
        assert!(skipped + 33 >= GOOD_FRAMES + 300, "{skipped} skipped");
    })
    .await;
}

async fn refused_from(server: &TestServer, sequence: u64) -> Status {
    let start = SubscribeStart {
        from_sequence: sequence,
        from_oldest: false,
        ..every_frame(SUBJECT)
    };
    match Subscriber::open(server, start).await {
        Err(status) => status,
        Ok(mut subscriber) => subscriber.sample().await.unwrap_err(),
    }
}

fn assert_out_of_range(status: &Status, positions: &[&str]) {
    let problem = Problem::of(status);
    assert_eq!(problem.code, Code::OutOfRange, "{problem:?}");
    assert!(!problem.reason.is_empty(), "{problem:?}");
    for position in positions {
        assert!(
            problem.message.contains(position),
            "{problem:?} does not name {position}"
        );
    }
}
