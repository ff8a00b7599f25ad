//! What a recorded session knows of frames whose numbers were passed too long ago for its memory (CONTRACTS D-6, D-6a).
//!
//! Whether such a frame is in the take, the take's file tells. Frames that came late stand in it anywhere, so those are
//! remembered here, as many as fit.

use std::collections::BTreeMap;

/// Late frames of one take that are remembered, the ones with the largest numbers; what is sent again of others is late again.
const MAX_LATE_FRAMES: usize = 4_096;

/// What is known of a frame whose number was passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// It is none of the take's.
    Never,
    /// It came late, with content of this hash.
    Late(u64),
    /// The take may have it.
    Unknown,
}

/// Frames of one take whose numbers were passed.
#[derive(Debug, Default)]
pub(super) struct PassedFrames {
    /// First number that the take can have in order.
    first: u64,
    /// Hashes of frames that came late, by number.
    late: BTreeMap<u64, u64>,
}

impl PassedFrames {
    /// Of a take that begins with frame `first`.
    pub(super) fn from(first: u64) -> Self {
        Self {
            first,
            late: BTreeMap::new(),
        }
    }

    pub(super) fn find(&self, number: u64) -> Found {
        match self.late.get(&number) {
            Some(hash) => Found::Late(*hash),
            None if number < self.first => Found::Never,
            None => Found::Unknown,
        }
    }

    /// Notes a frame that came late; the first of its number stands.
    pub(super) fn came_late(&mut self, number: u64, content_hash: u64) {
        self.late.entry(number).or_insert(content_hash);
        if self.late.len() > MAX_LATE_FRAMES {
            self.late.pop_first();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_before_the_take_were_never_in_it_and_late_ones_are_known() {
        let mut passed = PassedFrames::from(100);
        assert_eq!(passed.find(99), Found::Never);
        assert_eq!(passed.find(100), Found::Unknown);
        passed.came_late(50, 7);
        passed.came_late(50, 8);
        assert_eq!(passed.find(50), Found::Late(7));
    }

    #[test]
    fn no_more_late_frames_are_remembered_than_the_limit() {
        let mut passed = PassedFrames::from(1);
        for number in 1..=2 * MAX_LATE_FRAMES as u64 {
            passed.came_late(number, number);
        }
        assert_eq!(passed.late.len(), MAX_LATE_FRAMES);
        assert_eq!(passed.find(1), Found::Unknown);
    }
}
