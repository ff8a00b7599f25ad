//! The short form of the load figure: nothing shed, nothing missing. `make bench-load` has the long one.

use std::time::Duration;

use harness::{LoadProfile, TestServer};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn sessions_beside_each_other_lose_nothing() {
    let server = TestServer::start().await;
    server.import_reference().await;
    let profile = LoadProfile {
        n_sessions: 6,
        duration: Duration::from_secs(2),
    };
    let report = profile.run(&server).await;
    println!("{report}");
    assert_eq!((report.n_shed, report.n_missing), (0, 0));
    server.stop().await;
}
