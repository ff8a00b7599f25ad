//! Long runs whose figures stand in `docs/reliability.md`; each writes a section of its own:
//! `reliability kill N`, `reliability drain N`, `reliability recovery`, `reliability takes SECONDS`, `reliability resolve MINUTES`.
#![expect(
    clippy::unwrap_used,
    reason = "a run that cannot start has nothing to report"
)]

use std::{process::ExitCode, time::Duration};

use harness::{
    DrainProfile, KillProfile, RecordingProfile, RecoveryProfile, ResolveProfile, TestServer,
    write_section,
};

/// Sessions that are recorded while the server is killed.
const N_KILLED_SESSIONS: usize = 8;
const SEED: u64 = 1;
/// Sessions of `takes`.
const N_SESSIONS: usize = 64;
/// What `recovery` finds.
const RECOVERY: RecoveryProfile = RecoveryProfile {
    n_takes: 100_000,
    n_open: 10_000,
    n_frames: 1_000_000,
};

#[tokio::main(flavor = "multi_thread", worker_threads = 2)]
async fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let is_clean = match words[..] {
        ["kill", n_kills] => kill(n_kills.parse().unwrap()).await,
        ["drain", n_cycles] => drain(n_cycles.parse().unwrap()).await,
        ["recovery"] => recovery().await,
        ["takes", seconds] => takes(Duration::from_secs(seconds.parse().unwrap())).await,
        ["resolve", minutes] => resolve(minutes.parse().unwrap()).await,
        _ => {
            eprintln!("reliability kill N | drain N | recovery | takes SECONDS | resolve MINUTES");
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
        n_sessions: N_KILLED_SESSIONS,
        seed: SEED,
    };
    let report = profile.run().await;
    println!("{report}");
    let body = format!(
        "`make kill-test` kills the server (SIGKILL) at random instants within 400 ms of load, while {N_KILLED_SESSIONS} sessions are recorded, and after one kill in four once more while the takes are recovered.\n\
         Afterwards every take that was open is exported and compared with what was sent.\n\n\
         {report}.\n"
    );
    write_section("Kills while recording (G1)", &body);
    report.is_clean()
}

async fn drain(n_cycles: usize) -> bool {
    let report = DrainProfile { n_cycles }.run().await;
    println!("{report}");
    let body = format!(
        "`make drain-test` tells a recording server to stop (SIGTERM) and starts it again on the same port, with a publisher of the client library at 120 Hz that comes back by itself.\n\n\
         {report}.\n"
    );
    write_section("Drains and restarts (G10)", &body);
    report.is_clean()
}

async fn recovery() -> bool {
    let report = RECOVERY.run().await;
    println!("{report}");
    let body = format!(
        "`make bench-recovery` starts the server on what a crash left; readiness does not wait for takes to be read.\n\n\
         {report}.\n"
    );
    write_section("Recovery (G11)", &body);
    report.n_found >= RECOVERY.n_frames
}

async fn takes(duration: Duration) -> bool {
    let server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    let profile = RecordingProfile {
        n_sessions: N_SESSIONS,
        duration,
    };
    let report = profile.run(&server).await;
    println!("{report}");
    let body = format!(
        "`make bench-takes` records {N_SESSIONS} sessions at 120 Hz for {} s on two cores, publishers included.\n\n\
         {report}.\n",
        duration.as_secs()
    );
    write_section("Recording", &body);
    report.n_shed == 0 && report.n_missing == 0
}

async fn resolve(minutes: u64) -> bool {
    let [plain, default] = [true, false].map(|plain| ResolveProfile { minutes, plain });
    let reports = [plain.run().await, default.run().await];
    for report in reports {
        println!("{report}");
    }
    let body = format!(
        "`make bench-resolve` solves a take of {minutes} min of 27 markers at 120 Hz again, from opening its file to the new one on the disk.\n\n\
         - {}.\n- {}.\n",
        reports[0], reports[1]
    );
    write_section("Solving again", &body);
    true
}
