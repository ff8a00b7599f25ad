//! What happens to a session between two frames, in the order of the frames around it.

use std::sync::Arc;

use frontalis_analysis::{
    analyzer::{NeutralSource, QuietestError},
    face::actor::Actor,
};
use tokio::sync::oneshot;

use super::{
    mailbox::Mailbox,
    recording::{Recorded, RecordingTap},
    settings::{SessionSettings, StreamShape},
};

/// A request that waits in the session's queue.
#[derive(Debug)]
pub(super) enum Command {
    /// The frames that follow come from this publisher.
    Source(Source),
    /// The publisher closed its side; its mailbox is told when its frames are done.
    Finish(Arc<Mailbox>),
    /// A recording begins with the frames that follow.
    Record(RecordingTap),
    /// Settings or actor change.
    Update {
        settings: SessionSettings,
        actor: Arc<Actor>,
        actor_revision: u32,
        done: oneshot::Sender<()>,
    },
    /// Another neutral face.
    Recenter {
        source: NeutralSource,
        done: oneshot::Sender<Result<(), QuietestError>>,
    },
    /// Nothing follows.
    End,
}

impl Command {
    /// The command as a recording holds it, if it changes how frames are solved.
    pub(super) fn recorded(&self) -> Option<Recorded> {
        match self {
            Self::Update {
                settings,
                actor_revision,
                ..
            } => Some(Recorded::Change {
                settings: Box::new(settings.clone()),
                actor_revision: *actor_revision,
            }),
            Self::Recenter { source, .. } => Some(Recorded::Recenter(*source)),
            Self::Source(_) | Self::Finish(_) | Self::Record(_) | Self::End => None,
        }
    }
}

/// Where frames come from.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) shape: StreamShape,
    pub(super) rate_hz: f64,
    pub(super) mailbox: Arc<Mailbox>,
}
