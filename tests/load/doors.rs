//! What a delivered sample costs at each door, and what a client that stops reading costs the others.
//!
//! `doors [SECONDS]`: the server is a program of its own, and only its processor time counts. Beside it, in the same
//! rounds, a thread writes the same protobuf bytes to as many plain TCP connections.
#![expect(
    clippy::unwrap_used,
    reason = "a run that cannot start has nothing to report"
)]

use harness::{DoorCosts, StalledDoors, TestServer};

const SECONDS: u64 = 4;

#[tokio::main(flavor = "multi_thread", worker_threads = 2)]
async fn main() {
    let seconds = std::env::args()
        .nth(1)
        .map_or(SECONDS, |it| it.parse().unwrap());
    let server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    println!("{}", DoorCosts::measure(&server, seconds).await);
    server.stop().await;
    println!("{}", StalledDoors::measure().await);
}
