//! The first message of a stream, which must be its start (BAD_INPUT E8), and for which nobody waits for ever.

use std::time::Duration;

use futures::{Stream, StreamExt as _};
use tokio::time::timeout;
use tonic::{Code, Status};

use super::status::refuse;
use crate::session::{SessionError, SessionRegistry};

/// How long a stream may wait for its first message.
const START_TIMEOUT: Duration = Duration::from_secs(10);

/// Waits for the first message of `requests`.
///
/// # Errors
///
/// `START_TIMEOUT` after 10 s, `PROTOCOL_ORDER` when the stream ends before, `DRAINING` when the server does, or what the
/// stream itself says.
pub(super) async fn first_message<S, M>(
    requests: &mut S,
    registry: &SessionRegistry,
) -> Result<M, Status>
where
    S: Stream<Item = Result<M, Status>> + Unpin,
{
    let first = tokio::select! {
        biased;
        first = timeout(START_TIMEOUT, requests.next()) => first,
        () = registry.draining() => return Err(SessionError::Draining.into()),
    };
    let first = first.map_err(|_elapsed| {
        let message = "no start within 10 s";
        refuse(Code::DeadlineExceeded, "START_TIMEOUT", message)
    })?;
    first.ok_or_else(|| protocol_order("the stream ended before its start"))?
}

/// A message that is not due.
pub(super) fn protocol_order(message: &str) -> Status {
    refuse(Code::FailedPrecondition, "PROTOCOL_ORDER", message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::service::grpc::stage::{Stage, assert_refused};

    #[tokio::test(start_paused = true)]
    async fn streams_that_have_not_begun_end_with_the_server() {
        let stage = Stage::new().await;
        let mut publisher = stage.silent_publisher();
        let mut renderer = stage.silent_renderer();
        stage.registry.drain().await;
        assert_refused(&publisher.end().await, Code::Unavailable, "DRAINING");
        assert_refused(&renderer.end().await.1, Code::Unavailable, "DRAINING");
    }

    #[tokio::test(start_paused = true)]
    async fn streams_that_say_nothing_end_after_ten_seconds() {
        let stage = Stage::new().await;
        for end in [
            stage.silent_publisher().end().await,
            stage.silent_renderer().end().await.1,
        ] {
            assert_refused(&end, Code::DeadlineExceeded, "START_TIMEOUT");
        }
    }
}
