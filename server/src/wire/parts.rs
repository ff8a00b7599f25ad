//! How many parts a protobuf message has, counted while its bytes come and before any is decoded.
//!
//! An empty sub-message is two bytes on the wire and a whole structure in memory, so that a message within its limit of
//! size may cost seventy times its length when it is decoded (BAD_INPUT E5, CONTRACTS O-11). No message of this protocol
//! has more than a few hundred parts at its outermost level.

/// Most strings, byte strings, packed arrays and sub-messages at the outermost level of one message.
pub const MAX_PARTS: usize = 4_096;

/// A message has more than [`MAX_PARTS`] parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the message has more than {MAX_PARTS} parts")]
pub struct TooManyParts;

/// Counts the parts of one message, whose bytes may come in any pieces.
#[derive(Clone, Copy, Debug, Default)]
pub struct PartCount {
    n_parts: usize,
    at: At,
}

/// What the next byte belongs to.
#[derive(Clone, Copy, Debug)]
enum At {
    Tag(Varint),
    Number(Varint),
    Length(Varint),
    Content {
        n_left: u64,
    },
    /// No decoder gets further than this, so nothing more is counted.
    Malformed,
}

impl Default for At {
    fn default() -> Self {
        Self::Tag(Varint::default())
    }
}

/// A number of seven bits a byte, so far.
#[derive(Clone, Copy, Debug, Default)]
struct Varint {
    value: u64,
    n_bits: u32,
}

impl PartCount {
    /// Counts on.
    ///
    /// # Errors
    ///
    /// [`TooManyParts`], as soon as there is one too many.
    pub fn take(&mut self, mut bytes: &[u8]) -> Result<(), TooManyParts> {
        while let Some((&byte, rest)) = bytes.split_first() {
            if let At::Content { n_left } = self.at {
                let n_skipped = bytes
                    .len()
                    .min(usize::try_from(n_left).unwrap_or(usize::MAX));
                bytes = &bytes[n_skipped..];
                self.at = content(n_left - n_skipped as u64);
                continue;
            }
            self.at = match self.at {
                At::Tag(so_far) => so_far.with(byte, At::Tag, after_tag),
                At::Number(so_far) => so_far.with(byte, At::Number, |_| At::default()),
                At::Length(so_far) => so_far.with(byte, At::Length, content),
                At::Content { .. } | At::Malformed => return Ok(()),
            };
            let has_tag = matches!(self.at, At::Length(it) if it.n_bits == 0);
            self.n_parts += usize::from(has_tag);
            if self.n_parts > MAX_PARTS {
                return Err(TooManyParts);
            }
            bytes = rest;
        }
        Ok(())
    }
}

impl Varint {
    fn with(self, byte: u8, unfinished: fn(Self) -> At, finished: fn(u64) -> At) -> At {
        if self.n_bits > 63 {
            return At::Malformed;
        }
        let value = self.value | (u64::from(byte & 0x7f) << self.n_bits);
        if byte & 0x80 == 0 {
            return finished(value);
        }
        let n_bits = self.n_bits + 7;
        unfinished(Self { value, n_bits })
    }
}

fn content(n_left: u64) -> At {
    match n_left {
        0 => At::default(),
        n_left => At::Content { n_left },
    }
}

fn after_tag(tag: u64) -> At {
    match tag & 7 {
        0 => At::Number(Varint::default()),
        1 => content(8),
        2 => At::Length(Varint::default()),
        // What stands inside of a group is counted like what stands outside.
        3 | 4 => At::default(),
        5 => content(4),
        _ => At::Malformed,
    }
}

#[cfg(test)]
mod tests {
    use frontalis_proto::v1::{MarkerFrame, PublishMarkersRequest, PublishStart};
    use proptest::prelude::*;
    use prost::Message as _;

    use super::*;

    fn counted(pieces: &[&[u8]]) -> Result<usize, TooManyParts> {
        let mut count = PartCount::default();
        for piece in pieces {
            count.take(piece)?;
        }
        Ok(count.n_parts)
    }

    fn message(n_frames: usize, n_positions: usize) -> Vec<u8> {
        let frame = MarkerFrame {
            number: 1 << 40,
            capture_time_nanos: -1,
            positions: vec![0.5; n_positions],
            ..MarkerFrame::default()
        };
        let start = PublishStart {
            session: "sessions/s".to_owned(),
            rate_hz: 120.0,
            ..PublishStart::default()
        };
        let message = PublishMarkersRequest {
            start: Some(start),
            frames: vec![frame; n_frames],
            ..PublishMarkersRequest::default()
        };
        message.encode_to_vec()
    }

    proptest! {
        #[test]
        fn the_outermost_parts_are_counted_however_the_bytes_are_cut(
            n_frames in 0_usize..20, n_positions in 0_usize..100, cut in any::<prop::sample::Index>(),
        ) {
            let bytes = message(n_frames, n_positions);
            let (one, other) = bytes.split_at(cut.index(bytes.len()));
            prop_assert_eq!(counted(&[one, other]), Ok(n_frames + 1));
            let single: Vec<_> = bytes.chunks(1).collect();
            prop_assert_eq!(counted(&single), Ok(n_frames + 1));
        }

        #[test]
        fn no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            prop_assert!(counted(&[&bytes]).is_ok());
        }
    }

    #[test]
    fn one_part_too_many_is_refused_also_behind_a_group() {
        let empty = [0x12, 0];
        assert_eq!(counted(&[&empty.repeat(MAX_PARTS)]), Ok(MAX_PARTS));
        assert_eq!(counted(&[&empty.repeat(MAX_PARTS + 1)]), Err(TooManyParts));
        let group = [0xb3, 0x06, 0xb4, 0x06];
        let behind = [&group[..], &empty.repeat(MAX_PARTS + 1)].concat();
        assert_eq!(counted(&[&behind]), Err(TooManyParts));
    }
}
