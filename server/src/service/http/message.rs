//! Messages of the streams as JSON, in the protobuf mapping: one document a line, an event or a WebSocket message.
//!
//! What cannot be read is refused by the place of the error, never with the client's own text (BAD_INPUT D12, E3).

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use bytes::Bytes;
use frontalis_proto::v1;
use prost::Name;
use serde::Serialize;
use tonic::{Code, Status};

use super::{
    json::{self, Rules},
    problem::Problem,
};
use crate::{
    service::grpc::status::{Refusal, reason_of, refuse},
    wire::{capture::MAX_FRAMES_PER_MESSAGE, invalid::FieldError, parts::PartCount},
};

/// Objects of a publisher's message beside its frames: the message, `start`, its `image`, `clock`.
const OBJECTS_AROUND_FRAMES: usize = 4;
/// A frame, and its timecode.
const OBJECTS_OF_A_FRAME: usize = 2;

/// A message of a client, from either form.
pub(super) trait Incoming: Name + Default + Send + 'static {
    /// Most JSON objects in one: a short text must not become a large list (BAD_INPUT E5).
    const MAX_OBJECTS: usize;

    /// Names the session where the first message may leave it out.
    ///
    /// # Errors
    ///
    /// When it names another one.
    fn place(&mut self, session: &str) -> Result<(), Status>;

    /// Whether who sends this may stop reading for as long as it likes (CONTRACTS D-15).
    fn may_pause(&self) -> bool {
        false
    }
}

impl Incoming for v1::PublishMarkersRequest {
    const MAX_OBJECTS: usize = OBJECTS_AROUND_FRAMES + OBJECTS_OF_A_FRAME * MAX_FRAMES_PER_MESSAGE;

    fn place(&mut self, session: &str) -> Result<(), Status> {
        let Some(start) = &mut self.start else {
            return Ok(());
        };
        place(&mut start.session, session)
    }
}

impl Incoming for v1::SubscribeRequest {
    /// The message and `start`.
    const MAX_OBJECTS: usize = 2;

    fn place(&mut self, session: &str) -> Result<(), Status> {
        let Some(start) = &mut self.start else {
            return Ok(());
        };
        place(&mut start.session, session)
    }

    fn may_pause(&self) -> bool {
        let latest = |it: &v1::SubscribeStart| it.delivery() != v1::Delivery::EveryFrame;
        self.start.as_ref().is_some_and(latest)
    }
}

fn place(named: &mut String, session: &str) -> Result<(), Status> {
    if named.is_empty() {
        session.clone_into(named);
        return Ok(());
    }
    if named == session {
        return Ok(());
    }
    let detail = "the start names another session than the path";
    Err(FieldError::unusable("start.session", "SESSION_MISMATCH", detail).into())
}

/// Reads a message from a text that begins on this line of its stream.
///
/// # Errors
///
/// `INVALID_ARGUMENT JSON`, `ENUM` or `FRAME_COUNT`, with field, line and column.
pub(super) fn from_json<M: Incoming>(text: &[u8], line: u64) -> Result<M, Status> {
    let rules = Rules {
        in_path: &[],
        max_objects: M::MAX_OBJECTS,
    };
    json::read(text, rules).map_err(|fault| fault.on_line(line).into())
}

/// Reads a message.
///
/// # Errors
///
/// `INVALID_ARGUMENT PROTOBUF` or `MESSAGE_PARTS`.
pub(super) fn from_protobuf<M: Incoming>(bytes: Bytes) -> Result<M, Status> {
    let counted = PartCount::default().take(&bytes);
    counted.map_err(|error| refuse(Code::InvalidArgument, "MESSAGE_PARTS", error.to_string()))?;
    M::decode(bytes).map_err(|error| {
        tracing::debug!(%error, "a message could not be read");
        let message = "the message is not the protobuf message that is due here";
        refuse(Code::InvalidArgument, "PROTOBUF", message)
    })
}

/// Which message of a stream was taken last, so that a refusal can say of which it is; cheap to clone.
#[derive(Clone, Debug)]
pub(super) struct Taken {
    unit: &'static str,
    number: Arc<AtomicU64>,
}

impl Taken {
    /// None was taken yet. A problem names `unit`: `line` or `message`.
    pub fn none(unit: &'static str) -> Self {
        Self {
            unit,
            number: Arc::default(),
        }
    }

    /// The message of this number, from 1, was taken.
    pub fn take(&self, number: u64) {
        self.number.store(number, Ordering::Relaxed);
    }

    /// The next message was taken.
    pub fn take_next(&self) {
        self.number.fetch_add(1, Ordering::Relaxed);
    }

    /// A refusal as the problem that it is, with the number when it is one of the message.
    pub fn problem(&self, status: Status) -> Problem {
        let number = self.number.load(Ordering::Relaxed);
        let says_it = number > 0 && is_of_a_message(&status);
        let problem = Problem::from(status);
        if says_it {
            problem.of_message(self.unit, number)
        } else {
            problem
        }
    }
}

/// Whether a refusal is one of the message that was taken last, and not of what happened meanwhile.
fn is_of_a_message(status: &Status) -> bool {
    match status.code() {
        Code::InvalidArgument | Code::OutOfRange | Code::Unimplemented => true,
        _ => matches!(
            reason_of(status).as_deref(),
            Some("PROTOCOL_ORDER" | "MESSAGE_DEADLINE")
        ),
    }
}

/// Writes a message at the end of `text`.
///
/// # Errors
///
/// `INTERNAL ENCODING`; no message of this server gives one.
pub(super) fn write_json<M: Serialize>(message: &M, text: &mut Vec<u8>) -> Result<(), Status> {
    serde_json::to_writer(text, message).map_err(|error| {
        tracing::error!(%error, "a message could not be written as JSON");
        refuse(
            Code::Internal,
            "ENCODING",
            "the server made a mistake; it goes on",
        )
    })
}

/// A message that is larger than the limit (BAD_INPUT E1).
pub(super) fn too_large(limit_bytes: usize) -> Status {
    let message = format!("a message is limited to {limit_bytes} bytes");
    Refusal::new(Code::OutOfRange, "MESSAGE_SIZE", message)
        .with("limit", &"message_bytes")
        .with("value", &limit_bytes)
        .into_status()
}

/// A message that was begun and not finished in time (BAD_INPUT E2, F5).
pub(super) fn too_slow() -> Status {
    let message = "a message must arrive within 10 s of its first byte";
    refuse(Code::DeadlineExceeded, "MESSAGE_DEADLINE", message)
}

#[cfg(test)]
mod tests;
