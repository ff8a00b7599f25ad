//! The part of a run that is kept in memory (CONTRACTS D-17, D-18).
//!
//! Keeps the larger of a span of time and a number of samples, within a limit of bytes; the oldest go first.
//! Samples are numbered from 1 without holes; gaps stand between them, each before the sample that followed it.
//! A gap that goes on is one entry until a reader has passed it (D-4); what was read is never changed.

use std::{collections::VecDeque, sync::Arc};

use super::{
    budget::BufferBudget,
    sample::{Gap, PublishedSample},
};

/// How much is kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct WindowLimits {
    pub(super) span_nanos: i64,
    pub(super) entries: usize,
    pub(super) bytes: usize,
}

#[derive(Clone, Debug)]
pub(super) enum Entry {
    Sample(Arc<PublishedSample>),
    Gap(Gap),
}

impl Entry {
    fn first_frame(&self) -> u64 {
        match self {
            Self::Sample(sample) => sample.sample.frame.0,
            Self::Gap(gap) => gap.first,
        }
    }

    pub(super) fn last_frame(&self) -> u64 {
        match self {
            Self::Sample(sample) => sample.sample.frame.0,
            Self::Gap(gap) => gap.last,
        }
    }
}

#[derive(Debug)]
struct Kept {
    entry: Entry,
    /// Of the sample itself, or of the one that follows the gap.
    sequence: u64,
    time_nanos: i64,
    cost_bytes: usize,
}

/// Where a reader stands. Positions count entries since the run began.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    pub(super) position: u64,
    /// The next sample's sequence.
    pub(super) sequence: u64,
    /// The last frame number that the reader knows about.
    pub(super) last_frame: u64,
}

impl Cursor {
    /// Before everything that was ever kept, for a reader of sample `sequence` that knows all frames through `last_frame`.
    pub(super) fn before_all(sequence: u64, last_frame: u64) -> Self {
        Self {
            position: 0,
            sequence,
            last_frame,
        }
    }
}

/// What a reader missed, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostRange {
    /// First lost sample.
    pub first_sequence: u64,
    /// Last lost sample; one less than the first when only gaps were lost.
    pub last_sequence: u64,
    /// First lost frame number.
    pub first_frame: u64,
    /// Last lost frame number.
    pub last_frame: u64,
}

/// A position that cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RangeError {
    /// The position counts in another run.
    #[error("the session is in run {current}, the position is in run {wanted}")]
    NewRun {
        /// The run asked for.
        wanted: u64,
        /// The run that is kept.
        current: u64,
    },
    /// No such sample is kept, nor is it the next.
    #[error(
        "sample {wanted} is not kept: the first available is {first_available}, the last {last_available}"
    )]
    NotKept {
        /// The sequence asked for.
        wanted: u64,
        /// The oldest that can be read; one more than the last when there is none.
        first_available: u64,
        /// The newest; 0 before the first.
        last_available: u64,
    },
}

#[derive(Debug)]
pub(super) struct Window {
    entries: VecDeque<Kept>,
    /// Position of the oldest entry.
    base: u64,
    /// Position before which some reader may have read.
    read_through: u64,
    next_sequence: u64,
    n_samples: usize,
    bytes: usize,
    limits: WindowLimits,
    budget: BufferBudget,
}

impl Window {
    pub(super) fn new(limits: WindowLimits, budget: BufferBudget) -> Self {
        Self {
            entries: VecDeque::new(),
            base: 0,
            read_through: 0,
            next_sequence: 1,
            n_samples: 0,
            bytes: 0,
            limits,
            budget,
        }
    }

    pub(super) fn next_sequence(&self) -> u64 {
        self.next_sequence
    }

    pub(super) fn newest_sequence(&self) -> u64 {
        self.next_sequence - 1
    }

    /// Oldest sample kept; the next one to come when none is.
    pub(super) fn first_sequence(&self) -> u64 {
        self.next_sequence - self.n_samples as u64
    }

    pub(super) fn push_sample(&mut self, sample: Arc<PublishedSample>, now_nanos: i64) {
        let cost_bytes = sample.cost_bytes();
        let sequence = self.next_sequence;
        self.next_sequence += 1;
        self.n_samples += 1;
        self.push(Entry::Sample(sample), sequence, cost_bytes, now_nanos);
    }

    pub(super) fn push_gap(&mut self, gap: Gap, now_nanos: i64) {
        if !self.extend_newest(gap, now_nanos) {
            self.push(Entry::Gap(gap), self.next_sequence, 0, now_nanos);
        }
    }

    /// Lets the newest entry go on with `gap`, when it is the same gap and no reader stands behind it.
    fn extend_newest(&mut self, gap: Gap, now_nanos: i64) -> bool {
        let end = self.base + self.entries.len() as u64;
        let newest = self.entries.back_mut().filter(|_| self.read_through < end);
        let Some(kept) = newest else {
            return false;
        };
        match &mut kept.entry {
            Entry::Gap(last) if last.is_continued_by(&gap) => {
                last.last = gap.last;
                kept.time_nanos = now_nanos;
                true
            }
            _ => false,
        }
    }

    /// Notes where a reader stands: what lies before its cursor stays as it is.
    pub(super) fn reader_at(&mut self, cursor: &Cursor) {
        self.read_through = self.read_through.max(cursor.position);
    }

    fn push(&mut self, entry: Entry, sequence: u64, content_bytes: usize, time_nanos: i64) {
        let cost_bytes = content_bytes + size_of::<Kept>();
        self.bytes += cost_bytes;
        self.budget.charge(cost_bytes);
        self.entries.push_back(Kept {
            entry,
            sequence,
            time_nanos,
            cost_bytes,
        });
        while self.oldest_must_go(time_nanos) {
            self.forget_oldest();
        }
    }

    fn oldest_must_go(&self, now_nanos: i64) -> bool {
        let Some(oldest) = self.entries.front() else {
            return false;
        };
        let n_gaps = self.entries.len() - self.n_samples;
        let past_count = self.n_samples.max(n_gaps) > self.limits.entries;
        let past_span = now_nanos.saturating_sub(oldest.time_nanos) > self.limits.span_nanos;
        // The newest entry always stays: it is what a subscriber that keeps up reads next.
        let past_memory = self.bytes > self.limits.bytes || self.budget.is_exceeded();
        (past_count && past_span) || (past_memory && self.entries.len() > 1)
    }

    fn forget_oldest(&mut self) {
        if let Some(oldest) = self.entries.pop_front() {
            self.base += 1;
            self.bytes -= oldest.cost_bytes;
            self.budget.release(oldest.cost_bytes);
            self.n_samples -= usize::from(matches!(oldest.entry, Entry::Sample(_)));
        }
    }

    /// Before the gaps that stand before sample `sequence`, or past the end when it is the next to come.
    pub(super) fn seek(&self, sequence: u64) -> Result<Cursor, RangeError> {
        let (first, next) = (self.first_sequence(), self.next_sequence);
        if sequence < first || sequence > next {
            return Err(RangeError::NotKept {
                wanted: sequence,
                first_available: first,
                last_available: self.newest_sequence(),
            });
        }
        let offset = self.entries.partition_point(|it| it.sequence < sequence);
        Ok(self.cursor_at(offset))
    }

    /// At sample `sequence`, behind the gaps before it that a reader of all through `last_frame` has read elsewhere.
    pub(super) fn seek_after(&self, sequence: u64, last_frame: u64) -> Result<Cursor, RangeError> {
        let mut cursor = self.seek(sequence)?;
        let is_known = |it: &&Entry| matches!(it, Entry::Gap(gap) if gap.last <= last_frame);
        let n_known = self
            .read(&cursor)
            .map_or(0, |entries| entries.take_while(is_known).count());
        cursor.position += n_known as u64;
        cursor.last_frame = cursor.last_frame.max(last_frame);
        Ok(cursor)
    }

    /// Before everything that is kept.
    pub(super) fn oldest(&self) -> Cursor {
        self.cursor_at(0)
    }

    /// Just before the newest sample.
    pub(super) fn newest(&self) -> Cursor {
        let is_sample = |it: &Kept| matches!(it.entry, Entry::Sample(_));
        let offset = self.entries.iter().rposition(is_sample);
        self.cursor_at(offset.unwrap_or(self.entries.len()))
    }

    fn cursor_at(&self, offset: usize) -> Cursor {
        let kept = self.entries.get(offset);
        let before = offset.checked_sub(1).and_then(|it| self.entries.get(it));
        let last_frame = match (before, kept) {
            (Some(before), _) => before.entry.last_frame(),
            (None, Some(kept)) => kept.entry.first_frame().saturating_sub(1),
            (None, None) => 0,
        };
        Cursor {
            position: self.base + offset as u64,
            sequence: kept.map_or(self.next_sequence, |it| it.sequence),
            last_frame,
        }
    }

    /// The entries from `cursor` on, or what was lost between it and the oldest that is kept.
    pub(super) fn read(&self, cursor: &Cursor) -> Result<impl Iterator<Item = &Entry>, LostRange> {
        let Some(offset) = cursor.position.checked_sub(self.base) else {
            let oldest_frame = self.entries.front().map(|it| it.entry.first_frame());
            return Err(LostRange {
                first_sequence: cursor.sequence,
                last_sequence: self.first_sequence() - 1,
                first_frame: cursor.last_frame.saturating_add(1),
                last_frame: oldest_frame.map_or(cursor.last_frame, |it| it.saturating_sub(1)),
            });
        };
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let kept = self.entries.range(offset.min(self.entries.len())..);
        Ok(kept.map(|it| &it.entry))
    }

    /// Everything from `cursor` on, kept or not; none when nothing is.
    pub(super) fn behind(&self, cursor: &Cursor) -> Option<LostRange> {
        let end = self.base + self.entries.len() as u64;
        let newest = self.entries.back().filter(|_| cursor.position < end)?;
        Some(LostRange {
            first_sequence: cursor.sequence,
            last_sequence: self.newest_sequence(),
            first_frame: cursor.last_frame.saturating_add(1),
            last_frame: newest.entry.last_frame(),
        })
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        self.budget.release(self.bytes);
    }
}
