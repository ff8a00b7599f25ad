//! The take that a re-solve makes: the frames as they were recorded, and what they give now.

use std::path::Path;

use frontalis_proto::v1::{self, take_event::Event};
use prost::Message as _;

use super::super::{
    channel::Channel, chunk::Message, figures::TakeFigures, final_form::FinalForm,
    rewrite::TakeFileError, scribe::DETAIL,
};
use crate::{
    fs::Fs,
    hub::Outgoing,
    wire::{
        common,
        curve::{gap_to_wire, sample_to_wire},
    },
};

/// A take in its final form, message after message.
pub(super) struct NewTake {
    file: FinalForm,
    next_sequences: [u32; 3],
    pub(super) figures: TakeFigures,
    /// Of the last frame or event.
    time_nanos: u64,
    encoded: Vec<u8>,
}

impl NewTake {
    pub(super) fn create(fs: &dyn Fs, file: &Path) -> Result<Self, TakeFileError> {
        Ok(Self {
            file: FinalForm::create(fs, file)?,
            next_sequences: [0; 3],
            figures: TakeFigures::default(),
            time_nanos: 0,
            encoded: Vec::new(),
        })
    }

    /// What follows happened then.
    pub(super) fn at(&mut self, time_nanos: u64) {
        self.time_nanos = time_nanos;
    }

    pub(super) fn add_frame(
        &mut self,
        frame: &v1::MarkerFrame,
        data: &[u8],
    ) -> Result<(), TakeFileError> {
        let timecode = frame.timecode.as_ref().and_then(common::timecode);
        self.figures.count_frame(frame.number, timecode);
        self.add(Channel::Markers, data)
    }

    pub(super) fn add_event(&mut self, event: Event) -> Result<(), TakeFileError> {
        let event = v1::TakeEvent { event: Some(event) };
        self.add(Channel::Events, &event.encode_to_vec())
    }

    /// A sample, with the next sequence, or a gap.
    pub(super) fn add_outgoing(&mut self, outgoing: Outgoing) -> Result<(), TakeFileError> {
        match outgoing {
            Outgoing::Gap(gap) => self.add_event(Event::Gap(gap_to_wire(&gap))),
            Outgoing::Sample(mut sample) => {
                self.figures.n_samples += 1;
                sample.sequence = self.figures.n_samples;
                let mut encoded = std::mem::take(&mut self.encoded);
                encoded.clear();
                // A growing buffer always has room.
                let _fits = sample_to_wire(&sample, DETAIL).encode(&mut encoded);
                self.add(Channel::Curves, &encoded)?;
                self.encoded = encoded;
                Ok(())
            }
        }
    }

    fn add(&mut self, channel: Channel, data: &[u8]) -> Result<(), TakeFileError> {
        let next = &mut self.next_sequences[usize::from(channel.id() - 1)];
        let sequence = *next;
        *next = next.wrapping_add(1);
        self.file.add(&Message {
            channel,
            sequence,
            time_nanos: self.time_nanos,
            data,
        })
    }

    /// Flushes the file; returns its length.
    pub(super) fn finish(self) -> Result<u64, TakeFileError> {
        self.file.finish()
    }
}
