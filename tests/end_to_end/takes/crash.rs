//! A server that is killed loses nothing that it acknowledged as durable (CONTRACTS G1, the short form).

use frontalis_proto::v1::TakeState;
use harness::{KillProfile, RecordedTake, TestPerformance, TestServer, take_in_order};

use super::{export, record};

/// Kills of one run of the test; `make kill-test` does more.
const N_KILLS: u64 = 5;

/// Frames between two kills, so that each comes at another moment.
const STEP: u64 = 17;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_killed_server_gives_back_every_durable_frame() {
    let mut server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    server
        .create_session("stage", "actors/reference")
        .await
        .unwrap();
    let performance = TestPerformance::reference();
    for kill in 0..N_KILLS {
        let (take, mut publisher) = record(&server, &performance).await;
        let n_durable = 40 + kill * STEP;
        for number in 1..=n_durable + 20 {
            publisher.send(vec![performance.frame(number)]).await;
        }
        publisher.durable(n_durable).await.unwrap();
        let durable_through = publisher.report().durable_through;
        server = server.kill_and_restart().await;

        let found = take_in_order(&server, &take.name).await;
        assert!(found.recovered, "{found:?}");
        assert_eq!(found.state(), TakeState::Closed);
        let recorded = RecordedTake::read(&export(&server, &take.name).await);
        let numbers = recorded.frame_numbers();
        let expected: Vec<u64> = (1..=numbers.len() as u64).collect();
        assert_eq!(numbers, expected, "none lost, doubled or out of order");
        assert!(numbers.len() as u64 >= durable_through, "{durable_through}");
        assert_eq!(
            recorded.frames,
            performance.frames(1..=numbers.len() as u64)
        );
        assert_eq!(found.n_frames, numbers.len() as u64);
    }
}

/// Kills under load of several sessions; `make kill-test` does many more.
const N_KILLS_UNDER_LOAD: usize = 3;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn eight_sessions_lose_no_durable_frame_when_their_server_is_killed() {
    let profile = KillProfile {
        n_kills: N_KILLS_UNDER_LOAD,
        n_sessions: 8,
        seed: 7,
    };
    let report = profile.run().await;
    println!("G1: {report}");
    assert!(report.is_clean(), "{report}");
    assert!(report.n_durable > 0, "nothing was under way");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_that_a_crash_left_in_its_final_form_is_whole() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let (take, mut publisher) = record(&server, &performance).await;
    publisher.send(performance.frames(1..=60)).await;
    publisher.durable(60).await.unwrap();
    // A drained server closes its takes; their rows then say so, or, after a crash in between, still that they are recorded.
    let server = server.restart().await;
    let found = take_in_order(&server, &take.name).await;
    assert_eq!((found.state(), found.n_frames), (TakeState::Closed, 60));
    let recorded = RecordedTake::read(&export(&server, &take.name).await);
    assert_eq!(recorded.frames, performance.frames(1..=60));
}
