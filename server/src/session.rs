//! One actor's capture: frames in from at most one publisher, samples out through the hub.
//!
//! A session owns its time, its task and its queue; what happens to it cannot reach another session.
//! Other layers see [`SessionRegistry`], [`SessionHandle`] and [`Publication`], and read its [`SessionEvent`]s.

mod capture_order;
mod clock_estimate;
mod command;
mod error;
mod figures;
mod frame;
mod handle;
mod intake;
mod judging;
mod mailbox;
mod order;
mod panic_count;
mod passed;
mod pipeline;
mod pre_roll;
mod publication;
mod queue;
mod rate;
mod recording;
mod reenactment;
mod registry;
mod settings;
mod shared;
mod starting_point;
mod status;
mod tape;
mod worker;

pub use capture_order::CaptureOrder;
pub use clock_estimate::{ClockExchange, ClockReport};
pub use error::SessionError;
pub use frame::{IncomingFrame, Rejection};
pub use handle::SessionHandle;
pub use pre_roll::MAX_BYTES as PRE_ROLL_BYTES;
pub use publication::{
    Claim, Grant, Granted, Ingest, Offer, Publication, PublishEnd, Wait, Watermarks,
};
pub use recording::{Recorded, RecordedFrame, RecordedSource, RecordingFeed};
pub use reenactment::Reenactment;
pub use registry::SessionRegistry;
pub use settings::{
    RestoredAlignment, SessionEvent, SessionLimits, SessionSettings, SessionSpec, SessionUpdate,
    StreamShape,
};
pub use starting_point::{StartingPoint, StreamPoint};
pub use status::{AlignmentReport, ControlRange, SessionStatus, StageLatency};
pub use worker::alignment_problem;
