//! Where an error becomes a gRPC status.
//!
//! Every status carries `google.rpc.ErrorInfo { reason, domain: "frontalis" }` in `grpc-status-details-bin`, and
//! `google.rpc.RetryInfo` where waiting helps (BAD_INPUT, "Status mapping").

use std::time::Duration;

use bytes::Bytes;
use prost::Message as _;
use tonic::{Code, Status};

/// Domain of every `ErrorInfo`.
const DOMAIN: &str = "frontalis";

/// A status with its reason.
pub fn refuse(code: Code, reason: &'static str, message: impl Into<String>) -> Status {
    Refusal::new(code, reason, message).into_status()
}

/// A refusal in the making: code, reason and message, and what else the client may use.
pub struct Refusal {
    code: Code,
    reason: &'static str,
    message: String,
    metadata: Vec<(String, String)>,
    retry_after: Option<Duration>,
}

impl Refusal {
    /// A refusal without metadata or retry delay.
    pub fn new(code: Code, reason: &'static str, message: impl Into<String>) -> Self {
        Self {
            code,
            reason,
            message: message.into(),
            metadata: Vec::new(),
            retry_after: None,
        }
    }

    /// Adds an entry to `ErrorInfo.metadata`: figures a program can read.
    #[must_use]
    pub fn with(mut self, key: &str, value: &impl ToString) -> Self {
        self.metadata.push((key.to_owned(), value.to_string()));
        self
    }

    /// Adds a `RetryInfo`.
    #[must_use]
    pub fn retry_after(mut self, delay: Duration) -> Self {
        self.retry_after = Some(delay);
        self
    }

    /// The status that goes out.
    pub fn into_status(self) -> Status {
        let info = ErrorInfo {
            reason: self.reason.to_owned(),
            domain: DOMAIN.to_owned(),
            metadata: self.metadata.into_iter().collect(),
        };
        let mut details = vec![packed("google.rpc.ErrorInfo", &info)];
        if let Some(delay) = self.retry_after {
            details.push(packed("google.rpc.RetryInfo", &RetryInfo::new(delay)));
        }
        let status = RpcStatus {
            code: self.code as i32,
            message: self.message.clone(),
            details,
        };
        let details = Bytes::from(status.encode_to_vec());
        Status::with_details(self.code, self.message, details)
    }
}

/// The reason in a status, when it carries one of ours.
pub fn reason_of(status: &Status) -> Option<String> {
    Some(info_of(status)?.reason)
}

/// The figures in a status, by key.
pub fn metadata_of(status: &Status) -> Vec<(String, String)> {
    info_of(status).map_or_else(Vec::new, |info| info.metadata.into_iter().collect())
}

/// After which time trying again makes sense, when the status says so.
pub fn retry_after_of(status: &Status) -> Option<Duration> {
    let info: RetryInfo = detail_of(status, "/google.rpc.RetryInfo")?;
    info.retry_delay?.try_into().ok()
}

fn info_of(status: &Status) -> Option<ErrorInfo> {
    detail_of(status, "/google.rpc.ErrorInfo")
}

fn detail_of<M: prost::Message + Default>(status: &Status, name: &str) -> Option<M> {
    let rpc = RpcStatus::decode(status.details()).ok()?;
    let detail = rpc.details.iter().find(|it| it.type_url.ends_with(name))?;
    M::decode(detail.value.as_slice()).ok()
}

fn packed(name: &str, message: &impl prost::Message) -> prost_types::Any {
    prost_types::Any {
        type_url: format!("type.googleapis.com/{name}"),
        value: message.encode_to_vec(),
    }
}

/// `google.rpc.Status`.
#[derive(Clone, PartialEq, prost::Message)]
struct RpcStatus {
    #[prost(int32, tag = "1")]
    code: i32,
    #[prost(string, tag = "2")]
    message: String,
    #[prost(message, repeated, tag = "3")]
    details: Vec<prost_types::Any>,
}

/// `google.rpc.ErrorInfo`.
#[derive(Clone, PartialEq, prost::Message)]
struct ErrorInfo {
    #[prost(string, tag = "1")]
    reason: String,
    #[prost(string, tag = "2")]
    domain: String,
    #[prost(btree_map = "string, string", tag = "3")]
    metadata: std::collections::BTreeMap<String, String>,
}

/// `google.rpc.RetryInfo`.
#[derive(Clone, Copy, PartialEq, prost::Message)]
struct RetryInfo {
    #[prost(message, optional, tag = "1")]
    retry_delay: Option<prost_types::Duration>,
}

impl RetryInfo {
    fn new(delay: Duration) -> Self {
        Self {
            retry_delay: prost_types::Duration::try_from(delay).ok(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_carries_its_reason() {
        let status = Refusal::new(Code::OutOfRange, "NEW_RUN", "the run is 4")
            .with("run", &4)
            .retry_after(Duration::from_millis(1500))
            .into_status();
        assert_eq!(status.code(), Code::OutOfRange);
        assert_eq!(status.message(), "the run is 4");
        assert_eq!(reason_of(&status).as_deref(), Some("NEW_RUN"));
        assert_eq!(retry_after_of(&status), Some(Duration::from_millis(1500)));
        assert_eq!(retry_after_of(&Status::internal("")), None);
    }
}
