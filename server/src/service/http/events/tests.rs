//! Row F4: a client of every frame that does not read, on a paused clock.

use std::{convert::Infallible, time::Duration};

use axum::http::Request;
use hyper::{
    body::Incoming,
    server::conn::{http1, http2},
    service::{Service, service_fn},
};
use hyper_util::rt::{TokioExecutor, TokioIo};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream, duplex},
    sync::oneshot,
    time::sleep,
};

use super::*;
use crate::service::grpc::{
    curves::MAX_PAUSE,
    stage::{Stage, asked, every_frame},
};

const SECOND: Duration = Duration::from_secs(1);
/// What the network holds between the two.
const BUFFER_BYTES: usize = 512;
/// What the server's library holds, at the least.
const WRITE_BYTES: usize = 8 * 1024;
/// Frames that are published before anybody reads.
const N_FRAMES: u64 = 200;

/// Answers every request with the events of every frame.
fn following(
    stage: &Stage,
) -> impl Service<Request<Incoming>, Response = Response, Error = Infallible, Future: Send> + use<>
{
    let curves = stage.curves.clone();
    service_fn(move |_| {
        let curves = curves.clone();
        async move {
            let followed = curves.follow(asked(every_frame())).await.unwrap();
            let events = Events::new(followed.into_inner(), "/here");
            Ok(answer(events.stream()))
        }
    })
}

/// The client's end of a connection that asked for every frame.
async fn follower(stage: &Stage) -> DuplexStream {
    let (mut client, server) = duplex(BUFFER_BYTES);
    let connection = http1::Builder::new()
        .max_buf_size(WRITE_BYTES)
        .serve_connection(TokioIo::new(server), following(stage));
    tokio::spawn(connection);
    let request = b"GET /here HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    client.write_all(request).await.unwrap();
    client
}

/// The answer to a client over HTTP/2 that has no room for any of it, and what makes room.
async fn follower_without_room(stage: &Stage) -> (h2::RecvStream, oneshot::Sender<()>) {
    let (client, server) = duplex(64 * 1024);
    let connection = http2::Builder::new(TokioExecutor::new())
        .serve_connection(TokioIo::new(server), following(stage));
    tokio::spawn(connection);
    let client = h2::client::Builder::new()
        .initial_window_size(0)
        .handshake::<_, Bytes>(client);
    let (mut requests, mut connection) = client.await.unwrap();
    let (make_room, room) = oneshot::channel();
    tokio::spawn(async move {
        tokio::select! {
            _ = &mut connection => return,
            _ = room => {}
        }
        connection.set_initial_window_size(1 << 20).unwrap();
        drop(connection.await);
    });
    let request = Request::get("http://localhost/here").body(()).unwrap();
    let (response, _) = requests.send_request(request, true).unwrap();
    (response.await.unwrap().into_body(), make_room)
}

/// The lines of events, without the framing of chunks.
fn events(body: &str) -> Vec<&str> {
    let lines = body.lines().map(str::trim_end);
    lines.filter(|it| it.contains(": ")).collect()
}

fn n_subscribers(stage: &Stage) -> usize {
    stage.session.status().subscribers.len()
}

/// Lets the time go by for which a reader of every frame may take nothing; then its place must be free.
async fn lose_patience(stage: &Stage) {
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=N_FRAMES)).await;
    sleep(MAX_PAUSE.saturating_sub(SECOND)).await;
    assert_eq!(n_subscribers(stage), 1);
    sleep(SECOND).await;
    assert_eq!(n_subscribers(stage), 0, "its place is not free");
}

/// The last event says what was lost: all behind the last event that came.
fn assert_lagged(answer: &str) {
    let events = events(answer);
    let last = events.last().unwrap().strip_prefix("data: ").unwrap();
    assert_eq!(events[events.len() - 2], "event: problem", "{answer}");
    let problem: serde_json::Value = serde_json::from_str(last).unwrap();
    assert_eq!(problem["type"], "urn:frontalis:problem:SUBSCRIBER_LAGGED");
    let mut ids = events.iter().filter_map(|it| it.strip_prefix("id: 1:"));
    let heard: u64 = ids.next_back().map_or(0, |it| it.parse().unwrap());
    let detail = problem["detail"].as_str().unwrap();
    let lost = format!("samples {} to {N_FRAMES} ", heard + 1);
    assert!(detail.starts_with(&lost), "{detail} after {heard}");
}

#[tokio::test(start_paused = true)]
async fn f4_a_client_of_every_frame_that_takes_nothing_for_thirty_seconds_hears_what_it_lost() {
    let stage = Stage::new().await;
    let mut client = follower(&stage).await;
    lose_patience(&stage).await;
    let mut answer = String::new();
    client.read_to_string(&mut answer).await.unwrap();
    let (_head, body) = answer.split_once("\r\n\r\n").unwrap();
    assert_lagged(body);
}

#[tokio::test(start_paused = true)]
async fn f4_a_client_over_http_2_that_has_no_room_for_thirty_seconds_hears_what_it_lost() {
    let stage = Stage::new().await;
    let (mut body, make_room) = follower_without_room(&stage).await;
    lose_patience(&stage).await;
    make_room.send(()).unwrap();
    let mut answer = Vec::new();
    while let Some(bytes) = body.data().await {
        answer.extend(bytes.unwrap());
    }
    assert_lagged(std::str::from_utf8(&answer).unwrap());
}
