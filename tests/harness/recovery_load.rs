//! A server that finds very much after a crash: when it listens again, and when all of it is in order (CONTRACTS U-7, G11).

use std::{
    fmt,
    fs::{self, OpenOptions},
    io::Write as _,
    path::Path,
};

use frontalis_proto::v1::{StartTakeRequest, TakeState};
use frontalis_server::{
    catalogue::{Catalogue, TakeContent, TakeLabels, TakeRow, TakeState as StoredState},
    name::{ActorId, SessionId, TakeId},
};
use tokio::time::Instant;

use crate::{Publisher, RecordedTake, TestPerformance, TestServer, take_calls::take_in_order};

/// Opcode of a chunk in a take's file.
const CHUNK: u8 = 0x06;

/// How much a crash left.
#[derive(Clone, Copy, Debug)]
pub struct RecoveryProfile {
    /// Takes in the catalogue.
    pub n_takes: usize,
    /// Of them, those that were open.
    pub n_open: usize,
    /// Frames of one more take that was open.
    pub n_frames: u64,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct RecoveryReport {
    /// What was left.
    pub profile: RecoveryProfile,
    /// Length of the large take's file, bytes.
    pub n_bytes: u64,
    /// Frames that were found in it.
    pub n_found: u64,
    /// From the start of the program to its port, milliseconds.
    pub ready_millis: f64,
    /// From the port until everything was in order, seconds.
    pub in_order_secs: f64,
}

impl RecoveryProfile {
    /// Runs it on a server of its own.
    pub async fn run(self) -> RecoveryReport {
        let server = TestServer::start_program(|_| {}).await;
        server.import_reference().await;
        let created = server.create_session("stage", "actors/reference").await;
        created.unwrap();
        let (name, n_recorded) = (record(&server).await, 60);
        let file = format!("{}.mcap", name.trim_start_matches("takes/"));
        let mut n_bytes = 0;
        let mut started = Instant::now();
        let server = server
            .kill_and_restart_after(|folder| {
                let takes = folder.join("takes");
                n_bytes = lengthen(&takes.join(&file), self.n_frames - n_recorded);
                let whole = fs::read(takes.join(&file)).unwrap();
                many_takes(folder, head_of(&whole), self.n_takes, self.n_open);
                started = Instant::now();
            })
            .await;
        let ready_millis = started.elapsed().as_secs_f64() * 1e3;
        let ready = Instant::now();
        if self.n_open > 0 {
            frames_in_order(&server, &format!("takes/a-{:08}", self.n_open - 1)).await;
        }
        let n_found = frames_in_order(&server, &name).await;
        RecoveryReport {
            profile: self,
            n_bytes,
            n_found,
            ready_millis,
            in_order_secs: ready.elapsed().as_secs_f64(),
        }
    }
}

/// Starts a take and publishes sixty frames into it.
async fn record(server: &TestServer) -> String {
    let request = StartTakeRequest {
        session: "sessions/stage".to_owned(),
        ..StartTakeRequest::default()
    };
    let take = server.takes().await.start_take(request).await.unwrap();
    let performance = TestPerformance::reference();
    let start = performance.start("sessions/stage", "stage");
    let mut publisher = Publisher::open(server, start).await.unwrap();
    publisher.send(performance.frames(1..=60)).await;
    publisher.durable(60).await.unwrap();
    take.into_inner().take.unwrap().name
}

/// Waits until a take is in order; its frames.
async fn frames_in_order(server: &TestServer, name: &str) -> u64 {
    let take = take_in_order(server, name).await;
    assert_eq!(take.state(), TakeState::Closed);
    take.n_frames
}

/// Where the records of a growing file begin, in order.
fn records(file: &[u8]) -> Vec<(usize, u8)> {
    let mut records = Vec::new();
    let mut place = mcap::MAGIC.len();
    while place + 9 <= file.len() {
        records.push((place, file[place]));
        let length = u64::from_le_bytes(file[place + 1..place + 9].try_into().unwrap());
        place += 9 + usize::try_from(length).unwrap();
    }
    records
}

/// What stands before the first chunk of a growing take.
///
/// # Panics
///
/// When it has none.
pub fn head_of(file: &[u8]) -> &[u8] {
    let chunk = records(file).into_iter().find(|it| it.1 == CHUNK);
    &file[..chunk.unwrap().0]
}

/// Adds at least so many frames to a growing file, by repeating its last commit that has some; returns its length.
fn lengthen(file: &Path, n_frames: u64) -> u64 {
    let whole = fs::read(file).unwrap();
    let head = head_of(&whole);
    let places = records(&whole);
    let ends = places.iter().skip(1).map(|it| it.0).chain([whole.len()]);
    let chunks = places
        .iter()
        .zip(ends)
        .filter(|(start, _)| start.1 == CHUNK);
    let frames_of = |chunk: &[u8]| RecordedTake::read(&[head, chunk].concat()).frames.len() as u64;
    let chunks = chunks.map(|(start, end)| &whole[start.0..end]);
    let (chunk, n_each) = chunks
        .map(|it| (it, frames_of(it)))
        .filter(|it| it.1 > 0)
        .last()
        .unwrap();
    let mut open = OpenOptions::new().append(true).open(file).unwrap();
    let mut left = n_frames;
    while left > 0 {
        open.write_all(chunk).unwrap();
        left = left.saturating_sub(n_each);
    }
    open.metadata().unwrap().len()
}

/// Takes in the catalogue of a folder, the first of which a crash left open before their first commit.
///
/// # Panics
///
/// When they cannot be written.
pub fn many_takes(folder: &Path, head: &[u8], n_takes: usize, n_open: usize) {
    let row = |number: usize| TakeRow {
        id: TakeId::parse(&format!("a-{number:08}")).unwrap(),
        session: SessionId::parse("stage").unwrap(),
        actor: ActorId::parse("reference").unwrap(),
        actor_revision: 1,
        labels: TakeLabels {
            number: 1,
            ..TakeLabels::default()
        },
        start_time_nanos: 1,
        stop_time_nanos: (number >= n_open).then_some(2),
        content: TakeContent::default(),
        state: if number < n_open {
            StoredState::Recording
        } else {
            StoredState::Closed
        },
        recovered: false,
        resolved_from: None,
        start_timecode: None,
        with_images: false,
    };
    let rows: Vec<_> = (0..n_takes).map(row).collect();
    Catalogue::open(folder).unwrap().add_takes(&rows).unwrap();
    for row in &rows[..n_open] {
        let file = folder.join("takes").join(format!("{}.mcap", row.id));
        fs::write(file, head).unwrap();
    }
}

impl fmt::Display for RecoveryReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} takes of which {} were open, and one more with {} frames ({} MB): listening after {:.0} ms, all in order {:.1} s later",
            self.profile.n_takes,
            self.profile.n_open,
            self.n_found,
            self.n_bytes / 1_000_000,
            self.ready_millis,
            self.in_order_secs,
        )
    }
}
