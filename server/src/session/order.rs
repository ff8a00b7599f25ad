//! Which frame numbers are new, sent again, late, or impossible, and which were skipped.
//!
//! Numbers strictly increase in a run (CONTRACTS D-1). A frame that is sent again has no effect twice (D-6), the same
//! number with other content is a conflict (D-7), a number that was passed is late (D-11), and every skipped span gives
//! one gap a cause (D-4). Pure: times are handed in.

use std::collections::VecDeque;

use crate::hub::{Gap, GapCause};

/// Largest step between two numbers; a larger one is a mistake, not a gap (bad input A22).
const MAX_JUMP: u64 = 1 << 32;
/// Most frames that are recognized when they are sent again, whatever the rate.
const MAX_RECENT_FRAMES: usize = 1 << 16;
/// Most separate spans of rejected numbers that are remembered until a frame beyond them is accepted; a hundred rejects
/// in a row end a publication, so only a hostile publisher gets here, and then the rest count as skipped.
const MAX_REJECTED_SPANS: usize = 1_024;

/// What a frame's number and content say about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Not seen before, and beyond all that was accepted.
    New,
    /// Accepted before, with this content.
    Duplicate,
    /// Accepted before, with other content.
    Conflict,
    /// Passed by a larger number, or accepted too long ago to know.
    Late,
    /// Too far beyond the last.
    Jump,
}

#[derive(Clone, Copy, Debug)]
struct RecentFrame {
    number: u64,
    content_hash: u64,
    received_nanos: i64,
}

/// The order of one run's frames.
#[derive(Debug)]
pub(super) struct FrameOrder {
    span_nanos: i64,
    last_accepted: Option<u64>,
    recent: VecDeque<RecentFrame>,
    /// Spans beyond `last_accepted`, ascending and apart.
    rejected: Vec<(u64, u64)>,
    skip_cause: GapCause,
}

impl FrameOrder {
    /// The order of a run without frames; resent frames are recognized for `span_nanos`.
    pub(super) fn new(span_nanos: i64) -> Self {
        Self {
            span_nanos,
            last_accepted: None,
            recent: VecDeque::new(),
            rejected: Vec::new(),
            skip_cause: GapCause::CaptureSkip,
        }
    }

    /// Largest accepted number; 0 before the first.
    pub(super) fn accepted_through(&self) -> u64 {
        self.last_accepted.unwrap_or(0)
    }

    /// First number that is not there; 0 in a run without frames.
    pub(super) fn next_expected(&self) -> u64 {
        self.last_accepted.map_or(0, |it| it.saturating_add(1))
    }

    /// Numbers skipped before the next accepted frame are this publisher's change, not the capture system's.
    pub(super) fn publisher_changed(&mut self) {
        self.skip_cause = GapCause::PublisherChange;
    }

    pub(super) fn judge(&self, number: u64, content_hash: u64) -> Verdict {
        // Numbers count from 1, and the wire refuses 0; nothing can come before the first.
        if number == 0 {
            return Verdict::Late;
        }
        let Some(last) = self.last_accepted else {
            return Verdict::New;
        };
        match number.checked_sub(last) {
            None | Some(0) => self.judge_passed(number, content_hash),
            Some(step) if step > MAX_JUMP => Verdict::Jump,
            Some(_) => Verdict::New,
        }
    }

    fn judge_passed(&self, number: u64, content_hash: u64) -> Verdict {
        let found = self.recent.binary_search_by_key(&number, |it| it.number);
        match found.ok().and_then(|idx| self.recent.get(idx)) {
            None => Verdict::Late,
            Some(recent) if recent.content_hash == content_hash => Verdict::Duplicate,
            Some(_) => Verdict::Conflict,
        }
    }

    /// Takes a frame that was judged [`Verdict::New`]; returns the gaps before it, in order.
    pub(super) fn accept(&mut self, number: u64, content_hash: u64, now_nanos: i64) -> Vec<Gap> {
        let gaps = self.gaps_before(number);
        self.rejected.retain_mut(|(first, last)| {
            *first = (*first).max(number.saturating_add(1));
            *first <= *last
        });
        self.last_accepted = Some(number);
        self.skip_cause = GapCause::CaptureSkip;
        self.recent.push_back(RecentFrame {
            number,
            content_hash,
            received_nanos: now_nanos,
        });
        self.forget_old(now_nanos);
        gaps
    }

    fn forget_old(&mut self, now_nanos: i64) {
        let is_old = |it: &RecentFrame| now_nanos - it.received_nanos > self.span_nanos;
        while self.recent.len() > MAX_RECENT_FRAMES || self.recent.front().is_some_and(is_old) {
            self.recent.pop_front();
        }
    }

    /// The numbers between the last accepted and `number`. Before the first accepted frame only rejected ones count:
    /// a run may begin anywhere.
    fn gaps_before(&self, number: u64) -> Vec<Gap> {
        let mut gaps = Vec::new();
        let mut next = self.last_accepted.map(|it| it + 1);
        let below = self.rejected.iter().filter(|(first, _)| *first < number);
        for &(first, last) in below {
            self.skip(next, first, &mut gaps);
            let last = last.min(number - 1);
            gaps.push(Gap {
                first,
                last,
                cause: GapCause::Rejected,
            });
            next = next.map(|_| last + 1);
        }
        self.skip(next, number, &mut gaps);
        gaps
    }

    fn skip(&self, from: Option<u64>, before: u64, gaps: &mut Vec<Gap>) {
        if let Some(first) = from.filter(|first| *first < before) {
            gaps.push(Gap {
                first,
                last: before - 1,
                cause: self.skip_cause,
            });
        }
    }

    /// Remembers a number that was sent and not used, so that its gap says so.
    pub(super) fn reject(&mut self, number: u64) {
        let last_accepted = self.last_accepted.unwrap_or(0);
        let step = number.saturating_sub(last_accepted);
        if step == 0 || (self.last_accepted.is_some() && step > MAX_JUMP) {
            return;
        }
        let after = self.rejected.partition_point(|(first, _)| *first <= number);
        let previous = after
            .checked_sub(1)
            .and_then(|it| self.rejected.get_mut(it));
        if let Some((_, last)) = previous.filter(|(_, last)| last.saturating_add(1) >= number) {
            *last = (*last).max(number);
        } else if self.rejected.len() < MAX_REJECTED_SPANS {
            self.rejected.insert(after, (number, number));
        }
        self.join_spans();
    }

    fn join_spans(&mut self) {
        self.rejected.dedup_by(|next, span| {
            let touches = span.1.saturating_add(1) >= next.0;
            if touches {
                span.1 = span.1.max(next.1);
            }
            touches
        });
    }

    /// The rejected numbers after the last accepted one, when nothing can follow them any more.
    pub(super) fn finish(&mut self) -> Vec<Gap> {
        let cause = GapCause::Rejected;
        let gap = |(first, last)| Gap { first, last, cause };
        self.rejected.drain(..).map(gap).collect()
    }
}

#[cfg(test)]
mod tests;
