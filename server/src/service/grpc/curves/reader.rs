//! Who reads a stream, and takes nothing for too long (BAD_INPUT F4).
//!
//! A stream is asked for its next response once its connection has room for one. A reader of every frame that does not
//! ask for [`MAX_PAUSE`], while something waits for it, is blocked: a task of its own gives its place back at that
//! moment, and tells it what it lost when it asks again. A reader of the newest sample may pause for any time
//! (CONTRACTS D-15).

use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use tokio::time::{Instant, sleep_until};
use tokio_util::task::AbortOnDropHandle;

use crate::hub::{LostRange, Subscription};

/// A reader of every frame takes something at least so often.
pub(in crate::service) const MAX_PAUSE: Duration = Duration::from_secs(30);

/// A subscription and its one reader.
pub(super) struct Reader {
    place: Arc<Mutex<Place>>,
    _watch: Option<AbortOnDropHandle<()>>,
}

enum Place {
    /// The reader has all that it asked for.
    Idle {
        subscription: Box<Subscription>,
        since: Instant,
    },
    /// The reader waits.
    Asking,
    /// The reader was blocked.
    GivenUp(LostRange),
}

impl Reader {
    pub(super) fn new(subscription: Subscription) -> Self {
        let may_pause = !subscription.is_of_every_frame();
        let place = Arc::new(Mutex::new(Place::idle(Box::new(subscription))));
        let watch = || tokio::spawn(watch(Arc::clone(&place)));
        let watch = (!may_pause).then(|| AbortOnDropHandle::new(watch()));
        Self {
            place,
            _watch: watch,
        }
    }

    /// The subscription, to be asked and [put back](Self::put_back).
    ///
    /// # Errors
    ///
    /// What was lost, when the reader was blocked.
    pub(super) fn ask(&self) -> Result<Box<Subscription>, LostRange> {
        let mut place = lock(&self.place);
        match std::mem::replace(&mut *place, Place::Asking) {
            Place::Idle { subscription, .. } => Ok(subscription),
            Place::GivenUp(lost) => Err(lost),
            Place::Asking => unreachable!("a stream has one reader, which waits for its answer"),
        }
    }

    /// The reader was answered.
    pub(super) fn put_back(&self, subscription: Box<Subscription>) {
        *lock(&self.place) = Place::idle(subscription);
    }
}

impl Drop for Reader {
    /// The subscriber's place is free at once, not when the watching task has been told.
    fn drop(&mut self) {
        *lock(&self.place) = Place::Asking;
    }
}

impl Place {
    fn idle(subscription: Box<Subscription>) -> Self {
        Self::Idle {
            subscription,
            since: Instant::now(),
        }
    }

    /// When the reader may have been away for too long.
    fn due(&self) -> Instant {
        let now = Instant::now();
        let end = match self {
            Self::Idle { since, .. } => *since + MAX_PAUSE,
            Self::Asking | Self::GivenUp(_) => now,
        };
        // One that is away over time has all there is: what comes next waits as long for it.
        if end > now { end } else { now + MAX_PAUSE }
    }

    /// What a reader that is away for too long has lost.
    fn lost(&self) -> Option<LostRange> {
        match self {
            Self::Idle {
                subscription,
                since,
            } if since.elapsed() >= MAX_PAUSE => subscription.unsent(),
            _ => None,
        }
    }
}

/// Gives the place of a blocked reader back.
async fn watch(place: Arc<Mutex<Place>>) {
    loop {
        let due = lock(&place).due();
        sleep_until(due).await;
        let mut place = lock(&place);
        if let Some(lost) = place.lost() {
            *place = Place::GivenUp(lost);
            tracing::debug!(?lost, "a reader of every frame is blocked and given up");
            return;
        }
    }
}

fn lock(place: &Mutex<Place>) -> MutexGuard<'_, Place> {
    place.lock().unwrap_or_else(PoisonError::into_inner)
}
