//! What a server answered instead of a result: message, reason, and what to do about it.
//!
//! A refusal carries `google.rpc.ErrorInfo { reason, domain: "frontalis" }` in `grpc-status-details-bin`.
//! An error without it was made by the transport, and trying again may help.

mod details;

use std::{collections::BTreeMap, error::Error as _, time::Duration};

use tonic::Code;

use crate::connection::failure::{self, Lasting};

/// A call or stream that failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message} ({}{code:?})", reason.as_ref().map(|it| format!("{it}, ")).unwrap_or_default())]
pub struct ClientError {
    /// The gRPC status code.
    pub code: Code,
    /// The server's own name for the refusal: `SESSION_OWNED`, `UNITS_SUSPECT`; or why no connection can be made until
    /// somebody changes something: `TLS_UNTRUSTED`, `TLS_NAME`. Absent when the transport failed.
    pub reason: Option<String>,
    /// What happened, in the server's words.
    pub message: String,
    /// Figures the server added: limits, first and last available position.
    pub metadata: BTreeMap<String, String>,
    /// How long the server asked to wait.
    pub retry_after: Option<Duration>,
}

impl ClientError {
    /// An error that the client itself found.
    pub fn local(code: Code, message: impl Into<String>) -> Self {
        Self {
            code,
            reason: None,
            message: message.into(),
            metadata: BTreeMap::new(),
            retry_after: None,
        }
    }

    /// Whether the server gave this reason.
    pub fn has_reason(&self, reason: &str) -> bool {
        self.reason.as_deref() == Some(reason)
    }

    /// Whether the same call may succeed later without anybody changing anything.
    ///
    /// `PUBLISHER_FENCED` never does (CONTRACTS D-29): somebody else publishes on purpose.
    pub fn is_transient(&self) -> bool {
        match self.code {
            Code::Unavailable => true,
            Code::ResourceExhausted => self.reason.is_none() || self.retry_after.is_some(),
            Code::Unknown | Code::Internal | Code::Cancelled | Code::DeadlineExceeded => {
                self.reason.is_none()
            }
            _ => false,
        }
    }

    /// What a person can do about it.
    pub fn advice(&self) -> Option<&'static str> {
        match self.reason.as_deref() {
            Some("NAME") => self.advice_on_name(),
            Some(reason) => advice_on(reason).or_else(|| advice_on_code(self.code)),
            None if self.code == Code::Unavailable => {
                Some("check that the server runs and that --server names its address")
            }
            None => advice_on_code(self.code),
        }
    }

    /// Names are of several kinds, told by the refused field.
    fn advice_on_name(&self) -> Option<&'static str> {
        match self.metadata.get("field").map(String::as_str) {
            Some("display_name") => {
                Some("--display-name takes at most 128 characters of plain text, in one line")
            }
            Some("session_id" | "actor_id" | "actor" | "session" | "start.session" | "name") => {
                Some("ids are 1 to 63 of a-z, 0-9, - and _, the first a letter or digit")
            }
            _ => None,
        }
    }
}

/// What a person can do about every refusal of this code.
fn advice_on_code(code: Code) -> Option<&'static str> {
    Some(match code {
        Code::Unauthenticated => {
            "the token is missing, wrong, expired or revoked: `frontalis login`, --token-file FILE or FRONTALIS_TOKEN give another"
        }
        Code::PermissionDenied => {
            "your token does not allow this: `frontalis server` shows your role and sessions, an operator can make another token"
        }
        _ => return None,
    })
}

/// What a person can do about a refusal, a rejected frame or a failed alignment of this reason.
pub fn advice_on(reason: &str) -> Option<&'static str> {
    Some(match reason {
        "SESSION_OWNED" => {
            "another publisher holds the session: wait until it stops, or give --takeover"
        }
        "PUBLISHER_FENCED" => {
            "another publisher took the session over; this one stopped and does not come back by itself"
        }
        "UNITS_SUSPECT" => {
            "the coordinates are in another unit than declared: correct the file's Units field or the rig's export"
        }
        "OUT_OF_VOLUME" => {
            "coordinates lie beyond 10 m: the unit may be wrong, correct the file's Units field or the rig's export"
        }
        "MIRRORED" => "one axis of the capture is flipped: correct the rig's axes or the export",
        "NEUTRAL_INCOMPLETE" => {
            "let the actor hold a neutral face with all markers seen, then `frontalis session recenter`"
        }
        "QUIETEST_FRAMES" | "NOT_ALIGNED" => {
            "publish more frames, some of them with a relaxed face; or recenter on the next frames, without --quietest"
        }
        "DEGENERATE_POSE" => "the markers lie on a line or in one place: check the labelling",
        "UNKNOWN_MARKERS" => {
            "no marker name is one of the actor's: `frontalis actor show ID` lists them"
        }
        "FRAME_CONFLICT" | "LATE" => {
            "frames of these numbers came before: give --renumber, or use a new session"
        }
        "FRAME_NUMBER" => "frame numbers start at 1: give --renumber",
        "TOO_MANY_REJECTS" => "the first rejected frame above says what is wrong with the file",
        "BASIS_RANK" => {
            "some muscles move the markers alike: correct the basis, or accept it with --regularize"
        }
        "DRAINING" => "the server is shutting down; try again when it is back",
        "ACTOR_HAS_TAKES" => "`frontalis actor delete --with-takes` erases them too",
        "ACTOR_IN_USE" => "end its sessions first: `frontalis session list` shows them",
        "SESSION_EXISTS" => "end it with `frontalis session end ID`, or choose another --id",
        "ACTOR" => "`frontalis actor list` shows what there is",
        "SESSION" => "`frontalis session list` shows what there is",
        "SUBSCRIBERS" => {
            "close another subscriber (`frontalis session show ID` lists them), or raise the limit"
        }
        "SUBSCRIBER_LAGGED" => "read faster, or watch without --every-frame",
        failure::UNTRUSTED => "--ca-cert FILE names the authority that issued the certificate",
        failure::NAME => "--server has to use a name or address that the certificate holds",
        failure::EXPIRED => "the certificate needs renewal, or a clock is wrong",
        failure::NOT_SPOKEN => {
            "--server with http:// instead of https://, if the server has no TLS"
        }
        failure::CLIENT_CERTIFICATE => {
            "--client-cert FILE and --client-key FILE give a certificate that the server trusts"
        }
        "DISK_LOW" => "free disk space on the server",
        _ => return None,
    })
}

impl From<tonic::Status> for ClientError {
    fn from(status: tonic::Status) -> Self {
        if status.details().is_empty()
            && let Some(lasting) = failure::lasting(&status)
        {
            return lasting.into();
        }
        let details = details::decode(status.details());
        Self {
            code: status.code(),
            reason: details.reason,
            message: message_of(&status),
            metadata: details.metadata,
            retry_after: details.retry_after,
        }
    }
}

/// The server's words; of a failed transport what lies below it.
fn message_of(status: &tonic::Status) -> String {
    match (status.message(), status.source()) {
        ("", None) => status.code().description().to_owned(),
        ("" | "transport error", Some(cause)) => transport_text(cause),
        (message, _) => message.to_owned(),
    }
}

fn transport_text(error: &dyn std::error::Error) -> String {
    let text = chain(error);
    text.strip_prefix("transport error: ")
        .map_or(text.clone(), str::to_owned)
}

impl From<tonic::transport::Error> for ClientError {
    fn from(error: tonic::transport::Error) -> Self {
        if let Some(lasting) = failure::lasting(&error) {
            return lasting.into();
        }
        Self::local(Code::Unavailable, transport_text(&error))
    }
}

impl From<Lasting> for ClientError {
    fn from(lasting: Lasting) -> Self {
        Self {
            reason: Some(lasting.reason.to_owned()),
            ..Self::local(Code::FailedPrecondition, lasting.message)
        }
    }
}

/// The error and its causes, outermost first, without repeating a cause that the outer message already holds.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        let inner_text = inner.to_string();
        if !text.contains(&inner_text) {
            text = format!("{text}: {inner_text}");
        }
        cause = inner.source();
    }
    text
}

/// A status as a server refuses with it.
#[cfg(test)]
pub(crate) fn refusal_for_tests(code: Code, reason: &str) -> tonic::Status {
    let details = details::encode_for_tests(reason, &[], None);
    tonic::Status::with_details(code, "refused", details.into())
}

/// A limit: a status that asks to wait.
#[cfg(test)]
pub(crate) fn refusal_to_wait_for_tests(code: Code, reason: &str, millis: u64) -> tonic::Status {
    let details = details::encode_for_tests(reason, &[], Some(millis));
    tonic::Status::with_details(code, "refused", details.into())
}

#[cfg(test)]
mod tests {
    use tonic::Status;

    use super::*;

    #[test]
    fn a_refusal_shows_its_message_reason_figures_and_wait() {
        let bytes = details::encode_for_tests("SESSION_OWNED", &[("owner", "rig-2")], Some(1_500));
        let status = Status::with_details(
            Code::FailedPrecondition,
            "session take-1 is held by rig-2",
            bytes.into(),
        );
        let error = ClientError::from(status);
        assert_eq!(error.reason.as_deref(), Some("SESSION_OWNED"));
        assert_eq!(error.metadata["owner"], "rig-2");
        assert_eq!(error.retry_after, Some(Duration::from_millis(1_500)));
        assert_eq!(
            error.to_string(),
            "session take-1 is held by rig-2 (SESSION_OWNED, FailedPrecondition)"
        );
        assert!(error.advice().is_some_and(|it| it.contains("--takeover")));
        assert!(!error.is_transient());
    }

    #[test]
    fn advice_on_a_refused_name_is_for_its_kind() {
        let advice = |field: &str| {
            let details = details::encode_for_tests("NAME", &[("field", field)], None);
            let status = Status::with_details(Code::InvalidArgument, "", details.into());
            ClientError::from(status).advice()
        };
        assert!(advice("session_id").is_some_and(|it| it.contains("ids are")));
        assert!(advice("display_name").is_some_and(|it| !it.contains("id")));
        assert_eq!(advice("start.marker_names"), None);
    }

    #[test]
    fn details_that_are_not_protobuf_leave_code_and_message() {
        let status = Status::with_details(Code::Internal, "broken", vec![0xff; 7].into());
        let error = ClientError::from(status);
        assert_eq!(error.reason, None);
        assert_eq!(error.message, "broken");
    }

    #[test]
    fn only_a_failure_that_time_can_heal_is_transient() {
        let check = |code: Code, reason: Option<&str>, expected: bool| {
            let error = ClientError {
                reason: reason.map(str::to_owned),
                ..ClientError::local(code, "")
            };
            assert_eq!(error.is_transient(), expected, "{code:?} {reason:?}");
        };
        check(Code::Unavailable, None, true);
        check(Code::Unavailable, Some("DRAINING"), true);
        check(Code::Unknown, None, true);
        check(Code::Aborted, Some("PUBLISHER_FENCED"), false);
        check(Code::FailedPrecondition, Some("MIRRORED"), false);
        check(Code::Internal, Some("PANIC"), false);
        check(Code::NotFound, Some("SESSION"), false);
        check(Code::InvalidArgument, None, false);
    }
}
