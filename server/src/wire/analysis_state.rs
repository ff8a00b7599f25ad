//! What a take is solved from, as its file holds it: written and read by the same version of a server.

use frontalis_analysis::{marker_analysis::alignment::Alignment, numeric::tape::Entry};
use frontalis_proto::v1;

use super::{
    common, curve,
    invalid::FieldError,
    session::{effective, of_effective},
};
use crate::{
    catalogue::StoredAlignment,
    session::{RestoredAlignment, StartingPoint, StreamPoint, StreamShape},
};

/// Of the numbers that this server writes and reads.
const VERSION: u32 = 1;

/// Most fields of a state; a state with a full window of neutral frames has some two thousand.
const MAX_FIELDS: usize = 10_000;

/// A starting point as a file holds it.
pub fn to_wire(point: &StartingPoint) -> v1::AnalysisState {
    let alignment = point.alignment.as_ref();
    v1::AnalysisState {
        version: VERSION,
        actor_revision: point.actor_revision,
        settings: Some(effective(&point.settings)),
        alignment: alignment
            .map(|it| alignment_to_wire(&it.alignment, &it.shape, point.actor_revision)),
        source: point.stream.as_ref().map(|it| v1::TakeSource {
            unit: common::length_unit_to_wire(it.shape.unit).into(),
            marker_names: it.shape.marker_names.clone(),
            rate_hz: it.rate_hz,
            ..v1::TakeSource::default()
        }),
        recentering: point.is_recentering,
        giving_up: point
            .giving_up
            .map_or(v1::GapCause::Unspecified, curve::gap_cause_to_wire)
            .into(),
        scale_jumps: point.n_scale_jumps,
        numbers: point
            .stream
            .iter()
            .flat_map(|it| &it.state)
            .map(|it| v1::StateNumbers {
                name: it.name.clone(),
                reals: it.reals.clone(),
                integers: it.integers.clone(),
            })
            .collect(),
    }
}

/// The starting point that a file holds.
///
/// # Errors
///
/// [`FieldError`] when another version wrote it, or it is damaged.
pub fn starting_point(sent: v1::AnalysisState) -> Result<StartingPoint, FieldError> {
    const FIELD: &str = "analysis_state";
    if sent.version != VERSION || sent.numbers.len() > MAX_FIELDS {
        let detail = format!("version {}, this server reads {VERSION}", sent.version);
        return Err(FieldError::unusable(FIELD, "STATE_VERSION", detail));
    }
    let alignment = sent.alignment.as_ref().map(alignment).transpose()?;
    let numbers = sent.numbers.into_iter().map(|it| Entry {
        name: it.name,
        reals: it.reals,
        integers: it.integers,
    });
    let state: Vec<Entry> = numbers.collect();
    let stream = sent
        .source
        .map(|source| {
            Ok(StreamPoint {
                rate_hz: source.rate_hz,
                shape: stream_shape(source)?,
                state,
            })
        })
        .transpose()?;
    Ok(StartingPoint {
        settings: of_effective(&sent.settings.unwrap_or_default())?,
        actor_revision: sent.actor_revision,
        alignment,
        stream,
        is_recentering: sent.recentering,
        giving_up: curve::gap_cause(sent.giving_up),
        n_scale_jumps: sent.scale_jumps,
    })
}

/// The stream that a take's source declared.
///
/// # Errors
///
/// [`FieldError`] when its unit is none.
pub fn stream_shape(source: v1::TakeSource) -> Result<StreamShape, FieldError> {
    Ok(StreamShape {
        unit: common::length_unit("source.unit", source.unit)?,
        marker_names: source.marker_names,
    })
}

/// The neutral face that frames are solved against.
pub fn alignment_to_wire(
    alignment: &Alignment,
    shape: &StreamShape,
    actor_revision: u32,
) -> v1::TakeAlignment {
    let stored = StoredAlignment {
        alignment: alignment.clone(),
        unit: shape.unit,
        marker_names: shape.marker_names.clone(),
        actor_revision,
    };
    v1::TakeAlignment {
        actor_revision,
        unit: common::length_unit_to_wire(shape.unit).into(),
        marker_names: shape.marker_names.clone(),
        // An alignment in use has nothing that has no text.
        alignment_json: stored.to_text().unwrap_or_default(),
    }
}

fn alignment(sent: &v1::TakeAlignment) -> Result<RestoredAlignment, FieldError> {
    let stored = StoredAlignment::from_text(&sent.alignment_json).map_err(|_unreadable| {
        FieldError::unusable("alignment_json", "ALIGNMENT", "it cannot be read")
    })?;
    Ok(RestoredAlignment {
        alignment: stored.alignment,
        shape: StreamShape {
            unit: stored.unit,
            marker_names: stored.marker_names,
        },
    })
}
