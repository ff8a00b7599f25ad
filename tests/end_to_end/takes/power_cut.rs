//! The power goes at any instant: only flushed bytes and names survive for sure, of the rest any sectors in any state
//! (CONTRACTS G2).

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use frontalis_server::{
    fs::{Fs, MemFs},
    take::{Belonging, Recovered, recover},
};
use harness::{Publisher, RecordedTake, TestPerformance, TestServer};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

use super::{SESSION, start, stop};

/// Power cuts of one run, each of its own seed.
const N_CUTS: u64 = 200;
/// Power cuts during one take.
const CUTS_A_TAKE: u64 = 10;
/// What a disk writes as a whole, bytes.
const SECTOR_BYTES: usize = 512;
const DIR: &str = "/takes";

/// What is left of the disk, by a seed.
fn after_cut(disk: &MemFs, seed: u64) -> MemFs {
    let mut sectors = Pcg64::seed_from_u64(seed);
    let mut names = Pcg64::seed_from_u64(seed + 1_000_000);
    disk.after_power_cut_with(
        |_, rest| torn(rest, &mut sectors),
        |_| names.random_range(0..2) == 0,
    )
}

/// Sectors that were not flushed, of which some were written, some not, and some are none that anybody wrote; and the file
/// may end anywhere among them.
fn torn(rest: &[u8], random: &mut Pcg64) -> Vec<u8> {
    let n_kept = random.random_range(0..=rest.len());
    let mut left = rest[..n_kept].to_vec();
    for sector in left.chunks_mut(SECTOR_BYTES) {
        match random.random_range(0..3) {
            0 => {}
            1 => sector.fill(0),
            _ => sector
                .iter_mut()
                .for_each(|it| *it = random.random_range(0..=255)),
        }
    }
    left
}

/// How many of the durable frames are missing, or not where they belong, in what recovery makes of the take.
fn n_lost(disk: &MemFs, name: &str, performance: &TestPerformance, durable_through: u64) -> u64 {
    let id = name.trim_start_matches("takes/");
    let file = format!("{id}.mcap");
    let wanted = Belonging {
        take: name.to_owned(),
        session: SESSION.to_owned(),
        actor: "actors/reference".to_owned(),
    };
    let path: PathBuf = Path::new(DIR).join(&file);
    let frames = match recover(disk, Path::new(DIR), &file, &wanted) {
        Recovered::Whole(_) => RecordedTake::read(&disk.read(&path).unwrap()).frames,
        Recovered::NeverBegun => Vec::new(),
        // Not even the head was flushed.
        other @ (Recovered::Unreadable(_) | Recovered::Foreign(_)) => {
            assert!(disk.read(&path).is_ok(), "{other:?}");
            Vec::new()
        }
    };
    for frame in &frames {
        assert_eq!(*frame, performance.frame(frame.number), "never a wrong one");
    }
    let in_order = frames
        .iter()
        .zip(1..)
        .take_while(|(frame, number)| frame.number == *number);
    durable_through.saturating_sub(in_order.count() as u64)
}

/// Durable frames that were lost over all cuts, and how many there were.
async fn lost_over_all_cuts(disk: MemFs) -> (u64, u64) {
    let files: Arc<dyn Fs> = Arc::new(disk.clone());
    let server = TestServer::start_on(files).await;
    server.import_reference().await;
    let performance = TestPerformance::reference();
    let (mut n_all_lost, mut n_all_durable) = (0, 0);
    for seed in (0..N_CUTS).step_by(usize::try_from(CUTS_A_TAKE).unwrap()) {
        let created = server.create_session("stage", "actors/reference").await;
        created.unwrap();
        let take = start(&server, SESSION, "").await.unwrap();
        let mut random = Pcg64::seed_from_u64(seed);
        let opened = Publisher::open(&server, performance.start(SESSION, "stage")).await;
        let mut publisher = opened.unwrap();
        let mut sent = 0;
        for cut in 0..CUTS_A_TAKE {
            let more = random.random_range(1..8);
            publisher
                .send(performance.frames(sent + 1..=sent + more))
                .await;
            sent += more;
            // Some cuts come while commits are on their way, some after they are acknowledged.
            if random.random_range(0..2) == 0 {
                publisher.durable(sent).await.unwrap();
            } else {
                publisher.accepted(sent).await.unwrap();
            }
            let durable_through = publisher.report().durable_through;
            let after = after_cut(&disk, seed + cut);
            n_all_lost += n_lost(&after, &take.name, &performance, durable_through);
            n_all_durable += durable_through;
        }
        stop(&server, &take.name).await.unwrap();
        server.end_session(SESSION).await;
    }
    (n_all_lost, n_all_durable)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn no_power_cut_costs_a_durable_frame() {
    let (n_lost, n_durable) = lost_over_all_cuts(MemFs::default()).await;
    println!("G2: {N_CUTS} power cuts, {n_durable} durable frames, {n_lost} lost");
    assert!(n_durable > N_CUTS, "{n_durable}");
    assert_eq!(n_lost, 0);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_server_that_acknowledges_before_the_flush_is_found_out() {
    let disk = MemFs::default();
    disk.ignore_flushes();
    let (n_lost, n_durable) = lost_over_all_cuts(disk).await;
    println!("G2, acknowledged before the flush: {n_durable} durable frames, {n_lost} lost");
    assert!(n_lost > 0);
}
