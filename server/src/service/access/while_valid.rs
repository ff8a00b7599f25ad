//! Streams end when what proved their caller no longer does (CONTRACTS S-3, BAD_INPUT I4).

use std::{
    pin::Pin,
    sync::Arc,
    task::{Context, Poll},
    time::Duration,
};

use futures::{
    Stream, StreamExt as _,
    future::{BoxFuture, FutureExt as _},
    stream::{self, BoxStream},
};
use tonic::Status;

use super::{
    Caller,
    caller::{Known, unauthenticated},
    time_left,
};

/// Longest time until the wall clock is looked at again, which may have been set; a third of what is promised.
const LOOK_INTERVAL: Duration = Duration::from_secs(10);

impl Caller {
    /// The stream until the caller's token expires, is revoked or loses rights; then `UNAUTHENTICATED` and the end.
    pub fn while_valid<T, S>(&self, stream: S) -> BoxStream<'static, Result<T, Status>>
    where
        T: Send + 'static,
        S: Stream<Item = Result<T, Status>> + Send + 'static,
    {
        let Some(known) = self.as_known() else {
            return stream.boxed();
        };
        let watched = Watched {
            over: Some(over(Arc::clone(known)).boxed()),
            stream: stream.boxed(),
        };
        watched.boxed()
    }
}

/// A stream and what ends it. It keeps what it holds until it is dropped, as the stream alone would.
struct Watched<T> {
    /// None: it is over.
    over: Option<BoxFuture<'static, ()>>,
    stream: BoxStream<'static, Result<T, Status>>,
}

impl<T: Send + 'static> Stream for Watched<T> {
    type Item = Result<T, Status>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        let Some(over) = &mut self.over else {
            return Poll::Ready(None);
        };
        if over.poll_unpin(context).is_ready() {
            self.over = None;
            self.stream = stream::empty().boxed();
            return Poll::Ready(Some(Err(unauthenticated())));
        }
        self.stream.poll_next_unpin(context)
    }
}

/// Waits until the principal's proof no longer stands.
async fn over(known: Arc<Known>) {
    let Known { principal, access } = &*known;
    let mut changes = access.changes();
    while access.still_stands(principal) {
        let left = time_left(principal).unwrap_or(LOOK_INTERVAL);
        let look = tokio::time::sleep(left.min(LOOK_INTERVAL));
        tokio::select! {
            () = look => {}
            // Gone only with the server.
            _changed = changes.changed() => {}
        }
    }
}
