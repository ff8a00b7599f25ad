//! How what was read from files is read again without a restart (CONTRACTS O-15, S-2): on SIGHUP, and when a file changed.
//!
//! Whoever holds such files waits on a [`Reloads`] and looks at them; what does not fit keeps the old state.

use std::time::Duration;

use tokio::{sync::watch, time::timeout};

/// How often files are looked at without being asked to.
const LOOK_INTERVAL: Duration = Duration::from_secs(2);

/// Asks everybody to look at their files now; cheap to clone, clones share the listeners.
#[derive(Clone, Debug, Default)]
pub struct Reload(watch::Sender<u64>);

/// One listener's requests.
pub struct Reloads(watch::Receiver<u64>);

/// Why it is time to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occasion {
    /// Somebody asked for it.
    Asked,
    /// It has been a while.
    Routine,
}

impl Reload {
    /// Asks for it.
    pub fn ask(&self) {
        self.0.send_modify(|n| *n = n.wrapping_add(1));
    }

    /// A listener that hears what is asked from now on.
    pub fn listen(&self) -> Reloads {
        Reloads(self.0.subscribe())
    }
}

impl Reloads {
    /// Waits until it is time to look.
    pub async fn next(&mut self) -> Occasion {
        match timeout(LOOK_INTERVAL, self.0.changed()).await {
            Ok(Ok(())) => Occasion::Asked,
            // Nobody can ask any more; files still change.
            Ok(Err(_)) => {
                tokio::time::sleep(LOOK_INTERVAL).await;
                Occasion::Routine
            }
            Err(_) => Occasion::Routine,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test(start_paused = true)]
    async fn it_is_time_to_look_when_asked_and_every_few_seconds() {
        let reload = Reload::default();
        let mut reloads = reload.listen();
        reload.ask();
        reload.ask();
        assert_eq!(reloads.next().await, Occasion::Asked);
        let before = tokio::time::Instant::now();
        assert_eq!(reloads.next().await, Occasion::Routine);
        assert_eq!(before.elapsed(), LOOK_INTERVAL);
        drop(reload);
        assert_eq!(reloads.next().await, Occasion::Routine);
        assert_eq!(before.elapsed(), LOOK_INTERVAL * 2);
    }
}
