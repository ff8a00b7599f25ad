//! Messages of the streams as JSON, in the protobuf mapping: one document a line, an event or a WebSocket message.
//!
//! What cannot be read is refused by the place of the error, never with the client's own text (BAD_INPUT D12, E3).

use bytes::Bytes;
use frontalis_proto::v1;
use prost::Message;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::error::Category;
use tonic::{Code, Status};

use crate::{
    service::grpc::status::{Refusal, refuse},
    wire::{capture::MAX_FRAMES_PER_MESSAGE, invalid::FieldError, parts::PartCount},
};

/// Objects of a publisher's message beside its frames: the message, `start`, its `image`, `clock`.
const OBJECTS_AROUND_FRAMES: usize = 4;
/// A frame, and its timecode.
const OBJECTS_OF_A_FRAME: usize = 2;

/// A message of a client, from either form.
pub(super) trait Incoming: Message + DeserializeOwned + Default + Send + 'static {
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

/// Reads a message.
///
/// # Errors
///
/// `INVALID_ARGUMENT JSON` or `FRAME_COUNT`, with the column where it fails.
pub(super) fn from_json<M: Incoming>(text: &[u8]) -> Result<M, Status> {
    let n_objects = n_objects(text);
    if n_objects > M::MAX_OBJECTS {
        let message = format!(
            "{n_objects} objects in a message, at most {} are taken",
            M::MAX_OBJECTS
        );
        return Err(Refusal::new(Code::InvalidArgument, "FRAME_COUNT", message)
            .with("value", &M::MAX_OBJECTS)
            .into_status());
    }
    serde_json::from_slice(text).map_err(|error| unreadable(text, &error))
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

/// Objects that begin in a text, strings left out.
fn n_objects(text: &[u8]) -> usize {
    let (mut n, mut in_string, mut escaped) = (0, false, false);
    for byte in text {
        if escaped {
            escaped = false;
        } else if in_string {
            escaped = *byte == b'\\';
            in_string = *byte != b'"';
        } else {
            in_string = *byte == b'"';
            n += usize::from(*byte == b'{');
        }
    }
    n
}

/// The parser's own text may repeat the client's; its place does not.
fn unreadable(text: &[u8], error: &serde_json::Error) -> Status {
    let column = error.column();
    let read = text.get(..column).unwrap_or(text);
    // The parser stands behind what follows the value.
    let read = read
        .strip_suffix(b",")
        .or(read.strip_suffix(b"]"))
        .unwrap_or(read);
    let message = match error.classify() {
        Category::Data if read.trim_ascii_end().ends_with(b"null") => {
            format!(
                "null at column {column}: a coordinate that was not seen is \"NaN\", three for a marker"
            )
        }
        Category::Data => format!(
            "at column {column}: a field that is unknown or stands twice, or a value that does not fit its field"
        ),
        Category::Eof => format!("the JSON ends at column {column} in the middle of the message"),
        Category::Syntax | Category::Io => format!("not JSON, from column {column} on"),
    };
    Refusal::new(Code::InvalidArgument, "JSON", message)
        .with("column", &column)
        .into_status()
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
