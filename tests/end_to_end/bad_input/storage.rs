//! H: what a crash, a bad disk or a mistake leaves in the data directory.

mod faults;

use std::{
    fs,
    ops::RangeInclusive,
    os::unix::process::CommandExt as _,
    path::Path,
    process::{Command, Stdio},
};

use frontalis_proto::v1::{
    ExportTakeRequest, ListTakesRequest, ResolveTakeRequest, Take, TakeFormat, TakeState,
};
use harness::{
    Problem, Publisher, RecordedTake, TestPerformance, TestServer, assert_eventually,
    assert_refused, head_of, http_get, many_takes, program,
};
use tonic::Code;

use crate::takes::{SESSION, export, get, start, stop};

const DATABASE: &str = "catalogue.sqlite";

/// All takes; there are few.
async fn list(server: &TestServer) -> Vec<Take> {
    let request = ListTakesRequest::default();
    let answer = server.takes().await.list_takes(request).await.unwrap();
    answer.into_inner().takes
}

/// Records frames from 1 on and stops the take.
async fn record(server: &TestServer, n_frames: u64) -> Take {
    let take = begin(server, 1..=n_frames).await;
    stop(server, &take.name).await.unwrap()
}

/// Records frames, until they are on stable storage.
async fn begin(server: &TestServer, frames: RangeInclusive<u64>) -> Take {
    let performance = TestPerformance::reference();
    let take = start(server, SESSION, "12A").await.unwrap();
    let start = performance.start(SESSION, "stage");
    let mut publisher = Publisher::open(server, start).await.unwrap();
    publisher.send(performance.frames(frames.clone())).await;
    publisher.durable(*frames.end()).await.unwrap();
    take
}

async fn recorded(server: &TestServer, take: &Take) -> RecordedTake {
    RecordedTake::read(&export(server, &take.name).await)
}

async fn is_in_order(server: &TestServer, n_takes: usize) -> bool {
    let takes = list(server).await;
    let is_waiting = |it: &Take| it.state() == TakeState::Recovering;
    takes.len() == n_takes && !takes.iter().any(is_waiting)
}

fn remove_catalogue(folder: &Path) {
    for name in [DATABASE, "catalogue.sqlite-wal", "catalogue.sqlite-shm"] {
        drop(fs::remove_file(folder.join(name)));
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h6_takes_without_rows_have_rows_again_and_what_a_crash_left_half_done_is_gone() {
    let server = TestServer::with_session("stage").await;
    let take = record(&server, 60).await;
    let server = server
        .restart_after(|folder| {
            remove_catalogue(folder);
            let takes = folder.join("takes");
            fs::write(takes.join("stage-1.mcap.tmp"), b"half a rewriting").unwrap();
            fs::write(takes.join("stage-2.mcap"), b"").unwrap();
            fs::write(takes.join("notes of a person.txt"), b"kept").unwrap();
        })
        .await;
    assert_eventually!(is_in_order(&server, 1).await);
    let found = get(&server, &take.name).await.unwrap();
    assert!(found.recovered);
    let without = |it: Take| Take {
        recovered: false,
        stop_time: None,
        ..it
    };
    assert_eq!(without(found), without(take.clone()));
    assert_eq!(recorded(&server, &take).await.frame_numbers().len(), 60);
    let takes = server.folder().join("takes");
    assert_eventually!(!takes.join("stage-2.mcap").exists());
    assert!(!takes.join("stage-1.mcap.tmp").exists());
    assert!(takes.join("notes of a person.txt").exists());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h5_a_file_of_another_take_is_reported_served_and_never_merged() {
    let server = TestServer::with_session("stage").await;
    let take = record(&server, 60).await;
    let own = format!("{}.mcap", take.name.trim_start_matches("takes/"));
    let server = server
        .restart_after(|folder| {
            let takes = folder.join("takes");
            fs::copy(takes.join(own), takes.join("stranger.mcap")).unwrap();
        })
        .await;
    assert_eventually!(is_in_order(&server, 2).await);
    let stranger = get(&server, "takes/stranger").await.unwrap();
    assert_eq!(stranger.state(), TakeState::Quarantined);
    let found = get(&server, &take.name).await.unwrap();
    assert_eq!((found.state(), found.n_frames), (TakeState::Closed, 60));
    assert_eq!(recorded(&server, &take).await.frame_numbers().len(), 60);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h5_a_file_of_another_take_in_place_of_a_closed_one_is_nobody_s_business() {
    let server = TestServer::with_session("stage").await;
    let first = record(&server, 60).await;
    let begun = begin(&server, 61..=90).await;
    let second = stop(&server, &begun.name).await.unwrap();
    let file = |take: &Take| format!("{}.mcap", take.name.trim_start_matches("takes/"));
    let (from, to) = (file(&first), file(&second));
    let server = server
        .restart_after(|folder| {
            let takes = folder.join("takes");
            fs::copy(takes.join(from), takes.join(to)).unwrap();
        })
        .await;
    let is_refused = |status: &tonic::Status| {
        assert_refused(status, Code::DataLoss, "TAKE_UNREADABLE");
        assert!(status.message().contains(&first.name), "{status}");
    };
    let mut client = server.takes().await;
    for format in [TakeFormat::Mcap, TakeFormat::Csv, TakeFormat::Trc] {
        let request = ExportTakeRequest {
            name: second.name.clone(),
            format: format.into(),
        };
        is_refused(&client.export_take(request).await.unwrap_err());
    }
    let request = ResolveTakeRequest {
        name: second.name.clone(),
        ..ResolveTakeRequest::default()
    };
    let mut answers = client.resolve_take(request).await.unwrap().into_inner();
    is_refused(&answers.message().await.unwrap_err());
    assert_eq!(recorded(&server, &first).await.frame_numbers().len(), 60);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h7_with_a_damaged_catalogue_the_takes_are_shown_and_nothing_is_changed() {
    let server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    let created = server.create_session("stage", "actors/reference").await;
    created.unwrap();
    let closed = record(&server, 40).await;
    let open = begin(&server, 41..=81).await;
    let server = server
        .kill_and_restart_after(|folder| {
            remove_catalogue(folder);
            fs::write(folder.join(DATABASE), vec![b'x'; 8_192]).unwrap();
        })
        .await;
    for (take, n_frames) in [(&closed, 40), (&open, 41)] {
        let found = get(&server, &take.name).await.unwrap();
        assert_eq!(
            (found.state(), found.n_frames),
            (TakeState::Closed, n_frames)
        );
        assert_eq!(found.slate, "12A");
        let numbers = recorded(&server, &found).await.frame_numbers();
        assert_eq!(numbers.len() as u64, n_frames);
    }
    assert_eq!(list(&server).await.len(), 2);
    let refused = server.create_session("more", "actors/reference").await;
    let refused = Problem::of(&refused.unwrap_err());
    assert_eq!(
        (refused.code, refused.reason.as_str()),
        (Code::Unavailable, "RESCUE_MODE")
    );
    let request = frontalis_proto::v1::DeleteTakeRequest {
        name: open.name.clone(),
    };
    let refused = server.takes().await.delete_take(request).await;
    assert_eq!(Problem::of(&refused.unwrap_err()).reason, "RESCUE_MODE");
    assert_eq!(http_get(&server, "/readyz").await.status, 503);
    let database = server.folder().join(DATABASE);
    assert_eq!(fs::read(database).unwrap(), vec![b'x'; 8_192]);
    assert_eq!(server.exit_code().await, Some(3));
}

/// What the program at `server` says that does not start on `folder`; where the test is an administrator's, as another
/// account.
fn refused_start(server: &Path, folder: &Path) -> String {
    let mut command = Command::new(server);
    command
        .env_clear()
        .args(["--listen", "127.0.0.1:0", "--data-dir"])
        .arg(folder)
        .stdout(Stdio::null());
    if rustix::process::geteuid().is_root() {
        command.uid(65_534);
    }
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn h10_a_directory_that_cannot_be_written_is_refused_with_whose_it_is() {
    use std::os::unix::fs::PermissionsExt as _;
    let parent = tempfile::tempdir().unwrap();
    // Readable by everybody, so that what is refused is the writing.
    let open =
        |path: &Path, mode| fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    open(parent.path(), 0o755);
    let folder = parent.path().join("data");
    fs::create_dir(&folder).unwrap();
    open(&folder, 0o555);
    // The program may stand where another account cannot reach it.
    let copy = parent.path().join("frontalis-server");
    fs::copy(program("frontalis-server"), &copy).unwrap();
    let said = refused_start(&copy, &folder);
    assert!(said.contains(folder.to_str().unwrap()), "{said}");
    assert!(
        said.contains("mode 0555; this server runs as user"),
        "{said}"
    );
}

/// `make bench-recovery` has 100,000, and 10,000 of them open.
const N_TAKES: usize = 2_000;
const N_OPEN: usize = 100;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn h12_many_takes_are_recovered_behind_a_server_that_works() {
    let server = TestServer::with_session("stage").await;
    let take = begin(&server, 1..=30).await;
    let bytes = export(&server, &take.name).await;
    let server = server
        .restart_after(|folder| many_takes(folder, head_of(&bytes), N_TAKES, N_OPEN))
        .await;
    // Whatever is still ahead, a new take is recorded.
    let new = record(&server, 30).await;
    assert_eq!(recorded(&server, &new).await.frame_numbers().len(), 30);
    let last = format!("takes/a-{:08}", N_OPEN - 1);
    assert_eventually!(get(&server, &last).await.unwrap().state() == TakeState::Closed);
    let first = get(&server, "takes/a-00000000").await.unwrap();
    assert!(first.recovered);
    assert_eq!((first.state(), first.n_frames), (TakeState::Closed, 0));
}
