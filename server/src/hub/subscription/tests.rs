//! Subscribers that keep up, pause, come late, and fall out of the window, on a paused clock.

use std::time::SystemTime;

use frontalis_analysis::{
    curve::{CurveSample, MarkerTrace, Quality, RegionReport},
    face::{marker::FrameIndex, region::FaceRegion},
};
use proptest::prelude::*;
use tokio::time::advance;

use super::*;
use crate::{
    clock::ServerClock,
    hub::{BufferBudget, GapCause, HubLimits, Outgoing, SampleTag, SessionState, SubscriberQuota},
};

const EVERY_FROM_NOW: Delivery = Delivery::EveryFrame(StartAt::Now);
const EVERY_FROM_OLDEST: Delivery = Delivery::EveryFrame(StartAt::Oldest);

fn limits() -> HubLimits {
    HubLimits {
        window_span: Duration::from_secs(10),
        window_samples: 100,
        window_bytes: 1 << 20,
        subscribers: 4,
        subscriber_quota: SubscriberQuota::new(6),
        buffers: BufferBudget::new(1 << 30),
    }
}

fn hub_with(limits: HubLimits) -> Arc<CurveHub> {
    let clock = ServerClock::start(SystemTime::UNIX_EPOCH);
    Arc::new(CurveHub::new(3, clock, limits))
}

fn hub() -> Arc<CurveHub> {
    hub_with(limits())
}

fn sample(frame: u64) -> Outgoing {
    let region = |region| RegionReport {
        region,
        marker_error_cm: 0.0,
        n_markers: 0,
        quality: Quality::Solved,
        held_reason: None,
        quality_fraction: 1.0,
    };
    Outgoing::Sample(Box::new(PublishedSample {
        sequence: 0,
        sample: CurveSample {
            frame: FrameIndex(frame),
            capture_time_nanos: 0,
            activations: vec![0.0; 4],
            quality: Quality::Solved,
            held_frames: 0,
            regions: FaceRegion::ALL.map(region),
            head: None,
            unobserved: Vec::new(),
            standard_errors: Vec::new(),
            outliers: Vec::new(),
            relabeled: Vec::new(),
            markers: MarkerTrace::default(),
            kkt_residual: 0.0,
        },
        tag: SampleTag::default(),
        solved_time_nanos: 0,
        actor_revision: 1,
    }))
}

fn gap(first: u64, last: u64) -> Outgoing {
    let cause = GapCause::CaptureSkip;
    Outgoing::Gap(Gap { first, last, cause })
}

fn publish(hub: &CurveHub, frames: impl IntoIterator<Item = u64>) {
    hub.publish(&mut frames.into_iter().map(sample).collect());
}

fn subscribe(hub: &Arc<CurveHub>, delivery: Delivery) -> Result<Subscription, SubscribeError> {
    hub.subscribe(SubscribeSpec {
        name: "wall".to_owned(),
        protocol: "grpc",
        delivery,
        run: None,
    })
}

fn latest(credits: u32) -> Delivery {
    Delivery::Latest {
        credits: Some(credits),
        max_rate_hz: None,
    }
}

async fn update(subscription: &mut Subscription) -> Update {
    match subscription.next().await {
        Delivered::Update(update) => update,
        other => panic!("{other:?}"),
    }
}

fn sequences(update: &Update) -> Vec<u64> {
    update.samples.iter().map(|it| it.sequence).collect()
}

#[tokio::test(start_paused = true)]
async fn a_late_subscriber_sees_the_newest_sample_at_once() {
    let hub = hub();
    publish(&hub, 1..=9);
    for delivery in [latest(2), EVERY_FROM_NOW] {
        let mut late = subscribe(&hub, delivery).unwrap();
        let first = update(&mut late).await;
        assert_eq!(sequences(&first), [9]);
        assert_eq!(first.skipped_samples, 0);
        assert_eq!(first.state.unwrap().session_state, SessionState::Waiting);
    }
}

#[tokio::test(start_paused = true)]
async fn latest_gets_no_more_than_its_credits_and_then_the_newest() {
    let hub = hub();
    let mut wall = subscribe(&hub, latest(2)).unwrap();
    update(&mut wall).await;
    for frame in 1..=2 {
        publish(&hub, [frame]);
        assert_eq!(sequences(&update(&mut wall).await), [frame]);
    }
    publish(&hub, 3..=50);
    let heartbeat = update(&mut wall).await;
    assert!(heartbeat.samples.is_empty());
    wall.grant(1);
    let fresh = update(&mut wall).await;
    assert_eq!(sequences(&fresh), [50]);
    assert_eq!(fresh.skipped_samples, 47);
    let status = &hub.subscribers()[0];
    assert_eq!((status.sent_samples, status.skipped_samples), (3, 47));
    assert_eq!(status.lag_frames, 0);
}

#[tokio::test(start_paused = true)]
async fn what_is_passed_over_is_told_before_the_next_sample_and_at_the_end() {
    let hub = hub();
    let mut wall = subscribe(&hub, latest(1)).unwrap();
    let mut every = subscribe(&hub, EVERY_FROM_NOW).unwrap();
    publish(&hub, [1]);
    assert_eq!(sequences(&update(&mut wall).await), [1]);
    publish(&hub, 2..=50);
    let heartbeat = update(&mut wall).await;
    assert!(heartbeat.samples.is_empty());
    // The newest, 50, may still be sent.
    assert_eq!(heartbeat.skipped_samples, 48);
    let statuses = hub.subscribers();
    assert_eq!(statuses[0].skipped_samples, 48);
    assert_eq!(statuses[1].skipped_samples, 0);
    publish(&hub, 51..=60);
    hub.announce(SessionState::Stale);
    assert_eq!(update(&mut wall).await.skipped_samples, 58);
    hub.close(Closing::Draining);
    assert!(matches!(wall.next().await, Delivered::Closed(_)));
    assert_eq!(wall.skipped_samples(), 59);
    while let Delivered::Update(told) = every.next().await {
        assert_eq!(told.skipped_samples, 0);
    }
    assert_eq!(every.skipped_samples(), 0);
}

proptest! {
    /// Whatever is granted when: each sample was sent, was skipped, or is the newest and may still be sent.
    #[test]
    fn sent_and_skipped_add_up_to_what_was_published(
        steps in prop::collection::vec((0_u64..5, 0_u32..3), 1..30),
    ) {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_time()
            .start_paused(true)
            .build()
            .unwrap();
        runtime.block_on(async {
            let hub = hub();
            let mut wall = subscribe(&hub, latest(1)).unwrap();
            update(&mut wall).await;
            let (mut n_published, mut sent, mut n_sent) = (0, 0, 0);
            for (n_frames, credits) in steps {
                publish(&hub, n_published + 1..=n_published + n_frames);
                n_published += n_frames;
                wall.grant(credits);
                let told = update(&mut wall).await;
                for sequence in sequences(&told) {
                    (sent, n_sent) = (sequence, n_sent + 1);
                }
                let pending = u64::from(sent < n_published);
                assert_eq!(told.skipped_samples + n_sent + pending, n_published);
                assert_eq!(hub.subscribers()[0].skipped_samples, told.skipped_samples);
            }
        });
    }
}

#[tokio::test(start_paused = true)]
async fn a_flood_of_credits_sends_no_sample_twice() {
    let hub = hub();
    let mut wall = subscribe(&hub, latest(u32::MAX)).unwrap();
    wall.grant(u32::MAX);
    publish(&hub, 1..=3);
    assert_eq!(sequences(&update(&mut wall).await), [3]);
    assert!(update(&mut wall).await.samples.is_empty());
}

#[tokio::test(start_paused = true)]
async fn uncontrolled_latest_keeps_to_thirty_hertz() {
    let hub = hub();
    let delivery = Delivery::Latest {
        credits: None,
        max_rate_hz: None,
    };
    let mut page = subscribe(&hub, delivery).unwrap();
    let feeding = Arc::clone(&hub);
    let feeder = tokio::spawn(async move {
        for frame in 1..=240 {
            publish(&feeding, [frame]);
            tokio::time::sleep(Duration::from_micros(8_333)).await;
        }
    });
    let start = Instant::now();
    let mut n_samples = 0;
    while start.elapsed() < Duration::from_secs(2) {
        n_samples += update(&mut page).await.samples.len();
    }
    feeder.await.unwrap();
    assert!((59..=62).contains(&n_samples), "{n_samples}");
}

#[tokio::test(start_paused = true)]
async fn every_frame_resumes_with_the_gaps_just_before_its_sample() {
    let hub = hub();
    hub.publish(&mut vec![
        sample(1),
        gap(2, 4),
        gap(5, 5),
        sample(6),
        sample(7),
        gap(8, 9),
    ]);
    let mut again = subscribe(&hub, Delivery::EveryFrame(StartAt::Sequence(2))).unwrap();
    let first = update(&mut again).await;
    assert_eq!(sequences(&first), [2, 3]);
    let gaps: Vec<_> = first.gaps.iter().map(|it| (it.first, it.last)).collect();
    assert_eq!(gaps, [(2, 5), (8, 9)]);
    let mut next = subscribe(&hub, Delivery::EveryFrame(StartAt::Sequence(4))).unwrap();
    let repeated = update(&mut next).await;
    assert!(repeated.samples.is_empty());
    assert_eq!(repeated.gaps.len(), 1);
    publish(&hub, [10]);
    assert_eq!(sequences(&update(&mut next).await), [4]);
}

#[tokio::test(start_paused = true)]
async fn positions_that_are_not_kept_name_those_that_are() {
    let hub = hub();
    let from = |sequence| subscribe(&hub, Delivery::EveryFrame(StartAt::Sequence(sequence)));
    let not_kept = |wanted, first_available, last_available| RangeError::NotKept {
        wanted,
        first_available,
        last_available,
    };
    assert_eq!(
        from(2).err(),
        Some(SubscribeError::Range(not_kept(2, 1, 0)))
    );
    assert!(from(1).is_ok());
    publish(&hub, 1..=100);
    advance(Duration::from_secs(11)).await;
    publish(&hub, 101..=150);
    assert_eq!(
        from(7).err(),
        Some(SubscribeError::Range(not_kept(7, 51, 150)))
    );
    assert_eq!(
        from(152).err(),
        Some(SubscribeError::Range(not_kept(152, 51, 150)))
    );
    assert!(from(151).is_ok());
    let mut other_run = SubscribeSpec {
        name: String::new(),
        protocol: "grpc",
        delivery: EVERY_FROM_OLDEST,
        run: Some(2),
    };
    let refused = hub.subscribe(other_run.clone()).err();
    let new_run = RangeError::NewRun {
        wanted: 2,
        current: 3,
    };
    assert_eq!(refused, Some(SubscribeError::Range(new_run)));
    other_run.run = Some(3);
    assert!(hub.subscribe(other_run).is_ok());
}

#[tokio::test(start_paused = true)]
async fn a_subscriber_that_falls_out_of_the_window_learns_what_it_lost() {
    let hub = hub();
    let mut slow = subscribe(&hub, EVERY_FROM_OLDEST).unwrap();
    publish(&hub, 1..=100);
    assert_eq!(update(&mut slow).await.samples.len(), BATCH_ENTRIES);
    advance(Duration::from_secs(11)).await;
    publish(&hub, 101..=250);
    let Delivered::Lagged(lost) = slow.next().await else {
        panic!("it lagged");
    };
    assert_eq!((lost.first_sequence, lost.last_sequence), (65, 100));
    assert_eq!((lost.first_frame, lost.last_frame), (65, 100));
}

#[tokio::test(start_paused = true)]
async fn the_window_keeps_the_larger_of_its_span_and_its_count() {
    let hub = hub();
    publish(&hub, 1..=500);
    assert_eq!(hub.page(None, None, 1_000).unwrap().samples.len(), 500);
    advance(Duration::from_secs(11)).await;
    publish(&hub, [501]);
    let page = hub.page(None, None, 1_000).unwrap();
    assert_eq!(page.samples.len(), 100);
    assert_eq!(page.samples[0].sequence, 402);
    assert_eq!((page.read_through, page.newest_sequence), (501, 501));
}

#[tokio::test(start_paused = true)]
async fn the_window_keeps_to_its_bytes_and_to_those_of_all() {
    let small = HubLimits {
        window_bytes: 20_000,
        ..limits()
    };
    let buffers = small.buffers.clone();
    let hub = hub_with(small);
    publish(&hub, 1..=500);
    assert!(buffers.used_bytes() <= 20_000);
    assert!(hub.page(None, None, 1_000).unwrap().samples.len() > 10);
    let crowded = HubLimits {
        buffers: BufferBudget::new(1),
        ..limits()
    };
    let hub = hub_with(crowded);
    publish(&hub, 1..=500);
    assert_eq!(hub.page(None, None, 1_000).unwrap().samples.len(), 1);
    drop(hub);
}

#[tokio::test(start_paused = true)]
async fn a_silent_session_is_heard_every_half_second() {
    let hub = hub();
    hub.frame_received(0);
    let mut wall = subscribe(&hub, latest(2)).unwrap();
    update(&mut wall).await;
    for beat in 1..=3 {
        let before = Instant::now();
        let heard = update(&mut wall).await;
        assert!(before.elapsed() <= Duration::from_millis(500));
        let state = heard.state.unwrap();
        assert_eq!(state.last_frame_age_nanos, beat * 500_000_000);
    }
}

#[tokio::test(start_paused = true)]
async fn every_transition_is_heard_in_order() {
    let hub = hub();
    let mut wall = subscribe(&hub, latest(2)).unwrap();
    update(&mut wall).await;
    let states = [
        SessionState::Aligning,
        SessionState::Live,
        SessionState::Stale,
        SessionState::Live,
    ];
    for state in states {
        hub.announce(state);
        hub.announce(state);
    }
    for state in states {
        let heard = update(&mut wall).await.state.unwrap();
        assert_eq!(heard.session_state, state);
    }
}

#[tokio::test(start_paused = true)]
async fn the_end_comes_after_everything_that_was_published() {
    let hub = hub();
    let mut recorder = subscribe(&hub, EVERY_FROM_OLDEST).unwrap();
    publish(&hub, 1..=100);
    hub.announce(SessionState::Ended);
    let ended = Closing::Ended {
        reason: "ENDED".to_owned(),
        last_frame: 100,
    };
    hub.close(ended.clone());
    hub.close(Closing::Draining);
    let mut n_samples = 0;
    let closing = loop {
        match recorder.next().await {
            Delivered::Update(update) => n_samples += update.samples.len(),
            Delivered::Closed(closing) => break closing,
            Delivered::Lagged(lost) => panic!("{lost:?}"),
        }
    };
    assert_eq!(n_samples, 100);
    assert_eq!(closing, ended);
}

#[tokio::test(start_paused = true)]
async fn places_are_limited_and_free_again() {
    let shared = limits();
    let (first, second) = (hub_with(shared.clone()), hub_with(shared));
    let mut seated: Vec<_> = (0..4)
        .map(|_| subscribe(&first, latest(1)).unwrap())
        .collect();
    let full = subscribe(&first, latest(1)).err();
    assert_eq!(full, Some(SubscribeError::SessionFull { limit: 4 }));
    seated.extend((0..2).map(|_| subscribe(&second, latest(1)).unwrap()));
    let full = subscribe(&second, latest(1)).err();
    assert_eq!(full, Some(SubscribeError::ServerFull { limit: 6 }));
    drop(seated);
    assert!(subscribe(&first, latest(1)).is_ok());
    assert!(first.subscribers().is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// However publishing and reading interleave: an EVERY_FRAME reader sees each frame number once, as sample or gap,
    /// in order, and sequences without holes; a LATEST reader sees rising sequences and its skips add up.
    #[test]
    fn readers_account_for_every_sample(steps in prop::collection::vec(0u8..6, 1..120)) {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_time().start_paused(true).build().unwrap();
        runtime.block_on(async move {
            let hub = hub();
            let mut every = subscribe(&hub, EVERY_FROM_OLDEST).unwrap();
            let mut wall = subscribe(&hub, latest(1)).unwrap();
            let (mut next_frame, mut next_sequence, mut read_through) = (1, 1, 0);
            let (mut shown, mut skipped) = (0, 0);
            for step in steps {
                match step {
                    0 | 1 => { publish(&hub, [next_frame]); next_frame += 1; }
                    2 => { hub.publish(&mut vec![gap(next_frame, next_frame + 1)]); next_frame += 2; }
                    3 => {
                        let update = update(&mut every).await;
                        let frames = update.samples.iter().map(|it| (it.sample.frame.0, it.sample.frame.0));
                        let gaps = update.gaps.iter().map(|it| (it.first, it.last));
                        let mut spans: Vec<_> = frames.chain(gaps).collect();
                        spans.sort_unstable();
                        for (first, last) in spans {
                            assert_eq!(first, read_through + 1);
                            read_through = last;
                        }
                        for sample in &update.samples {
                            assert_eq!(sample.sequence, next_sequence);
                            next_sequence += 1;
                        }
                    }
                    _ => {
                        let update = update(&mut wall).await;
                        for sample in &update.samples {
                            assert!(sample.sequence > shown);
                            skipped += sample.sequence - shown - 1;
                            shown = sample.sequence;
                            wall.grant(1);
                        }
                        assert_eq!(update.skipped_samples, skipped);
                    }
                }
            }
        });
    }
}

/// Reads all there is now: first and last frame of every sample and gap, in order of frames.
fn drain(subscription: &mut Subscription) -> Vec<(u64, u64)> {
    let mut heard = Vec::new();
    while let Some(Delivered::Update(update)) = subscription.take_ready(Instant::now()) {
        let samples = update.samples.iter().map(|it| it.sample.frame.0);
        let mut batch: Vec<_> = samples.map(|it| (it, it)).collect();
        batch.extend(update.gaps.iter().map(|it| (it.first, it.last)));
        batch.sort_unstable();
        heard.extend(batch);
    }
    heard
}

#[test]
fn a_gap_that_goes_on_is_one_until_someone_has_read_it() {
    let hub = hub();
    let go_on = |frame: u64| hub.publish(&mut vec![gap(frame, frame)]);
    publish(&hub, [1]);
    (2..=50).for_each(go_on);
    let mut early = subscribe(&hub, EVERY_FROM_OLDEST).unwrap();
    assert_eq!(drain(&mut early), [(1, 1), (2, 50)]);
    (51..=60).for_each(go_on);
    // What was read stays as it is; what goes on after it is one again.
    assert_eq!(drain(&mut early), [(51, 60)]);
    let mut late = subscribe(&hub, EVERY_FROM_OLDEST).unwrap();
    assert_eq!(drain(&mut late), [(1, 1), (2, 50), (51, 60)]);
    let page = hub.page(None, Some(1), 100).unwrap();
    assert_eq!(page.gaps.len(), 2);
}

#[test]
fn a_reader_at_the_end_hears_how_the_gap_goes_on() {
    let hub = hub();
    hub.publish(&mut vec![gap(1, 3)]);
    // Without a sample the newest position is behind the gap.
    let mut now = subscribe(&hub, EVERY_FROM_NOW).unwrap();
    hub.publish(&mut vec![gap(4, 6)]);
    assert_eq!(drain(&mut now), [(4, 6)]);
}

proptest! {
    #[test]
    fn every_reader_hears_every_frame_once_whenever_it_reads(
        actions in prop::collection::vec(0_u8..6, 1..120),
        n_before_the_late_one in 0_usize..120,
    ) {
        let hub = hub_with(HubLimits { window_samples: 1_000, ..limits() });
        let mut readers: Vec<_> = (0..2).map(|_| subscribe(&hub, EVERY_FROM_OLDEST).unwrap()).collect();
        let mut heard = vec![Vec::new(); 3];
        let mut n_frames = 0;
        for (idx, action) in actions.into_iter().enumerate() {
            if idx == n_before_the_late_one {
                readers.push(subscribe(&hub, EVERY_FROM_OLDEST).unwrap());
            }
            match action {
                0 => publish(&hub, [n_frames + 1]),
                1 => hub.publish(&mut vec![gap(n_frames + 1, n_frames + 1)]),
                2 => hub.publish(&mut vec![Outgoing::Gap(Gap::of_frame(n_frames + 1, GapCause::Shed))]),
                reader => {
                    let reader = usize::from(reader - 3);
                    if let Some(subscription) = readers.get_mut(reader) {
                        heard[reader].extend(drain(subscription));
                    }
                    continue;
                }
            }
            n_frames += 1;
        }
        for (subscription, heard) in readers.iter_mut().zip(&mut heard) {
            heard.extend(drain(subscription));
            let frames: Vec<u64> = heard.iter().flat_map(|(first, last)| *first..=*last).collect();
            prop_assert_eq!(frames, (1..=n_frames).collect::<Vec<_>>());
        }
    }
}
