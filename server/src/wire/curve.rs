//! `curve.proto`: what a subscriber asks for, and what it is answered.

mod sample;

use frontalis_analysis::{
    analyzer::MarkerSettings, face::muscle::Muscle, marker_analysis::objective::MuscleBounds,
};
use frontalis_proto::v1;

use super::{
    common,
    invalid::{FieldError, FieldProblem},
};
use crate::{
    hub::{Delivery, Gap, GapCause, Page, StartAt, StreamState, SubscribeSpec, Update},
    name::{DisplayName, SessionId},
    session::SessionHandle,
};

pub use sample::{SampleDetail, sample_to_wire, samples_in_a_response};

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
    let detail = SampleDetail {
        with_uncertainty: sent.with_uncertainty,
        with_markers: sent.with_markers,
    };
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
        detail: SampleDetail {
            with_uncertainty: sent.with_uncertainty,
            with_markers: sent.with_markers,
        },
    })
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
    let settings = session.settings().marker;
    let muscles = actor.muscle_set().muscles().iter();
    v1::CurveHeader {
        session: session.id().resource(),
        actor: session.actor_id().resource(),
        muscle_set: actor.muscle_set().id().to_owned(),
        actor_revision: session.actor_revision(),
        controls: muscles.map(|it| control(it, &settings)).collect(),
        nominal_rate_hz: session.nominal_rate_hz(),
        server_time_nanos,
        run: session.run(),
        unix_offset_nanos,
        // The subscription's.
        next_sequence: 0,
    }
}

fn control(muscle: &Muscle, settings: &MarkerSettings) -> v1::Control {
    let mut bounds = settings.objective.bounds.iter();
    let own = bounds.find(|it| it.muscle == muscle.name);
    let (lower, upper) = own.map_or((0.0, settings.upper_bound()), |it: &MuscleBounds| {
        (it.lower, it.upper)
    });
    v1::Control {
        name: muscle.name.clone(),
        region: common::face_region(muscle.region).into(),
        driven: true,
        lower: common::narrow(lower),
        upper: common::narrow(upper),
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

/// A state on the wire.
pub fn state_to_wire(state: &StreamState) -> v1::StreamState {
    v1::StreamState {
        session_state: common::session_state(state.session_state).into(),
        last_frame_age_micros: state.last_frame_age_nanos.unsigned_abs() / 1_000,
    }
}

/// A gap on the wire.
pub fn gap_to_wire(gap: &Gap) -> v1::Gap {
    v1::Gap {
        first: gap.first,
        last: gap.last,
        cause: gap_cause_to_wire(gap.cause).into(),
    }
}

/// A gap's cause on the wire.
pub fn gap_cause_to_wire(cause: GapCause) -> v1::GapCause {
    match cause {
        GapCause::CaptureSkip => v1::GapCause::CaptureSkip,
        GapCause::Rejected => v1::GapCause::Rejected,
        GapCause::Shed => v1::GapCause::Shed,
        GapCause::PublisherChange => v1::GapCause::PublisherChange,
        GapCause::NotAligned => v1::GapCause::NotAligned,
    }
}

/// The cause that a session gives; `None` for any other.
pub fn gap_cause(number: i32) -> Option<GapCause> {
    match v1::GapCause::try_from(number) {
        Ok(v1::GapCause::CaptureSkip) => Some(GapCause::CaptureSkip),
        Ok(v1::GapCause::Rejected) => Some(GapCause::Rejected),
        Ok(v1::GapCause::Shed) => Some(GapCause::Shed),
        Ok(v1::GapCause::PublisherChange) => Some(GapCause::PublisherChange),
        Ok(v1::GapCause::NotAligned) => Some(GapCause::NotAligned),
        Ok(v1::GapCause::Unspecified | v1::GapCause::Corrupt) | Err(_) => None,
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

#[cfg(test)]
mod tests;
