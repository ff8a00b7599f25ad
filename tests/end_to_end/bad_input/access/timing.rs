//! How long an answer takes, by what was shown: printed, for people to compare.

use frontalis_proto::v1::{GetServerRequest, server_service_client::ServerServiceClient};
use harness::TestServer;
use tokio::time::{Duration, Instant};

use super::request;

/// Calls of each kind; the kinds take turns, so that whatever else the machine does meets all of them.
const ROUNDS: usize = 41;

/// Prints the median time to the answer of each kind, over one connection, the shortest first.
pub(super) async fn print_medians(server: &TestServer, kinds: &[(&str, Option<&str>)]) {
    let mut client = ServerServiceClient::new(server.bare_channel().await);
    let mut times = vec![[Duration::ZERO; ROUNDS]; kinds.len()];
    for round in 0..ROUNDS {
        for ((_, authorization), times) in kinds.iter().zip(&mut times) {
            let request = request(*authorization, GetServerRequest {});
            let asked_at = Instant::now();
            drop(client.get_server(request).await);
            times[round] = asked_at.elapsed();
        }
    }
    let median = |mut times: [Duration; ROUNDS]| {
        times.sort();
        times[ROUNDS / 2].as_micros()
    };
    let mut medians: Vec<_> = times.into_iter().map(median).zip(kinds).collect();
    medians.sort();
    for (micros, (what, _)) in medians {
        println!("I1: answered in {micros} us (median of {ROUNDS}): {what}");
    }
}
