//! Takes as tests write them.

use std::io::Cursor;

use futures::stream;
use mcap::{Writer, records::MessageHeader};

use super::RecordedTake;

/// A file of these messages, each with its topic.
pub(crate) fn written(messages: impl IntoIterator<Item = (&'static str, Vec<u8>)>) -> Vec<u8> {
    let mut writer = Writer::new(Cursor::new(Vec::new())).unwrap();
    let schema = writer.add_schema("any", "protobuf", &[]).unwrap();
    for (topic, data) in messages {
        // The same again for a topic that is known.
        let channel_id = writer.add_channel(schema, topic, "protobuf", &[].into());
        let header = MessageHeader {
            channel_id: channel_id.unwrap(),
            sequence: 0,
            log_time: 0,
            publish_time: 0,
        };
        writer.write_to_known_channel(&header, &data).unwrap();
    }
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

/// A take of these messages.
pub(crate) fn take(messages: impl IntoIterator<Item = (&'static str, Vec<u8>)>) -> RecordedTake {
    RecordedTake::new(stream::iter([Ok(written(messages))]))
}
