//! The description of the HTTP door, `/openapi.json`: made from the routes and from the descriptors of the messages.

mod messages;
mod refusals;

pub(super) use messages::enum_names;
pub(super) use refusals::{BodyRefusals, ObjectRefusals, RangeRefusals, Refusals, StateRefusals};
