//! How a WebSocket ends: the close code of every failure (RFC 6455, section 7.4; BAD_INPUT E13).

use tokio_tungstenite::tungstenite::{
    self,
    protocol::{CloseFrame, frame::coding::CloseCode},
};
use tonic::{Code, Status};

use super::super::message::too_large;
use crate::service::grpc::status::{reason_of, refuse};

/// The close frame of a stream that ended as its contract says.
pub(super) fn in_peace() -> CloseFrame {
    CloseFrame {
        code: CloseCode::Normal,
        reason: "END".into(),
    }
}

/// The close frame of a failure; its reason is that of the status.
pub(super) fn of(status: &Status) -> CloseFrame {
    let reason = reason_of(status).unwrap_or_else(|| "INTERNAL".to_owned());
    CloseFrame {
        code: code(status.code(), &reason),
        reason: reason.into(),
    }
}

fn code(code: Code, reason: &str) -> CloseCode {
    match (code, reason) {
        (_, "DRAINING") => CloseCode::Away,
        (_, "WEBSOCKET") => CloseCode::Protocol,
        (_, "MESSAGE_FORM") => CloseCode::Unsupported,
        (_, "JSON" | "PROTOBUF" | "UTF8") => CloseCode::Invalid,
        (_, "MESSAGE_SIZE") => CloseCode::Size,
        (_, "PING_FLOOD") => CloseCode::Policy,
        (Code::Internal | Code::Unknown, _) => CloseCode::Error,
        (Code::Unavailable | Code::ResourceExhausted | Code::DataLoss, _) => CloseCode::Again,
        _ => CloseCode::Policy,
    }
}

/// What a client broke; `None` when it is simply gone.
pub(super) fn broken(error: &tungstenite::Error, limit_bytes: usize) -> Option<Status> {
    use tungstenite::{Error, error::ProtocolError};
    match error {
        Error::Capacity(_) => Some(too_large(limit_bytes)),
        Error::Utf8(_) => {
            let message = "a text message must be UTF-8";
            Some(refuse(Code::InvalidArgument, "UTF8", message))
        }
        Error::Protocol(ProtocolError::ResetWithoutClosingHandshake) => None,
        Error::Protocol(error) => {
            tracing::debug!(%error, "a WebSocket's framing is broken");
            let message = "a frame breaks the WebSocket protocol (RFC 6455)";
            Some(refuse(Code::InvalidArgument, "WEBSOCKET", message))
        }
        _ => None,
    }
}

/// A text message where a binary one is due, or the other way round.
pub(super) fn other_form() -> Status {
    let message = "the subprotocol's messages are text for +json, binary for +proto";
    refuse(Code::InvalidArgument, "MESSAGE_FORM", message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_failure_has_its_close_code() {
        for (grpc, reason, expected) in [
            (Code::Unavailable, "DRAINING", 1001),
            (Code::InvalidArgument, "WEBSOCKET", 1002),
            (Code::InvalidArgument, "MESSAGE_FORM", 1003),
            (Code::InvalidArgument, "JSON", 1007),
            (Code::NotFound, "SESSION", 1008),
            (Code::Aborted, "PUBLISHER_FENCED", 1008),
            (Code::Unauthenticated, "TOKEN", 1008),
            (Code::OutOfRange, "MESSAGE_SIZE", 1009),
            (Code::Internal, "STORAGE", 1011),
            (Code::ResourceExhausted, "SUBSCRIBERS", 1013),
            (Code::DataLoss, "SUBSCRIBER_LAGGED", 1013),
        ] {
            assert_eq!(u16::from(code(grpc, reason)), expected, "{reason}");
        }
        let frame = of(&refuse(
            Code::NotFound,
            "SESSION",
            "there is no such session",
        ));
        assert_eq!(frame.reason.as_str(), "SESSION");
    }
}
