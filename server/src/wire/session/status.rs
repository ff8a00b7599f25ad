//! A session's figures on the wire, all of them finite.

use frontalis_proto::v1;

use crate::{
    hub::{SessionState, SubscriberStatus},
    session::{AlignmentReport, ControlRange, SessionStatus, StageLatency},
    wire::{actor::finite, common::session_state},
};

/// A state in words, for metrics and JSON.
pub fn state_name(state: SessionState) -> &'static str {
    match state {
        SessionState::Waiting => "waiting",
        SessionState::Aligning => "aligning",
        SessionState::Live => "live",
        SessionState::Stale => "stale",
        SessionState::Ended => "ended",
        SessionState::Failed => "failed",
    }
}

pub(super) fn status(status: &SessionStatus) -> v1::SessionStatus {
    v1::SessionStatus {
        state: session_state(status.state).into(),
        failure: status.failure.clone().unwrap_or_default(),
        last_frame: status.last_frame,
        frame_rate_hz: finite(status.frame_rate_hz),
        frames_received: status.frames_received,
        frames_rejected: status.frames_rejected,
        frames_shed: status.frames_shed,
        frames_missing: status.frames_missing,
        alignment: status.alignment.as_ref().map(alignment),
        latencies: status.latencies.iter().map(latency).collect(),
        subscribers: status.subscribers.iter().map(subscriber).collect(),
        take: String::new(),
        actor_revision: status.actor_revision,
        ranges: status.ranges.iter().map(range).collect(),
        run: status.run,
        alignment_problem: status.alignment_problem.unwrap_or_default().to_owned(),
        clock: None,
        unknown_markers: status.unknown_markers.clone(),
    }
}

fn alignment(report: &AlignmentReport) -> v1::AlignmentReport {
    v1::AlignmentReport {
        scale: finite(report.scale),
        rms_residual_cm: finite(report.rms_residual_cm),
        iterations: report.iterations,
        n_markers: u32::try_from(report.n_markers).unwrap_or(u32::MAX),
    }
}

fn latency(it: &StageLatency) -> v1::StageLatency {
    v1::StageLatency {
        stage: it.stage.to_owned(),
        latency: Some(v1::Latency {
            p50_micros: finite(it.latency.p50_micros),
            p99_micros: finite(it.latency.p99_micros),
            max_micros: finite(it.latency.max_micros),
        }),
    }
}

fn subscriber(it: &SubscriberStatus) -> v1::SubscriberStatus {
    v1::SubscriberStatus {
        subscriber: it.subscriber.clone(),
        protocol: it.protocol.to_owned(),
        sent_samples: it.sent_samples,
        skipped_samples: it.skipped_samples,
        lag_frames: it.lag_frames,
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the wire carries f32; what is finite stays finite"
)]
fn range(it: &ControlRange) -> v1::ControlRange {
    let narrow = |value: f64| (finite(value) as f32).clamp(f32::MIN, f32::MAX);
    v1::ControlRange {
        control: it.control.clone(),
        min: narrow(it.min),
        max: narrow(it.max),
        out_of_range: 0.0,
    }
}
