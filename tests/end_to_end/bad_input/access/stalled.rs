//! A token that is revoked while its holder has streams open and reads none of them.

use bytes::Bytes;
use frontalis_access::Role;
use harness::{assert_eventually, encoded, every_frame};
use http::Request;
use tokio::net::TcpStream;
use tokio::time::{Duration, Instant};

use super::{
    super::{SUBJECT, Stage, beside_a_control_session_of},
    bearer, get_server, guarded,
};

const FOLLOW: &str = "/frontalis.v1.CurveService/Follow";
const WATCH: &str = "/grpc.health.v1.Health/Watch";

async fn n_subscribers(stage: &Stage) -> usize {
    let session = stage.server.session(SUBJECT).await;
    session.status.unwrap().subscribers.len()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn i4_a_revoked_reader_that_does_not_read_loses_its_seat_and_the_health_is_watched_no_more() {
    let mut server = guarded().await;
    let keys = server.keys();
    let renderer = keys.grant(Role::Renderer, "*");
    keys.save();
    let id = keys.file().tokens().last().unwrap().id.clone();
    let mut keys = keys.clone();
    server.reload();
    let authorization = bearer(&renderer);
    assert_eventually!(get_server(&server, Some(&authorization)).await.is_ok());
    beside_a_control_session_of("I4 stalled", server, async |stage| {
        let address = stage.server.address();
        let open = async |window: u32, path: &str, message: Vec<u8>| {
            let stream = TcpStream::connect(address).await.unwrap();
            let client = h2::client::Builder::new()
                .initial_window_size(window)
                .handshake::<_, Bytes>(stream);
            let (requests, connection) = client.await.unwrap();
            tokio::spawn(async move { drop(connection.await) });
            let request = Request::post(format!("http://{address}{path}"))
                .header("content-type", "application/grpc")
                .header("te", "trailers")
                .header("authorization", &authorization)
                .body(())
                .unwrap();
            let mut requests = requests.ready().await.unwrap();
            let (response, mut outgoing) = requests.send_request(request, false).unwrap();
            outgoing.send_data(message.into(), true).unwrap();
            let response = response.await.unwrap();
            assert_eq!(response.status(), 200);
            (requests, response.into_body())
        };
        // No byte of the answer may be sent.
        let _stalled = open(0, FOLLOW, encoded(&every_frame(SUBJECT))).await;
        let (_requests, mut health) = open(65_535, WATCH, vec![0; 5]).await;
        let publisher = stage.publisher().await;
        assert_eventually!(n_subscribers(stage).await == 1);
        keys.file().revoke(&id).unwrap();
        keys.save();
        let revoked_at = Instant::now();
        assert_eventually!(n_subscribers(stage).await == 0);
        let after = revoked_at.elapsed();
        println!(
            "I4: the seat was free {:.1} s after the token was revoked",
            after.as_secs_f64()
        );
        assert!(after < Duration::from_secs(30), "{after:?}");
        while health.data().await.is_some() {}
        let trailers = health.trailers().await.unwrap().unwrap();
        assert_eq!(trailers["grpc-status"], "16");
        drop(publisher);
    })
    .await;
}
