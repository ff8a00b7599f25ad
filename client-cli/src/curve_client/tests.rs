//! The subscriber against a server that breaks, under a paused clock.

use tonic::{Code, Status};

use super::*;
use crate::{
    error::{refusal_for_tests, refusal_to_wait_for_tests},
    fake_server::{Curves, FakeServer},
    proto::{Delivery, SubscribeResponse},
};

fn header(run: u64) -> SubscribeResponse {
    SubscribeResponse {
        header: Some(CurveHeader {
            run,
            ..CurveHeader::default()
        }),
        ..SubscribeResponse::default()
    }
}

fn samples(sequences: std::ops::RangeInclusive<u64>) -> SubscribeResponse {
    let sample = |sequence| CurveSample {
        frame: sequence,
        sequence,
        ..CurveSample::default()
    };
    SubscribeResponse {
        samples: sequences.map(sample).collect(),
        ..SubscribeResponse::default()
    }
}

fn end() -> SubscribeResponse {
    SubscribeResponse {
        end: Some(CurveEnd::default()),
        ..SubscribeResponse::default()
    }
}

fn curves(responses: Vec<SubscribeResponse>, status: Option<Status>) -> Curves {
    Curves { responses, status }
}

fn cut() -> Status {
    Status::unavailable("the connection was cut")
}

/// Every event of an every-frame subscription that the script ends.
async fn follow(script: Vec<Curves>) -> (FakeServer, Vec<CurveEvent>) {
    let server = FakeServer::with_curves(script);
    let wanted = Wanted::EveryFrame {
        from: StartAt::Oldest,
    };
    let settings = CurveSettings::new("sessions/take-1", wanted);
    let mut client = CurveClient::subscribe(server.channel(), settings)
        .await
        .unwrap();
    let mut events = Vec::new();
    while let Some(event) = client.next().await.unwrap() {
        events.push(event);
    }
    (server, events)
}

fn sequences(events: &[CurveEvent]) -> Vec<u64> {
    let sequence = |it: &CurveEvent| match it {
        CurveEvent::Sample(sample) => Some(sample.sequence),
        _ => None,
    };
    events.iter().filter_map(sequence).collect()
}

#[tokio::test(start_paused = true)]
async fn a_cut_stream_goes_on_after_its_last_sample() {
    let (server, events) = follow(vec![
        curves(vec![header(7), samples(1..=5)], Some(cut())),
        curves(vec![], Some(cut())),
        // A server that repeats one sample must not make the client repeat it.
        curves(vec![header(7), samples(5..=9), end()], None),
    ])
    .await;
    assert_eq!(sequences(&events), (1..=9).collect::<Vec<_>>());
    let record = server.record();
    assert!(record.subscriptions[0].from_oldest);
    let resumed = &record.subscriptions[2];
    assert_eq!((resumed.run, resumed.from_sequence), (7, 6));
}

#[tokio::test(start_paused = true)]
async fn a_new_run_is_reported_and_followed_from_its_start() {
    let new_run = refusal_for_tests(Code::OutOfRange, "NEW_RUN");
    let (server, events) = follow(vec![
        curves(vec![header(1), samples(1..=5)], Some(cut())),
        curves(vec![], Some(new_run)),
        curves(vec![header(2), samples(1..=3), end()], None),
    ])
    .await;
    let reported = CurveEvent::NewRun {
        previous: 1,
        present: 2,
    };
    assert!(events.contains(&reported));
    assert_eq!(sequences(&events), [1, 2, 3, 4, 5, 1, 2, 3]);
    assert!(server.record().subscriptions[2].from_oldest);
}

#[tokio::test(start_paused = true)]
async fn data_loss_is_reported_with_the_exact_range() {
    let lagged = refusal_for_tests(Code::DataLoss, "SUBSCRIBER_LAGGED");
    let (_, events) = follow(vec![
        curves(vec![header(1), samples(1..=5)], Some(lagged)),
        curves(vec![header(1), samples(41..=42), end()], None),
    ])
    .await;
    let lost = CurveEvent::Lost {
        first_sequence: 6,
        last_sequence: 40,
    };
    assert!(events.contains(&lost));
}

/// CONTRACTS D-14.
#[tokio::test(start_paused = true)]
async fn a_credit_goes_back_when_the_next_sample_is_asked_for() {
    let response = |it| samples(it..=it);
    let script = curves(vec![header(1), response(1), response(2), response(3)], None);
    let server = FakeServer::with_curves([script]);
    let wanted = Wanted::Latest {
        credits: 2,
        max_rate_hz: 0.0,
    };
    let settings = CurveSettings::new("sessions/take-1", wanted);
    let mut client = CurveClient::subscribe(server.channel(), settings)
        .await
        .unwrap();
    for _ in 0..4 {
        client.next().await.unwrap();
    }
    // The third sample is still being shown.
    tokio::time::timeout(Duration::from_millis(1), std::future::pending::<()>())
        .await
        .unwrap_err();
    assert_eq!(server.record().credits_returned, 2);
    let asking = tokio::time::timeout(Duration::from_secs(1), client.next());
    assert!(asking.await.is_err());
    assert_eq!(server.record().credits_returned, 3);
    let start = server.record().subscriptions[0].clone();
    assert_eq!((start.delivery(), start.credits), (Delivery::Latest, 2));
}

#[tokio::test(start_paused = true)]
async fn a_refusal_is_told_at_once() {
    let missing = refusal_for_tests(Code::NotFound, "SESSION");
    let server = FakeServer::with_curves([curves(vec![], Some(missing))]);
    let wanted = Wanted::EveryFrame { from: StartAt::Now };
    let settings = CurveSettings::new("sessions/none", wanted);
    let error = CurveClient::subscribe(server.channel(), settings)
        .await
        .unwrap_err();
    assert!(error.has_reason("SESSION"));
}

/// A limit may refuse after the stream was opened; what it asks to wait is for a subscription that was served before.
#[tokio::test(start_paused = true)]
async fn a_limit_ends_a_first_subscription_and_delays_a_later_one() {
    let full = || refusal_to_wait_for_tests(Code::ResourceExhausted, "SUBSCRIBERS", 1_000);
    let opened = SubscribeResponse::default;
    for responses in [vec![], vec![opened()]] {
        let server = FakeServer::with_curves([curves(responses, Some(full()))]);
        let wanted = Wanted::EveryFrame { from: StartAt::Now };
        let settings = CurveSettings::new("sessions/take-1", wanted);
        let refused = match CurveClient::subscribe(server.channel(), settings).await {
            Ok(mut client) => client.next().await.map(|_| ()),
            Err(error) => Err(error),
        };
        assert!(refused.unwrap_err().has_reason("SUBSCRIBERS"));
        assert_eq!(server.record().subscriptions.len(), 1);
    }
    let (_, events) = follow(vec![
        curves(vec![header(1), samples(1..=2)], Some(cut())),
        curves(vec![], Some(full())),
        curves(vec![opened()], Some(full())),
        curves(vec![header(1), samples(3..=4), end()], None),
    ])
    .await;
    assert_eq!(sequences(&events), [1, 2, 3, 4]);
}
