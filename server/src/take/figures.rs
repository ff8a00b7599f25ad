//! What a take holds, in numbers.

use frontalis_analysis::timecode::Timecode;
use frontalis_proto::v1;
use prost::Message as _;

use super::channel::Channel;
use crate::wire::common;

/// Number and timecode of a `MarkerFrame` and of a `CurveSample`, which both have them as these fields: all else is passed
/// over.
#[derive(Clone, PartialEq, prost::Message)]
pub(super) struct Numbered {
    #[prost(uint64, tag = "1")]
    pub(super) number: u64,
    #[prost(message, optional, tag = "3")]
    pub(super) timecode: Option<v1::Timecode>,
}

/// Counts over a take's messages.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TakeFigures {
    /// Number of the first frame; 0 without frames.
    pub first_frame: u64,
    /// Number of the last frame.
    pub last_frame: u64,
    /// Frames that were recorded, late ones included.
    pub n_frames: u64,
    /// Samples that were recorded.
    pub n_samples: u64,
    /// Of the first frame that has one.
    pub start_timecode: Option<Timecode>,
}

impl TakeFigures {
    /// Counts a frame.
    pub fn count_frame(&mut self, number: u64, timecode: Option<Timecode>) {
        self.start_timecode = self.start_timecode.or(timecode);
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
                if let Ok(frame) = Numbered::decode(data) {
                    let timecode = frame.timecode.as_ref().and_then(common::timecode);
                    self.count_frame(frame.number, timecode);
                }
            }
            Channel::Curves => self.n_samples += 1,
            Channel::Events => {}
        }
    }
}
