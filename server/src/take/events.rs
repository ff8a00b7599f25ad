//! What happens to a session, as a take's file holds it.

use frontalis_analysis::analyzer::NeutralSource;
use frontalis_proto::v1::{self, take_event::Event};

use crate::{
    session::Recorded,
    wire::{
        analysis_state::{self, alignment_to_wire},
        capture, common,
        session::effective,
    },
};

/// What came in, unless it is a frame.
pub(super) fn recorded(recorded: &Recorded, unix_offset_nanos: i64) -> Option<Event> {
    match recorded {
        Recorded::Frame(_) => None,
        Recorded::Source(source) => Some(Event::Source(v1::TakeSource {
            publisher: source.publisher.to_string(),
            epoch: source.epoch,
            unit: common::length_unit_to_wire(source.shape.unit).into(),
            marker_names: source.shape.marker_names.clone(),
            rate_hz: source.rate_hz,
            continued: source.is_continued,
            is_other: source.is_other,
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
        } => Some(Event::Alignment(alignment_to_wire(
            alignment,
            shape,
            *actor_revision,
        ))),
        Recorded::Clock(report) => Some(Event::Clock(v1::TakeClock {
            clock: Some(capture::clock_report(report)),
            server_time_nanos: report.server_time_nanos,
            unix_offset_nanos,
        })),
        Recorded::StartingPoint(point) => {
            Some(Event::AnalysisState(analysis_state::to_wire(point)))
        }
    }
}

fn neutral_source(source: NeutralSource) -> v1::NeutralSource {
    match source {
        NeutralSource::NextFrames => v1::NeutralSource::NextFrames,
        NeutralSource::QuietestFrames => v1::NeutralSource::QuietestFrames,
    }
}
