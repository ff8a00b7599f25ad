//! Long runs whose figures stand in `docs/reliability.md`: `reliability kill N`, each writes its own section.
#![expect(
    clippy::unwrap_used,
    reason = "a run that cannot start has nothing to report"
)]

use std::process::ExitCode;

use harness::{KillProfile, write_section};

/// Sessions that are recorded while the server is killed.
const N_SESSIONS: usize = 8;
const SEED: u64 = 1;

#[tokio::main(flavor = "multi_thread", worker_threads = 2)]
async fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let count = || arguments[1].parse().unwrap();
    let is_clean = match arguments.first().map(String::as_str) {
        Some("kill") => kill(count()).await,
        _ => {
            eprintln!("reliability kill N");
            false
        }
    };
    if is_clean {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

async fn kill(n_kills: usize) -> bool {
    let profile = KillProfile {
        n_kills,
        n_sessions: N_SESSIONS,
        seed: SEED,
    };
    let report = profile.run().await;
    println!("{report}");
    let body = format!(
        "`make kill-test` kills the server (SIGKILL) at random instants within 400 ms of load, while {N_SESSIONS} sessions are recorded, and after one kill in four once more while the takes are recovered.\n\
         Afterwards every take that was open is exported and compared with what was sent.\n\n\
         {report}.\n"
    );
    write_section("Kills while recording (G1)", &body);
    report.is_clean()
}
