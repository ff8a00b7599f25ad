//! Publishers and renderers of a session that is recorded, on a paused clock and with a window that soon forgets.

use std::time::Duration;

use frontalis_proto::v1::{self, GapCause, curve_service_server::CurveService as _};
use tokio::time::advance;
use tokio_util::{sync::CancellationToken, task::AbortOnDropHandle};
use tonic::{Code, Status};

use super::stage::{Publisher, SESSION, Seen, Stage, asked, assert_refused, every_frame, settings};
use crate::{
    catalogue::TakeRow,
    name::{SessionId, TakeId},
    session::SessionLimits,
    wire::take::NewTake,
};

/// Longer than the window and the memory for frames that are sent again.
const LONG: Duration = Duration::from_secs(3);

/// A stage whose window keeps a second, or ten samples.
struct Recorded {
    stage: Stage,
    take: TakeId,
    publisher: Publisher,
    _commits: AbortOnDropHandle<()>,
}

impl Recorded {
    async fn start() -> Self {
        let limits = SessionLimits {
            window_span: Duration::from_secs(1),
            window_samples: 10,
            ..SessionLimits::default()
        };
        let stage = Stage::with(limits, settings(), None).await;
        let commit = stage
            .takes
            .recorder()
            .clone()
            .commit(CancellationToken::new());
        let commits = AbortOnDropHandle::new(tokio::spawn(commit));
        let take = start_take(&stage).await.id;
        Self {
            publisher: stage.publisher("stage").await,
            _commits: commits,
            stage,
            take,
        }
    }

    /// Publishes frames and waits until they are on stable storage; then lets the window forget what it may.
    async fn publish(&mut self, frames: Vec<v1::MarkerFrame>) {
        let last = frames.last().map_or(0, |it| it.number);
        self.publisher.publish(frames).await;
        self.durable(last).await;
        advance(LONG).await;
        self.publisher.keep_alive().await;
    }

    async fn durable(&mut self, number: u64) {
        self.publisher.send(Vec::new()).await;
        while self.publisher.response().await.unwrap().durable_through < number {}
    }

    async fn stop(&self) -> TakeRow {
        self.stage.takes.stop(&self.take).await.unwrap()
    }

    async fn refused_from(&self, sequence: u64) -> Status {
        let mut renderer = self.stage.subscribe(starting_at(sequence)).await;
        renderer.end().await.1
    }
}

/// Every frame from a sample of the present run on, with all that is stored of it.
fn starting_at(sequence: u64) -> v1::SubscribeStart {
    v1::SubscribeStart {
        from_sequence: sequence,
        from_oldest: false,
        with_uncertainty: true,
        ..every_frame()
    }
}

async fn start_take(stage: &Stage) -> TakeRow {
    let session = SessionId::from_resource(SESSION).unwrap();
    let started = stage.takes.start(&session, NewTake::default()).await;
    started.unwrap()
}

fn sample(frame: u64, sequence: u64) -> Seen {
    Seen::Sample { frame, sequence }
}

/// CONTRACTS D-6, D-6a, D-7.
#[tokio::test(start_paused = true)]
async fn a_frame_sent_again_after_long_is_known_from_the_take() {
    let mut recorded = Recorded::start().await;
    let frames = recorded.stage.frames(1..=300);
    recorded.publish(frames.clone()).await;
    let later = recorded.stage.frames(301..=301);
    recorded.publish(later).await;
    let before = recorded.stage.session.status();

    let publisher = &mut recorded.publisher;
    for message in frames.chunks(100) {
        publisher.send(message.to_vec()).await;
    }
    let mut other = frames[6].clone();
    other.positions[0] += 1.0;
    publisher.send(vec![other]).await;
    publisher.publish(recorded.stage.frames(302..=302)).await;
    while recorded.publisher.rejected.is_empty() {
        recorded.publisher.response().await.unwrap();
    }
    let conflict = [(7, "FRAME_CONFLICT".to_owned())];
    assert_eq!(recorded.publisher.rejected, conflict);
    let after = recorded.stage.session.status();
    assert_eq!(after.frames_duplicate - before.frames_duplicate, 300);
    assert_eq!((after.frames_received, after.frames_late), (302, 0));
    assert_eq!(recorded.stop().await.content.n_frames, 302);
}

/// CONTRACTS D-11: a late frame is in the take once, however often it is sent.
#[tokio::test(start_paused = true)]
async fn a_late_frame_is_recorded_once() {
    let mut recorded = Recorded::start().await;
    let mut frames = recorded.stage.frames(1..=50);
    let late = frames.remove(29);
    recorded.publish(frames).await;
    for _ in 0..3 {
        recorded.publisher.send(vec![late.clone()]).await;
        advance(LONG).await;
        recorded.publisher.keep_alive().await;
    }
    let rejected = [(30, "LATE".to_owned())];
    assert_eq!(recorded.publisher.rejected, rejected);
    assert_eq!(recorded.stage.session.status().frames_duplicate, 2);
    assert_eq!(recorded.stop().await.content.n_frames, 50);
}

/// CONTRACTS D-17: no hole, no double, the same samples and the same gaps.
#[tokio::test(start_paused = true)]
async fn what_the_window_forgot_is_replayed_and_joined_to_what_it_keeps() {
    let mut recorded = Recorded::start().await;
    let mut live = recorded.stage.renderer(starting_at(1)).await;
    let mut frames = recorded.stage.frames(1..=400);
    frames.drain(99..110);
    recorded.publish(frames).await;
    let heard = live.samples_through(400).await;
    recorded.publish(recorded.stage.frames(401..=420)).await;
    assert!(recorded.stage.session.hub().oldest_sequence() > 380);

    for from in [1, 99, 100, 250] {
        let mut renderer = recorded.stage.renderer(starting_at(from)).await;
        let samples = renderer.samples_through(400).await;
        let expected: Vec<_> = heard.iter().filter(|it| it.sequence >= from).collect();
        assert!(samples.iter().take(expected.len()).eq(expected), "{from}");
        let mut renderer = recorded.stage.renderer(starting_at(from)).await;
        let number_of = |sequence| sequence + if sequence < 100 { 0 } else { 11 };
        let mut expected: Vec<_> = (from..=409).map(|it| sample(number_of(it), it)).collect();
        if from <= 100 {
            let gap = Seen::Gap {
                first: 100,
                last: 110,
                cause: GapCause::CaptureSkip,
            };
            expected.insert(usize::try_from(100 - from).unwrap(), gap);
        }
        assert_eq!(renderer.see_through(420).await, expected, "from {from}");
    }
}

/// CONTRACTS D-18.
#[tokio::test(start_paused = true)]
async fn a_renderer_that_lags_is_served_from_the_take() {
    let mut recorded = Recorded::start().await;
    let mut slow = recorded.stage.renderer(starting_at(1)).await;
    recorded.publish(recorded.stage.frames(1..=20)).await;
    let mut sequences: Vec<u64> = Vec::new();
    let mut last = 20;
    // Each time it asks, twenty samples more have come and gone.
    while last < 400 {
        let samples = slow.response().await.unwrap().samples;
        sequences.extend(samples.iter().map(|it| it.sequence));
        let frames = recorded.stage.frames(last + 1..=last + 20);
        recorded.publish(frames).await;
        last += 20;
    }
    let rest = slow.samples_through(last).await;
    sequences.extend(rest.iter().map(|it| it.sequence));
    assert_eq!(sequences, (1..=last).collect::<Vec<_>>());
}

/// CONTRACTS D-17, D-18: what was not recorded is lost, and said to be.
#[tokio::test(start_paused = true)]
async fn a_take_that_is_over_is_replayed_to_its_end_and_then_the_exact_loss_is_told() {
    let mut recorded = Recorded::start().await;
    recorded.publish(recorded.stage.frames(1..=100)).await;
    recorded.stop().await;
    let publisher = &mut recorded.publisher;
    for first in [101, 201] {
        publisher
            .publish(recorded.stage.frames(first..=first + 99))
            .await;
        advance(LONG).await;
        publisher.keep_alive().await;
    }
    recorded.take = start_take(&recorded.stage).await.id;
    recorded.publish(recorded.stage.frames(301..=400)).await;
    recorded.publish(recorded.stage.frames(401..=420)).await;

    let mut renderer = recorded.stage.renderer(starting_at(40)).await;
    let samples = renderer.samples_through(100).await;
    let sequences: Vec<_> = samples.iter().map(|it| it.sequence).collect();
    assert_eq!(sequences, (40..=100).collect::<Vec<_>>());
    let lost = renderer.end().await.1;
    assert_refused(&lost, Code::DataLoss, "SUBSCRIBER_LAGGED");
    let range = "samples 101 to 300 (frames 101 to 300)";
    assert!(lost.message().starts_with(range), "{lost:?}");

    let refused = recorded.refused_from(150).await;
    assert_refused(&refused, Code::OutOfRange, "SEQUENCE");
    assert!(
        refused.message().contains("the first available is 301"),
        "{refused:?}"
    );
    // The oldest is that from which on nothing is missing.
    let mut oldest = recorded.stage.renderer(every_frame()).await;
    assert_eq!(oldest.samples_through(420).await[0].sequence, 301);
}

#[tokio::test(start_paused = true)]
async fn an_erased_take_is_replayed_no_more() {
    let mut recorded = Recorded::start().await;
    for first in [1, 101, 201] {
        let frames = recorded.stage.frames(first..=first + 99);
        recorded.publish(frames).await;
    }
    let mut before = recorded.stage.renderer(starting_at(1)).await;
    before.response().await.unwrap();
    recorded.stage.takes.delete(&recorded.take).await.unwrap();
    let refused = recorded.refused_from(1).await;
    assert_refused(&refused, Code::OutOfRange, "SEQUENCE");
    let oldest = recorded.stage.session.hub().oldest_sequence();
    let first = format!("the first available is {oldest}");
    assert!(refused.message().contains(&first), "{refused:?}");
}

#[tokio::test(start_paused = true)]
async fn a_script_that_polls_reads_out_of_the_take_too() {
    let mut recorded = Recorded::start().await;
    for first in [1, 101, 201] {
        let frames = recorded.stage.frames(first..=first + 99);
        recorded.publish(frames).await;
    }
    let mut sequences = Vec::new();
    let mut after = None;
    loop {
        let request = v1::ReadCurvesRequest {
            session: SESSION.to_owned(),
            after,
            limit: 70,
            ..v1::ReadCurvesRequest::default()
        };
        let page = recorded.stage.curves.read_curves(asked(request)).await;
        let page = page.unwrap().into_inner();
        assert_eq!(page.newest_sequence, 300);
        if page.samples.is_empty() {
            break;
        }
        assert!(page.samples.len() <= 70);
        assert!(page.samples.iter().all(|it| it.standard_errors.is_empty()));
        sequences.extend(page.samples.iter().map(|it| it.sequence));
        after = Some(page.read_through);
    }
    assert_eq!(sequences, (1..=300).collect::<Vec<_>>());
}
