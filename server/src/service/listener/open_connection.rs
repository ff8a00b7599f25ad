//! A connection that counts as open, also after it was upgraded and its first task is gone.
//!
//! Every request carries it; who takes the connection over keeps it (CONTRACTS O-1, O-13).

use std::sync::Arc;

use tokio_util::task::task_tracker::TaskTrackerToken;

use super::admission::Permit;

/// Counted and waited for until the last clone is gone.
#[derive(Clone)]
pub struct OpenConnection(#[expect(dead_code, reason = "held for its end")] Arc<Held>);

struct Held {
    _permit: Permit,
    _token: TaskTrackerToken,
}

impl OpenConnection {
    pub(super) fn new(permit: Permit, token: TaskTrackerToken) -> Self {
        Self(Arc::new(Held {
            _permit: permit,
            _token: token,
        }))
    }
}
