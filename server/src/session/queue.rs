//! Work that waits for a session's solver, in order.
//!
//! Bounded in frames, bytes and commands (CONTRACTS O-1). When live ingest finds it full, the oldest waiting frame is
//! shed and leaves its gap in its place (O-4, O-5).

use std::collections::VecDeque;

use super::{command::Command, frame::IncomingFrame};
use crate::hub::{BufferBudget, Gap, GapCause};

/// Most commands that wait.
pub(super) const MAX_WAITING_COMMANDS: usize = 64;

/// One thing to do.
#[derive(Debug)]
pub(super) enum Work {
    /// Solve a frame.
    Frame(Box<WaitingFrame>),
    /// Tell subscribers of numbers without samples.
    Gaps(Vec<Gap>),
    /// Something that happens between two frames.
    Command(Command),
}

/// An accepted frame.
#[derive(Debug)]
pub(super) struct WaitingFrame {
    pub(super) frame: IncomingFrame,
    /// Numbers without frames just before it.
    pub(super) gaps_before: Vec<Gap>,
    pub(super) received_nanos: i64,
}

/// The queue of one session.
#[derive(Debug)]
pub(super) struct WorkQueue {
    work: VecDeque<Work>,
    n_frames: usize,
    n_commands: usize,
    bytes: usize,
    max_frames: usize,
    max_bytes: usize,
    budget: BufferBudget,
}

impl WorkQueue {
    pub(super) fn new(max_frames: usize, max_bytes: usize, budget: BufferBudget) -> Self {
        Self {
            work: VecDeque::new(),
            n_frames: 0,
            n_commands: 0,
            bytes: 0,
            max_frames,
            max_bytes,
            budget,
        }
    }

    /// Whether a frame of `cost_bytes` fits. The first one always does, whatever other sessions hold.
    pub(super) fn has_room(&self, cost_bytes: usize) -> bool {
        self.n_frames == 0
            || (self.n_frames < self.max_frames
                && self.bytes + cost_bytes <= self.max_bytes
                && !self.budget.is_exceeded())
    }

    pub(super) fn has_room_for_a_command(&self) -> bool {
        self.n_commands < MAX_WAITING_COMMANDS
    }

    pub(super) fn push_frame(&mut self, waiting: WaitingFrame) {
        let cost_bytes = waiting.frame.cost_bytes();
        self.bytes += cost_bytes;
        self.budget.charge(cost_bytes);
        self.n_frames += 1;
        self.work.push_back(Work::Frame(Box::new(waiting)));
    }

    pub(super) fn push_gaps(&mut self, gaps: Vec<Gap>) {
        if !gaps.is_empty() {
            self.work.push_back(Work::Gaps(gaps));
        }
    }

    pub(super) fn push_command(&mut self, command: Command) {
        self.n_commands += 1;
        self.work.push_back(Work::Command(command));
    }

    pub(super) fn pop(&mut self) -> Option<Work> {
        let work = self.work.pop_front()?;
        match &work {
            Work::Frame(waiting) => self.note_taken(waiting.frame.cost_bytes()),
            Work::Command(_) => self.n_commands -= 1,
            Work::Gaps(_) => {}
        }
        Some(work)
    }

    fn note_taken(&mut self, cost_bytes: usize) {
        self.n_frames -= 1;
        self.bytes -= cost_bytes;
        self.budget.release(cost_bytes);
    }

    /// Turns the oldest waiting frame into a gap; `false` when none waits.
    pub(super) fn shed_oldest(&mut self) -> bool {
        let is_frame = |it: &Work| matches!(it, Work::Frame(_));
        let Some(place) = self.work.iter().position(is_frame) else {
            return false;
        };
        self.replace_by_gap(place, GapCause::Shed);
        true
    }

    /// The gap joins the gaps just before it, so that the queue does not grow by shedding.
    fn replace_by_gap(&mut self, place: usize, cause: GapCause) {
        let Some(Work::Frame(waiting)) = self.work.get(place) else {
            return;
        };
        let cost_bytes = waiting.frame.cost_bytes();
        let number = waiting.frame.number;
        let gaps_before = waiting.gaps_before.clone();
        self.note_taken(cost_bytes);
        let before = place.checked_sub(1);
        let joined = before.and_then(|it| self.work.get_mut(it));
        let lost = gaps_before
            .into_iter()
            .chain([Gap::of_frame(number, cause)]);
        if let Some(Work::Gaps(gaps)) = joined {
            lost.for_each(|gap| gap.append_to(gaps));
            self.work.remove(place);
        } else {
            let mut gaps = Vec::new();
            lost.for_each(|gap| gap.append_to(&mut gaps));
            self.work[place] = Work::Gaps(gaps);
        }
    }
}

impl Drop for WorkQueue {
    fn drop(&mut self) {
        self.budget.release(self.bytes);
    }
}

#[cfg(test)]
mod tests;
