//! What a take's file holds, as any MCAP reader sees it.

use frontalis_proto::v1::{CurveSample, MarkerFrame, TakeEvent, take_event::Event};
use mcap::{
    McapError,
    read::{ChunkReader, LinearReader, Options},
    records::Record,
};
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
        Self::read_with(file, |error| panic!("{error}"))
    }

    /// Reads as much of a file as is whole: its end may be cut amid a record.
    pub fn beginning(file: &[u8]) -> Self {
        Self::read_with(file, |error| {
            let is_cut = matches!(error, McapError::UnexpectedEof | McapError::UnexpectedEoc);
            assert!(is_cut, "{error}");
        })
    }

    fn read_with(file: &[u8], at_end: impl Fn(McapError)) -> Self {
        let mut take = Self::default();
        let mut topics = std::collections::HashMap::new();
        let options = Options::IgnoreEndMagic.into();
        for record in LinearReader::new_with_options(file, options).unwrap() {
            match record {
                Err(error) => at_end(error),
                Ok(Record::Channel(it)) => drop(topics.insert(it.id, it.topic)),
                Ok(Record::Chunk { header, data }) => {
                    for inner in ChunkReader::new(header, &data).unwrap() {
                        match inner.unwrap() {
                            Record::Channel(it) => drop(topics.insert(it.id, it.topic)),
                            Record::Message { header, data } => {
                                take.add(&topics[&header.channel_id], &data);
                            }
                            _ => {}
                        }
                    }
                }
                Ok(_) => {}
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
