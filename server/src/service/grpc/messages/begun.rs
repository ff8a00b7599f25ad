//! A message that has begun: its prefix, and what came of it, in pieces that are small beside what came.

use std::collections::VecDeque;

use bytes::{Buf as _, BufMut as _, Bytes, BytesMut};
use tonic::{Code, Status};

use super::{compressed, too_large};
use crate::{
    service::grpc::status::refuse,
    wire::parts::{PartCount, TooManyParts},
};

/// A flag and a length of four bytes stand before every message.
const PREFIX_BYTES: usize = 5;

/// What is reserved at once: as much as came, within these. With the codec's own 8 KiB and the call itself it stays below
/// the 16 KiB that a call may hold beside what came.
const PIECE_BYTES: [usize; 2] = [512, 4 * 1024];

/// A message of which not everything came.
#[derive(Debug, Default)]
pub struct Begun {
    pieces: VecDeque<BytesMut>,
    n_held: usize,
    prefix: [u8; PREFIX_BYTES],
    /// Of the prefix and what it declares; known with the whole prefix.
    n_bytes: Option<usize>,
    parts: PartCount,
}

impl Begun {
    /// Whether no byte of it came.
    pub fn is_empty(&self) -> bool {
        self.n_held == 0
    }

    /// Whether all of it came.
    pub fn is_whole(&self) -> bool {
        self.n_bytes == Some(self.n_held)
    }

    /// Takes as many bytes as belong to the message.
    ///
    /// # Errors
    ///
    /// When the message may not be taken, which is known from its prefix or from its parts.
    pub fn take(&mut self, bytes: &mut Bytes, limit_bytes: usize) -> Result<(), Status> {
        while self.n_bytes.is_none() && bytes.has_remaining() {
            let byte = bytes.get_u8();
            self.prefix[self.n_held] = byte;
            self.hold(&[byte], PREFIX_BYTES);
            if self.n_held == PREFIX_BYTES {
                self.n_bytes = Some(PREFIX_BYTES + declared_bytes(self.prefix, limit_bytes)?);
            }
        }
        if let Some(n_bytes) = self.n_bytes {
            let n_missing = n_bytes - self.n_held;
            let content = bytes.split_to(bytes.len().min(n_missing));
            self.parts.take(&content).map_err(too_many_parts)?;
            self.hold(&content, n_missing);
        }
        Ok(())
    }

    /// Copies, so that no byte keeps the connection's whole buffer alive.
    fn hold(&mut self, mut bytes: &[u8], n_missing: usize) {
        let mut n_missing = n_missing;
        while !bytes.is_empty() {
            let has_room = |it: &BytesMut| it.len() < it.capacity();
            if !self.pieces.back().is_some_and(has_room) {
                let [least, most] = PIECE_BYTES;
                let n_bytes = self.n_held.clamp(least, most).min(n_missing);
                let piece = BytesMut::with_capacity(n_bytes);
                self.pieces.push_back(piece);
            }
            let piece = self
                .pieces
                .back_mut()
                .expect("invariant: the last piece has room");
            let n_fitting = bytes.len().min(piece.capacity() - piece.len());
            piece.put_slice(&bytes[..n_fitting]);
            bytes = &bytes[n_fitting..];
            self.n_held += n_fitting;
            n_missing -= n_fitting;
        }
    }

    /// Bytes of it that came.
    #[cfg(test)]
    pub fn n_held(&self) -> usize {
        self.n_held
    }

    /// What it takes in memory.
    #[cfg(test)]
    pub fn n_reserved(&self) -> usize {
        self.pieces.iter().map(BytesMut::capacity).sum()
    }

    /// What came, in order.
    pub fn pieces(self) -> impl Iterator<Item = Bytes> {
        self.pieces.into_iter().map(BytesMut::freeze)
    }
}

/// How many bytes at the start of `bytes`, where a message begins, are whole messages that may be taken.
///
/// # Errors
///
/// When the first of them may not be taken.
pub fn whole_messages(bytes: &[u8], limit_bytes: usize) -> Result<usize, Status> {
    let mut n_whole = 0;
    loop {
        match first_message(&bytes[n_whole..], limit_bytes) {
            Ok(Some(n_bytes)) => n_whole += n_bytes,
            // What stands before a message that may not be taken is handed on first.
            Err(refused) if n_whole == 0 => return Err(refused),
            Ok(None) | Err(_) => return Ok(n_whole),
        }
    }
}

/// The length of the first message with its prefix, when all of it is there.
fn first_message(bytes: &[u8], limit_bytes: usize) -> Result<Option<usize>, Status> {
    let Some((prefix, content)) = bytes.split_first_chunk::<PREFIX_BYTES>() else {
        return Ok(None);
    };
    let n_declared = declared_bytes(*prefix, limit_bytes)?;
    let Some(message) = content.get(..n_declared) else {
        return Ok(None);
    };
    let mut parts = PartCount::default();
    parts.take(message).map_err(too_many_parts)?;
    Ok(Some(PREFIX_BYTES + n_declared))
}

fn declared_bytes(prefix: [u8; PREFIX_BYTES], limit_bytes: usize) -> Result<usize, Status> {
    let [flag, length @ ..] = prefix;
    let n_bytes = u32::from_be_bytes(length) as usize;
    match flag {
        0 if n_bytes <= limit_bytes => Ok(n_bytes),
        0 => Err(too_large(n_bytes, limit_bytes)),
        1 => Err(compressed()),
        _ => {
            let message = "a message begins with neither of the two flags that there are";
            Err(refuse(Code::Unimplemented, "COMPRESSION", message))
        }
    }
}

fn too_many_parts(error: TooManyParts) -> Status {
    refuse(Code::InvalidArgument, "MESSAGE_PARTS", error.to_string())
}
