//! A subscriber of every frame that is served out of takes until it can go on with what the session keeps (CONTRACTS D-17,
//! D-18).
//!
//! What it lacks is read when it asks, never ahead of it. A run that is over is replayed to its end, where the subscriber
//! hears of the run that followed.

use frontalis_proto::v1;
use tokio::time::sleep_until;
use tonic::Status;

use crate::{
    hub::{Delivery, LostRange, RangeError, StartAt, SubscribeError, SubscribeSpec, Subscription},
    service::{
        grpc::ending,
        replay::{Replay, Replays, Step},
    },
    session::{SessionError, SessionHandle},
    wire::curve::{self as wire, SampleDetail},
};

/// One subscriber's replay.
pub(super) struct Replaying {
    replays: Replays,
    replay: Replay,
    session: SessionHandle,
    run: u64,
    max_samples: usize,
}

/// Where a subscriber begins.
pub(super) enum Begun {
    /// With what the session keeps.
    Live(Subscription),
    /// With what a take has.
    Replay(Subscription, Box<Replaying>),
}

/// Starts a subscription, with a take where the session no longer keeps its position.
///
/// # Errors
///
/// As it goes over the wire: at a limit, or that the position is neither kept nor in a take.
pub(super) async fn begin(
    replays: &Replays,
    session: &SessionHandle,
    spec: SubscribeSpec,
    max_samples: usize,
) -> Result<Begun, Status> {
    let hub = session.hub();
    let Some(wanted) = wanted(replays, session, &spec).await? else {
        return Ok(Begun::Live(hub.subscribe(spec)?));
    };
    let run = spec.run.unwrap_or_else(|| hub.run());
    let of_start = |start| SubscribeSpec {
        run: None,
        delivery: Delivery::EveryFrame(start),
        ..spec.clone()
    };
    let replaying = |replay| {
        Box::new(Replaying {
            replays: replays.clone(),
            replay,
            session: session.clone(),
            run,
            max_samples,
        })
    };
    if run != hub.run() {
        let found = replays.find_at_end(session.id(), run, wanted, 0).await?;
        let Some(replay) = found else {
            return Err(Status::from(SubscribeError::from(RangeError::NewRun {
                wanted: run,
                current: hub.run(),
            })));
        };
        let subscription = hub.subscribe(of_start(StartAt::Now))?;
        return Ok(Begun::Replay(subscription, replaying(replay)));
    }
    let refused = match hub.subscribe(of_start(StartAt::Sequence(wanted))) {
        Ok(subscription) => return Ok(Begun::Live(subscription)),
        Err(refused) => refused,
    };
    let range = match refused {
        SubscribeError::Range(range) => range,
        other => return Err(other.into()),
    };
    if is_past(&range)
        && let Some(replay) = replays.find(session.id(), run, wanted, 0).await?
    {
        let subscription = hub.subscribe(of_start(StartAt::Behind(wanted)))?;
        return Ok(Begun::Replay(subscription, replaying(replay)));
    }
    Err(not_kept(replays, session, range).await?.into())
}

/// The sample that a subscriber has to begin with, unless that is the session's to choose.
async fn wanted(
    replays: &Replays,
    session: &SessionHandle,
    spec: &SubscribeSpec,
) -> Result<Option<u64>, Status> {
    match spec.delivery {
        Delivery::EveryFrame(StartAt::Sequence(sequence)) => Ok(Some(sequence)),
        Delivery::EveryFrame(StartAt::Oldest) => oldest(replays, session, spec.run).await,
        Delivery::EveryFrame(StartAt::Now | StartAt::Behind(_)) | Delivery::Latest { .. } => {
            Ok(None)
        }
    }
}

/// The first sample from which on a run can be read without a hole; none when that is what the session keeps.
///
/// # Errors
///
/// That the storage failed.
pub(super) async fn oldest(
    replays: &Replays,
    session: &SessionHandle,
    run: Option<u64>,
) -> Result<Option<u64>, Status> {
    let hub = session.hub();
    let kept_from = hub.oldest_sequence();
    match run {
        Some(run) if run != hub.run() => {
            let held = replays.held(session.id(), run).await?;
            Ok(held.first().map(|it| it.first))
        }
        // The session keeps all there ever was.
        _ if kept_from == 1 => Ok(None),
        _ => {
            let oldest = replays.oldest(session.id(), hub.run(), kept_from).await?;
            Ok((oldest < kept_from).then_some(oldest))
        }
    }
}

/// Whether a position was kept once.
pub(super) fn is_past(range: &RangeError) -> bool {
    matches!(range, RangeError::NotKept { wanted, first_available, .. } if wanted < first_available)
}

/// What a position that is not kept is answered: the first one behind it that is, in a take or by the session.
///
/// # Errors
///
/// That the storage failed.
pub(super) async fn not_kept(
    replays: &Replays,
    session: &SessionHandle,
    range: RangeError,
) -> Result<RangeError, Status> {
    let RangeError::NotKept {
        wanted,
        first_available,
        last_available,
    } = range
    else {
        return Ok(range);
    };
    if !is_past(&range) {
        return Ok(range);
    }
    let run = session.hub().run();
    let in_take = replays.first_after(session.id(), run, wanted).await?;
    Ok(RangeError::NotKept {
        wanted,
        first_available: in_take.map_or(first_available, |(it, _)| it.min(first_available)),
        last_available,
    })
}

impl Replaying {
    /// A replay for a subscriber that fell out of what the session keeps; none when no take has what it lacks.
    ///
    /// # Errors
    ///
    /// That the storage failed.
    pub(super) async fn after_lag(
        replays: &Replays,
        session: &SessionHandle,
        subscription: &Subscription,
        max_samples: usize,
    ) -> Result<Option<Box<Self>>, Status> {
        let run = session.hub().run();
        let (sequence, last_frame) = (subscription.next_sequence(), subscription.last_frame());
        let found = replays
            .find(session.id(), run, sequence, last_frame)
            .await?;
        Ok(found.map(|replay| {
            Box::new(Self {
                replays: replays.clone(),
                replay,
                session: session.clone(),
                run,
                max_samples,
            })
        }))
    }

    /// The next sample that is wanted.
    pub(super) fn next_sequence(&self) -> u64 {
        self.replay.next_sequence()
    }

    /// The run that is replayed.
    pub(super) fn run(&self) -> u64 {
        self.run
    }

    fn is_of_present_run(&self) -> bool {
        self.run == self.session.hub().run()
    }

    /// The next response; none when the subscription goes on by itself.
    ///
    /// # Errors
    ///
    /// As it goes over the wire: samples that are in no take, a run that is over, a server that drains.
    pub(super) async fn next(
        &mut self,
        subscription: &mut Subscription,
        detail: SampleDetail,
    ) -> Result<Option<v1::SubscribeResponse>, Status> {
        loop {
            if subscription.is_draining() {
                return Err(SessionError::Draining.into());
            }
            match self.replay.step(self.max_samples, detail).await? {
                Step::Entries { samples, gaps } => {
                    return Ok(Some(self.respond(samples, gaps, subscription, detail)));
                }
                Step::Hole { sequence, frame } => {
                    if self.is_of_present_run() && subscription.rejoin().is_ok() {
                        return Ok(None);
                    }
                    return Err(ending::lagged(&self.lost_before(sequence, frame)));
                }
                Step::Caught => {
                    if subscription.rejoin().is_ok() {
                        return Ok(None);
                    }
                    tokio::select! {
                        () = self.replay.grown() => {}
                        () = sleep_until(subscription.heartbeat_due()) => {
                            let update = subscription.take_heartbeat();
                            return Ok(Some(wire::update_to_wire(&update, detail)));
                        }
                    }
                }
                Step::Over { unsolved } => {
                    if self.is_of_present_run() && subscription.rejoin().is_ok() {
                        return Ok(None);
                    }
                    if let Some(gap) = self.go_on(unsolved, subscription).await? {
                        return Ok(Some(self.respond(
                            Vec::new(),
                            vec![gap],
                            subscription,
                            detail,
                        )));
                    }
                }
            }
        }
    }

    fn respond(
        &self,
        samples: Vec<v1::CurveSample>,
        gaps: Vec<v1::Gap>,
        subscription: &mut Subscription,
        detail: SampleDetail,
    ) -> v1::SubscribeResponse {
        if self.is_of_present_run() {
            let (next_sequence, last_frame) =
                (self.replay.next_sequence(), self.replay.last_frame());
            subscription.given(next_sequence, last_frame, samples.len());
        } else {
            subscription.sent(samples.len());
        }
        v1::SubscribeResponse {
            samples,
            gaps,
            ..wire::update_to_wire(&subscription.take_state(), detail)
        }
    }

    /// Goes on with the next take, where one take is over; of a run that is over, first tells of the frames at its end that
    /// were not solved.
    async fn go_on(
        &mut self,
        unsolved: Option<v1::Gap>,
        subscription: &Subscription,
    ) -> Result<Option<v1::Gap>, Status> {
        let (next, last_frame) = (self.replay.next_sequence(), self.replay.last_frame());
        let (id, run) = (self.session.id(), self.run);
        if let Some(replay) = self.replays.find(id, run, next, last_frame).await? {
            self.replay = replay;
            return Ok(None);
        }
        if let Some((sequence, frame)) = self.replays.first_after(id, run, next).await? {
            return Err(ending::lagged(&self.lost_before(sequence, frame)));
        }
        if self.is_of_present_run() {
            let lost = subscription.missing();
            return Err(lost.map_or_else(
                || SessionError::Draining.into(),
                |lost| ending::lagged(&lost),
            ));
        }
        // A take that a crash ended before its first sample still tells of frames.
        let end = self.replays.find_at_end(id, run, next, last_frame).await?;
        if let Some(end) = end.filter(|it| it.take() != self.replay.take()) {
            self.replay = end;
            return Ok(None);
        }
        match unsolved.filter(|gap| gap.last > last_frame) {
            Some(gap) => {
                self.replay.tell(&gap);
                Ok(Some(gap))
            }
            None => Err(RangeError::NewRun {
                wanted: run,
                current: self.session.hub().run(),
            }
            .into()),
        }
    }

    /// What lies between the last that was given and the next that there is.
    fn lost_before(&self, sequence: u64, frame: u64) -> LostRange {
        LostRange {
            first_sequence: self.replay.next_sequence(),
            last_sequence: sequence.saturating_sub(1),
            first_frame: self.replay.last_frame().saturating_add(1),
            last_frame: frame.saturating_sub(1),
        }
    }
}
