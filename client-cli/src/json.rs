//! What `--json` prints: the messages of the wire under their own field names, enums in lower case.

use frontalis_client::{
    capture_client::report::PublishReport,
    csv,
    curve_client::CurveEvent,
    error::ClientError,
    proto::{Actor, CurveSample, Session},
    solve::SolveError,
};
use serde_json::{Map, Value, json};

use crate::terminal::tables;

/// An error, with the server's reason and figures when it refused.
pub fn error(error: &anyhow::Error, refusal: Option<&ClientError>) -> Value {
    let mut value = json!({ "error": format!("{error:#}") });
    if let Some(refusal) = refusal {
        value["code"] = json!(format!("{:?}", refusal.code));
        value["reason"] = json!(refusal.reason);
        value["metadata"] = json!(refusal.metadata);
        value["retry_after_secs"] = json!(refusal.retry_after.map(|it| it.as_secs_f64()));
    }
    if refusal.is_some() || advice(error, refusal).is_some() {
        value["advice"] = json!(advice(error, refusal));
    }
    value
}

/// What can be done about an error, when the server or the analysis knows.
pub fn advice(error: &anyhow::Error, refusal: Option<&ClientError>) -> Option<&'static str> {
    let unsolved = || {
        error
            .chain()
            .find_map(|it| it.downcast_ref::<SolveError>())
            .and_then(SolveError::advice)
    };
    refusal.and_then(ClientError::advice).or_else(unsolved)
}

/// One actor.
pub fn actor(actor: &Actor) -> Value {
    let muscles: Vec<_> = actor
        .muscles
        .iter()
        .map(|it| json!({ "name": it.name, "region": tables::region(it.region()) }))
        .collect();
    let markers: Vec<_> = actor
        .markers
        .iter()
        .map(|it| {
            json!({
                "name": it.name,
                "region": tables::region(it.region()),
                "head_fixed": it.head_fixed,
            })
        })
        .collect();
    let basis = actor.basis.as_ref().map(|it| {
        let ambiguous: Vec<_> = it
            .ambiguous
            .iter()
            .map(|pair| {
                json!({
                    "first": pair.first,
                    "second": pair.second,
                    "correlation": pair.correlation,
                })
            })
            .collect();
        json!({
            "condition_upper": it.condition_upper,
            "condition_lower": it.condition_lower,
            "ambiguous": ambiguous,
        })
    });
    json!({
        "name": actor.name,
        "display_name": actor.display_name,
        "revision": actor.revision,
        "create_time": tables::timestamp(actor.create_time.as_ref()),
        "muscle_set": actor.muscle_set,
        "muscles": muscles,
        "markers": markers,
        "n_vertices": actor.n_vertices,
        "n_triangles": actor.n_triangles,
        "regions_trained": actor.regions_trained,
        "basis": basis,
    })
}

/// One session.
pub fn session(session: &Session) -> Value {
    json!({
        "name": session.name,
        "display_name": session.display_name,
        "actor": session.actor,
        "kind": tables::kind(session.kind()),
        "create_time": tables::timestamp(session.create_time.as_ref()),
        "settings": session.settings.map(|it| json!({
            "neutral_frames": it.neutral_frames,
            "allow_exaggeration": it.allow_exaggeration,
            "stabilize_head": it.stabilize_head,
            "align_on_request": it.align_on_request,
            "region_mode": tables::region_mode(it.region_mode()),
            "stale_after_secs": it.stale_after.map(tables::seconds),
            "publisher_timeout_secs": it.publisher_timeout.map(tables::seconds),
        })),
        "status": session.status.as_ref().map(status),
    })
}

fn status(status: &frontalis_client::proto::SessionStatus) -> Value {
    let latencies: Map<_, _> = status
        .latencies
        .iter()
        .map(|it| {
            let latency = it.latency.unwrap_or_default();
            let figures = json!({
                "p50_micros": latency.p50_micros,
                "p99_micros": latency.p99_micros,
                "max_micros": latency.max_micros,
            });
            (it.stage.clone(), figures)
        })
        .collect();
    let subscribers: Vec<_> = status
        .subscribers
        .iter()
        .map(|it| {
            json!({
                "subscriber": it.subscriber,
                "protocol": it.protocol,
                "sent_samples": it.sent_samples,
                "skipped_samples": it.skipped_samples,
                "lag_frames": it.lag_frames,
            })
        })
        .collect();
    json!({
        "state": tables::state(status.state()),
        "failure": status.failure,
        "run": status.run,
        "actor_revision": status.actor_revision,
        "last_frame": status.last_frame,
        "frame_rate_hz": status.frame_rate_hz,
        "frames_received": status.frames_received,
        "frames_rejected": status.frames_rejected,
        "frames_shed": status.frames_shed,
        "frames_missing": status.frames_missing,
        "alignment": status.alignment.map(|it| json!({
            "scale": it.scale,
            "rms_residual_cm": it.rms_residual_cm,
            "iterations": it.iterations,
            "n_markers": it.n_markers,
        })),
        "alignment_problem": status.alignment_problem,
        "unknown_markers": status.unknown_markers,
        "latencies": latencies,
        "subscribers": subscribers,
    })
}

/// What became of a publication.
pub fn publication(session: &str, report: &PublishReport, failure: Option<&ClientError>) -> Value {
    let rejected: Map<_, _> = report
        .rejected
        .iter()
        .map(|(reason, it)| {
            let figures = json!({
                "frames": it.frames,
                "first_frame": it.first_frame,
                "first_detail": it.first_detail,
            });
            (reason.clone(), figures)
        })
        .collect();
    json!({
        "session": session,
        "run": report.run,
        "sent_frames": report.sent_frames,
        "resent_frames": report.resent_frames,
        "accepted_frames": report.accepted_frames,
        "known_frames": report.known_frames,
        "rejected_frames": report.rejected_frames(),
        "rejected": rejected,
        "shed_frames": report.shed_frames,
        "lost_frames": report.lost.n_frames(),
        "lost": report.lost.as_pairs(),
        "unacknowledged_frames": report.unacknowledged_frames,
        "reconnections": report.reconnections,
        "new_runs": report.new_runs,
        "failure": failure.map(|it| json!({ "message": it.message, "reason": it.reason })),
    })
}

/// One event of a subscription, tagged by `event`.
pub fn event(event: &CurveEvent) -> Value {
    match event {
        CurveEvent::Header(it) => {
            let controls: Vec<_> = it.controls.iter().map(|it| &it.name).collect();
            json!({
                "event": "header",
                "session": it.session,
                "actor": it.actor,
                "actor_revision": it.actor_revision,
                "run": it.run,
                "nominal_rate_hz": it.nominal_rate_hz,
                "controls": controls,
            })
        }
        CurveEvent::Sample(it) => sample(it),
        CurveEvent::Gap(it) => {
            let cause = it.cause().as_str_name();
            let cause = cause.strip_prefix("GAP_CAUSE_").unwrap_or(cause);
            json!({ "event": "gap", "first": it.first, "last": it.last, "cause": cause })
        }
        CurveEvent::Skipped(it) => json!({ "event": "skipped", "samples": it }),
        CurveEvent::State(it) => json!({
            "event": "state",
            "state": tables::state(it.session_state()),
            "last_frame_age_micros": it.last_frame_age_micros,
        }),
        CurveEvent::Lost {
            first_sequence,
            last_sequence,
        } => json!({
            "event": "lost",
            "first_sequence": first_sequence,
            "last_sequence": last_sequence,
        }),
        CurveEvent::NewRun { previous, present } => {
            json!({ "event": "new_run", "previous": previous, "present": present })
        }
        CurveEvent::Reconnecting { cause, wait } => json!({
            "event": "reconnecting",
            "cause": cause.to_string(),
            "wait_secs": wait.as_secs_f64(),
        }),
        CurveEvent::End(it) => json!({
            "event": "end",
            "reason": it.reason,
            "last_frame": it.last_frame,
        }),
    }
}

fn sample(sample: &CurveSample) -> Value {
    let regions: Vec<_> = sample
        .region_errors
        .iter()
        .map(|it| {
            json!({
                "region": tables::region(it.region()),
                "marker_error_cm": it.marker_error_cm,
                "n_markers": it.n_markers,
                "quality": csv::quality_name(it.quality()),
                "held_reason": it.held_reason,
            })
        })
        .collect();
    let head = sample.head.map(|it| {
        json!({
            "quaternion_xyzw": [it.qx, it.qy, it.qz, it.qw],
            "translation_cm": [it.tx_cm, it.ty_cm, it.tz_cm],
        })
    });
    json!({
        "event": "sample",
        "frame": sample.frame,
        "sequence": sample.sequence,
        "capture_time_nanos": sample.capture_time_nanos,
        "quality": csv::quality_name(sample.quality()),
        "activations": sample.activations,
        "regions": regions,
        "head": head,
        "held_frames": sample.held_frames,
        "unobserved": sample.unobserved,
    })
}
