//! Messages under one checksum: what one commit adds to a take's file (CONTRACTS U-3).
//!
//! An MCAP chunk without compression. Every byte of it can be checked: the records by their checksum, what stands around
//! them by the records, so that no flipped bit goes unnoticed.

use super::channel::Channel;

/// Opcodes of the MCAP format.
const MESSAGE: u8 = 0x05;
const CHUNK: u8 = 0x06;

/// Opcode and length of a record.
const PREFIX_BYTES: usize = 9;

/// What a chunk says before its records: times, size, checksum, no compression, size again.
const CHUNK_HEADER_BYTES: usize = 8 + 8 + 8 + 4 + 4 + 8;

/// What a message says before its data.
const MESSAGE_HEADER_BYTES: usize = 2 + 4 + 8 + 8;

/// Records of one chunk. Commits are far smaller; what claims to be larger is none of ours.
pub const MAX_CHUNK_BYTES: usize = 64 << 20;

/// A message as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message<'a> {
    /// Where it belongs.
    pub channel: Channel,
    /// Its number in its channel, from 0.
    pub sequence: u32,
    /// Unix time at which it was recorded, nanoseconds.
    pub time_nanos: u64,
    /// The protobuf message.
    pub data: &'a [u8],
}

/// Messages that wait for the next commit.
#[derive(Debug, Default)]
pub struct ChunkBuffer {
    records: Vec<u8>,
    first_nanos: u64,
    last_nanos: u64,
}

impl ChunkBuffer {
    /// Whether nothing waits.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Adds a message.
    pub fn add(&mut self, message: &Message<'_>) {
        let time_nanos = message.time_nanos;
        if self.is_empty() {
            (self.first_nanos, self.last_nanos) = (time_nanos, time_nanos);
        }
        self.first_nanos = self.first_nanos.min(time_nanos);
        self.last_nanos = self.last_nanos.max(time_nanos);
        let records = &mut self.records;
        records.push(MESSAGE);
        put_size(records, MESSAGE_HEADER_BYTES + message.data.len());
        records.extend(message.channel.id().to_le_bytes());
        records.extend(message.sequence.to_le_bytes());
        records.extend(time_nanos.to_le_bytes());
        records.extend(time_nanos.to_le_bytes());
        records.extend(message.data);
    }

    /// The chunk of all that waits, which then no longer does.
    pub fn take(&mut self) -> Vec<u8> {
        let records = std::mem::take(&mut self.records);
        let mut chunk = Vec::with_capacity(PREFIX_BYTES + CHUNK_HEADER_BYTES + records.len());
        chunk.push(CHUNK);
        put_size(&mut chunk, CHUNK_HEADER_BYTES + records.len());
        chunk.extend(self.first_nanos.to_le_bytes());
        chunk.extend(self.last_nanos.to_le_bytes());
        put_size(&mut chunk, records.len());
        chunk.extend(crc32fast::hash(&records).to_le_bytes());
        chunk.extend(0_u32.to_le_bytes());
        put_size(&mut chunk, records.len());
        chunk.extend(records);
        chunk
    }
}

fn put_size(to: &mut Vec<u8>, size: usize) {
    to.extend((size as u64).to_le_bytes());
}

/// How many bytes a chunk has that starts with these, by what it says itself; `None` when it is none of ours.
///
/// Fewer than [`CHUNK_START_BYTES`] bytes are too few to say.
pub fn announced_bytes(start: &[u8]) -> Option<usize> {
    let mut fields = Fields(start);
    let is_chunk = fields.u8()? == CHUNK;
    let n_bytes = usize::try_from(fields.u64()?).ok()?;
    let fits = (CHUNK_HEADER_BYTES..=CHUNK_HEADER_BYTES + MAX_CHUNK_BYTES).contains(&n_bytes);
    // A length that does not fit may be any number: nothing is added to it.
    (is_chunk && fits).then(|| PREFIX_BYTES + n_bytes)
}

/// So many bytes say how long a chunk is.
pub const CHUNK_START_BYTES: usize = PREFIX_BYTES;

/// The messages of a whole chunk; `None` when any byte of it is wrong.
pub fn messages(chunk: &[u8]) -> Option<Vec<Message<'_>>> {
    if announced_bytes(chunk)? != chunk.len() {
        return None;
    }
    let mut fields = Fields(&chunk[PREFIX_BYTES..]);
    let bounds = (fields.u64()?, fields.u64()?);
    let (size, checksum) = (fields.u64()?, fields.u32()?);
    let (compression_bytes, same_size) = (fields.u32()?, fields.u64()?);
    let records = fields.0;
    let is_whole = compression_bytes == 0
        && size == same_size
        && size == records.len() as u64
        && checksum == crc32fast::hash(records);
    let messages = if is_whole {
        parse(records)?
    } else {
        return None;
    };
    let times = || messages.iter().map(|it| it.time_nanos);
    let found = (times().min()?, times().max()?);
    (found == bounds).then_some(messages)
}

fn parse(records: &[u8]) -> Option<Vec<Message<'_>>> {
    let mut fields = Fields(records);
    let mut messages = Vec::new();
    while !fields.0.is_empty() {
        let is_message = fields.u8()? == MESSAGE;
        let n_bytes = usize::try_from(fields.u64()?).ok()?;
        let mut record = Fields(fields.take(n_bytes)?);
        let channel = Channel::of(record.u16()?)?;
        let sequence = record.u32()?;
        let (time_nanos, same_time) = (record.u64()?, record.u64()?);
        if !is_message || time_nanos != same_time {
            return None;
        }
        messages.push(Message {
            channel,
            sequence,
            time_nanos,
            data: record.0,
        });
    }
    Some(messages)
}

/// Little-endian numbers, one after the other.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn take(&mut self, n_bytes: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(n_bytes)?;
        self.0 = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn u8(&mut self) -> Option<u8> {
        self.array().map(u8::from_le_bytes)
    }

    fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk() -> Vec<u8> {
        let mut buffer = ChunkBuffer::default();
        for (sequence, channel) in [Channel::Events, Channel::Markers].into_iter().enumerate() {
            buffer.add(&Message {
                channel,
                sequence: u32::try_from(sequence).unwrap(),
                time_nanos: 7 + sequence as u64,
                data: &[1, 2, 3],
            });
        }
        buffer.take()
    }

    #[test]
    fn a_chunk_gives_back_its_messages() {
        let chunk = chunk();
        assert_eq!(
            announced_bytes(&chunk[..CHUNK_START_BYTES]),
            Some(chunk.len())
        );
        let found = messages(&chunk).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!(found[1].channel, Channel::Markers);
        assert_eq!((found[1].sequence, found[1].time_nanos), (1, 8));
        assert_eq!(found[1].data, [1, 2, 3]);
    }

    #[test]
    fn every_flipped_bit_and_every_cut_is_noticed() {
        let whole = chunk();
        for bit in 0..8 * whole.len() {
            let mut flipped = whole.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(messages(&flipped).is_none(), "bit {bit}");
        }
        for n_bytes in 0..whole.len() {
            assert!(messages(&whole[..n_bytes]).is_none(), "{n_bytes} bytes");
        }
    }
}
