//! Over a crash of the server, publisher and subscriber go on by themselves (CONTRACTS D-8, D-9, D-17, O-14).

use std::collections::BTreeSet;

use frontalis_client::{
    capture_client::CaptureClient,
    connection::lazy_channel,
    curve_client::{CurveClient, CurveEvent, CurveSettings, StartAt, Wanted},
};
use frontalis_proto::v1::{ListTakesRequest, SessionSettings};
use harness::{
    Heard, RecordedTake, Subscriber, TestPerformance, TestServer, assert_eventually,
    assert_refused, every_frame, take_in_order,
};
use tonic::Code;

use super::{SESSION, export, start};

/// Frames before the crash, and as many after it.
const N_FRAMES: u64 = 150;

async fn server() -> TestServer {
    let server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    let created = server.create_session("stage", "actors/reference");
    created.await.unwrap();
    server
}

/// What a subscriber of every frame was told: sequences and frames by run.
#[derive(Default)]
struct Told {
    runs: Vec<Vec<(u64, u64)>>,
    gap_frames: BTreeSet<u64>,
    last_frame: u64,
}

impl Told {
    fn take(&mut self, event: CurveEvent) {
        match event {
            CurveEvent::Header(_) if self.runs.is_empty() => self.runs.push(Vec::new()),
            CurveEvent::NewRun { .. } => self.runs.push(Vec::new()),
            CurveEvent::Sample(sample) => {
                self.last_frame = sample.frame;
                let run = self.runs.last_mut().unwrap();
                run.push((sample.sequence, sample.frame));
            }
            CurveEvent::Gap(gap) => self.gap_frames.extend(gap.first..=gap.last),
            CurveEvent::Lost { .. } => panic!("{event:?}"),
            _ => {}
        }
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn publisher_and_subscriber_go_on_over_a_crash_without_a_hole_or_a_double() {
    let server = server().await;
    let performance = TestPerformance::reference();
    let take = start(&server, SESSION, "").await.unwrap();
    let channel = lazy_channel(&server.url()).unwrap();
    let publisher = CaptureClient::start(
        channel.clone(),
        performance.capture_settings(SESSION, "camera-1"),
    )
    .await
    .unwrap();
    let from = StartAt::Oldest;
    let wanted = CurveSettings::new(SESSION, Wanted::EveryFrame { from });
    let mut curves = CurveClient::subscribe(channel, wanted).await.unwrap();
    let mut told = Told::default();
    for number in 1..=N_FRAMES {
        publisher.send(performance.frame(number)).await.unwrap();
    }
    // Somewhere amid the frames; the subscriber has heard few of them.
    assert_eventually!(publisher.report().durable_through > N_FRAMES / 2);
    while told.last_frame < N_FRAMES / 4 {
        told.take(curves.next().await.unwrap().unwrap());
    }
    let server = server.kill_and_restart().await;
    for number in N_FRAMES + 1..=2 * N_FRAMES {
        publisher.send(performance.frame(number)).await.unwrap();
    }
    while told.last_frame < 2 * N_FRAMES {
        told.take(curves.next().await.unwrap().unwrap());
    }
    let published = publisher.finish().await;
    assert!(published.failure.is_none(), "{:?}", published.failure);
    assert_eq!(published.report.lost.n_frames(), 0);
    assert_eq!(published.report.unacknowledged_frames, 0);
    assert!(published.report.reconnections >= 1);

    assert_eq!(told.runs.len(), 2, "the run that crashed, and the next");
    for run in &told.runs {
        let sequences: Vec<u64> = run.iter().map(|it| it.0).collect();
        assert_eq!(sequences, (1..=run.len() as u64).collect::<Vec<_>>());
        assert!(run.is_sorted_by(|one, other| one.1 < other.1));
    }
    let frames = told.runs.iter().flatten().map(|it| it.1);
    let mut answered: BTreeSet<u64> = frames.collect();
    answered.extend(told.gap_frames);
    assert_eq!(answered, (1..=2 * N_FRAMES).collect::<BTreeSet<_>>());

    let recorded = RecordedTake::read(&export(&server, &take.name).await);
    let numbers = recorded.frame_numbers();
    assert_eq!(numbers, (1..=numbers.len() as u64).collect::<Vec<_>>());
    assert!(numbers.len() as u64 > N_FRAMES / 2);
    println!(
        "{} frames were recorded before the crash; {} + {} samples, {} frames sent again",
        numbers.len(),
        told.runs[0].len(),
        told.runs[1].len(),
        published.report.resent_frames,
    );
}

/// Every frame is in one of the takes, once, and both have the slate that was given.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_session_that_records_itself_goes_on_over_a_crash_and_no_frame_is_in_both_takes() {
    let server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    let settings = SessionSettings {
        record: Some(true),
        ..SessionSettings::default()
    };
    let created = server.create_session_with("stage", "actors/reference", settings);
    created.await.unwrap();
    let first = start(&server, SESSION, "12A").await.unwrap();
    let performance = TestPerformance::reference();
    let channel = lazy_channel(&server.url()).unwrap();
    let settings = performance.capture_settings(SESSION, "camera-1");
    let publisher = CaptureClient::start(channel, settings).await.unwrap();
    for number in 1..=N_FRAMES {
        publisher.send(performance.frame(number)).await.unwrap();
    }
    assert_eventually!(publisher.report().durable_through > N_FRAMES / 2);
    let server = server.kill_and_restart().await;
    for number in N_FRAMES + 1..=2 * N_FRAMES {
        publisher.send(performance.frame(number)).await.unwrap();
    }
    let published = publisher.finish().await;
    assert!(published.failure.is_none(), "{:?}", published.failure);
    assert_eq!(published.report.unacknowledged_frames, 0);

    let mut client = server.takes().await;
    let listed = client.list_takes(ListTakesRequest::default()).await;
    let takes = listed.unwrap().into_inner().takes;
    assert_eq!(takes.len(), 2, "{takes:?}");
    let mut numbers = Vec::new();
    for take in &takes {
        assert_eq!(take.slate, "12A");
        let recorded = RecordedTake::read(&export(&server, &take.name).await);
        numbers.extend(recorded.frame_numbers());
    }
    assert!(takes.iter().any(|it| it.name == first.name));
    numbers.sort_unstable();
    assert_eq!(numbers, (1..=2 * N_FRAMES).collect::<Vec<_>>());
}

async fn stored_samples(server: &TestServer, take: &str) -> usize {
    RecordedTake::read(&export(server, take).await)
        .samples
        .len()
}

/// The wire's own form: the rest of the run that crashed, then where the next begins.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_position_in_the_run_that_crashed_is_replayed_to_its_end() {
    let server = server().await;
    let performance = TestPerformance::reference();
    let take = start(&server, SESSION, "").await.unwrap();
    let mut publisher = harness::Publisher::open(&server, performance.start(SESSION, "camera-1"))
        .await
        .unwrap();
    publisher.send(performance.frames(1..=100)).await;
    publisher.durable(100).await.unwrap();
    let run = publisher.started.run;
    // Frames are on stable storage before their samples are; the position that is asked for is to be there.
    assert_eventually!(stored_samples(&server, &take.name).await >= 5);
    let server = server.kill_and_restart().await;
    assert!(take_in_order(&server, &take.name).await.recovered);

    let recorded = RecordedTake::read(&export(&server, &take.name).await);
    let stored = recorded.samples;
    let position = frontalis_proto::v1::SubscribeStart {
        run,
        from_sequence: 5,
        from_oldest: false,
        with_uncertainty: true,
        ..every_frame(SESSION)
    };
    let mut subscriber = Subscriber::open(&server, position).await.unwrap();
    assert_eq!(subscriber.header.run, run);
    let (mut samples, mut unsolved) = (Vec::new(), 0);
    let end = loop {
        match subscriber.next().await {
            Ok(Some(Heard::Sample(sample))) => samples.push(*sample),
            Ok(Some(Heard::Gap(gap))) => unsolved += gap.last - gap.first + 1,
            Ok(Some(_)) => {}
            Ok(None) => panic!("it ended in peace"),
            Err(status) => break status,
        }
    };
    assert_refused(&end, Code::OutOfRange, "NEW_RUN");
    assert_eq!(samples, stored[4..]);
    assert_eq!(
        samples.len() as u64 + 4 + unsolved,
        100,
        "every frame is told of"
    );
}
