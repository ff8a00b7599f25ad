//! A subscriber of every frame that is served from elsewhere for a while: out of a recording, where the window has lost its
//! place (CONTRACTS D-17, D-18).
//!
//! It stays one of the session's subscribers: it is counted, hears every state, and what it was not given yet is known.

use std::sync::atomic::Ordering;

use tokio::time::Instant;

use super::{HEARTBEAT, Reading, Subscription, Update};
use crate::hub::{
    curve_hub::Closing,
    window::{Cursor, LostRange, RangeError},
};

impl Subscription {
    /// The next sample that it has not been given; 0 where the newest wins.
    pub fn next_sequence(&self) -> u64 {
        match &self.reading {
            Reading::Every(cursor) => cursor.sequence,
            Reading::Latest { .. } => 0,
        }
    }

    /// The last frame that it was told of.
    pub fn last_frame(&self) -> u64 {
        match &self.reading {
            Reading::Every(cursor) => cursor.last_frame,
            Reading::Latest { .. } => 0,
        }
    }

    /// Notes that it was given all before sample `next_sequence` and all frames through `last_frame`, `n_samples` of them now.
    pub fn given(&mut self, next_sequence: u64, last_frame: u64, n_samples: usize) {
        if let Reading::Every(cursor) = &mut self.reading {
            *cursor = Cursor::before_all(next_sequence, last_frame);
            let served_through = next_sequence.saturating_sub(1);
            self.tally
                .served_through
                .store(served_through, Ordering::Relaxed);
        }
        self.sent(n_samples);
    }

    /// Notes that it was given `n_samples` of another run.
    pub fn sent(&mut self, n_samples: usize) {
        self.tally
            .sent_samples
            .fetch_add(n_samples as u64, Ordering::Relaxed);
        self.last_delivery = Instant::now();
    }

    /// A state that it has not heard, to be told with what it is given.
    pub fn take_state(&mut self) -> Update {
        let hub = std::sync::Arc::clone(&self.hub);
        let state = self.unheard_state(&hub.shared());
        Update {
            state,
            ..Update::default()
        }
    }

    /// The sign of life that is due while it is given nothing.
    pub fn take_heartbeat(&mut self) -> Update {
        self.last_delivery = Instant::now();
        let unheard = self.take_state();
        if unheard.state.is_some() {
            return unheard;
        }
        self.heartbeat()
    }

    /// When it has to hear something.
    pub fn heartbeat_due(&self) -> Instant {
        self.last_delivery + HEARTBEAT
    }

    /// Goes on where it stands, from what the session keeps: no sample and no gap is missing, and none comes twice.
    ///
    /// # Errors
    ///
    /// [`RangeError::NotKept`] when the next sample is no longer kept.
    pub fn rejoin(&mut self) -> Result<(), RangeError> {
        let mut shared = self.hub.shared();
        if let Reading::Every(cursor) = &mut self.reading {
            *cursor = shared
                .window
                .seek_after(cursor.sequence, cursor.last_frame)?;
            shared.window.reader_at(cursor);
        }
        Ok(())
    }

    /// What lies between its place and the oldest sample that is kept; none when nothing does.
    pub fn missing(&self) -> Option<LostRange> {
        match &self.reading {
            Reading::Every(cursor) => self.hub.shared().window.read(cursor).err(),
            Reading::Latest { .. } => None,
        }
    }

    /// Whether the server shuts down: it is to come back later.
    pub fn is_draining(&self) -> bool {
        matches!(self.hub.shared().closing, Some(Closing::Draining))
    }
}
