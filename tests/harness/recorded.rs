//! What a take's file holds, as any MCAP reader sees it.

use frontalis_proto::v1::{CurveSample, MarkerFrame, TakeEvent, take_event::Event};
use mcap::read::{LinearReader, Options};
use prost::Message as _;

/// The messages of a take's file, by channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedTake {
    /// Frames, in the order in which they came.
    pub frames: Vec<MarkerFrame>,
    /// Samples, in the order in which they went.
    pub samples: Vec<CurveSample>,
    /// All else, in order.
    pub events: Vec<Event>,
}

impl RecordedTake {
    /// Reads a file, closed or under way: chunks may be followed by nothing.
    ///
    /// # Panics
    ///
    /// When a record that is there cannot be read.
    pub fn read(file: &[u8]) -> Self {
        let mut take = Self::default();
        let mut topics = std::collections::HashMap::new();
        for record in LinearReader::new_with_options(file, Options::IgnoreEndMagic.into()).unwrap()
        {
            match record.unwrap() {
                mcap::records::Record::Channel(it) => drop(topics.insert(it.id, it.topic)),
                mcap::records::Record::Chunk { header, data } => {
                    for inner in mcap::read::ChunkReader::new(header, &data).unwrap() {
                        match inner.unwrap() {
                            mcap::records::Record::Channel(it) => {
                                topics.insert(it.id, it.topic);
                            }
                            mcap::records::Record::Message { header, data } => {
                                take.add(&topics[&header.channel_id], &data);
                            }
                            _ => {}
                        }
                    }
                }
                _ => {}
            }
        }
        take
    }

    fn add(&mut self, topic: &str, data: &[u8]) {
        match topic {
            "/markers" => self.frames.push(MarkerFrame::decode(data).unwrap()),
            "/curves" => self.samples.push(CurveSample::decode(data).unwrap()),
            "/events" => self
                .events
                .push(TakeEvent::decode(data).unwrap().event.unwrap()),
            other => panic!("no such channel: {other}"),
        }
    }

    /// Numbers of the frames.
    pub fn frame_numbers(&self) -> Vec<u64> {
        self.frames.iter().map(|it| it.number).collect()
    }
}
