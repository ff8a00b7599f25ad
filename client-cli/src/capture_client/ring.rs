//! The frames that a publisher has not seen acknowledged, kept for the next connection.
//!
//! CONTRACTS D-9: bounded in time and bytes; what falls out unacknowledged is reported as a gap, never hidden.
//! Pure: knows no network and no clock.

use std::collections::VecDeque;

use crate::proto::MarkerFrame;

use super::ranges::FrameRanges;

/// Bytes of a frame beside its coordinates: number, times, lengths.
const FRAME_OVERHEAD_BYTES: usize = 64;

/// How much a ring holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RingLimits {
    /// Frames: ten seconds at the declared rate.
    pub frames: usize,
    /// Bytes of coordinates and their frames' overhead: 64 MiB.
    pub bytes: usize,
}

impl RingLimits {
    /// Ten seconds at `rate_hz`, at least 64 frames, and 64 MiB.
    pub fn for_rate(rate_hz: f64) -> Self {
        let frames = (rate_hz * 10.0).ceil().clamp(64.0, 100_000.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to 64..=100,000 above; NaN becomes 0 and then one frame"
        )]
        let frames = (frames as usize).max(1);
        Self {
            frames,
            bytes: 64 << 20,
        }
    }
}

/// Sent frames that a watermark covered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settled {
    /// The server took them.
    pub accepted: u64,
    /// The session had frames of these numbers before this publication began.
    pub known: u64,
}

/// Unacknowledged frames in the order they were handed in.
#[derive(Debug)]
pub struct UnackedRing {
    limits: RingLimits,
    frames: VecDeque<MarkerFrame>,
    bytes: usize,
    /// Frames from the front that went out on the present connection.
    sent_here: usize,
    /// Frames from the front that went out on any connection.
    sent_ever: usize,
    /// Fell out after they were sent: the next watermark tells whether the server has them.
    doubtful: FrameRanges,
    lost: FrameRanges,
}

impl UnackedRing {
    /// An empty ring.
    pub fn new(limits: RingLimits) -> Self {
        Self {
            limits,
            frames: VecDeque::new(),
            bytes: 0,
            sent_here: 0,
            sent_ever: 0,
            doubtful: FrameRanges::default(),
            lost: FrameRanges::default(),
        }
    }

    /// Whether `frame` fits without pushing another out.
    pub fn has_room_for(&self, frame: &MarkerFrame) -> bool {
        self.frames.is_empty()
            || (self.frames.len() < self.limits.frames
                && self.bytes + size_bytes(frame) <= self.limits.bytes)
    }

    /// Keeps `frame`; the oldest fall out when there is no room.
    pub fn push(&mut self, frame: MarkerFrame) {
        while !self.has_room_for(&frame) {
            self.drop_oldest();
        }
        self.bytes += size_bytes(&frame);
        self.frames.push_back(frame);
    }

    fn drop_oldest(&mut self) {
        let was_sent = self.sent_ever > 0;
        if let Some(frame) = self.pop_front() {
            if was_sent {
                self.doubtful.add(frame.number);
            } else {
                self.lost.add(frame.number);
            }
        }
    }

    fn pop_front(&mut self) -> Option<MarkerFrame> {
        let frame = self.frames.pop_front()?;
        self.bytes -= size_bytes(&frame);
        self.sent_here = self.sent_here.saturating_sub(1);
        self.sent_ever = self.sent_ever.saturating_sub(1);
        Some(frame)
    }

    /// The server has every usable frame up to `number`, and had those below `known_below` before.
    pub fn settle_through(&mut self, number: u64, known_below: u64) -> Settled {
        let mut settled = Settled {
            accepted: self.doubtful.remove_through(number),
            known: 0,
        };
        while self.sent_ever > 0
            && let Some(first) = self.frames.front().map(|it| it.number)
            && first <= number
        {
            self.pop_front();
            if first < known_below {
                settled.known += 1;
            } else {
                settled.accepted += 1;
            }
        }
        settled
    }

    /// The server refused frame `number`; returns whether it was still here.
    pub fn settle_rejected(&mut self, number: u64) -> bool {
        let sent = self.sent_ever;
        let found = self
            .frames
            .iter()
            .take(sent)
            .position(|it| it.number == number);
        let Some(index) = found else {
            return false;
        };
        if let Some(frame) = self.frames.remove(index) {
            self.bytes -= size_bytes(&frame);
        }
        self.sent_ever -= 1;
        if index < self.sent_here {
            self.sent_here -= 1;
        }
        true
    }

    /// A new connection: everything that is still here goes out again, and what fell out unacknowledged is lost.
    pub fn start_connection(&mut self) {
        self.sent_here = 0;
        self.lost.append(&mut self.doubtful);
    }

    /// The next frames for this connection, within both limits but at least one; empty when all went out.
    pub fn next_batch(&mut self, max_frames: usize, max_bytes: usize) -> Vec<MarkerFrame> {
        let mut bytes = 0;
        let batch: Vec<_> = self
            .frames
            .iter()
            .skip(self.sent_here)
            .take(max_frames)
            .take_while(|it| {
                let is_first = bytes == 0;
                bytes += size_bytes(it);
                is_first || bytes <= max_bytes
            })
            .cloned()
            .collect();
        self.sent_here += batch.len();
        self.sent_ever = self.sent_ever.max(self.sent_here);
        batch
    }

    /// Whether frames wait for this connection.
    pub fn has_unsent(&self) -> bool {
        self.sent_here < self.frames.len()
    }

    /// Frames sent on an earlier connection and not yet on this one.
    pub fn to_resend(&self) -> usize {
        self.sent_ever - self.sent_here
    }

    /// Frames that are neither acknowledged nor refused.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether every frame is settled.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Frames that never reached the server.
    pub fn lost(&self) -> &FrameRanges {
        &self.lost
    }
}

fn size_bytes(frame: &MarkerFrame) -> usize {
    FRAME_OVERHEAD_BYTES + frame.positions.len() * size_of::<f32>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u64) -> MarkerFrame {
        MarkerFrame {
            number,
            positions: vec![0.0; 81],
            ..MarkerFrame::default()
        }
    }

    fn ring_of(limit_frames: usize, numbers: std::ops::RangeInclusive<u64>) -> UnackedRing {
        let mut ring = UnackedRing::new(RingLimits {
            frames: limit_frames,
            bytes: 64 << 20,
        });
        numbers.for_each(|it| ring.push(frame(it)));
        ring
    }

    fn numbers(frames: &[MarkerFrame]) -> Vec<u64> {
        frames.iter().map(|it| it.number).collect()
    }

    /// CONTRACTS D-9.
    #[test]
    fn frames_that_fall_out_unsent_are_a_reported_gap() {
        let ring = ring_of(10, 1..=15);
        assert_eq!(ring.len(), 10);
        assert_eq!(ring.lost().as_pairs(), [(1, 5)]);
        assert_eq!(ring.lost().n_frames(), 5);
    }

    /// CONTRACTS D-9.
    #[test]
    fn the_byte_limit_holds_too() {
        let mut ring = UnackedRing::new(RingLimits {
            frames: 1_000,
            bytes: 10 * size_bytes(&frame(1)),
        });
        (1..=12).for_each(|it| ring.push(frame(it)));
        assert_eq!(ring.len(), 10);
        assert_eq!(ring.lost().as_pairs(), [(1, 2)]);
    }

    #[test]
    fn a_frame_that_fell_out_after_it_was_sent_is_lost_only_if_the_server_has_not_got_it() {
        let mut ring = ring_of(4, 1..=4);
        ring.next_batch(256, 1 << 20);
        (5..=7).for_each(|it| ring.push(frame(it)));
        assert_eq!(ring.lost().n_frames(), 0);
        // The server had 1 and 2 when the connection broke.
        assert_eq!(ring.settle_through(2, 0).accepted, 2);
        ring.start_connection();
        assert_eq!(ring.lost().as_pairs(), [(3, 3)]);
        assert_eq!(numbers(&ring.next_batch(256, 1 << 20)), [4, 5, 6, 7]);
    }

    #[test]
    fn a_new_connection_sends_what_was_not_acknowledged_again() {
        let mut ring = ring_of(100, 1..=6);
        assert_eq!(numbers(&ring.next_batch(4, 1 << 20)), [1, 2, 3, 4]);
        ring.settle_through(2, 0);
        ring.start_connection();
        assert_eq!(ring.to_resend(), 2);
        assert_eq!(numbers(&ring.next_batch(256, 1 << 20)), [3, 4, 5, 6]);
        assert!(!ring.has_unsent());
    }

    #[test]
    fn a_watermark_does_not_settle_what_was_never_sent() {
        let mut ring = ring_of(100, 1..=3);
        assert_eq!(ring.settle_through(300, 0), Settled::default());
        assert_eq!(ring.len(), 3);
    }

    #[test]
    fn frames_of_numbers_that_the_session_had_before_are_counted_apart() {
        let mut ring = ring_of(100, 1..=5);
        ring.next_batch(256, 1 << 20);
        let expected = Settled {
            accepted: 2,
            known: 3,
        };
        assert_eq!(ring.settle_through(5, 4), expected);
    }

    #[test]
    fn a_refused_frame_is_not_sent_again() {
        let mut ring = ring_of(100, 1..=4);
        ring.next_batch(256, 1 << 20);
        assert!(ring.settle_rejected(2));
        assert!(!ring.settle_rejected(2));
        ring.start_connection();
        assert_eq!(numbers(&ring.next_batch(256, 1 << 20)), [1, 3, 4]);
    }

    #[test]
    fn batches_keep_both_limits_but_always_move() {
        let mut ring = ring_of(100, 1..=5);
        let two = 2 * size_bytes(&frame(1));
        assert_eq!(ring.next_batch(256, two).len(), 2);
        assert_eq!(ring.next_batch(256, 1).len(), 1);
        assert_eq!(ring.next_batch(1, two).len(), 1);
    }
}
