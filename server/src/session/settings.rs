//! What a session is made from, may hold, and tells about itself.

use std::{
    sync::Arc,
    time::{Duration, SystemTime},
};

use frontalis_analysis::{
    analyzer::MarkerSettings, face::actor::Actor, marker_analysis::alignment::Alignment,
    space::LengthUnit,
};

use crate::name::{ActorId, SessionId};

/// What the creator of a session chose; the defaults are the service's.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionSettings {
    /// How the markers are analyzed.
    pub marker: MarkerSettings,
    /// Silence after which a live session is stale; `None`: three frame periods, at least 100 ms.
    pub stale_after: Option<Duration>,
    /// Silence after which another publisher may start without `takeover`; 10 s.
    pub publisher_timeout: Duration,
    /// Whether a run is recorded from its first frame on.
    pub record: bool,
    /// Whether that recording keeps raw images.
    pub record_images: bool,
}

impl Default for SessionSettings {
    fn default() -> Self {
        Self {
            marker: MarkerSettings::default(),
            stale_after: None,
            publisher_timeout: Duration::from_secs(10),
            record: false,
            record_images: false,
        }
    }
}

/// All that a session starts from.
#[derive(Clone, Debug)]
pub struct SessionSpec {
    /// Its id.
    pub id: SessionId,
    /// A person's name for it.
    pub display_name: String,
    /// The actor's id.
    pub actor_id: ActorId,
    /// The actor.
    pub actor: Arc<Actor>,
    /// Which revision of the actor that is.
    pub actor_revision: u32,
    /// What its creator chose.
    pub settings: SessionSettings,
    /// Number of this run, from 1; grows whenever samples are lost or the id is used again.
    pub run: u64,
    /// When it was created.
    pub create_time: SystemTime,
    /// The alignment of an earlier run.
    pub restored: Option<RestoredAlignment>,
}

/// An alignment that outlived its process, with the stream that it was found from.
#[derive(Clone, Debug, PartialEq)]
pub struct RestoredAlignment {
    /// The alignment.
    pub alignment: Alignment,
    /// It holds for streams of this shape only.
    pub shape: StreamShape,
}

/// What a publisher declares about its frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StreamShape {
    /// Unit of the coordinates.
    pub unit: LengthUnit,
    /// Markers in the order of the coordinates.
    pub marker_names: Vec<String>,
}

/// A change of a running session; what is `None` stays.
#[derive(Clone, Debug, Default)]
pub struct SessionUpdate {
    /// All settings, as they shall be.
    pub settings: Option<SessionSettings>,
    /// Another revision of the actor.
    pub actor: Option<(Arc<Actor>, u32)>,
}

/// What all sessions of a server may hold together and each.
#[derive(Clone, Debug)]
pub struct SessionLimits {
    /// Sessions that are not ended; 512.
    pub sessions: usize,
    /// Subscribers of one session; 1,024.
    pub subscribers_per_session: usize,
    /// Subscribers of all sessions; 4,096.
    pub subscribers: usize,
    /// Frames that wait for one session's solver; 512.
    pub waiting_frames: usize,
    /// Bytes of frames that wait for one session's solver; 16 MiB.
    pub waiting_bytes: usize,
    /// Frames a second that a session takes with live ingest; 250.
    pub live_rate_hz: f64,
    /// Samples of this last span are kept; 10 s. Also the window in which a resent frame is recognized.
    pub window_span: Duration,
    /// At least so many samples are kept; 4,096.
    pub window_samples: usize,
    /// Most bytes of samples that one session keeps; 16 MiB.
    pub window_bytes: usize,
    /// Waiting frames and kept samples of all sessions together; 4 GiB.
    pub buffer_bytes: usize,
}

impl Default for SessionLimits {
    fn default() -> Self {
        Self {
            sessions: 512,
            subscribers_per_session: 1_024,
            subscribers: 4_096,
            waiting_frames: 512,
            waiting_bytes: 16 << 20,
            live_rate_hz: 250.0,
            window_span: Duration::from_secs(10),
            window_samples: 4_096,
            window_bytes: 16 << 20,
            buffer_bytes: 4 << 30,
        }
    }
}

/// What a session tells the rest of the server, on a bounded channel. Nothing is dropped: the session waits.
#[derive(Clone, Debug)]
pub enum SessionEvent {
    /// The neutral face is known, or its bindings moved to another revision of the actor.
    Aligned {
        /// Which session.
        id: SessionId,
        /// In which run.
        run: u64,
        /// The alignment now in use.
        alignment: Box<Alignment>,
        /// The stream it holds for.
        shape: StreamShape,
        /// Revision of the actor whose mesh it binds to.
        actor_revision: u32,
    },
    /// The alignment was given up: the publisher's unit or marker names changed.
    AlignmentForgotten {
        /// Which session.
        id: SessionId,
        /// In which run.
        run: u64,
    },
    /// The session ended; its queue was finished first.
    Ended {
        /// Which session.
        id: SessionId,
        /// In which run.
        run: u64,
    },
    /// The session is broken.
    Failed {
        /// Which session.
        id: SessionId,
        /// In which run.
        run: u64,
        /// Why.
        reason: String,
    },
}
