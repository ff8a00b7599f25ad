//! A renderer that sleeps for real: `late [SECONDS]`, by default 20 s at 120 Hz with three credits.
#![expect(
    clippy::unwrap_used,
    reason = "a run that cannot start has nothing to report"
)]

use std::process::ExitCode;

use harness::{StallProfile, TestServer};

const SECONDS: u64 = 20;
const RATE_HZ: u64 = 120;
const CREDITS: u32 = 3;

#[tokio::main(flavor = "multi_thread", worker_threads = 2)]
async fn main() -> ExitCode {
    let seconds = std::env::args()
        .nth(1)
        .map_or(SECONDS, |it| it.parse().unwrap());
    let profile = StallProfile {
        credits: CREDITS,
        n_frames: seconds * RATE_HZ,
        real_time: true,
    };
    let server = TestServer::start().await;
    server.import_reference().await;
    let report = profile.run(&server).await;
    println!("a renderer asleep for {seconds} s at {RATE_HZ} Hz, {CREDITS} credits: {report}");
    server.stop().await;
    if report.n_stale <= CREDITS as usize && report.n_missing == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
