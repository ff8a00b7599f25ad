//! What a take's file is made of before its first message: three channels of protobuf messages, with their schema.

use mcap::{
    WriteOptions,
    write::{NoSeek, Writer},
};

/// A channel of a take's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Frames as they came, `frontalis.v1.MarkerFrame`.
    Markers,
    /// Samples as they went, `frontalis.v1.CurveSample`.
    Curves,
    /// All else that happened, `frontalis.v1.TakeEvent`.
    Events,
}

/// Encoding of schemas and messages, as the MCAP registry names it.
const PROTOBUF: &str = "protobuf";

/// Who wrote the file.
const LIBRARY: &str = concat!("frontalis ", env!("CARGO_PKG_VERSION"));

impl Channel {
    /// All of them, in the order of their ids.
    pub const ALL: [Self; 3] = [Self::Markers, Self::Curves, Self::Events];

    /// Its number in the file.
    pub fn id(self) -> u16 {
        match self {
            Self::Markers => 1,
            Self::Curves => 2,
            Self::Events => 3,
        }
    }

    /// The channel of this number.
    pub fn of(id: u16) -> Option<Self> {
        Self::ALL.into_iter().find(|it| it.id() == id)
    }

    /// Its name in the file.
    pub fn topic(self) -> &'static str {
        match self {
            Self::Markers => "/markers",
            Self::Curves => "/curves",
            Self::Events => "/events",
        }
    }

    fn message(self) -> &'static str {
        match self {
            Self::Markers => "frontalis.v1.MarkerFrame",
            Self::Curves => "frontalis.v1.CurveSample",
            Self::Events => "frontalis.v1.TakeEvent",
        }
    }
}

/// Options of every file of ours; those of one kind are changed where it is written.
pub(super) fn options() -> WriteOptions {
    WriteOptions::new()
        .profile("")
        .library(LIBRARY)
        .compression(None)
        .disable_seeking(true)
}

/// Declares the channels.
///
/// # Errors
///
/// When `writer` cannot be written to.
pub(super) fn declare<W: std::io::Write>(writer: &mut Writer<NoSeek<W>>) -> mcap::McapResult<()> {
    let schema = frontalis_proto::FILE_DESCRIPTOR_SET;
    for channel in Channel::ALL {
        let schema = writer.add_schema(channel.message(), PROTOBUF, schema)?;
        writer.add_channel(schema, channel.topic(), PROTOBUF, &[].into())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::take::head::growing_head;

    #[test]
    fn channels_have_the_ids_that_messages_name() {
        let head = growing_head().unwrap();
        let mut found = Vec::new();
        for record in mcap::read::LinearReader::new_with_options(
            head,
            mcap::read::Options::IgnoreEndMagic.into(),
        )
        .unwrap()
        {
            if let mcap::records::Record::Channel(it) = record.unwrap() {
                found.push((it.id, it.topic));
            }
        }
        let expected = Channel::ALL.map(|it| (it.id(), it.topic().to_owned()));
        assert_eq!(found, expected);
    }
}
