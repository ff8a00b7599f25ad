//! `curve.proto`: what a subscriber asks for, and samples on their way out.
//!
//! Nothing that is not finite leaves here (CONTRACTS N-1): activations are inside their box by the solver's promise, and
//! are clamped to it after rounding to f32.

use frontalis_analysis::curve::{CurveSample, HeldReason, Quality, RegionReport};
use frontalis_proto::v1;

use super::{
    common,
    invalid::{FieldError, FieldProblem},
};
use crate::{
    hub::{
        Delivery, Gap, GapCause, Page, PublishedSample, StartAt, StreamState, SubscribeSpec, Update,
    },
    name::{DisplayName, SessionId},
    session::SessionHandle,
};

/// What a subscriber asks for, checked.
#[derive(Clone, Debug)]
pub struct SubscribeRequest {
    /// Which session.
    pub session: SessionId,
    /// What it gets.
    pub spec: SubscribeSpec,
    /// What each sample holds.
    pub detail: SampleDetail,
}

/// What a sample holds beside the activations.
#[derive(Clone, Copy, Debug, Default)]
pub struct SampleDetail {
    /// The markers, as seen and as reproduced.
    pub with_markers: bool,
}

/// A response stays below about so much in either form: several of them may wait for a slow reader (CONTRACTS D-20).
const RESPONSE_BYTES: usize = 64 * 1024;
/// A number with its comma, in JSON, which is the longer form.
const NUMBER_BYTES: usize = 13;
/// What a sample holds beside its activations and markers.
const SAMPLE_BYTES: usize = 1_024;

/// Samples of that many muscles and markers that go into one response.
pub fn samples_in_a_response(n_muscles: usize, n_markers: usize, detail: SampleDetail) -> usize {
    // Six coordinates and an index for each marker.
    let n_of_markers = if detail.with_markers {
        7 * n_markers
    } else {
        0
    };
    let n_bytes = SAMPLE_BYTES + NUMBER_BYTES * (n_muscles + n_of_markers);
    (RESPONSE_BYTES / n_bytes).max(1)
}

/// Checks a subscriber's start, which came over `protocol`; `peer` names a subscriber that gives no name. `credits` are ignored where the subscriber
/// cannot return them.
///
/// # Errors
///
/// [`FieldError`] names the first field that is wrong or not implemented.
pub fn start(
    sent: &v1::SubscribeStart,
    peer: String,
    protocol: &'static str,
    can_return_credits: bool,
) -> Result<SubscribeRequest, FieldError> {
    let session = SessionId::from_resource(&sent.session).map_err(FieldError::name("session"))?;
    let name = DisplayName::parse("subscriber", &sent.subscriber)
        .map_err(FieldError::name("subscriber"))?;
    check_control_space(sent.control_space)?;
    let detail = detail(sent.with_uncertainty, sent.with_markers)?;
    let delivery = delivery(sent, can_return_credits)?;
    let name = name.into_string();
    Ok(SubscribeRequest {
        session,
        spec: SubscribeSpec {
            name: if name.is_empty() { peer } else { name },
            protocol,
            delivery,
            run: (sent.run != 0).then_some(sent.run),
        },
        detail,
    })
}

/// What a reader without a stream asks for, checked.
#[derive(Clone, Debug)]
pub struct ReadRequest {
    /// Which session.
    pub session: SessionId,
    /// None: the current one.
    pub run: Option<u64>,
    /// None: from the oldest that is kept.
    pub after: Option<u64>,
    /// Samples in the answer.
    pub limit: usize,
    /// What each sample holds.
    pub detail: SampleDetail,
}

/// Samples of one answer when the client names no number, and the most.
const READ_SAMPLES: [u32; 2] = [100, 1_000];

/// Checks a reader's request.
///
/// # Errors
///
/// [`FieldError`] names the first field that is wrong or not implemented.
pub fn read(sent: &v1::ReadCurvesRequest) -> Result<ReadRequest, FieldError> {
    let [usual, most] = READ_SAMPLES;
    let limit = match sent.limit {
        0 => usual,
        limit if limit <= most => limit,
        _ => {
            let detail = "at most 1,000 samples are read at once";
            return Err(FieldError::unusable("limit", "LIMIT", detail));
        }
    };
    Ok(ReadRequest {
        session: SessionId::from_resource(&sent.session).map_err(FieldError::name("session"))?,
        run: (sent.run != 0).then_some(sent.run),
        after: sent.after,
        limit: limit as usize,
        detail: detail(sent.with_uncertainty, sent.with_markers)?,
    })
}

fn detail(with_uncertainty: bool, with_markers: bool) -> Result<SampleDetail, FieldError> {
    if with_uncertainty {
        let problem = FieldProblem::NotImplemented;
        return Err(FieldError::new("with_uncertainty", problem));
    }
    Ok(SampleDetail { with_markers })
}

fn check_control_space(number: i32) -> Result<(), FieldError> {
    let problem = match v1::ControlSpace::try_from(number) {
        Ok(v1::ControlSpace::Unspecified | v1::ControlSpace::Muscles) => return Ok(()),
        Ok(v1::ControlSpace::Facs | v1::ControlSpace::Arkit) => FieldProblem::NotImplemented,
        Err(_unknown) => FieldProblem::UnknownEnum(number),
    };
    Err(FieldError::new("control_space", problem))
}

fn delivery(sent: &v1::SubscribeStart, can_return_credits: bool) -> Result<Delivery, FieldError> {
    let max_rate_hz = max_rate_hz(sent.max_rate_hz)?;
    match v1::Delivery::try_from(sent.delivery) {
        Ok(v1::Delivery::Unspecified | v1::Delivery::Latest) => Ok(Delivery::Latest {
            credits: (can_return_credits && sent.credits > 0).then_some(sent.credits),
            max_rate_hz,
        }),
        Ok(v1::Delivery::EveryFrame) => Ok(Delivery::EveryFrame(match sent.from_sequence {
            _ if sent.from_oldest => StartAt::Oldest,
            0 => StartAt::Now,
            sequence => StartAt::Sequence(sequence),
        })),
        Err(_unknown) => Err(FieldError::new(
            "delivery",
            FieldProblem::UnknownEnum(sent.delivery),
        )),
    }
}

/// Far more than any stream has: what is asked beyond is a mistake.
const MAX_RATE_HZ: f32 = 1e6;

fn max_rate_hz(sent: f32) -> Result<Option<f64>, FieldError> {
    if (0.0..=MAX_RATE_HZ).contains(&sent) {
        return Ok((sent > 0.0).then_some(f64::from(sent)));
    }
    let detail = "the rate must be from 0 to 1,000,000";
    Err(FieldError::unusable("max_rate_hz", "RATE", detail))
}

/// The first response: what the samples that follow mean.
pub fn header(
    session: &SessionHandle,
    server_time_nanos: i64,
    unix_offset_nanos: i64,
) -> v1::CurveHeader {
    let actor = session.actor();
    let upper = if session.settings().marker.allow_exaggeration {
        2.0
    } else {
        1.0
    };
    let muscles = actor.muscle_set().muscles().iter();
    let control = |muscle: &frontalis_analysis::face::muscle::Muscle| v1::Control {
        name: muscle.name.clone(),
        region: common::face_region(muscle.region).into(),
        driven: true,
        lower: 0.0,
        upper,
    };
    v1::CurveHeader {
        session: session.id().resource(),
        actor: session.actor_id().resource(),
        muscle_set: actor.muscle_set().id().to_owned(),
        actor_revision: session.actor_revision(),
        controls: muscles.map(control).collect(),
        nominal_rate_hz: session.nominal_rate_hz(),
        server_time_nanos,
        run: session.run(),
        unix_offset_nanos,
    }
}

/// Samples, gaps and state of one response.
pub fn update_to_wire(update: &Update, detail: SampleDetail) -> v1::SubscribeResponse {
    let samples = update.samples.iter();
    v1::SubscribeResponse {
        samples: samples.map(|it| sample_to_wire(it, detail)).collect(),
        skipped_samples: update.skipped_samples,
        gaps: update.gaps.iter().map(gap_to_wire).collect(),
        state: update.state.as_ref().map(state_to_wire),
        ..v1::SubscribeResponse::default()
    }
}

/// The last response of a session that ended.
pub fn end_to_wire(reason: String, last_frame: u64, skipped_samples: u64) -> v1::SubscribeResponse {
    v1::SubscribeResponse {
        end: Some(v1::CurveEnd { reason, last_frame }),
        skipped_samples,
        ..v1::SubscribeResponse::default()
    }
}

fn state_to_wire(state: &StreamState) -> v1::StreamState {
    v1::StreamState {
        session_state: common::session_state(state.session_state).into(),
        last_frame_age_micros: state.last_frame_age_nanos.unsigned_abs() / 1_000,
    }
}

/// A gap on the wire.
pub fn gap_to_wire(gap: &Gap) -> v1::Gap {
    let cause = match gap.cause {
        GapCause::CaptureSkip => v1::GapCause::CaptureSkip,
        GapCause::Rejected => v1::GapCause::Rejected,
        GapCause::Shed => v1::GapCause::Shed,
        GapCause::PublisherChange => v1::GapCause::PublisherChange,
        GapCause::NotAligned => v1::GapCause::NotAligned,
    };
    v1::Gap {
        first: gap.first,
        last: gap.last,
        cause: cause.into(),
    }
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
        timecode: tag.timecode.as_ref().map(common::timecode_to_wire),
        activations: sample.activations.iter().map(|it| to_f32(*it)).collect(),
        region_errors: sample.regions.iter().map(region_to_wire).collect(),
        head: sample.head.as_ref().map(common::head_pose),
        quality: quality(sample.quality).into(),
        solved_time_nanos: *solved_time_nanos,
        actor_revision: *actor_revision,
        sequence: *sequence,
        held_frames: sample.held_frames,
        source_frame: tag.source_frame,
        unobserved: indices(&sample.unobserved),
        ..v1::CurveSample::default()
    };
    if tag.time_non_monotonic {
        wire.flags.push(v1::SampleFlag::TimeNonMonotonic.into());
    }
    if tag.timecode_invalid {
        wire.flags.push(v1::SampleFlag::TimecodeInvalid.into());
    }
    if detail.with_markers {
        add_markers(sample, &mut wire);
    }
    wire
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
        region: common::face_region(report.region).into(),
        marker_error_cm: to_f32(report.marker_error_cm),
        n_markers: u32::try_from(report.n_markers).unwrap_or(u32::MAX),
        quality: quality(report.quality).into(),
        held_reason: report
            .held_reason
            .map_or_else(String::new, |it: HeldReason| it.identifier().to_owned()),
        quality_fraction: to_f32(report.quality_fraction),
    }
}

fn quality(quality: Quality) -> v1::Quality {
    match quality {
        Quality::Solved => v1::Quality::Solved,
        Quality::Partial => v1::Quality::Partial,
        Quality::Held => v1::Quality::Held,
    }
}

/// Part of a session's curves, for readers without a stream.
pub fn page_to_wire(
    page: &Page,
    header: v1::CurveHeader,
    detail: SampleDetail,
) -> v1::ReadCurvesResponse {
    let samples = page.samples.iter();
    v1::ReadCurvesResponse {
        header: Some(header),
        samples: samples.map(|it| sample_to_wire(it, detail)).collect(),
        gaps: page.gaps.iter().map(gap_to_wire).collect(),
        read_through: page.read_through,
        newest_sequence: page.newest_sequence,
        state: Some(state_to_wire(&page.state)),
    }
}

/// The bounds 0, 1 and 2 are exact in f32, so rounding keeps a value inside its box.
#[expect(clippy::cast_possible_truncation, reason = "the wire has f32")]
fn to_f32(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests;
