//! Fan-out of one session's curves to any number of subscribers.
//!
//! The hub keeps a bounded window of what was published, and every subscriber pulls from it with its own cursor.
//! Nothing is queued per subscriber, and publishing never waits for one (CONTRACTS D-14 to D-20).
//! The hub knows samples and subscribers, not how samples are made.

mod budget;
mod credit;
mod curve_hub;
mod quota;
mod sample;
mod subscription;
mod times;
mod window;

pub use budget::BufferBudget;
pub use curve_hub::{Closing, CurveHub, HubLimits, Page};
pub use quota::{SubscriberQuota, SubscriberStatus};
pub use sample::{Gap, GapCause, Outgoing, PublishedSample, SampleTag, SessionState, StreamState};
pub use subscription::{
    Delivered, Delivery, MAX_CREDITS, StartAt, SubscribeError, SubscribeSpec, Subscription, Update,
};
pub use times::Latency;
pub(crate) use times::Times;
pub use window::{LostRange, RangeError};
