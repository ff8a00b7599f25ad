//! The same content as JSON, for browsers and one-line scripts.
//!
//! Keys are the names of the `.proto` files, enums are words in lower case, times are Unix nanoseconds.
//! A number that is not finite becomes `null` (CONTRACTS N-1).

use frontalis_analysis::{
    curve::{CurveSample, Quality},
    face::actor::Actor,
};
use frontalis_proto::v1;
use serde_json::{Value, json};

use super::session::state_name;
use crate::{
    hub::{Gap, GapCause, Page, PublishedSample, SessionState},
    name::SessionId,
};

/// An actor.
pub fn actor(actor: &v1::Actor) -> Value {
    let muscle = |it: &v1::Muscle| json!({ "name": it.name, "region": region(it.region) });
    let marker = |it: &v1::Marker| json!({ "name": it.name, "region": region(it.region), "head_fixed": it.head_fixed });
    let pair = |it: &v1::MusclePair| json!({ "first": it.first, "second": it.second, "correlation": it.correlation });
    let basis = actor.basis.as_ref().map(|it| {
        json!({
            "condition_upper": it.condition_upper,
            "condition_lower": it.condition_lower,
            "ambiguous": it.ambiguous.iter().map(pair).collect::<Vec<_>>(),
        })
    });
    json!({
        "name": actor.name,
        "display_name": actor.display_name,
        "revision": actor.revision,
        "create_time_nanos": actor.create_time.map(nanos),
        "muscle_set": actor.muscle_set,
        "muscles": actor.muscles.iter().map(muscle).collect::<Vec<_>>(),
        "markers": actor.markers.iter().map(marker).collect::<Vec<_>>(),
        "n_vertices": actor.n_vertices,
        "n_triangles": actor.n_triangles,
        "regions_trained": actor.regions_trained,
        "basis": basis,
    })
}

/// A session with its settings and its status.
pub fn session(session: &v1::Session) -> Value {
    json!({
        "name": session.name,
        "display_name": session.display_name,
        "actor": session.actor,
        "kind": "markers",
        "settings": session.settings.as_ref().map(settings),
        "create_time_nanos": session.create_time.map(nanos),
        "status": session.status.as_ref().map(status),
    })
}

/// Part of a session's curves; `actor` gives the names of the controls.
pub fn curves(session: &SessionId, actor: &Actor, page: &Page) -> Value {
    let muscles = actor.muscle_set().muscles();
    json!({
        "session": session.resource(),
        "run": page.run,
        "controls": muscles.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(),
        "samples": page.samples.iter().map(|it| sample(it)).collect::<Vec<_>>(),
        "gaps": page.gaps.iter().map(gap).collect::<Vec<_>>(),
        "read_through": page.read_through,
        "newest_sequence": page.newest_sequence,
    })
}

fn settings(it: &v1::SessionSettings) -> Value {
    let millis = |it: &pbjson_types::Duration| {
        it.seconds
            .saturating_mul(1_000)
            .saturating_add(i64::from(it.nanos / 1_000_000))
    };
    let split = it.region_mode() == v1::RegionMode::Split;
    json!({
        "neutral_frames": it.neutral_frames,
        "allow_exaggeration": it.allow_exaggeration,
        "smoothing": it.smoothing,
        "sparsity": it.sparsity,
        "robust": it.robust,
        "stabilize_head": it.stabilize_head,
        "stale_after_millis": it.stale_after.as_ref().map(millis),
        "publisher_timeout_millis": it.publisher_timeout.as_ref().map(millis),
        "record": it.record,
        "region_mode": if split { "split" } else { "joint" },
        "plain": it.plain,
        "align_on_request": it.align_on_request,
        "record_images": it.record_images,
    })
}

fn status(it: &v1::SessionStatus) -> Value {
    let alignment = it.alignment.as_ref().map(|it| {
        json!({
            "scale": it.scale,
            "rms_residual_cm": it.rms_residual_cm,
            "iterations": it.iterations,
            "n_markers": it.n_markers,
        })
    });
    let latency = |it: &v1::StageLatency| {
        let figures = it.latency.unwrap_or_default();
        json!({
            "stage": it.stage,
            "p50_micros": figures.p50_micros,
            "p99_micros": figures.p99_micros,
            "max_micros": figures.max_micros,
        })
    };
    let subscriber = |it: &v1::SubscriberStatus| {
        json!({
            "subscriber": it.subscriber,
            "protocol": it.protocol,
            "sent_samples": it.sent_samples,
            "skipped_samples": it.skipped_samples,
            "lag_frames": it.lag_frames,
        })
    };
    let range =
        |it: &v1::ControlRange| json!({ "control": it.control, "min": it.min, "max": it.max });
    json!({
        "state": wire_state_name(it.state()),
        "failure": it.failure,
        "run": it.run,
        "last_frame": it.last_frame,
        "frame_rate_hz": it.frame_rate_hz,
        "frames_received": it.frames_received,
        "frames_rejected": it.frames_rejected,
        "frames_shed": it.frames_shed,
        "frames_missing": it.frames_missing,
        "alignment": alignment,
        "alignment_problem": it.alignment_problem,
        "latencies": it.latencies.iter().map(latency).collect::<Vec<_>>(),
        "subscribers": it.subscribers.iter().map(subscriber).collect::<Vec<_>>(),
        "actor_revision": it.actor_revision,
        "ranges": it.ranges.iter().map(range).collect::<Vec<_>>(),
        "unknown_markers": it.unknown_markers,
    })
}

fn sample(it: &PublishedSample) -> Value {
    let curves: &CurveSample = &it.sample;
    let regions: Vec<Value> = curves
        .regions
        .iter()
        .map(|it| {
            json!({
                "region": it.region.name(),
                "marker_error_cm": it.marker_error_cm,
                "n_markers": it.n_markers,
                "quality": quality(it.quality),
                "held_reason": it.held_reason.map(frontalis_analysis::curve::HeldReason::identifier),
                "quality_fraction": it.quality_fraction,
            })
        })
        .collect();
    json!({
        "sequence": it.sequence,
        "frame": curves.frame.0,
        "source_frame": it.tag.source_frame,
        "capture_time_nanos": curves.capture_time_nanos,
        "solved_time_nanos": it.solved_time_nanos,
        "actor_revision": it.actor_revision,
        "quality": quality(curves.quality),
        "held_frames": curves.held_frames,
        "activations": curves.activations,
        "unobserved": curves.unobserved,
        "region_errors": regions,
    })
}

fn gap(it: &Gap) -> Value {
    let cause = match it.cause {
        GapCause::CaptureSkip => "capture_skip",
        GapCause::Rejected => "rejected",
        GapCause::Shed => "shed",
        GapCause::PublisherChange => "publisher_change",
        GapCause::NotAligned => "not_aligned",
    };
    json!({ "first": it.first, "last": it.last, "cause": cause })
}

fn quality(quality: Quality) -> &'static str {
    match quality {
        Quality::Solved => "solved",
        Quality::Partial => "partial",
        Quality::Held => "held",
    }
}

fn wire_state_name(state: v1::SessionState) -> &'static str {
    let state = match state {
        v1::SessionState::Unspecified => return "unspecified",
        v1::SessionState::Waiting => SessionState::Waiting,
        v1::SessionState::Aligning => SessionState::Aligning,
        v1::SessionState::Live => SessionState::Live,
        v1::SessionState::Stale => SessionState::Stale,
        v1::SessionState::Ended => SessionState::Ended,
        v1::SessionState::Failed => SessionState::Failed,
    };
    state_name(state)
}

fn region(region: i32) -> &'static str {
    match v1::FaceRegion::try_from(region) {
        Ok(v1::FaceRegion::Upper) => "upper",
        Ok(v1::FaceRegion::Lower) => "lower",
        _ => "unspecified",
    }
}

fn nanos(time: pbjson_types::Timestamp) -> i64 {
    time.seconds
        .saturating_mul(1_000_000_000)
        .saturating_add(time.nanos.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_not_finite_becomes_null() {
        let broken = v1::Session {
            status: Some(v1::SessionStatus {
                frame_rate_hz: f64::NAN,
                ranges: vec![v1::ControlRange {
                    control: "x".into(),
                    min: f32::NEG_INFINITY,
                    ..Default::default()
                }],
                ..Default::default()
            }),
            ..Default::default()
        };
        let text = session(&broken).to_string();
        assert!(text.contains("\"frame_rate_hz\":null"), "{text}");
        assert!(text.contains("\"min\":null"), "{text}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }

    #[test]
    fn text_of_clients_is_escaped() {
        let named = v1::Actor {
            display_name: "\"</script>\u{7}".into(),
            ..Default::default()
        };
        let text = actor(&named).to_string();
        assert!(text.contains("\\\"</script>\\u0007"), "{text}");
    }
}
