//! The reason of a gRPC error: `google.rpc.ErrorInfo` from `grpc-status-details-bin`.

use prost::Message;
use tonic::{Code, Status};

/// A refused call, as a client sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The gRPC code.
    pub code: Code,
    /// `ErrorInfo.reason`; empty when the answer carries none.
    pub reason: String,
    /// `ErrorInfo.domain`.
    pub domain: String,
    /// The sentence for a person.
    pub message: String,
}

impl Problem {
    /// Reads what a status says.
    pub fn of(status: &Status) -> Self {
        let info = error_info(status.details()).unwrap_or_default();
        Self {
            code: status.code(),
            reason: info.reason,
            domain: info.domain,
            message: status.message().to_owned(),
        }
    }
}

/// Fails unless `status` refuses with this code and reason, in the service's domain.
#[track_caller]
pub fn assert_refused(status: &Status, code: Code, reason: &str) {
    let problem = Problem::of(status);
    assert_eq!(
        (
            problem.code,
            problem.reason.as_str(),
            problem.domain.as_str()
        ),
        (code, reason, "frontalis"),
        "{}",
        problem.message
    );
    assert!(!problem.message.is_empty(), "a refusal says what and where");
}

#[derive(Clone, PartialEq, Message)]
struct RpcStatus {
    #[prost(message, repeated, tag = "3")]
    details: Vec<prost_types::Any>,
}

#[derive(Clone, PartialEq, Message)]
struct ErrorInfo {
    #[prost(string, tag = "1")]
    reason: String,
    #[prost(string, tag = "2")]
    domain: String,
}

fn error_info(details: &[u8]) -> Option<ErrorInfo> {
    RpcStatus::decode(details)
        .ok()?
        .details
        .iter()
        .find(|it| it.type_url.ends_with("/google.rpc.ErrorInfo"))
        .and_then(|it| ErrorInfo::decode(it.value.as_slice()).ok())
}
