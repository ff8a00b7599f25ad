//! How far a take under way is on stable storage, and what stands where in its file.
//!
//! Whoever reads a take while it is recorded reads only what was committed. Marks say what stands where, every so many
//! bytes, so that a sample or a frame from long ago is found without reading all before it (CONTRACTS D-6a, D-17).

use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

/// Bytes between two marks, at first.
const MARK_EVERY_BYTES: u64 = 64 << 10;

/// Most marks of one take: half a gigabyte of it. When there are more, every second one goes, and they stand twice as far
/// apart: 192 KiB of memory at most, however long the take.
const MAX_MARKS: usize = 8_192;

/// What was written before a place of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Written {
    /// The largest frame number.
    pub(super) frames_through: u64,
    /// The sample after the last; 0 before the first.
    pub(super) next_sample: u64,
    /// The first sample, and its frame.
    pub(super) first_sample: Option<(u64, u64)>,
}

impl Written {
    pub(super) fn add_frame(&mut self, number: u64) {
        self.frames_through = self.frames_through.max(number);
    }

    pub(super) fn add_sample(&mut self, sequence: u64, frame: u64) {
        self.next_sample = sequence.saturating_add(1);
        self.first_sample.get_or_insert((sequence, frame));
    }
}

#[derive(Clone, Copy, Debug)]
struct Mark {
    offset: u64,
    frames_through: u64,
    next_sample: u64,
}

/// How far one take is on stable storage. Shared by who writes it and those who read it.
#[derive(Debug)]
pub struct Growth {
    run: u64,
    grown: Mutex<Grown>,
    /// Changes with every commit.
    commits: watch::Sender<u64>,
}

#[derive(Debug)]
struct Grown {
    n_bytes: u64,
    written: Written,
    marks: Vec<Mark>,
    mark_every_bytes: u64,
    is_over: bool,
}

/// What a reader has to know of a take under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Committed {
    /// Length of the file that is on stable storage.
    pub n_bytes: u64,
    /// Whether nothing will follow.
    pub is_over: bool,
}

impl Growth {
    /// A take of a session's run whose file has `n_bytes`, a head and nothing else.
    pub(super) fn new(run: u64, n_bytes: u64) -> Self {
        let first = Mark {
            offset: n_bytes,
            frames_through: 0,
            next_sample: 0,
        };
        Self {
            run,
            grown: Mutex::new(Grown {
                n_bytes,
                written: Written::default(),
                marks: vec![first],
                mark_every_bytes: MARK_EVERY_BYTES,
                is_over: false,
            }),
            commits: watch::Sender::new(0),
        }
    }

    /// The run that is recorded.
    pub fn run(&self) -> u64 {
        self.run
    }

    /// How much can be read.
    pub fn committed(&self) -> Committed {
        let grown = self.grown();
        Committed {
            n_bytes: grown.n_bytes,
            is_over: grown.is_over,
        }
    }

    /// The first sample that can be read, and its frame.
    pub fn first_sample(&self) -> Option<(u64, u64)> {
        self.grown().written.first_sample
    }

    /// Wakes whoever waits for more; see [`watch::Receiver::changed`].
    pub fn watch(&self) -> watch::Receiver<u64> {
        self.commits.subscribe()
    }

    /// A commit of `n_bytes` is on stable storage: before it `before` had been written, with it `through`.
    pub(super) fn commit(&self, n_bytes: u64, before: Written, through: Written) {
        let mut grown = self.grown();
        grown.mark(before);
        grown.n_bytes += n_bytes;
        grown.written = through;
        drop(grown);
        self.commits.send_modify(|it| *it += 1);
    }

    /// Nothing follows.
    pub(super) fn end(&self) {
        self.grown().is_over = true;
        self.commits.send_modify(|it| *it += 1);
    }

    /// A place at which a commit starts, before that of sample `sequence`, with the sample before it where there is one.
    pub(super) fn before_sample(&self, sequence: u64) -> u64 {
        let grown = self.grown();
        let after = grown.marks.partition_point(|it| it.next_sample < sequence);
        grown.marks[after.saturating_sub(1)].offset
    }

    /// From where to where frame `number` stands, unless it came late.
    pub(super) fn around_frame(&self, number: u64) -> (u64, u64) {
        let grown = self.grown();
        let after = grown.marks.partition_point(|it| it.frames_through < number);
        let start = grown.marks[after.saturating_sub(1)].offset;
        (
            start,
            grown.marks.get(after).map_or(grown.n_bytes, |it| it.offset),
        )
    }

    fn grown(&self) -> MutexGuard<'_, Grown> {
        self.grown.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Grown {
    /// Notes what stands before the commit that begins where the file ends.
    fn mark(&mut self, before: Written) {
        let last = self.marks.last().map_or(0, |it| it.offset);
        if self.n_bytes - last < self.mark_every_bytes {
            return;
        }
        if self.marks.len() == MAX_MARKS {
            let mut idx = 0;
            self.marks.retain(|_| {
                idx += 1;
                idx % 2 == 1
            });
            self.mark_every_bytes *= 2;
        }
        self.marks.push(Mark {
            offset: self.n_bytes,
            frames_through: before.frames_through,
            next_sample: before.next_sample,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COMMIT_BYTES: u64 = 48 << 10;

    /// A take of one frame and one sample a commit; samples begin at 101.
    fn growth(n_commits: u64) -> Growth {
        let growth = Growth::new(1, 1_000);
        let mut written = Written::default();
        for number in 1..=n_commits {
            let before = written;
            written.add_frame(number);
            written.add_sample(100 + number, number);
            growth.commit(COMMIT_BYTES, before, written);
        }
        growth
    }

    /// Where the commit of frame `number` starts.
    fn start_of(number: u64) -> u64 {
        1_000 + (number - 1) * COMMIT_BYTES
    }

    #[test]
    fn every_frame_and_sample_lies_behind_its_mark_and_not_far() {
        for n_commits in [1, 10, 3 * MAX_MARKS as u64] {
            let growth = growth(n_commits);
            let spacing = growth.grown().mark_every_bytes + COMMIT_BYTES;
            assert!(growth.grown().marks.len() <= MAX_MARKS);
            for number in (1..=n_commits).step_by(7) {
                let (start, end) = growth.around_frame(number);
                assert!(start <= start_of(number) && start_of(number) < end);
                assert!(end - start <= 2 * spacing, "{}", end - start);
                let sample = growth.before_sample(100 + number);
                assert!(sample <= start_of(number.max(2) - 1));
                assert!(start_of(number) - sample <= 2 * spacing + COMMIT_BYTES);
            }
        }
    }

    #[test]
    fn the_last_mark_reaches_to_the_end_of_what_is_committed() {
        let growth = growth(3);
        assert_eq!(growth.around_frame(99).1, start_of(4));
        assert_eq!(growth.first_sample(), Some((101, 1)));
        growth.end();
        let expected = Committed {
            n_bytes: start_of(4),
            is_over: true,
        };
        assert_eq!(growth.committed(), expected);
    }
}
