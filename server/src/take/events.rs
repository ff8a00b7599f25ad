//! What happens to a session, as a take's file holds it.

use frontalis_analysis::{analyzer::NeutralSource, marker_analysis::alignment::Alignment};
use frontalis_proto::v1::{self, take_event::Event};

use crate::{
    catalogue::StoredAlignment,
    session::{Recorded, StreamShape},
    wire::{common, session::effective},
};

/// What came in, unless it is a frame.
pub(super) fn recorded(recorded: &Recorded) -> Option<Event> {
    match recorded {
        Recorded::Frame(_) => None,
        Recorded::Source(source) => Some(Event::Source(v1::TakeSource {
            publisher: source.publisher.to_string(),
            epoch: source.epoch,
            unit: common::length_unit_to_wire(source.shape.unit).into(),
            marker_names: source.shape.marker_names.clone(),
            rate_hz: source.rate_hz,
        })),
        Recorded::Change {
            settings,
            actor_revision,
        } => Some(Event::Change(v1::TakeChange {
            actor_revision: *actor_revision,
            settings: Some(effective(settings)),
        })),
        Recorded::Recenter(source) => Some(Event::Recenter(v1::TakeRecenter {
            source: neutral_source(*source).into(),
        })),
        Recorded::Aligned {
            alignment,
            shape,
            actor_revision,
        } => Some(aligned(alignment, shape, *actor_revision)),
    }
}

fn neutral_source(source: NeutralSource) -> v1::NeutralSource {
    match source {
        NeutralSource::NextFrames => v1::NeutralSource::NextFrames,
        NeutralSource::QuietestFrames => v1::NeutralSource::QuietestFrames,
    }
}

/// The neutral face that frames are solved against.
fn aligned(alignment: &Alignment, shape: &StreamShape, actor_revision: u32) -> Event {
    let stored = StoredAlignment {
        alignment: alignment.clone(),
        unit: shape.unit,
        marker_names: shape.marker_names.clone(),
        actor_revision,
    };
    Event::Alignment(v1::TakeAlignment {
        actor_revision,
        unit: common::length_unit_to_wire(shape.unit).into(),
        marker_names: shape.marker_names.clone(),
        // An alignment in use has nothing that has no text.
        alignment_json: stored.to_text().unwrap_or_default(),
    })
}
