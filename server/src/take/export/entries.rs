//! The messages of a take, one after the other, as what they are.

use std::collections::VecDeque;

use frontalis_proto::v1::{self, take_event::Event};
use prost::Message as _;

use super::{ExportError, ExportSource};
use crate::take::{Channel, TakeReader, TakeRecord};

/// What a take holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Entry {
    Frame(v1::MarkerFrame),
    Sample(v1::CurveSample),
    Event(Event),
    /// An event of a later version, which says nothing here.
    Unknown,
}

pub(super) struct Entries {
    reader: TakeReader,
    batch: VecDeque<TakeRecord>,
}

impl Entries {
    pub(super) fn open(source: &ExportSource) -> Result<Self, ExportError> {
        Ok(Self {
            reader: TakeReader::open(&*source.fs, &source.file, source.n_bytes)?,
            batch: VecDeque::new(),
        })
    }

    /// The next one; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<Entry>, ExportError> {
        if self.batch.is_empty() {
            self.batch = self.reader.next_batch()?.unwrap_or_default().into();
        }
        let Some(record) = self.batch.pop_front() else {
            return Ok(None);
        };
        entry(&record).map(Some)
    }
}

fn entry(record: &TakeRecord) -> Result<Entry, ExportError> {
    let data = &*record.data;
    let read = match record.channel {
        Channel::Markers => v1::MarkerFrame::decode(data).map(Entry::Frame),
        Channel::Curves => v1::CurveSample::decode(data).map(Entry::Sample),
        Channel::Events => {
            v1::TakeEvent::decode(data).map(|it| it.event.map_or(Entry::Unknown, Entry::Event))
        }
    };
    read.map_err(|source| ExportError::Message {
        channel: record.channel.topic(),
        sequence: record.sequence,
        source,
    })
}
