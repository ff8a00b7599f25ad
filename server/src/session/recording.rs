//! What a session hands to whoever records it, in the order in which it came in.
//!
//! Frames are handed on when they are taken, before they are solved: what was shed is recorded too. Requests that change how
//! frames are solved stand among them where they take effect. The recorder reads from a bounded channel; a session that
//! finds it full takes no frame until there is room (CONTRACTS U-1).

use bytes::Bytes;
use frontalis_analysis::{
    analyzer::NeutralSource, marker_analysis::alignment::Alignment, timecode::Timecode,
};
use tokio::sync::mpsc;

use super::{
    clock_estimate::ClockReport,
    settings::{SessionSettings, StreamShape},
    starting_point::StartingPoint,
};
use crate::name::PublisherId;

/// Things that may wait for the recorder of one session.
const MAX_WAITING: usize = 1_024;

/// Room that is kept for what is no frame: at most one of each kind of request waits in the session itself.
const ROOM_FOR_REQUESTS: usize = 128;

/// One thing that came in.
#[derive(Clone, Debug)]
pub enum Recorded {
    /// A frame.
    Frame(RecordedFrame),
    /// The frames that follow come from this publisher.
    Source(RecordedSource),
    /// The frames that follow are solved so.
    Change {
        /// All settings.
        settings: Box<SessionSettings>,
        /// Revision of the actor.
        actor_revision: u32,
    },
    /// What the first frame of the recording is solved from. It comes when the session's task has done all that waited
    /// before, so that frames may come first.
    StartingPoint(Box<StartingPoint>),
    /// The publisher's clock stands so from now on.
    Clock(ClockReport),
    /// Another neutral face was asked for.
    Recenter(NeutralSource),
    /// The neutral face is known.
    Aligned {
        /// The alignment now in use.
        alignment: Box<Alignment>,
        /// The stream it holds for.
        shape: StreamShape,
        /// Revision of the actor whose mesh it binds to.
        actor_revision: u32,
    },
}

/// A frame as it came.
#[derive(Clone, Debug)]
pub struct RecordedFrame {
    /// The publisher's number.
    pub number: u64,
    /// When it was taken, server clock.
    pub received_nanos: i64,
    /// Time of day on the stage, when it was valid.
    pub timecode: Option<Timecode>,
    /// The message that brought it.
    pub sent: Bytes,
    /// Whether it came after a later one, and takes no part in the curves (CONTRACTS D-11).
    pub is_late: bool,
}

/// Who publishes, and how its frames are read.
#[derive(Clone, Debug)]
pub struct RecordedSource {
    /// What it calls itself.
    pub publisher: PublisherId,
    /// Number of its grant.
    pub epoch: u64,
    /// Unit and order of the coordinates.
    pub shape: StreamShape,
    /// Declared rate.
    pub rate_hz: f64,
    /// It published before the recording began.
    pub is_continued: bool,
    /// Another one than published before, with another clock.
    pub is_other: bool,
}

/// The session's end of a recording.
#[derive(Clone, Debug)]
pub(super) struct RecordingTap(mpsc::Sender<Recorded>);

/// The recorder's end.
pub struct RecordingFeed {
    /// First frame number that the session did not have when the recording began.
    pub next_frame: u64,
    /// Capture time of the frame before, where the next one's can be compared with it.
    pub last_capture_nanos: Option<i64>,
    /// Frames that came before, as far as they were asked for and are still there.
    pub pre_roll: Vec<RecordedFrame>,
    pub(super) received: mpsc::Receiver<Recorded>,
}

/// Both ends of a recording that begins with frame `next_frame`.
pub(super) fn recording(
    next_frame: u64,
    last_capture_nanos: Option<i64>,
) -> (RecordingTap, RecordingFeed) {
    let (sender, received) = mpsc::channel(MAX_WAITING);
    let feed = RecordingFeed {
        next_frame,
        last_capture_nanos,
        pre_roll: Vec::new(),
        received,
    };
    (RecordingTap(sender), feed)
}

impl RecordingTap {
    /// Whether a frame may be taken.
    pub(super) fn has_room(&self) -> bool {
        self.0.is_closed() || self.0.capacity() > ROOM_FOR_REQUESTS
    }

    /// Hands on what came in; a recorder that is gone misses it, and its take ends there.
    pub(super) fn record(&self, recorded: Recorded) {
        if let Err(mpsc::error::TrySendError::Full(lost)) = self.0.try_send(recorded) {
            tracing::error!(?lost, "the recorder has no room for a request");
        }
    }
}

impl RecordingFeed {
    /// First frame number of the recording, the pre-roll included.
    pub fn first_frame(&self) -> u64 {
        let first = self.pre_roll.first();
        first.map_or(self.next_frame, |it| it.number)
    }

    /// The next thing that came in; `None` when the recording is over. May be dropped while it waits.
    pub async fn next(&mut self) -> Option<Recorded> {
        self.received.recv().await
    }

    /// The next thing that came in, if it is there.
    pub fn next_now(&mut self) -> Option<Recorded> {
        self.received.try_recv().ok()
    }
}
