//! Writes down one session: what came in from its intake, what went out from its hub.

use std::{sync::Arc, time::Duration};

use frontalis_proto::v1::take_event::Event;
use tokio::time::timeout;

use super::{events, open_take::OpenTake};
use crate::{
    clock::ServerClock,
    hub::{Delivered, Gap, GapCause, SessionState, Subscription, Update},
    session::{Recorded, RecordingFeed},
    wire::curve::{SampleDetail, gap_to_wire, sample_to_wire, state_to_wire},
};

/// After the last frame came in, so long without a sample ends a take whose frames are not all solved.
const LAST_SAMPLES: Duration = Duration::from_secs(2);

/// What is kept of every sample.
pub(super) const DETAIL: SampleDetail = SampleDetail {
    with_uncertainty: true,
    with_markers: false,
};

/// One take's writer.
pub(super) struct Scribe {
    pub(super) take: Arc<OpenTake>,
    pub(super) feed: RecordingFeed,
    /// Of the take, its pre-roll included.
    pub(super) first_frame: u64,
    pub(super) samples: Subscription,
    pub(super) clock: ServerClock,
    /// Told after everything that was added.
    pub(super) dirty: Arc<tokio::sync::Notify>,
    pub(super) progress: Progress,
}

/// How far a take has been written.
#[derive(Debug, Default)]
pub(super) struct Progress {
    /// Last frame that came in and was not late.
    last_frame: u64,
    /// Last frame that a sample or a gap answers for.
    solved_through: u64,
    state: Option<SessionState>,
}

/// Whether more may come.
#[derive(PartialEq)]
enum Next {
    More,
    Over,
}

impl Scribe {
    /// Writes until the recording is over and all of its frames are answered for.
    pub(super) async fn run(&mut self) {
        for frame in std::mem::take(&mut self.feed.pre_roll) {
            let time_nanos = unix_nanos(&self.clock, frame.received_nanos);
            self.take.add_frame(&frame, time_nanos);
        }
        loop {
            tokio::select! {
                biased;
                recorded = self.feed.next() => match recorded {
                    Some(recorded) => self.write(&recorded),
                    None => break,
                },
                delivered = self.samples.next() => {
                    if self.take_delivered(delivered) == Next::Over {
                        break;
                    }
                }
            }
            self.dirty.notify_one();
        }
        // What came in while the hub closed.
        while let Some(recorded) = self.feed.next_now() {
            self.write(&recorded);
        }
        self.write_last_samples().await;
        self.dirty.notify_one();
    }

    /// Frames that were taken before the end are still solved.
    async fn write_last_samples(&mut self) {
        while self.progress.solved_through < self.progress.last_frame {
            let Ok(delivered) = timeout(LAST_SAMPLES, self.samples.next()).await else {
                return;
            };
            if self.take_delivered(delivered) == Next::Over {
                return;
            }
        }
    }

    fn now(&self) -> u64 {
        unix_nanos(&self.clock, self.clock.now_nanos())
    }

    fn write(&mut self, recorded: &Recorded) {
        if let Recorded::Frame(frame) = recorded {
            let time_nanos = unix_nanos(&self.clock, frame.received_nanos);
            if !frame.is_late {
                self.progress.last_frame = frame.number;
            }
            return self.take.add_frame(frame, time_nanos);
        }
        if let Some(event) = events::recorded(recorded, self.clock.unix_offset_nanos()) {
            self.take.add_event(event, self.now());
        }
    }

    fn take_delivered(&mut self, delivered: Delivered) -> Next {
        match delivered {
            Delivered::Update(update) => {
                self.write_update(&update);
                Next::More
            }
            Delivered::Lagged(lost) => {
                let gap = Gap {
                    first: lost.first_frame,
                    last: lost.last_frame,
                    cause: GapCause::Shed,
                };
                self.take
                    .add_event(Event::Gap(gap_to_wire(&gap)), self.now());
                Next::Over
            }
            Delivered::Closed(_) => Next::Over,
        }
    }

    /// Only what belongs to recorded frames: samples of frames before them may still be on their way.
    fn write_update(&mut self, update: &Update) {
        let (first, now) = (self.first_frame, self.now());
        let mut gaps = update.gaps.iter().filter(|it| it.last >= first).peekable();
        for sample in &update.samples {
            let number = sample.sample.frame.0;
            // In the order of their frames: whoever reads from a sample on finds the gaps before it there.
            while let Some(gap) = gaps.next_if(|it| it.last < number) {
                self.write_gap(gap, now);
            }
            if number >= first {
                self.progress.solved_through = self.progress.solved_through.max(number);
                self.take.add_sample(&sample_to_wire(sample, DETAIL), now);
            }
        }
        for gap in gaps {
            self.write_gap(gap, now);
        }
        if let Some(state) = update.state {
            // The same state again is a sign of life and no change.
            if self.progress.state.replace(state.session_state) != Some(state.session_state) {
                self.take
                    .add_event(Event::State(state_to_wire(&state)), now);
            }
        }
    }

    fn write_gap(&mut self, gap: &Gap, now: u64) {
        self.progress.solved_through = self.progress.solved_through.max(gap.last);
        self.take.add_event(Event::Gap(gap_to_wire(gap)), now);
    }
}

/// A reading of the server's clock as Unix time.
pub(super) fn unix_nanos(clock: &ServerClock, reading_nanos: i64) -> u64 {
    let unix = reading_nanos.saturating_add(clock.unix_offset_nanos());
    u64::try_from(unix).unwrap_or(0)
}
