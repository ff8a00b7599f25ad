//! A session's figures on the wire, all of them finite.

use frontalis_analysis::marker_analysis::{
    neutral_watch::{DoubtCause, NeutralDoubt},
    range::{Percentiles, Verdict},
};
use frontalis_proto::v1;

use crate::{
    hub::{SessionState, SubscriberStatus},
    session::{AlignmentReport, ControlRange, SessionStatus, StageLatency},
    wire::{
        actor::finite,
        capture::clock_report,
        common::{narrow, session_state},
    },
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
        clock: status.clock.as_ref().map(clock_report),
        unknown_markers: status.unknown_markers.clone(),
        neutral_doubt: status.neutral_doubt.as_ref().map(doubt),
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

fn range(it: &ControlRange) -> v1::ControlRange {
    let judged = it.judged.as_ref().filter(|it| it.n_frames > 0);
    let verdict = verdict(judged.map(|it| it.verdict).unwrap_or_default());
    v1::ControlRange {
        control: it.control.clone(),
        min: narrow(it.min),
        max: narrow(it.max),
        out_of_range: judged.map_or(0.0, |it| narrow(it.out_of_range)),
        n_frames: judged.map_or(0, |it| it.n_frames),
        bounded: judged.map(|it| percentiles(&it.bounded)),
        unbounded: judged.map(|it| percentiles(&it.unbounded)),
        verdict: verdict.into(),
        sentence: verdict.sentence().to_owned(),
    }
}

fn percentiles(it: &Percentiles) -> v1::Percentiles {
    v1::Percentiles {
        p1: narrow(it.p1),
        p99: narrow(it.p99),
    }
}

fn verdict(verdict: Verdict) -> v1::RangeVerdict {
    match verdict {
        Verdict::NotYetSeen => v1::RangeVerdict::NotYetSeen,
        Verdict::Sound => v1::RangeVerdict::Sound,
        Verdict::TooWeak => v1::RangeVerdict::TooWeak,
        Verdict::TooStrong => v1::RangeVerdict::TooStrong,
        Verdict::WrongDirection => v1::RangeVerdict::WrongDirection,
        Verdict::HardlyObservable => v1::RangeVerdict::HardlyObservable,
        Verdict::NeutralInDoubt => v1::RangeVerdict::NeutralInDoubt,
    }
}

fn doubt(it: &NeutralDoubt) -> v1::NeutralDoubt {
    let cause = match it.cause {
        DoubtCause::LooksContracted => v1::NeutralDoubtCause::LooksContracted,
        DoubtCause::QuieterFramesSeen => v1::NeutralDoubtCause::QuieterFramesSeen,
    };
    v1::NeutralDoubt {
        cause: cause.into(),
        residual_cm: finite(it.residual_cm),
        expected_cm: finite(it.expected_cm),
        advice: format!("{} {}", cause.sentence(), cause.advice()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_verdict_keeps_its_identifier_and_says_something() {
        for it in [
            Verdict::NotYetSeen,
            Verdict::Sound,
            Verdict::TooWeak,
            Verdict::TooStrong,
            Verdict::WrongDirection,
            Verdict::HardlyObservable,
            Verdict::NeutralInDoubt,
        ] {
            let wire = verdict(it);
            let name = format!("RANGE_VERDICT_{}", it.identifier());
            assert_eq!(wire.as_str_name(), name);
            assert!(!wire.sentence().is_empty(), "{name}");
        }
    }

    #[test]
    fn a_doubt_says_why_and_what_to_do() {
        for cause in [DoubtCause::LooksContracted, DoubtCause::QuieterFramesSeen] {
            let wire = doubt(&NeutralDoubt {
                cause,
                residual_cm: f64::NAN,
                expected_cm: 0.02,
            });
            let name = format!("NEUTRAL_DOUBT_CAUSE_{}", cause.identifier());
            assert_eq!(wire.cause().as_str_name(), name);
            assert!(wire.advice.contains("ecenter"), "{}", wire.advice);
            assert!(wire.residual_cm.is_finite());
        }
    }

    #[test]
    fn a_control_that_nobody_judged_yet_has_its_extremes_and_no_percentiles() {
        let wire = range(&ControlRange {
            control: "jaw".into(),
            min: f64::INFINITY,
            max: f64::NEG_INFINITY,
            judged: None,
        });
        assert!(wire.min.is_finite() && wire.max.is_finite());
        assert_eq!((wire.n_frames, wire.bounded), (0, None));
        assert_eq!(wire.verdict(), v1::RangeVerdict::NotYetSeen);
    }
}
