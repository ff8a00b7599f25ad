//! What was seen of a run of publisher, server and subscriber, and whether it keeps the contract.
//!
//! The checker knows nothing of how the parts work: only what each of them saw, and what the storage holds in the end.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt,
};

/// Everything that was seen, in order.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Frames that were handed to the publisher, with a hash of their content.
    pub sent: BTreeMap<u64, u64>,
    /// What the server acknowledged, as the publisher heard it.
    pub acknowledged: Vec<Acknowledged>,
    /// Frames of which the publisher has no answer in the end, or lost.
    pub unanswered: u64,
    /// What the subscriber heard.
    pub heard: Vec<Heard>,
    /// What the storage holds.
    pub takes: Vec<TakeSeen>,
}

/// One answer to the publisher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Acknowledged {
    /// The session's run.
    pub run: u64,
    /// Every frame up to this one is with the server.
    pub accepted_through: u64,
    /// Whether the session was being recorded.
    pub recording: bool,
    /// Every frame up to this one is on stable storage, as far as it was recorded.
    pub durable_through: u64,
}

/// One thing that a subscriber to every frame heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heard {
    /// First of every connection.
    Header {
        /// The session's run.
        run: u64,
    },
    /// A sample.
    Sample(SampleSeen),
    /// Frames without samples, both ends included.
    Gap {
        /// First of them.
        first: u64,
        /// Last of them.
        last: u64,
    },
    /// Sequences that the client says it has lost, both ends included.
    Lost {
        /// First of them.
        first: u64,
        /// Last of them.
        last: u64,
    },
    /// The session ended.
    End,
}

/// A sample, wherever it was seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleSeen {
    /// Its place among the samples of its run.
    pub sequence: u64,
    /// Its frame.
    pub frame: u64,
    /// Of its activations.
    pub hash: u64,
}

/// What a take holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TakeSeen {
    /// The session's run.
    pub run: u64,
    /// First frame that it can hold.
    pub next_frame: u64,
    /// Numbers and hashes of its frames, in order.
    pub frames: Vec<(u64, u64)>,
    /// Its samples, in order.
    pub samples: Vec<SampleSeen>,
}

/// A sentence of the contract that was broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Violation {
    /// A frame was acknowledged as durable and is in no take (U-1).
    DurableFrameLost {
        /// The session's run.
        run: u64,
        /// The frame.
        frame: u64,
    },
    /// A take holds a frame twice, or frames out of order (D-1, D-6).
    FrameDisorder {
        /// The frame that should not be where it is.
        frame: u64,
    },
    /// A take holds a frame that was not sent, or not with this content (D-7).
    FrameChanged {
        /// The frame.
        frame: u64,
    },
    /// More is durable than was accepted, or a watermark went back (D-5).
    Watermark {
        /// The session's run.
        run: u64,
    },
    /// Sequences have a hole, or one came twice (D-2, D-17).
    SequenceBroken {
        /// What was expected.
        expected: u64,
        /// What came.
        found: u64,
    },
    /// Samples are not in the order of their frames (D-3).
    SampleDisorder {
        /// The later sample's frame.
        frame: u64,
    },
    /// Frames are missing between two samples without a word (D-4).
    SilentAbsence {
        /// The first of them.
        frame: u64,
    },
    /// What a subscriber heard and what the take holds differ (U-3).
    SampleDiffers {
        /// Its sequence.
        sequence: u64,
    },
    /// A recorded sample never reached a subscriber to every frame (D-17, D-18).
    RecordedSampleMissed {
        /// The session's run.
        run: u64,
        /// The sample.
        sequence: u64,
    },
    /// Frames were never answered (D-8).
    Unanswered {
        /// How many.
        n_frames: u64,
    },
    /// The subscriber did not hear of the last frame (D-17).
    EndMissing {
        /// The last frame that was sent.
        frame: u64,
    },
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

impl History {
    /// Every sentence that was broken, in no particular order.
    pub fn violations(&self) -> Vec<Violation> {
        let mut found = Vec::new();
        self.check_takes(&mut found);
        self.check_acknowledged(&mut found);
        self.check_heard(&mut found);
        if self.unanswered > 0 {
            found.push(Violation::Unanswered {
                n_frames: self.unanswered,
            });
        }
        found
    }

    fn check_takes(&self, found: &mut Vec<Violation>) {
        for take in &self.takes {
            let mut last = 0;
            for &(frame, hash) in &take.frames {
                if frame <= last {
                    found.push(Violation::FrameDisorder { frame });
                }
                if self.sent.get(&frame) != Some(&hash) {
                    found.push(Violation::FrameChanged { frame });
                }
                last = last.max(frame);
            }
        }
    }

    fn check_acknowledged(&self, found: &mut Vec<Violation>) {
        let mut before: Option<Acknowledged> = None;
        // Frames that the publisher gave up while nothing was recorded are nobody's promise.
        let mut given_up_through = 0;
        let mut lost = BTreeSet::new();
        for &now in &self.acknowledged {
            let same_run = before.filter(|it| it.run == now.run);
            let went_back = same_run.is_some_and(|it| {
                it.accepted_through > now.accepted_through
                    || it.durable_through > now.durable_through
            });
            if went_back || now.durable_through > now.accepted_through {
                found.push(Violation::Watermark { run: now.run });
            }
            let before_take = if now.recording {
                lost.extend(self.lost(&now, given_up_through));
                self.first_of_takes(now.run) - 1
            } else {
                u64::MAX
            };
            given_up_through = given_up_through.max(before_take.min(now.accepted_through));
            before = Some(now);
        }
        found.extend(lost);
    }

    /// Durable frames that are in no take.
    fn lost(&self, now: &Acknowledged, given_up_through: u64) -> Vec<Violation> {
        let run = now.run;
        let promised = self.first_of_takes(run).max(given_up_through + 1)..=now.durable_through;
        if promised.is_empty() {
            return Vec::new();
        }
        let held: BTreeSet<u64> = self
            .takes
            .iter()
            .flat_map(|it| &it.frames)
            .map(|it| it.0)
            .collect();
        let sent = self.sent.range(promised).map(|it| *it.0);
        let lost = sent.filter(|it| !held.contains(it));
        lost.map(|frame| Violation::DurableFrameLost { run, frame })
            .collect()
    }

    /// The first frame that a take of this run can hold.
    fn first_of_takes(&self, run: u64) -> u64 {
        let of_run = self.takes.iter().filter(|it| it.run == run);
        of_run.map(|it| it.next_frame).min().unwrap_or(1)
    }

    fn check_heard(&self, found: &mut Vec<Violation>) {
        let mut listener = Listener::default();
        let mut through = 0;
        let mut samples = BTreeSet::new();
        for heard in &self.heard {
            listener.hear(*heard, found);
            // The last frame may belong to a run before the last.
            through = listener.frame.max(through);
            if let Heard::Sample(sample) = heard {
                samples.insert((listener.run, sample.sequence));
                self.compare(listener.run, sample, found);
            }
        }
        self.check_recorded(&samples, found);
        let last = self.sent.keys().next_back().copied().unwrap_or_default();
        if !listener.has_ended || through < last {
            found.push(Violation::EndMissing { frame: last });
        }
    }

    /// Whoever began to listen hears all that was recorded from there on, whatever was cut meanwhile.
    fn check_recorded(&self, heard: &BTreeSet<(u64, u64)>, found: &mut Vec<Violation>) {
        let recorded = self.takes.iter().flat_map(|take| {
            let run = take.run;
            take.samples.iter().map(move |it| (run, it.sequence))
        });
        let begun = heard.first().copied().unwrap_or((u64::MAX, 0));
        let missed = recorded.filter(|it| *it > begun && !heard.contains(it));
        found.extend(
            missed.map(|(run, sequence)| Violation::RecordedSampleMissed { run, sequence }),
        );
    }

    fn compare(&self, run: u64, heard: &SampleSeen, found: &mut Vec<Violation>) {
        let of_run = self.takes.iter().filter(|it| it.run == run);
        let mut recorded = of_run.flat_map(|it| &it.samples);
        let same = recorded.find(|it| it.sequence == heard.sequence);
        if same.is_some_and(|it| it != heard) {
            found.push(Violation::SampleDiffers {
                sequence: heard.sequence,
            });
        }
    }
}

/// What a subscriber knows while it listens.
#[derive(Default)]
struct Listener {
    run: u64,
    /// Of the last sample, or of what the client says it has lost.
    sequence: u64,
    /// Last frame that a sample or a gap answered for.
    frame: u64,
    /// Whether frames may be missing up to the next sample: the client said that it lost some, or the run began.
    may_skip: bool,
    has_ended: bool,
}

impl Listener {
    fn hear(&mut self, heard: Heard, found: &mut Vec<Violation>) {
        match heard {
            Heard::Header { run } if run == self.run => {}
            Heard::Header { run } => {
                *self = Self {
                    run,
                    may_skip: true,
                    ..Self::default()
                };
            }
            Heard::Lost { first, last } => {
                self.expect(first, found);
                self.sequence = last;
                self.may_skip = true;
            }
            Heard::Gap { first, last } => {
                // Gaps before the place of a new subscription are repeated.
                if first <= self.frame + 1 || self.may_skip {
                    self.frame = self.frame.max(last);
                }
            }
            Heard::Sample(sample) => self.hear_sample(sample, found),
            Heard::End => self.has_ended = true,
        }
    }

    fn hear_sample(&mut self, sample: SampleSeen, found: &mut Vec<Violation>) {
        self.expect(sample.sequence, found);
        if sample.frame <= self.frame {
            found.push(Violation::SampleDisorder {
                frame: sample.frame,
            });
        } else if sample.frame > self.frame + 1 && !self.may_skip {
            found.push(Violation::SilentAbsence {
                frame: self.frame + 1,
            });
        }
        self.sequence = sample.sequence;
        self.frame = sample.frame;
        self.may_skip = false;
    }

    fn expect(&self, sequence: u64, found: &mut Vec<Violation>) {
        let expected = self.sequence + 1;
        if sequence != expected {
            found.push(Violation::SequenceBroken {
                expected,
                found: sequence,
            });
        }
    }
}
