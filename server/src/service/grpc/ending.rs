//! How streams end: publications and subscriptions as statuses.

use std::time::Duration;

use tonic::{Code, Status};

use super::{curves::MAX_PAUSE, status::Refusal};
use crate::{
    hub::{LostRange, SubscribeError},
    session::{PublishEnd, SessionError, alignment_problem},
};

/// When a subscriber may find room.
const RETRY_SUBSCRIBE_AFTER: Duration = Duration::from_secs(1);

impl From<PublishEnd> for Status {
    fn from(end: PublishEnd) -> Self {
        match end {
            PublishEnd::Fenced { epoch, current } => SessionError::Fenced { epoch, current }.into(),
            PublishEnd::NotAligned(error) => {
                let reason = alignment_problem(&error);
                Refusal::new(Code::FailedPrecondition, reason, error.to_string()).into_status()
            }
            PublishEnd::TooManyRejects { n_rejects } => {
                let message = format!("{n_rejects} frames in a row could not be used");
                Refusal::new(Code::InvalidArgument, "TOO_MANY_REJECTS", message)
                    .with("rejects", &n_rejects)
                    .into_status()
            }
            PublishEnd::Ended => SessionError::Ended.into(),
            PublishEnd::Failed { reason } => SessionError::Failed { reason }.into(),
            PublishEnd::Draining => SessionError::Draining.into(),
        }
    }
}

impl From<SubscribeError> for Status {
    fn from(error: SubscribeError) -> Self {
        let message = error.to_string();
        let full = |name: &str, limit: usize| {
            Refusal::new(Code::ResourceExhausted, "SUBSCRIBERS", message)
                .with("limit", &name)
                .with("value", &limit)
                .retry_after(RETRY_SUBSCRIBE_AFTER)
                .into_status()
        };
        match error {
            SubscribeError::SessionFull { limit } => full("limits.subscribers_per_session", limit),
            SubscribeError::ServerFull { limit } => full("limits.subscribers", limit),
            SubscribeError::Range(error) => error.into(),
        }
    }
}

/// A subscriber that fell out of the window.
pub(super) fn lagged(lost: &LostRange) -> Status {
    lost_range(lost, "are no longer kept")
}

/// A subscriber that took nothing while samples waited for it.
pub(super) fn blocked(lost: &LostRange) -> Status {
    let secs = MAX_PAUSE.as_secs();
    lost_range(lost, &format!("were not taken within {secs} s"))
}

fn lost_range(lost: &LostRange, what: &str) -> Status {
    let LostRange {
        first_sequence,
        last_sequence,
        first_frame,
        last_frame,
    } = lost;
    let message = format!(
        "samples {first_sequence} to {last_sequence} (frames {first_frame} to {last_frame}) {what}"
    );
    Refusal::new(Code::DataLoss, "SUBSCRIBER_LAGGED", message)
        .with("first_lost", first_sequence)
        .with("last_lost", last_sequence)
        .with("first_lost_frame", first_frame)
        .with("last_lost_frame", last_frame)
        .into_status()
}
