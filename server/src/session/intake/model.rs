//! Two publishers, one session, every order of claims, grants, frames, commits, lapses and crashes (CONTRACTS G7).
//!
//! The door itself is driven, not a copy of its rules: all states that it can be in are visited, each by the shortest way
//! there, and after every step the record is looked at. The same search is made of a door that does not look at epochs,
//! and has to find it out.

use std::{
    collections::{BTreeSet, VecDeque},
    sync::Arc,
};

use frontalis_analysis::space::LengthUnit;

use super::*;
use crate::{
    clock::ServerClock,
    hub::SampleTag,
    name::PublisherId,
    session::{
        frame::IncomingFrame,
        publication::{Claim, Grant, Ingest},
        settings::StreamShape,
    },
};

/// Lives of a lease.
const TIMEOUT: Duration = Duration::from_secs(10);

/// States are told apart by how far counters lie from each other, up to this.
const FAR: u64 = 2;

/// No state is further than so many steps from the start; the search ends by itself before.
const MAX_STEPS: usize = 64;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Who {
    Stage,
    Rig,
}

use Who::{Rig, Stage};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// Asks for the session; the number of its grant is made durable.
    Claim { who: Who, takeover: bool },
    /// The grant that was asked for is put in force.
    Grant(Who),
    /// Sends the next frame over its stream, if it has one.
    Send(Who),
    /// Gives the session back.
    Release(Who),
    /// No sign of life for longer than a lease lives.
    Lapse,
    /// What was taken is flushed, then acknowledged as durable.
    Commit,
    /// The process dies and another starts.
    Crash,
}

const STEPS: [Step; 13] = [
    Step::Claim {
        who: Stage,
        takeover: false,
    },
    Step::Claim {
        who: Stage,
        takeover: true,
    },
    Step::Claim {
        who: Rig,
        takeover: false,
    },
    Step::Claim {
        who: Rig,
        takeover: true,
    },
    Step::Grant(Stage),
    Step::Grant(Rig),
    Step::Send(Stage),
    Step::Send(Rig),
    Step::Release(Stage),
    Step::Release(Rig),
    Step::Lapse,
    Step::Commit,
    Step::Crash,
];

/// One line of the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Line {
    /// Grant in force when it was written.
    in_force: u64,
    /// Grant of whoever sent the frame.
    sender: u64,
    number: u64,
}

struct World {
    intake: Intake,
    feed: RecordingFeed,
    clock: ServerClock,
    now_nanos: i64,
    /// Grants that the catalogue has given numbers to; it outlives a crash.
    n_epochs: u64,
    asked: [Option<Grant>; 2],
    streams: [Option<Arc<Mailbox>>; 2],
    granted: Vec<u64>,
    in_force: u64,
    record: Vec<Line>,
    n_flushed: usize,
    forgets_epochs: bool,
}

impl World {
    fn new(forgets_epochs: bool) -> Self {
        let mut intake = intake(forgets_epochs);
        Self {
            feed: intake.record(None).unwrap(),
            intake,
            clock: ServerClock::start(std::time::UNIX_EPOCH),
            now_nanos: 0,
            n_epochs: 0,
            asked: [None, None],
            streams: [None, None],
            granted: Vec::new(),
            in_force: 0,
            record: Vec::new(),
            n_flushed: 0,
            forgets_epochs,
        }
    }

    fn after(path: &[Step], forgets_epochs: bool) -> Self {
        let mut world = Self::new(forgets_epochs);
        for step in path {
            world.step(*step);
        }
        world
    }

    fn step(&mut self, step: Step) {
        match step {
            Step::Claim { who, takeover } => self.claim(who, takeover),
            Step::Grant(who) => self.grant(who),
            Step::Send(who) => self.send(who),
            Step::Release(who) => {
                if let Some(stream) = self.streams[who as usize].take() {
                    self.intake.release(&stream);
                }
            }
            Step::Lapse => self.now_nanos += nanos(TIMEOUT) + 1,
            Step::Commit => {
                self.n_flushed = self.record.len();
                if let Some(last) = self.record.last() {
                    self.intake.set_durable_through(last.number);
                }
            }
            Step::Crash => self.crash(),
        }
        while self.intake.pop().is_some() {}
        self.read_feed();
    }

    fn claim(&mut self, who: Who, takeover: bool) {
        let claim = Claim {
            publisher: PublisherId::parse(name(who)).unwrap(),
            principal: Arc::from("studio"),
            takeover,
            outranks: false,
        };
        if self.intake.check_claim(&claim, self.now_nanos).is_ok() {
            self.n_epochs += 1;
            self.asked[who as usize] = Some(Grant {
                claim,
                epoch: self.n_epochs,
                unit: LengthUnit::Centimeter,
                marker_names: Vec::new(),
                ingest: Ingest::Lossless,
                rate_hz: 60.0,
            });
        }
    }

    fn grant(&mut self, who: Who) {
        let Some(grant) = self.asked[who as usize].take() else {
            return;
        };
        let shape = StreamShape {
            unit: grant.unit,
            marker_names: Vec::new(),
        };
        if let Ok(stream) = self.intake.grant(&grant, shape, self.now_nanos) {
            self.streams[who as usize] = Some(stream);
            self.granted.push(grant.epoch);
        }
    }

    fn send(&mut self, who: Who) {
        let Some(stream) = self.streams[who as usize].clone() else {
            return;
        };
        let frame = IncomingFrame {
            number: self.intake.accepted_through() + 1,
            capture_time_nanos: 0,
            positions: Vec::new(),
            tag: SampleTag::default(),
            content_hash: stream.epoch(),
            n_partial_markers: 0,
            sent: stream.epoch().to_le_bytes().to_vec().into(),
        };
        let offered = self
            .intake
            .offer(&stream, frame, &self.clock, self.now_nanos);
        if offered.is_err() {
            self.streams[who as usize] = None;
        }
    }

    /// What was not flushed is gone, and so is every stream.
    fn crash(&mut self) {
        self.record.truncate(self.n_flushed);
        self.intake = intake(self.forgets_epochs);
        self.feed = self.intake.record(None).unwrap();
        self.asked = [None, None];
        self.streams = [None, None];
    }

    fn read_feed(&mut self) {
        while let Some(recorded) = self.feed.next_now() {
            match recorded {
                Recorded::Source(source) => self.in_force = source.epoch,
                Recorded::Frame(frame) => self.record.push(Line {
                    in_force: self.in_force,
                    sender: u64::from_le_bytes(frame.sent[..].try_into().unwrap()),
                    number: frame.number,
                }),
                _ => {}
            }
        }
    }

    /// The sentence that is broken, if one is.
    fn violation(&self) -> Option<&'static str> {
        let epochs_grow = self.granted.is_sorted_by(|a, b| a < b);
        let only_in_force = self.record.iter().all(|it| it.sender == it.in_force);
        let in_order = self.record.is_sorted_by(|a, b| a.in_force <= b.in_force);
        let open = self.streams.iter().flatten();
        let n_open = open.filter(|it| it.ended().is_none()).count();
        let flushed = self.record[..self.n_flushed].last();
        let durable_through = self.intake.durable_through();
        let is_flushed = durable_through <= flushed.map_or(0, |it| it.number);
        [
            (epochs_grow, "grants never repeat (D-30)"),
            (only_in_force, "a fenced publisher has no effect (D-29)"),
            (in_order, "the record has one order of grants (D-28)"),
            (n_open <= 1, "one stream is open (D-28)"),
            (is_flushed, "durable is what was flushed (U-1)"),
            (
                durable_through <= self.intake.accepted_through(),
                "durable is what was accepted (D-5)",
            ),
        ]
        .into_iter()
        .find_map(|(holds, sentence)| (!holds).then_some(sentence))
    }

    /// What its future depends on: who has and asked for what, in which order, but not how often.
    fn shape(&self) -> Vec<u64> {
        let stream = |who: Who| self.streams[who as usize].as_ref();
        let asked = |who: Who| self.asked[who as usize].as_ref();
        let lease = self.intake.lease.as_ref();
        let epochs = [
            Some(self.n_epochs),
            Some(self.intake.newest_epoch),
            Some(self.in_force),
            lease.map(|it| it.mailbox.epoch()),
            stream(Stage).map(|it| it.epoch()),
            stream(Rig).map(|it| it.epoch()),
            asked(Stage).map(|it| it.epoch),
            asked(Rig).map(|it| it.epoch),
        ];
        let known: BTreeSet<u64> = epochs.iter().flatten().copied().collect();
        let rank = |epoch: u64| known.range(..=epoch).count() as u64;
        let mut shape: Vec<u64> = epochs.iter().map(|it| it.map_or(0, rank)).collect();
        let has_lapsed = lease.is_some_and(|it| it.expires_nanos <= self.now_nanos);
        let is_ended = |who| stream(who).is_some_and(|it| it.ended().is_some());
        let takes_over = |who| asked(who).is_some_and(|it| it.claim.takeover);
        let flags = [
            has_lapsed,
            is_ended(Stage),
            is_ended(Rig),
            takes_over(Stage),
            takes_over(Rig),
        ];
        shape.extend(flags.map(u64::from));
        let n_unflushed = (self.record.len() - self.n_flushed) as u64;
        let accepted = self.intake.accepted_through();
        let behind = accepted - self.intake.durable_through().min(accepted);
        shape.extend([accepted, n_unflushed, behind].map(|it| it.min(FAR)));
        let owner = self.intake.last_owner.as_ref();
        shape.push(owner.map_or(0, |it| 1 + u64::from(it.publisher.to_string() == name(Rig))));
        shape
    }
}

fn name(who: Who) -> &'static str {
    match who {
        Stage => "stage",
        Rig => "rig",
    }
}

fn intake(forgets_epochs: bool) -> Intake {
    let limits = IntakeLimits {
        waiting_frames: 8,
        waiting_bytes: 1 << 20,
        live_rate_hz: 250.0,
        resend_span: Duration::from_secs(1),
        budget: BufferBudget::new(1 << 20),
    };
    let mut intake = Intake::new(limits, TIMEOUT, 0);
    intake.forgets_epochs = forgets_epochs;
    intake
}

/// Every state; or the shortest way to one in which a sentence is broken.
fn search(forgets_epochs: bool) -> Result<usize, (&'static str, Vec<Step>)> {
    let mut seen = BTreeSet::from([World::new(forgets_epochs).shape()]);
    let mut open = VecDeque::from([Vec::new()]);
    while let Some(path) = open.pop_front() {
        assert!(path.len() < MAX_STEPS, "the states do not end");
        for step in STEPS {
            let mut next = path.clone();
            next.push(step);
            let world = World::after(&next, forgets_epochs);
            if let Some(sentence) = world.violation() {
                return Err((sentence, next));
            }
            if seen.insert(world.shape()) {
                open.push_back(next);
            }
        }
    }
    Ok(seen.len())
}

#[test]
fn in_every_state_one_publisher_has_effect_and_durable_is_what_was_flushed() {
    let n_states = search(false).unwrap();
    println!(
        "{n_states} states, each left by {} steps, no violation",
        STEPS.len()
    );
    assert!(n_states > 1_000, "{n_states}");
}

#[test]
fn a_door_that_does_not_look_at_epochs_is_found_out() {
    let (sentence, path) = search(true).unwrap_err();
    println!("{sentence}, after {path:?}");
    assert!(
        sentence.contains("D-29") || sentence.contains("D-28"),
        "{sentence}"
    );
}
