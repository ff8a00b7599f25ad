//! A copy of a directory of takes, made at any moment, opens, and holds a beginning of what was recorded (CONTRACTS U-10).

use harness::{RecordedTake, TestPerformance, TestServer};

use super::{record, stop};

/// Copies that are made while frames come in.
const N_COPIES: u64 = 12;

/// Frames between two copies.
const STEP: u64 = 40;

/// The files of takes as they are just now.
fn copy(server: &TestServer) -> Vec<Vec<u8>> {
    let folder = server.data_dir().join("takes");
    let files = std::fs::read_dir(folder).unwrap();
    let paths = files.map(|it| it.unwrap().path());
    let takes = paths.filter(|it| it.extension().is_some_and(|it| it == "mcap"));
    takes.filter_map(|it| std::fs::read(it).ok()).collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_copy_made_at_any_moment_is_a_beginning_of_the_take() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let (take, mut publisher) = record(&server, &performance).await;
    let mut copies = Vec::new();
    for idx in 0..N_COPIES {
        let first = idx * STEP + 1;
        for number in first..first + STEP {
            publisher.send(vec![performance.frame(number)]).await;
        }
        // What is acknowledged now is in every copy that is made now.
        publisher.accepted(first + STEP / 2).await.unwrap();
        let durable = publisher.report().durable_through;
        copies.push((durable, copy(&server)));
    }
    publisher.durable(N_COPIES * STEP).await.unwrap();
    // While it is put into its final form, and then.
    let stopping = stop(&server, &take.name);
    let copying = async { copies.push((N_COPIES * STEP, copy(&server))) };
    let (stopped, ()) = tokio::join!(stopping, copying);
    stopped.unwrap();
    copies.push((N_COPIES * STEP, copy(&server)));

    let frames = performance.frames(1..=N_COPIES * STEP);
    for (durable, files) in copies {
        assert_eq!(files.len(), 1);
        let recorded = RecordedTake::beginning(&files[0]);
        let n_frames = recorded.frames.len();
        assert!(n_frames as u64 >= durable, "{n_frames} of {durable}");
        assert_eq!(recorded.frames, frames[..n_frames]);
        let solved: Vec<u64> = recorded.samples.iter().map(|it| it.sequence).collect();
        assert_eq!(solved, (1..=solved.len() as u64).collect::<Vec<_>>());
    }
    server.stop().await;
}
