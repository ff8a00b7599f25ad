//! Which frames of a take are rows of an export, and which numbers between them are missing.

use std::ops::RangeInclusive;

use frontalis_proto::v1::{Gap, GapCause, TakeExport};

/// Gaps that are named one by one, and events that tell their causes.
const MAX_NAMED: usize = 256;

/// The rows of an export.
#[derive(Clone, Debug, Default)]
pub(super) struct Span {
    first: Option<u64>,
    last: u64,
    n_rows: u64,
    n_gaps: u64,
    n_missing: u64,
    gaps: Vec<RangeInclusive<u64>>,
    causes: Vec<Gap>,
}

impl Span {
    /// Adds the next row; numbers grow.
    pub(super) fn add(&mut self, number: u64) {
        if self.first.is_some() && number > self.last + 1 {
            let gap = self.last + 1..=number - 1;
            self.n_gaps += 1;
            self.n_missing += number - 1 - self.last;
            if self.gaps.len() < MAX_NAMED {
                self.gaps.push(gap);
            }
        }
        self.first.get_or_insert(number);
        self.last = number;
        self.n_rows += 1;
    }

    /// Notes what the take says of numbers without samples.
    pub(super) fn explain(&mut self, gap: &Gap) {
        if self.causes.len() < MAX_NAMED {
            self.causes.push(*gap);
        }
    }

    /// First and last row; `None` without rows.
    pub(super) fn ends(&self) -> Option<(u64, u64)> {
        Some((self.first?, self.last))
    }

    pub(super) fn n_rows(&self) -> u64 {
        self.n_rows
    }

    pub(super) fn tell(&self, told: &mut TakeExport) {
        told.first_frame = self.first.unwrap_or(0);
        told.last_frame = self.last;
        told.n_frames = self.n_rows;
        told.n_gaps = self.n_gaps;
        told.n_missing_frames = self.n_missing;
        told.gaps = self.gaps.iter().map(|it| self.named(it)).collect();
    }

    /// A gap with its cause: that of the take's own gap where they meet, else the frames never came.
    fn named(&self, gap: &RangeInclusive<u64>) -> Gap {
        let (first, last) = (*gap.start(), *gap.end());
        let mut causes = self.causes.iter();
        let met = causes.find(|it| it.first <= last && first <= it.last);
        let cause = met.map_or(GapCause::CaptureSkip.into(), |it| it.cause);
        Gap { first, last, cause }
    }
}
