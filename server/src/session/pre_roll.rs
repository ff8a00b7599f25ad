//! The frames that came last, for a recording that is to begin before it was asked for.

use std::collections::VecDeque;

use super::recording::RecordedFrame;
use crate::hub::BufferBudget;

/// Frames that are kept, whatever their rate.
const MAX_FRAMES: usize = 4_096;

/// Bytes that are kept of one session.
pub const MAX_BYTES: usize = 4 << 20;

/// Frames in the order in which they were taken; the oldest go first.
#[derive(Debug)]
pub(super) struct PreRoll {
    frames: VecDeque<RecordedFrame>,
    bytes: usize,
    span_nanos: i64,
    budget: BufferBudget,
}

impl PreRoll {
    /// Keeps the frames of the last `span_nanos`, as far as `budget` lasts.
    pub(super) fn new(span_nanos: i64, budget: BufferBudget) -> Self {
        Self {
            frames: VecDeque::new(),
            bytes: 0,
            span_nanos,
            budget,
        }
    }

    pub(super) fn push(&mut self, frame: RecordedFrame) {
        let oldest = frame.received_nanos.saturating_sub(self.span_nanos);
        let bytes = cost_bytes(&frame);
        self.bytes += bytes;
        self.budget.charge(bytes);
        self.frames.push_back(frame);
        let is_old = |it: &RecordedFrame| it.received_nanos < oldest;
        while self.frames.len() > MAX_FRAMES
            || self.bytes > MAX_BYTES
            || self.frames.front().is_some_and(is_old)
            || (self.budget.is_exceeded() && !self.frames.is_empty())
        {
            self.drop_oldest();
        }
    }

    fn drop_oldest(&mut self) {
        if let Some(oldest) = self.frames.pop_front() {
            let bytes = cost_bytes(&oldest);
            self.bytes -= bytes;
            self.budget.release(bytes);
        }
    }

    /// Forgets all of them: those that follow are read in another way.
    pub(super) fn clear(&mut self) {
        while !self.frames.is_empty() {
            self.drop_oldest();
        }
    }

    /// Those that were taken at `since_nanos` or later.
    pub(super) fn since(&self, since_nanos: i64) -> Vec<RecordedFrame> {
        let frames = self.frames.iter();
        let wanted = frames.skip_while(|it| it.received_nanos < since_nanos);
        wanted.cloned().collect()
    }
}

impl Drop for PreRoll {
    fn drop(&mut self) {
        self.budget.release(self.bytes);
    }
}

fn cost_bytes(frame: &RecordedFrame) -> usize {
    size_of::<RecordedFrame>() + frame.sent.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: i64 = 1_000_000_000;

    fn frame(number: u64) -> RecordedFrame {
        RecordedFrame {
            number,
            received_nanos: i64::try_from(number).unwrap() * SECOND,
            timecode: None,
            sent: bytes::Bytes::from_static(&[0; 100]),
            is_late: false,
        }
    }

    #[test]
    fn the_last_seconds_are_kept_and_given_from_a_moment_on() {
        let budget = BufferBudget::new(1 << 20);
        let mut pre_roll = PreRoll::new(10 * SECOND, budget.clone());
        (1..=30).for_each(|it| pre_roll.push(frame(it)));
        let numbers = |since| -> Vec<u64> {
            let frames = pre_roll.since(since).into_iter();
            frames.map(|it| it.number).collect()
        };
        assert_eq!(numbers(0), (20..=30).collect::<Vec<_>>());
        assert_eq!(numbers(28 * SECOND), [28, 29, 30]);
        drop(pre_roll);
        assert_eq!(budget.used_bytes(), 0);
    }

    #[test]
    fn nothing_is_kept_where_the_memory_of_all_sessions_is_used() {
        let mut pre_roll = PreRoll::new(10 * SECOND, BufferBudget::new(1));
        pre_roll.push(frame(1));
        assert!(pre_roll.since(0).is_empty());
    }
}
