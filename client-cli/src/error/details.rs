//! `google.rpc.Status` with `ErrorInfo` and `RetryInfo`, as `grpc-status-details-bin` carries them.
//!
//! The three messages are public and frozen (googleapis, `google/rpc/status.proto` and `error_details.proto`).

use std::{collections::BTreeMap, time::Duration};

use prost::Message;

/// What was found in the details of a status.
#[derive(Debug, Default)]
pub(super) struct Details {
    pub reason: Option<String>,
    pub metadata: BTreeMap<String, String>,
    pub retry_after: Option<Duration>,
}

#[derive(Clone, PartialEq, Message)]
struct RpcStatus {
    #[prost(int32, tag = "1")]
    code: i32,
    #[prost(string, tag = "2")]
    message: String,
    #[prost(message, repeated, tag = "3")]
    details: Vec<prost_types::Any>,
}

#[derive(Clone, PartialEq, Message)]
struct ErrorInfo {
    #[prost(string, tag = "1")]
    reason: String,
    #[prost(string, tag = "2")]
    domain: String,
    #[prost(btree_map = "string, string", tag = "3")]
    metadata: BTreeMap<String, String>,
}

#[derive(Clone, PartialEq, Message)]
struct RetryInfo {
    #[prost(message, optional, tag = "1")]
    retry_delay: Option<prost_types::Duration>,
}

/// Reads what it can; anything unreadable is left out, since the status itself already says what failed.
pub(super) fn decode(bytes: &[u8]) -> Details {
    let mut found = Details::default();
    let Ok(status) = RpcStatus::decode(bytes) else {
        return found;
    };
    for any in status.details {
        match any.type_url.rsplit('/').next() {
            Some("google.rpc.ErrorInfo") => {
                if let Ok(info) = ErrorInfo::decode(any.value.as_slice()) {
                    found.reason = Some(info.reason);
                    found.metadata = info.metadata;
                }
            }
            Some("google.rpc.RetryInfo") => {
                found.retry_after = RetryInfo::decode(any.value.as_slice())
                    .ok()
                    .and_then(|it| it.retry_delay)
                    .and_then(|it| Duration::try_from(it).ok());
            }
            _ => {}
        }
    }
    found
}

/// A details header as a server writes it.
#[cfg(test)]
pub(crate) fn encode_for_tests(
    reason: &str,
    metadata: &[(&str, &str)],
    retry_millis: Option<u64>,
) -> Vec<u8> {
    let any = |name: &str, value: Vec<u8>| prost_types::Any {
        type_url: format!("type.googleapis.com/google.rpc.{name}"),
        value,
    };
    let info = ErrorInfo {
        reason: reason.to_owned(),
        domain: "frontalis".to_owned(),
        metadata: metadata
            .iter()
            .map(|(key, value)| ((*key).to_owned(), (*value).to_owned()))
            .collect(),
    };
    let mut details = vec![any("ErrorInfo", info.encode_to_vec())];
    if let Some(millis) = retry_millis {
        let delay = prost_types::Duration::try_from(Duration::from_millis(millis)).unwrap();
        let retry = RetryInfo {
            retry_delay: Some(delay),
        };
        details.push(any("RetryInfo", retry.encode_to_vec()));
    }
    RpcStatus {
        code: 9,
        message: String::new(),
        details,
    }
    .encode_to_vec()
}
