//! The publisher against a server that breaks, under a paused clock.

use tonic::Status;

use super::*;
use crate::{
    error::refusal_for_tests,
    fake_server::{Capture, FakeServer},
};

fn settings(ingest: Ingest) -> CaptureSettings {
    CaptureSettings {
        session: "sessions/take-1".to_owned(),
        publisher: "rig-1".to_owned(),
        marker_names: vec!["chin".to_owned()],
        unit: LengthUnit::Centimeter,
        rate_hz: 60.0,
        ingest,
        takeover: true,
    }
}

fn frame(number: u64) -> MarkerFrame {
    MarkerFrame {
        number,
        positions: vec![0.0; 3],
        ..MarkerFrame::default()
    }
}

async fn publish(script: Vec<Capture>, frames: u64) -> (FakeServer, Published) {
    let server = FakeServer::with_capture(script);
    let client = CaptureClient::start(server.channel(), settings(Ingest::Lossless))
        .await
        .unwrap();
    for number in 1..=frames {
        if client.send(frame(number)).await.is_err() {
            break;
        }
    }
    (server, client.finish().await)
}

fn broken(taken: usize, acked: usize) -> Capture {
    Capture::Break {
        taken,
        acked,
        status: Status::unavailable("the connection was cut"),
    }
}

fn all(n_frames: u64) -> Vec<u64> {
    (1..=n_frames).collect()
}

#[tokio::test(start_paused = true)]
async fn every_frame_takes_effect_once_over_broken_connections() {
    let script = vec![
        broken(100, 90),
        broken(1, 0),
        broken(300, 10),
        Capture::Serve,
    ];
    let (server, published) = publish(script, 1_000).await;
    assert_eq!(published.failure, None);
    assert_eq!(server.record().effective, all(1_000));
    assert_eq!(published.report.accepted_frames, 1_000);
    assert_eq!(published.report.sent_frames, 1_000);
    assert_eq!(published.report.reconnections, 3);
    assert!(published.report.lost.is_empty());
}

#[tokio::test(start_paused = true)]
async fn resumes_from_what_the_server_expects_next() {
    let (server, published) = publish(vec![broken(64, 3), Capture::Serve], 64).await;
    assert_eq!(published.failure, None);
    // The server had all 64 and said so in `started`; nothing is sent again.
    assert_eq!(server.record().arrived[1], Vec::<u64>::new());
    assert_eq!(published.report.accepted_frames, 64);
}

#[tokio::test(start_paused = true)]
async fn a_takeover_is_asked_for_once_only() {
    let (server, _) = publish(vec![broken(1, 1), Capture::Serve], 10).await;
    assert_eq!(server.record().takeovers, [true, false]);
}

/// CONTRACTS D-29.
#[tokio::test(start_paused = true)]
async fn a_fenced_publisher_never_comes_back_by_itself() {
    let fenced = Capture::Break {
        taken: 5,
        acked: 5,
        status: refusal_for_tests(Code::Aborted, "PUBLISHER_FENCED"),
    };
    let (server, published) = publish(vec![fenced, Capture::Serve], 1_000).await;
    let failure = published.failure.unwrap();
    assert!(failure.has_reason("PUBLISHER_FENCED"));
    assert_eq!(server.record().arrived.len(), 1);
}

#[tokio::test(start_paused = true)]
async fn goes_on_in_the_new_run_of_a_restarted_server() {
    let (server, published) = publish(vec![broken(64, 60), Capture::ServeNewRun], 200).await;
    assert_eq!(published.failure, None);
    assert_eq!(published.report.new_runs, 1);
    let record = server.record();
    assert_eq!(record.arrived[1].last(), Some(&200));
    // Unacknowledged in the old run, so sent again in the new one.
    assert!(record.arrived[1].contains(&64));
}

#[tokio::test(start_paused = true)]
async fn a_refused_frame_is_reported_and_not_repeated() {
    let (server, published) = publish(vec![Capture::Reject(vec![3, 7])], 10).await;
    assert_eq!(published.failure, None);
    let rejection = &published.report.rejected["NON_FINITE"];
    assert_eq!((rejection.frames, rejection.first_frame), (2, 3));
    assert_eq!(published.report.accepted_frames, 8);
    assert_eq!(server.record().arrived[0], all(10));
}

/// CONTRACTS D-9.
#[tokio::test(start_paused = true)]
async fn a_live_publisher_that_cannot_reach_the_server_reports_the_gap() {
    let refuse = || Capture::Refuse(Status::unavailable("starting"));
    let mut script = vec![broken(1, 1)];
    script.extend((0..40).map(|_| refuse()));
    let server = FakeServer::with_capture(script);
    let client = CaptureClient::start(server.channel(), settings(Ingest::Live))
        .await
        .unwrap();
    client.send(frame(1)).await.unwrap();
    tokio::time::sleep(Duration::from_millis(50)).await;
    // The ring holds ten seconds at 60 Hz; fifteen pass.
    for number in 2..=901 {
        client.send(frame(number)).await.unwrap();
        tokio::time::sleep(Duration::from_micros(16_667)).await;
    }
    let report = client.report();
    assert_eq!(report.lost.as_pairs(), [(2, 301)]);
    assert_eq!(report.unacknowledged_frames, 600);
}

#[tokio::test(start_paused = true)]
async fn a_live_publisher_that_was_away_for_long_catches_up_losslessly() {
    let refuse = || Capture::Refuse(Status::unavailable("starting"));
    let mut script = vec![broken(1, 1)];
    script.extend((0..7).map(|_| refuse()));
    script.extend([Capture::Serve, Capture::Serve]);
    let server = FakeServer::with_capture(script);
    let client = CaptureClient::start(server.channel(), settings(Ingest::Live))
        .await
        .unwrap();
    for number in 1..=600 {
        client.send(frame(number)).await.unwrap();
        tokio::time::sleep(Duration::from_micros(16_667)).await;
    }
    let published = client.finish().await;
    assert_eq!(published.failure, None);
    assert_eq!(published.report.accepted_frames, 600);
    let record = server.record();
    assert_eq!(record.effective, all(600));
    let last_two = &record.ingests[record.ingests.len() - 2..];
    assert_eq!(last_two, [Ingest::Lossless, Ingest::Live]);
    assert!(!record.arrived.last().unwrap().is_empty());
}

#[tokio::test(start_paused = true)]
async fn the_first_refusal_is_told_at_once() {
    let owned = refusal_for_tests(Code::FailedPrecondition, "SESSION_OWNED");
    let server = FakeServer::with_capture([Capture::Refuse(owned)]);
    let error = CaptureClient::start(server.channel(), settings(Ingest::Live))
        .await
        .unwrap_err();
    assert!(error.has_reason("SESSION_OWNED"));
}
