//! What a take recorded, message after message, as the bytes of its MCAP file come in.
//!
//! The file may still grow, or have been cut off: what is whole of it is read. Nothing is kept but the message in hand and
//! the chunk it stands in.

use std::{
    collections::{HashMap, VecDeque},
    fs::File,
    io::{self, Read as _},
    path::Path,
};

use frontalis_proto::{
    MAX_TAKE_RECORD_BYTES, chunk_records,
    v1::{CurveSample, MarkerFrame, TakeEvent, take_event::Event},
};
use futures::{Stream, StreamExt as _, stream, stream::BoxStream};
use mcap::{
    McapError,
    records::{Channel, Record, op},
    sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions},
};
use prost::Message as _;

use crate::{error::ClientError, proto};

/// Bytes that are read of a file at once.
const PIECE_BYTES: usize = 64 << 10;

/// Channels that a file may have; a take has three.
const MAX_CHANNELS: usize = 64;

/// Why a take cannot be read on.
#[derive(Debug, thiserror::Error)]
pub enum RecordedTakeError {
    /// The file cannot be read.
    #[error("the file cannot be read")]
    Io(#[from] io::Error),
    /// The server does not give it.
    #[error("the server does not give the take")]
    Server(#[from] ClientError),
    /// It is no MCAP, or damaged.
    #[error("the take is no readable MCAP file, or damaged: {0}")]
    Format(String),
    /// It is no take.
    #[error("a message of {topic} is none of a take")]
    Message {
        /// Where it stands.
        topic: String,
    },
}

/// One thing that was recorded.
#[derive(Clone, Debug, PartialEq)]
pub enum RecordedMessage {
    /// A frame as it came.
    Frame(MarkerFrame),
    /// What the frame was solved to.
    Sample(Box<CurveSample>),
    /// What happened between frames.
    Event(Box<Event>),
}

/// A take's messages, in the order in which they were recorded.
pub struct RecordedTake {
    pieces: BoxStream<'static, Result<Vec<u8>, RecordedTakeError>>,
    piece: Vec<u8>,
    n_used: usize,
    reader: LinearReader,
    topics: HashMap<u16, String>,
    /// Of the chunk that was read last, and whose checksum was right.
    chunk: VecDeque<RecordedMessage>,
    /// Behind it come an index and a summary, and no messages.
    is_over: bool,
}

impl From<McapError> for RecordedTakeError {
    fn from(error: McapError) -> Self {
        // What follows the first line is for programmers.
        let words = error.to_string();
        Self::Format(words.lines().next().unwrap_or_default().to_owned())
    }
}

impl RecordedTake {
    /// A take out of a file.
    ///
    /// # Errors
    ///
    /// When the file cannot be opened.
    pub fn open(file: &Path) -> Result<Self, RecordedTakeError> {
        let file = File::open(file)?;
        Ok(Self::new(stream::try_unfold(file, async |mut file| {
            let mut piece = vec![0; PIECE_BYTES];
            let n_bytes = file.read(&mut piece)?;
            piece.truncate(n_bytes);
            Ok((n_bytes > 0).then_some((piece, file)))
        })))
    }

    /// A take out of a server's answer.
    pub fn download(pieces: tonic::Streaming<proto::ExportTakeResponse>) -> Self {
        Self::new(pieces.map(|piece| match piece {
            Ok(piece) => Ok(piece.chunk),
            Err(status) => Err(ClientError::from(status).into()),
        }))
    }

    fn new(
        pieces: impl Stream<Item = Result<Vec<u8>, RecordedTakeError>> + Send + 'static,
    ) -> Self {
        let options = LinearReaderOptions::default()
            .with_skip_end_magic(true)
            .with_emit_chunks(true)
            // A chunk that is no longer one is missed too, in a file that has its final form.
            .with_validate_data_section_crc(true)
            .with_record_length_limit(MAX_TAKE_RECORD_BYTES);
        Self {
            pieces: pieces.boxed(),
            piece: Vec::new(),
            n_used: 0,
            reader: LinearReader::new_with_options(options),
            topics: HashMap::new(),
            chunk: VecDeque::new(),
            is_over: false,
        }
    }

    /// The next message; `None` at the end, or where the rest of the file is missing.
    ///
    /// # Errors
    ///
    /// When the take cannot be read on.
    pub async fn next(&mut self) -> Result<Option<RecordedMessage>, RecordedTakeError> {
        loop {
            if let Some(message) = self.chunk.pop_front() {
                return Ok(Some(message));
            }
            if self.is_over {
                return Ok(None);
            }
            let n_wanted = match self.reader.next_event() {
                None | Some(Err(McapError::UnexpectedEof | McapError::UnexpectedEoc)) => {
                    return Ok(None);
                }
                Some(Err(error)) => return Err(error.into()),
                Some(Ok(LinearReadEvent::ReadRequest(n_bytes))) => n_bytes,
                Some(Ok(LinearReadEvent::Record { data, opcode })) => {
                    self.is_over = opcode == op::DATA_END;
                    // Messages stand in chunks only; what looks like one elsewhere is damage.
                    if opcode == op::CHUNK {
                        self.chunk = chunk_messages(data, &mut self.topics)?;
                    } else if let Record::Channel(channel) = mcap::parse_record(opcode, data)? {
                        know_topic(channel, &mut self.topics);
                    }
                    continue;
                }
            };
            self.feed(n_wanted).await?;
        }
    }

    /// Gives the reader bytes that it wants, as many as are there; none at the end.
    async fn feed(&mut self, n_wanted: usize) -> Result<(), RecordedTakeError> {
        while self.n_used == self.piece.len() {
            let Some(piece) = self.pieces.next().await else {
                self.reader.notify_read(0);
                return Ok(());
            };
            (self.piece, self.n_used) = (piece?, 0);
        }
        let rest = &self.piece[self.n_used..];
        let n_bytes = rest.len().min(n_wanted);
        self.reader
            .insert(n_bytes)
            .copy_from_slice(&rest[..n_bytes]);
        self.reader.notify_read(n_bytes);
        self.n_used += n_bytes;
        Ok(())
    }
}

fn know_topic(channel: Channel, topics: &mut HashMap<u16, String>) {
    if topics.len() < MAX_CHANNELS {
        topics.insert(channel.id, channel.topic);
    }
}

fn chunk_messages(
    record: &[u8],
    topics: &mut HashMap<u16, String>,
) -> Result<VecDeque<RecordedMessage>, RecordedTakeError> {
    let mut messages = VecDeque::new();
    for record in chunk_records(record)? {
        match record {
            Record::Channel(channel) => know_topic(channel, topics),
            Record::Message { header, data } => {
                if let Some(topic) = topics.get(&header.channel_id) {
                    messages.extend(message(topic, &data)?);
                }
            }
            _ => {}
        }
    }
    Ok(messages)
}

fn message(topic: &str, data: &[u8]) -> Result<Option<RecordedMessage>, RecordedTakeError> {
    let is_none = |_| RecordedTakeError::Message {
        topic: topic.to_owned(),
    };
    match topic {
        "/markers" => {
            let frame = MarkerFrame::decode(data).map_err(is_none)?;
            Ok(Some(RecordedMessage::Frame(frame)))
        }
        "/curves" => {
            let sample = CurveSample::decode(data).map_err(is_none)?;
            Ok(Some(RecordedMessage::Sample(Box::new(sample))))
        }
        "/events" => {
            let event = TakeEvent::decode(data).map_err(is_none)?.event;
            Ok(event.map(|it| RecordedMessage::Event(Box::new(it))))
        }
        _ => Ok(None),
    }
}

#[cfg(test)]
pub(crate) mod test_file;

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u64) -> MarkerFrame {
        MarkerFrame {
            number,
            positions: vec![1.0, f32::MIN_POSITIVE, -0.0],
            ..MarkerFrame::default()
        }
    }

    /// A file of 100 frames and a header before them.
    fn file() -> Vec<u8> {
        let event = Some(Event::Header(proto::TakeHeader::default()));
        let header = ("/events", TakeEvent { event }.encode_to_vec());
        let frames = (1..=100).map(|number| ("/markers", frame(number).encode_to_vec()));
        test_file::written([header].into_iter().chain(frames))
    }

    async fn read(bytes: &[u8], piece_bytes: usize) -> Vec<RecordedMessage> {
        let pieces: Vec<_> = bytes
            .chunks(piece_bytes)
            .map(|it| Ok(it.to_vec()))
            .collect();
        let mut take = RecordedTake::new(stream::iter(pieces));
        let mut messages = Vec::new();
        while let Some(message) = take.next().await.unwrap() {
            messages.push(message);
        }
        messages
    }

    #[tokio::test]
    async fn messages_come_as_they_were_recorded_however_the_bytes_come() {
        let bytes = file();
        for piece_bytes in [7, 1 << 20] {
            let messages = read(&bytes, piece_bytes).await;
            assert!(matches!(&messages[0], RecordedMessage::Event(_)));
            let expected: Vec<_> = (1..=100)
                .map(|it| RecordedMessage::Frame(frame(it)))
                .collect();
            assert_eq!(messages[1..], expected);
        }
    }

    #[tokio::test]
    async fn what_is_no_mcap_is_said_to_be_none() {
        let pieces = stream::iter([Ok(b"not an MCAP file at all".to_vec())]);
        let error = RecordedTake::new(pieces).next().await.unwrap_err();
        assert!(matches!(error, RecordedTakeError::Format(_)), "{error:?}");
    }

    #[tokio::test]
    async fn no_flipped_bit_gives_another_message_than_was_recorded() {
        let bytes = file();
        let whole = read(&bytes, 4_096).await;
        // One bit of every byte: all of them take long.
        for place in 0..bytes.len() {
            let mut flipped = bytes.clone();
            flipped[place] ^= 1 << (place % 8);
            let pieces = stream::iter([Ok(flipped)]);
            let mut take = RecordedTake::new(pieces);
            let mut messages = Vec::new();
            while let Ok(Some(message)) = take.next().await {
                messages.push(message);
            }
            let n_messages = messages.len();
            assert_eq!(messages, whole[..n_messages], "byte {place}");
        }
    }
}
