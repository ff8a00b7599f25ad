//! What a session tells the publisher of its frames after it took them.

use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use super::{frame::Rejection, publication::PublishEnd};

/// Most rejections that wait to be told; the rest stay counted in the status.
const MAX_WAITING_REJECTIONS: usize = 256;

/// Belongs to one publication; written by the session, read by the publication's stream.
#[derive(Debug)]
pub(super) struct Mailbox {
    epoch: u64,
    news: Notify,
    mail: Mutex<Mail>,
}

#[derive(Debug, Default)]
struct Mail {
    end: Option<PublishEnd>,
    is_finished: bool,
    rejections: Vec<Rejection>,
}

impl Mailbox {
    pub(super) fn new(epoch: u64) -> Self {
        Self {
            epoch,
            news: Notify::new(),
            mail: Mutex::default(),
        }
    }

    pub(super) fn epoch(&self) -> u64 {
        self.epoch
    }

    /// Ends the publication; the first reason stands.
    pub(super) fn end(&self, end: PublishEnd) {
        self.mail().end.get_or_insert(end);
        self.wake();
    }

    pub(super) fn ended(&self) -> Option<PublishEnd> {
        self.mail().end.clone()
    }

    /// All frames of the publication are done.
    pub(super) fn finish(&self) {
        self.mail().is_finished = true;
        self.wake();
    }

    pub(super) fn is_finished(&self) -> bool {
        self.mail().is_finished
    }

    pub(super) fn reject(&self, rejection: Rejection) {
        let mut mail = self.mail();
        if mail.rejections.len() < MAX_WAITING_REJECTIONS {
            mail.rejections.push(rejection);
        }
        drop(mail);
        self.wake();
    }

    pub(super) fn take_rejections(&self) -> Vec<Rejection> {
        std::mem::take(&mut self.mail().rejections)
    }

    /// Lets the publication's stream look again.
    pub(super) fn wake(&self) {
        self.news.notify_one();
    }

    /// Waits until there may be news. A wake between two waits is not lost.
    pub(super) async fn woken(&self) {
        self.news.notified().await;
    }

    fn mail(&self) -> MutexGuard<'_, Mail> {
        self.mail.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
