//! Sets of frame numbers as ranges, in the order they were met.

/// Ranges kept apart at most; past it the last range is stretched, so that a report may say too much but never too little.
const MAX_RANGES: usize = 1_024;

/// Inclusive ranges of frame numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameRanges {
    pairs: Vec<(u64, u64)>,
    n_frames: u64,
}

impl FrameRanges {
    /// Adds one frame.
    pub fn add(&mut self, number: u64) {
        self.n_frames += 1;
        self.stretch(number, number);
    }

    /// Moves everything from `other` into this set.
    pub fn append(&mut self, other: &mut Self) {
        self.n_frames += std::mem::take(&mut other.n_frames);
        for (first, last) in other.pairs.drain(..) {
            self.stretch(first, last);
        }
    }

    fn stretch(&mut self, first: u64, last: u64) {
        let is_full = self.pairs.len() >= MAX_RANGES;
        match self.pairs.last_mut() {
            Some(pair) if pair.1.checked_add(1) == Some(first) || is_full => {
                pair.0 = pair.0.min(first);
                pair.1 = pair.1.max(last);
            }
            _ => self.pairs.push((first, last)),
        }
    }

    /// Takes out the frames up to `number`; returns how many.
    pub fn remove_through(&mut self, number: u64) -> u64 {
        let before = self.n_frames;
        self.pairs.retain_mut(|pair| {
            if pair.1 <= number {
                self.n_frames = self.n_frames.saturating_sub(pair.1 - pair.0 + 1);
                return false;
            }
            if pair.0 <= number {
                self.n_frames = self.n_frames.saturating_sub(number - pair.0 + 1);
                pair.0 = number + 1;
            }
            true
        });
        before - self.n_frames
    }

    /// First and last of each range.
    pub fn as_pairs(&self) -> &[(u64, u64)] {
        &self.pairs
    }

    /// Frames in all.
    pub fn n_frames(&self) -> u64 {
        self.n_frames
    }

    /// Whether no frame is in it.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

impl std::fmt::Display for FrameRanges {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, (first, last)) in self.pairs.iter().enumerate() {
            let separator = if index == 0 { "" } else { ", " };
            if first == last {
                write!(f, "{separator}{first}")?;
            } else {
                write!(f, "{separator}{first}-{last}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_join_and_holes_stay() {
        let mut ranges = FrameRanges::default();
        for number in [1, 2, 3, 7, 8, 10] {
            ranges.add(number);
        }
        assert_eq!(ranges.to_string(), "1-3, 7-8, 10");
        assert_eq!(ranges.remove_through(7), 4);
        assert_eq!(ranges.to_string(), "8, 10");
        assert_eq!(ranges.n_frames(), 2);
    }

    #[test]
    fn many_holes_take_bounded_memory_and_hide_nothing() {
        let mut ranges = FrameRanges::default();
        (0..5_000).for_each(|it| ranges.add(it * 2));
        assert_eq!(ranges.as_pairs().len(), MAX_RANGES);
        assert_eq!(ranges.as_pairs().last().unwrap().1, 9_998);
        assert_eq!(ranges.n_frames(), 5_000);
    }
}
