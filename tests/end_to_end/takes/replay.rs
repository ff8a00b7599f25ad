//! Every sample of a session that is recorded can be had, however long ago it went, through every door (CONTRACTS D-17,
//! D-18).

use frontalis_proto::v1::{CurveSample, SubscribeStart};
use frontalis_server::config::Config;
use harness::{
    EventStream, Publisher, RecordedTake, Subscriber, TestPerformance, TestServer, every_frame,
    http_get,
};

use super::{SESSION, export, start, stop};

/// Frames whose samples do not fit the smallest window.
const N_FRAMES: u64 = 3_000;

/// Frames that come while the first are replayed.
const N_MORE: u64 = 200;

/// A server whose sessions keep a mebibyte of samples.
async fn server() -> TestServer {
    let server = TestServer::start_with(|config: &mut Config| config.limits.window_mib = 1).await;
    server.import_reference().await;
    let created = server.create_session("stage", "actors/reference");
    created.await.unwrap();
    server
}

fn from(sequence: u64) -> SubscribeStart {
    SubscribeStart {
        from_sequence: sequence,
        from_oldest: false,
        with_uncertainty: true,
        ..every_frame(SESSION)
    }
}

async fn publish(publisher: &mut Publisher, performance: &TestPerformance, first: u64, last: u64) {
    for first in (first..=last).step_by(50) {
        publisher
            .send(performance.frames(first..=last.min(first + 49)))
            .await;
    }
    publisher.durable(last).await.unwrap();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_sample_from_long_ago_comes_as_it_went_and_the_live_ones_follow() {
    let server = server().await;
    let performance = TestPerformance::reference();
    let take = start(&server, SESSION, "").await.unwrap();
    // Reads as they come: what it hears is what went.
    let mut live = Subscriber::open(&server, from(1)).await.unwrap();
    let listening = tokio::spawn(async move { live.samples_through(N_FRAMES + N_MORE).await });
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publish(&mut publisher, &performance, 1, N_FRAMES).await;

    let mut replayed = Subscriber::open(&server, from(1)).await.unwrap();
    let mut late = Subscriber::open(&server, from(N_FRAMES / 3)).await.unwrap();
    let first = replayed.sample().await.unwrap();
    assert_eq!((first.sequence, first.frame), (1, 1));
    publish(
        &mut publisher,
        &performance,
        N_FRAMES + 1,
        N_FRAMES + N_MORE,
    )
    .await;
    let went = listening.await.unwrap().unwrap();
    let mut samples = vec![first];
    samples.extend(replayed.samples_through(N_FRAMES + N_MORE).await.unwrap());
    assert_same(&samples, &went);
    let samples = late.samples_through(N_FRAMES + N_MORE).await.unwrap();
    assert_same(
        &samples,
        &went[usize::try_from(N_FRAMES / 3 - 1).unwrap()..],
    );

    let stopped = stop(&server, &take.name).await.unwrap();
    assert_eq!(stopped.n_frames, N_FRAMES + N_MORE);
    let recorded = RecordedTake::read(&export(&server, &take.name).await);
    assert_same(&recorded.samples, &went);
    // The file has its final form now.
    let mut again = Subscriber::open(&server, from(7)).await.unwrap();
    let samples = again.samples_through(N_FRAMES + N_MORE).await.unwrap();
    assert_same(&samples, &went[6..]);
    over_http(&server, &went).await;
    server.stop().await;
}

/// A script that polls, and a browser that comes back.
async fn over_http(server: &TestServer, went: &[CurveSample]) {
    let path = "/api/v1/sessions/stage/curves?after=40&limit=3&withUncertainty=true";
    let page = http_get(server, path).await.json();
    let page: frontalis_proto::v1::ReadCurvesResponse = serde_json::from_value(page).unwrap();
    assert_same(&page.samples, &went[40..43]);
    assert_eq!(page.read_through, 43);

    let path = "/api/v1/sessions/stage/events?delivery=every_frame&withUncertainty=true";
    let run = page.header.unwrap().run;
    let left_off = format!("{run}:99");
    let mut events = EventStream::open(server, path, &left_off).await.unwrap();
    let mut samples = Vec::new();
    while samples.len() < 200 {
        samples.extend(events.answer().await.unwrap().unwrap().samples);
    }
    assert_same(&samples, &went[99..99 + samples.len()]);
}

fn assert_same(found: &[CurveSample], expected: &[CurveSample]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found, expected);
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_subscriber_that_reads_slowly_is_served_from_disk() {
    let server = server().await;
    let performance = TestPerformance::reference();
    start(&server, SESSION, "").await.unwrap();
    let mut publisher = Publisher::open(&server, performance.start(SESSION, "stage"))
        .await
        .unwrap();
    publish(&mut publisher, &performance, 1, 60).await;
    let mut slow = Subscriber::open(&server, from(1)).await.unwrap();
    let first = slow.sample().await.unwrap();
    // It reads nothing while more than the window and its connection hold goes by.
    publish(&mut publisher, &performance, 61, N_FRAMES).await;
    let rest = slow.samples_through(N_FRAMES).await.unwrap();
    let sequences: Vec<u64> = rest.iter().map(|it| it.sequence).collect();
    assert_eq!(first.sequence, 1);
    assert_eq!(sequences, (2..=N_FRAMES).collect::<Vec<_>>());
    server.stop().await;
}
