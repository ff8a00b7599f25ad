//! What a take holds, in numbers.

use frontalis_proto::v1;
use prost::Message as _;

use super::channel::Channel;

/// Counts over a take's messages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TakeFigures {
    /// Number of the first frame; 0 without frames.
    pub first_frame: u64,
    /// Number of the last frame.
    pub last_frame: u64,
    /// Frames that were recorded, late ones included.
    pub n_frames: u64,
    /// Samples that were recorded.
    pub n_samples: u64,
}

impl TakeFigures {
    /// Counts a frame.
    pub fn count_frame(&mut self, number: u64) {
        if self.n_frames == 0 {
            self.first_frame = number;
        }
        self.first_frame = self.first_frame.min(number);
        self.last_frame = self.last_frame.max(number);
        self.n_frames += 1;
    }

    /// Counts a message of a file.
    pub fn count(&mut self, channel: Channel, data: &[u8]) {
        match channel {
            Channel::Markers => {
                if let Ok(frame) = v1::MarkerFrame::decode(data) {
                    self.count_frame(frame.number);
                }
            }
            Channel::Curves => self.n_samples += 1,
            Channel::Events => {}
        }
    }
}
