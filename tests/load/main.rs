//! Load on one server in this process: `load [SESSIONS] [SECONDS]`, by default 64 sessions at 120 Hz for 30 s.
//!
//! Publishers, server and subscribers share the machine, so the figures are those of all three together.
#![expect(
    clippy::unwrap_used,
    reason = "a load run that cannot start has nothing to report"
)]

use std::{process::ExitCode, time::Duration};

use harness::{LoadProfile, TestServer};

const SESSIONS: u64 = 64;
const SECONDS: u64 = 30;

#[tokio::main(flavor = "multi_thread", worker_threads = 2)]
async fn main() -> ExitCode {
    let profile = LoadProfile {
        n_sessions: usize::try_from(argument(1, SESSIONS)).unwrap(),
        duration: Duration::from_secs(argument(2, SECONDS)),
    };
    let server = TestServer::start().await;
    server.import_reference().await;
    let report = profile.run(&server).await;
    println!("{report}");
    server.stop().await;
    if report.n_shed + report.n_missing == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

fn argument(position: usize, default: u64) -> u64 {
    std::env::args()
        .nth(position)
        .map_or(default, |it| it.parse().unwrap())
}
