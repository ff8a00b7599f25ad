//! Streams end when what proved their caller no longer does (CONTRACTS S-3, BAD_INPUT I4).
//!
//! A task of its own watches the proof: what the stream holds is given back at that moment, also where the peer does not
//! read and nobody asks the stream for more.

use std::{
    pin::Pin,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    task::{Context, Poll, Waker},
    time::Duration,
};

use futures::{Stream, StreamExt as _, stream::BoxStream};
use tokio_util::task::AbortOnDropHandle;
use tonic::Status;

use super::{
    Caller,
    caller::{Standing, unauthenticated},
    time_left,
};
use crate::service::listener::PeerCertificate;

/// Longest time until the wall clock is looked at again, which may have been set, and a connection's certificate; a third
/// of what is promised.
const LOOK_INTERVAL: Duration = Duration::from_secs(10);

impl Caller {
    /// The stream until the caller's token expires, is revoked or loses rights, or the certificate of its connection is
    /// no longer believed; then `UNAUTHENTICATED` and the end.
    pub fn while_valid<T, S>(&self, stream: S) -> BoxStream<'static, Result<T, Status>>
    where
        T: Send + 'static,
        S: Stream<Item = Result<T, Status>> + Send + 'static,
    {
        let Some(standing) = self.standing() else {
            return stream.boxed();
        };
        let shared = Arc::new(Mutex::new(State::Open {
            stream: stream.boxed(),
            reader: None,
        }));
        let watched = Watched {
            state: Arc::clone(&shared),
            _watch: AbortOnDropHandle::new(tokio::spawn(watch(standing, shared))),
        };
        watched.boxed()
    }
}

/// A stream and the task that ends it.
struct Watched<T> {
    state: Arc<Mutex<State<T>>>,
    _watch: AbortOnDropHandle<()>,
}

enum State<T> {
    Open {
        stream: BoxStream<'static, Result<T, Status>>,
        /// Who waits for more.
        reader: Option<Waker>,
    },
    /// The proof is gone; the reader was not told yet.
    Cut,
    Over,
}

impl<T: Send + 'static> Stream for Watched<T> {
    type Item = Result<T, Status>;

    fn poll_next(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        let mut state = lock(&self.state);
        match &mut *state {
            State::Open { stream, reader } => {
                let polled = stream.poll_next_unpin(context);
                if polled.is_pending() {
                    *reader = Some(context.waker().clone());
                }
                polled
            }
            State::Cut => {
                *state = State::Over;
                Poll::Ready(Some(Err(unauthenticated())))
            }
            State::Over => Poll::Ready(None),
        }
    }
}

/// Cuts the stream when the proof no longer stands.
async fn watch<T>(standing: Standing, state: Arc<Mutex<State<T>>>) {
    over(&standing).await;
    let before = std::mem::replace(&mut *lock(&state), State::Cut);
    if let State::Open { stream, reader } = before {
        drop(stream);
        if let Some(reader) = reader {
            reader.wake();
        }
    }
}

fn lock<T>(state: &Mutex<State<T>>) -> MutexGuard<'_, State<T>> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Standing {
    fn holds(&self) -> bool {
        let known = self.known.as_ref();
        known.is_none_or(|it| it.access.still_stands(&it.principal))
            && self
                .certificate
                .as_ref()
                .is_none_or(PeerCertificate::is_believed)
    }

    fn time_left(&self) -> Option<Duration> {
        time_left(&self.known.as_ref()?.principal)
    }
}

/// Waits until the proof no longer stands.
async fn over(standing: &Standing) {
    let known = standing.known.as_ref();
    let mut changes = known.map(|it| it.access.changes());
    while standing.holds() {
        let left = standing.time_left().unwrap_or(LOOK_INTERVAL);
        let look = tokio::time::sleep(left.min(LOOK_INTERVAL));
        let changed = async {
            match &mut changes {
                // Gone only with the server.
                Some(changes) => drop(changes.changed().await),
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            () = look => {}
            () = changed => {}
        }
    }
}
