//! The task of one session: takes work in order, solves, publishes, and watches the time.
//!
//! Marker solves run here, on the runtime: a thread hop costs more than the solve (CONTRACTS O-6).
//! The task ends when the session ended or the server drains, after all that waited is done.

use std::{collections::VecDeque, panic::AssertUnwindSafe, sync::Arc};

use frontalis_analysis::{
    analyzer::{NeutralSource, Progress, QuietestError},
    marker_analysis::alignment::AlignmentError,
};
use futures::FutureExt as _;
use tokio::time::{Instant, sleep_until};

use super::{
    command::{Command, Source},
    figures::Passage,
    frame::Rejection,
    intake::{Closed, MAX_CONSECUTIVE_REJECTS},
    judging::JudgingPace,
    mailbox::Mailbox,
    panic_count::PanicCount,
    pipeline::{Outcome, Pipeline, Step},
    publication::PublishEnd,
    queue::{WaitingFrame, Work},
    recording::{Recorded, RecordingTap},
    settings::{SessionEvent, SessionSpec},
    shared::Shared,
};
use crate::hub::{Closing, Outgoing, SessionState};

/// Work done before other tasks of the runtime get their turn.
const WORK_PER_TURN: u32 = 16;

/// Runs a session until it is over.
pub(super) async fn run(shared: Arc<Shared>, spec: SessionSpec) {
    let mut worker = Worker::new(Arc::clone(&shared), &spec);
    drop(spec);
    let outcome = AssertUnwindSafe(worker.work()).catch_unwind().await;
    if outcome.is_err() {
        fail(&shared, "a panic outside a frame").await;
        wait_for_the_end(&shared).await;
    }
    shared.is_over.send_replace(true);
}

/// After a failure nothing is solved; the session can only end.
pub(super) async fn wait_for_the_end(shared: &Shared) {
    loop {
        let work = shared.intake().pop();
        match work {
            Some(Work::Command(Command::End)) => return end(shared).await,
            Some(Work::Command(Command::Finish(mailbox))) => mailbox.finish(),
            // Whoever waits for an answer sees that its sender is gone.
            Some(_) => {}
            None if shared.is_draining() => return shared.hub.close(Closing::Draining),
            None => shared.work.notified().await,
        }
    }
}

pub(super) async fn fail(shared: &Shared, reason: &str) {
    tracing::error!(session = %shared.id, reason, "session failed");
    let reason = reason.to_owned();
    shared.intake().close(Closed::Failed {
        reason: reason.clone(),
    });
    shared.hub.announce(SessionState::Failed);
    let (id, run) = (shared.id.clone(), shared.run);
    shared.tell(SessionEvent::Failed { id, run, reason }).await;
}

async fn end(shared: &Shared) {
    let last_frame = shared.intake().accepted_through();
    shared.hub.announce(SessionState::Ended);
    shared.hub.close(Closing::Ended {
        reason: "ENDED".to_owned(),
        last_frame,
    });
    let (id, run) = (shared.id.clone(), shared.run);
    shared.tell(SessionEvent::Ended { id, run }).await;
}

struct Worker {
    shared: Arc<Shared>,
    pipeline: Pipeline,
    actor_revision: u32,
    mailbox: Option<Arc<Mailbox>>,
    state: SessionState,
    stale_after_nanos: i64,
    rate_hz: f64,
    last_received_nanos: i64,
    panics: PanicCount,
    judging: JudgingPace,
    outcomes: Vec<Outcome>,
    outgoing: Vec<Outgoing>,
}

/// What follows a piece of work.
#[derive(PartialEq)]
enum Next {
    More,
    Over,
}

impl Worker {
    fn new(shared: Arc<Shared>, spec: &SessionSpec) -> Self {
        Self {
            shared,
            pipeline: Pipeline::new(spec),
            actor_revision: spec.actor_revision,
            mailbox: None,
            state: SessionState::Waiting,
            stale_after_nanos: i64::MAX,
            rate_hz: 1.0,
            last_received_nanos: 0,
            panics: PanicCount::default(),
            judging: JudgingPace::default(),
            outcomes: Vec::new(),
            outgoing: Vec::new(),
        }
    }

    async fn work(&mut self) {
        let mut n_done = 0;
        loop {
            let work = self.shared.intake().pop();
            let next = match work {
                Some(Work::Frame(waiting)) => self.solve(*waiting).await,
                Some(Work::Gaps(gaps)) => {
                    self.pipeline.pass_gaps(gaps, &mut self.outcomes);
                    self.publish();
                    Next::More
                }
                Some(Work::Command(command)) => self.obey(command).await,
                None if self.shared.is_draining() => {
                    return self.shared.hub.close(Closing::Draining);
                }
                None => {
                    self.wait().await;
                    Next::More
                }
            };
            if next == Next::Over {
                return;
            }
            n_done += 1;
            if n_done % WORK_PER_TURN == 0 {
                tokio::task::yield_now().await;
            }
        }
    }

    /// Waits for work; a live session that gets none for too long is stale, and its last samples are judged in time.
    async fn wait(&mut self) {
        let work = self.shared.work.notified();
        let stale_nanos = self
            .last_received_nanos
            .saturating_add(self.stale_after_nanos);
        let stale_nanos = (self.state == SessionState::Live).then_some(stale_nanos);
        let judging_nanos = self.judging.due_nanos();
        let at = |nanos: Option<i64>| -> Instant {
            self.shared.clock.instant_at(nanos.unwrap_or_default())
        };
        tokio::select! {
            () = work => {}
            () = sleep_until(at(stale_nanos)), if stale_nanos.is_some() => {
                self.enter(SessionState::Stale);
            }
            () = sleep_until(at(judging_nanos)), if judging_nanos.is_some() => self.judge(),
        }
    }

    /// Looks at what the performance says of the basis and the neutral face.
    fn judge(&mut self) {
        self.judging.judged(self.shared.clock.now_nanos());
        self.shared.figures().judgement = self.pipeline.judgement();
    }

    async fn solve(&mut self, waiting: WaitingFrame) -> Next {
        let number = waiting.frame.number;
        self.last_received_nanos = waiting.received_nanos;
        let now_nanos = self.shared.clock.now_nanos();
        let step = self.pipeline.push(waiting, now_nanos, &mut self.outcomes);
        if let Step::Progress(progress) = &step {
            self.enter(state_after(*progress));
        }
        self.publish();
        match step {
            Step::Progress(Progress::Aligned) => self.aligned().await,
            Step::Progress(Progress::RecenterFailed) => self.not_recentered(),
            Step::Progress(Progress::ScaleJump) => self.scale_jumped(number),
            Step::Progress(_) | Step::GivenUp => {}
            Step::NotAligned(error) => self.not_aligned(error),
            Step::Panicked => return self.panicked(number).await,
        }
        let now_nanos = self.shared.clock.now_nanos();
        if self.judging.due_nanos().is_some_and(|it| it <= now_nanos) {
            self.judge();
        }
        Next::More
    }

    fn publish(&mut self) {
        let solved_nanos = self.shared.clock.now_nanos();
        let mut passages = VecDeque::new();
        let mut figures = self.shared.figures();
        for outcome in self.outcomes.drain(..) {
            if let Outcome::Sample(sample, note) = &outcome {
                figures.sampled(sample);
                self.judging.sampled();
                if !note.was_collected {
                    passages.push_back((note.received_nanos, note.started_nanos));
                }
            }
            let outgoing = outcome.into_outgoing(solved_nanos, self.actor_revision);
            self.outgoing.push(outgoing);
        }
        drop(figures);
        self.shared.hub.publish(&mut self.outgoing);
        let published_nanos = self.shared.clock.now_nanos();
        let mut figures = self.shared.figures();
        for (received, started) in passages {
            figures.passed(Passage {
                received,
                started,
                solved: solved_nanos,
                published: published_nanos,
            });
        }
    }

    async fn aligned(&mut self) {
        let (Some(alignment), Some(shape)) = (self.pipeline.alignment(), self.pipeline.shape())
        else {
            return;
        };
        self.shared.figures().aligned(alignment);
        tracing::info!(
            n_markers = alignment.n_markers(),
            actor_revision = self.actor_revision,
            "aligned"
        );
        let event = SessionEvent::Aligned {
            id: self.shared.id.clone(),
            run: self.shared.run,
            alignment: Box::new(alignment.clone()),
            shape: shape.clone(),
            actor_revision: self.actor_revision,
        };
        self.shared.intake().note(Recorded::Aligned {
            alignment: Box::new(alignment.clone()),
            shape: shape.clone(),
            actor_revision: self.actor_revision,
        });
        self.judge();
        self.shared.tell(event).await;
    }

    /// The new neutral face could not be aligned; the old one holds on, and the stream goes on.
    fn not_recentered(&mut self) {
        let reason = self.pipeline.recenter_error().map(alignment_problem);
        tracing::info!(reason, "not recentered");
        self.shared.figures().alignment_problem = reason;
    }

    /// The capture's unit has changed: the frame is refused, and after many in a row the publication ends (CONTRACTS D-10).
    fn scale_jumped(&mut self, number: u64) {
        let Some(mailbox) = &self.mailbox else {
            return;
        };
        let times = self.pipeline.scale_jump().unwrap_or_default();
        let mut intake = self.shared.intake();
        let detail = format!(
            "the face is {times:.3} times as large as the neutral one: has the unit changed?"
        );
        let reason = "SCALE_JUMP";
        intake.reject_taken(
            mailbox,
            Rejection {
                number,
                reason,
                detail,
            },
        );
        if self.pipeline.is_giving_up() {
            let n_rejects = MAX_CONSECUTIVE_REJECTS;
            intake.give_up(mailbox, PublishEnd::TooManyRejects { n_rejects });
        }
    }

    fn not_aligned(&mut self, error: AlignmentError) {
        self.enter(SessionState::Waiting);
        let reason = alignment_problem(&error);
        tracing::info!(reason, "not aligned");
        self.shared.figures().alignment_problem = Some(reason);
        if let Some(mailbox) = &self.mailbox {
            let mut intake = self.shared.intake();
            intake.give_up(mailbox, PublishEnd::NotAligned(error));
        }
    }

    async fn alignment_forgotten(&mut self) {
        self.shared.figures().alignment = None;
        self.judge();
        let (id, run) = (self.shared.id.clone(), self.shared.run);
        let event = SessionEvent::AlignmentForgotten { id, run };
        self.shared.tell(event).await;
    }

    async fn panicked(&mut self, number: u64) -> Next {
        if let Some(mailbox) = &self.mailbox {
            mailbox.reject(Rejection {
                number,
                reason: "PANIC",
                detail: "the analysis of this frame broke; the frame is left out".to_owned(),
            });
        }
        if !self.panics.is_too_many(self.shared.clock.now_nanos()) {
            return Next::More;
        }
        fail(&self.shared, "PANIC").await;
        wait_for_the_end(&self.shared).await;
        Next::Over
    }

    async fn obey(&mut self, command: Command) -> Next {
        if self.judging.is_old() {
            // Whoever asks for the status after this command sees all frames before it.
            self.judge();
        }
        match command {
            Command::Source(source) => self.read_from(source).await,
            Command::Finish(mailbox) => mailbox.finish(),
            Command::Record(tap) => self.begin_recording(&tap),
            Command::Recenter { source, done } => {
                let recentered = self.recenter(source).await;
                // Whoever asked may have gone.
                let _gone = done.send(recentered);
            }
            Command::Update {
                settings,
                actor,
                actor_revision,
                done,
            } => {
                let revision_changed = actor_revision != self.actor_revision;
                self.pipeline
                    .update(Arc::clone(&actor), settings.marker.clone());
                self.actor_revision = actor_revision;
                self.shared
                    .figures()
                    .changed(settings, actor, actor_revision);
                self.stale_after_nanos = self.shared.stale_after_nanos(self.rate_hz);
                if revision_changed && self.pipeline.alignment().is_some() {
                    self.aligned().await;
                }
                let _gone = done.send(());
            }
            Command::End => {
                self.pipeline.give_up_awaiting(&mut self.outcomes);
                self.publish();
                end(&self.shared).await;
                return Next::Over;
            }
        }
        Next::More
    }

    /// Tells a recording what its first frame is solved from.
    fn begin_recording(&mut self, tap: &RecordingTap) {
        let settings = self.shared.figures().settings.clone();
        let point = self.pipeline.starting_point(settings, self.actor_revision);
        tap.record(Recorded::StartingPoint(Box::new(point)));
    }

    async fn recenter(&mut self, source: NeutralSource) -> Result<(), QuietestError> {
        match source {
            NeutralSource::NextFrames => {
                self.pipeline.recenter(&mut self.outcomes);
                self.shared.figures().alignment_problem = None;
                if self.pipeline.alignment().is_none() {
                    self.enter(SessionState::Waiting);
                }
                self.publish();
            }
            NeutralSource::QuietestFrames => {
                self.pipeline.recenter_on_quietest()?;
                self.aligned().await;
            }
        }
        Ok(())
    }

    async fn read_from(&mut self, source: Source) {
        self.rate_hz = source.rate_hz;
        self.stale_after_nanos = self.shared.stale_after_nanos(source.rate_hz);
        self.mailbox = Some(source.mailbox);
        let is_lost = self
            .pipeline
            .read_from(source.shape, source.rate_hz, &mut self.outcomes);
        self.publish();
        if is_lost {
            self.enter(SessionState::Waiting);
            self.alignment_forgotten().await;
        }
    }

    fn enter(&mut self, state: SessionState) {
        if self.state != state {
            self.state = state;
            self.shared.hub.announce(state);
        }
    }
}

fn state_after(progress: Progress) -> SessionState {
    match progress {
        Progress::Waiting => SessionState::Waiting,
        Progress::Collecting { .. } => SessionState::Aligning,
        Progress::Aligned | Progress::Solved | Progress::ScaleJump | Progress::RecenterFailed => {
            SessionState::Live
        }
    }
}

/// Why a neutral face could not be aligned, by the identifier of the bad-input table.
pub fn alignment_problem(error: &AlignmentError) -> &'static str {
    match error {
        AlignmentError::UnitsSuspect { .. } => "UNITS_SUSPECT",
        AlignmentError::Mirrored => "MIRRORED",
        AlignmentError::NeutralIncomplete { .. } => "NEUTRAL_INCOMPLETE",
        AlignmentError::Degenerate => "DEGENERATE_POSE",
    }
}
