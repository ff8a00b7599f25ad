//! A sample on its way out.
//!
//! Nothing that is not finite leaves here (CONTRACTS N-1). Activations are inside their box by the solver's promise, and
//! stay so: bounds are exact in f32, and rounding to it keeps the order.

use frontalis_analysis::curve::{CurveSample, HeldReason, Quality, RegionReport};
use frontalis_proto::v1;

use crate::{
    hub::{PublishedSample, SampleTag},
    wire::common::{face_region, head_pose, narrow, timecode_to_wire},
};

/// What a sample holds beside the activations.
#[derive(Clone, Copy, Debug, Default)]
pub struct SampleDetail {
    /// One sigma of each activation.
    pub with_uncertainty: bool,
    /// The markers, as seen and as reproduced.
    pub with_markers: bool,
}

/// A response stays below about so much in either form: several of them may wait for a slow reader (CONTRACTS D-20).
const RESPONSE_BYTES: usize = 64 * 1024;
/// A number with its comma, in JSON, which is the longer form.
const NUMBER_BYTES: usize = 13;
/// The index of a marker with its comma, in JSON.
const INDEX_BYTES: usize = 5;
/// What a sample holds beside its activations and markers.
const SAMPLE_BYTES: usize = 1_024;

/// Samples of that many muscles and markers that go into one response.
pub fn samples_in_a_response(n_muscles: usize, n_markers: usize, detail: SampleDetail) -> usize {
    let n_of_muscles = if detail.with_uncertainty {
        2 * n_muscles
    } else {
        n_muscles
    };
    // Six coordinates and an index for each marker.
    let n_of_markers = if detail.with_markers {
        7 * n_markers
    } else {
        0
    };
    let n_bytes =
        SAMPLE_BYTES + NUMBER_BYTES * (n_of_muscles + n_of_markers) + INDEX_BYTES * n_markers;
    (RESPONSE_BYTES / n_bytes).max(1)
}

/// A sample on the wire.
pub fn sample_to_wire(published: &PublishedSample, detail: SampleDetail) -> v1::CurveSample {
    let PublishedSample {
        sample,
        tag,
        sequence,
        solved_time_nanos,
        actor_revision,
    } = published;
    let mut wire = v1::CurveSample {
        frame: sample.frame.0,
        capture_time_nanos: sample.capture_time_nanos,
        timecode: tag.timecode.as_ref().map(timecode_to_wire),
        activations: sample.activations.iter().map(|it| narrow(*it)).collect(),
        region_errors: sample.regions.iter().map(region_to_wire).collect(),
        head: sample.head.as_ref().map(head_pose),
        quality: quality(sample.quality).into(),
        solved_time_nanos: *solved_time_nanos,
        actor_revision: *actor_revision,
        sequence: *sequence,
        held_frames: sample.held_frames,
        source_frame: tag.source_frame,
        flags: flags(sample, tag),
        capture_time_server_nanos: tag.capture_time_server_nanos.unwrap_or(0),
        unobserved: indices(&sample.unobserved),
        outlier_markers: indices(&sample.outliers),
        ..v1::CurveSample::default()
    };
    if detail.with_uncertainty {
        let errors = sample.standard_errors.iter();
        wire.standard_errors = errors.map(|it| narrow(*it)).collect();
    }
    if detail.with_markers {
        add_markers(sample, &mut wire);
    }
    wire
}

fn flags(sample: &CurveSample, tag: &SampleTag) -> Vec<i32> {
    let flags = [
        (!sample.outliers.is_empty(), v1::SampleFlag::Outlier),
        (!sample.relabeled.is_empty(), v1::SampleFlag::Relabeled),
        (tag.time_non_monotonic, v1::SampleFlag::TimeNonMonotonic),
        (tag.timecode_invalid, v1::SampleFlag::TimecodeInvalid),
    ];
    let set = flags.into_iter().filter(|(is_set, _)| *is_set);
    set.map(|(_, flag)| flag.into()).collect()
}

fn add_markers(sample: &CurveSample, wire: &mut v1::CurveSample) {
    let trace = &sample.markers;
    wire.observed_cm.clone_from(&trace.observed_cm);
    wire.reproduced_cm.clone_from(&trace.reproduced_cm);
    wire.observed_markers = indices(&trace.markers);
}

/// Indices of muscles and markers, of which there are far fewer than 2^32.
fn indices(indices: &[usize]) -> Vec<u32> {
    let index = |it: &usize| u32::try_from(*it).unwrap_or(u32::MAX);
    indices.iter().map(index).collect()
}

fn region_to_wire(report: &RegionReport) -> v1::RegionError {
    v1::RegionError {
        region: face_region(report.region).into(),
        marker_error_cm: narrow(report.marker_error_cm),
        n_markers: u32::try_from(report.n_markers).unwrap_or(u32::MAX),
        quality: quality(report.quality).into(),
        held_reason: report
            .held_reason
            .map_or_else(String::new, |it: HeldReason| it.identifier().to_owned()),
        quality_fraction: narrow(report.quality_fraction),
    }
}

fn quality(quality: Quality) -> v1::Quality {
    match quality {
        Quality::Solved => v1::Quality::Solved,
        Quality::Partial => v1::Quality::Partial,
        Quality::Held => v1::Quality::Held,
    }
}

#[cfg(test)]
mod tests;
