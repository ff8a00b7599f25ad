//! Health, metrics, and what there is to see.

use std::collections::BTreeMap;

use axum::{
    Extension,
    extract::{RawQuery, State},
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};

use serde::Deserialize;
use utoipa::IntoParams;

use super::{
    Doors,
    openapi::{Document, Refusals},
    problem::Problem,
    query,
};
use crate::{
    hub::SessionState,
    service::{
        access::{Action, Caller},
        grpc::status::reason_of,
        readiness::{RECORDING, Readiness},
    },
    session::{SessionHandle, SessionStatus},
    telemetry::{Protocol, SessionFigures},
    wire::session::state_name,
};

const INDEX: &str = "\
Frontalis: facial motion capture in, muscle curves out.

gRPC on this port: frontalis.v1, with reflection and health.

GET /docs
";

const STATES: [SessionState; 6] = [
    SessionState::Waiting,
    SessionState::Aligning,
    SessionState::Live,
    SessionState::Stale,
    SessionState::Ended,
    SessionState::Failed,
];

/// What there is to see, as text.
#[utoipa::path(
    get,
    path = "/",
    operation_id = "index",
    tag = "observation",
    security(()),
    responses((status = 200, description = "The paths.", body = String, content_type = "text/plain")),
)]
pub(super) async fn index(
    State(doors): State<Doors>,
    Extension(document): Extension<Document>,
) -> String {
    let warning = if doors.metrics.is_insecure() {
        "\nINSECURE: others can reach this port, without TLS or without tokens.\n"
    } else {
        ""
    };
    format!("{INDEX}{}{warning}", document.index())
}

/// Live: the runtime answers.
#[utoipa::path(
    get,
    path = "/healthz",
    operation_id = "isLive",
    tag = "observation",
    security(()),
    responses(
        (status = 200, description = "`ok`.", body = String, content_type = "text/plain"),
    ),
)]
pub(super) async fn healthz() -> &'static str {
    "ok\n"
}

/// What may be asked of readiness.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(super) struct ReadyQuery {
    /// The service that shall be ready, as the gRPC health check names it: empty or `frontalis.v1.CaptureService` for new
    /// sessions, `frontalis.v1.TakeService` for new takes too.
    #[serde(default)]
    #[param(
        required = false,
        pattern = "^(frontalis[.]v1[.](CaptureService|TakeService))?$",
        example = ""
    )]
    service: String,
}

/// Ready: new sessions are accepted, or, for `frontalis.v1.TakeService`, new takes.
#[utoipa::path(
    get,
    path = "/readyz",
    operation_id = "isReady",
    tag = "observation",
    security(()),
    params(ReadyQuery),
    responses(
        (status = 200, description = "`ready`.", body = String, content_type = "text/plain"),
        (
            status = 400,
            description = "There is no such service.",
            body = ref("#/components/schemas/Problem"),
            content_type = "application/problem+json",
        ),
        (
            status = 503,
            description = "The server is shutting down, or its catalogue is damaged, or the disk is almost full.",
            body = ref("#/components/schemas/Problem"),
            content_type = "application/problem+json",
        ),
    ),
)]
pub(super) async fn readyz(State(doors): State<Doors>, RawQuery(query): RawQuery) -> Response {
    match check_ready(&doors.readiness, &query.unwrap_or_default()) {
        Ok(()) => "ready\n".into_response(),
        Err(problem) => problem.into_response(),
    }
}

fn check_ready(readiness: &Readiness, query: &str) -> Result<(), Problem> {
    let query: ReadyQuery = query::read(query)?;
    let checked = match query.service.as_str() {
        "" | "frontalis.v1.CaptureService" => readiness.check(),
        RECORDING => readiness.check_recording(),
        _ => {
            let detail =
                "service must be empty, frontalis.v1.CaptureService or frontalis.v1.TakeService";
            let problem = Problem::new(StatusCode::BAD_REQUEST, "QUERY", detail);
            return Err(problem.with("field", "service"));
        }
    };
    checked.map_err(|refused| {
        let reason = reason_of(&refused).unwrap_or_default();
        Problem::new(StatusCode::SERVICE_UNAVAILABLE, &reason, refused.message())
    })
}

/// Figures for a monitoring system.
#[utoipa::path(
    get,
    path = "/metrics",
    operation_id = "metrics",
    tag = "observation",
    responses(
        (
            status = 200,
            description = "OpenMetrics.",
            body = String,
            content_type = "application/openmetrics-text",
        ),
        Refusals,
    ),
)]
pub(super) async fn metrics(
    State(doors): State<Doors>,
    Extension(caller): Extension<Caller>,
) -> Result<impl IntoResponse, Problem> {
    caller.may(Action::ReadMetrics)?;
    doors.metrics.request(Protocol::Http);
    let all: Vec<SessionStatus> = doors
        .services
        .sessions
        .sessions()
        .handles()
        .iter()
        .map(SessionHandle::status)
        .collect();
    doors.metrics.set_calls(doors.services.calls.in_progress());
    doors.metrics.set_ready(doors.readiness.check().is_ok());
    let is_recording = doors.readiness.check_recording().is_ok();
    doors.metrics.set_ready_to_record(is_recording);
    doors.metrics.set_sessions(&figures(&all));
    let kind = "application/openmetrics-text; version=1.0.0; charset=utf-8";
    Ok(([(header::CONTENT_TYPE, kind)], doors.metrics.to_text()))
}

fn figures(all: &[SessionStatus]) -> SessionFigures {
    let in_state = |state| all.iter().filter(|it| it.state == state).count() as u64;
    let sum = |figure: fn(&SessionStatus) -> u64| all.iter().map(figure).sum::<u64>();
    let subscribers = || all.iter().flat_map(|it| &it.subscribers);
    SessionFigures {
        states: STATES
            .iter()
            .map(|&it| (state_name(it), in_state(it)))
            .collect(),
        frames: vec![
            ("received", sum(|it| it.frames_received)),
            ("rejected", sum(|it| it.frames_rejected)),
            ("late", sum(|it| it.frames_late)),
            ("duplicate", sum(|it| it.frames_duplicate)),
            ("shed", sum(|it| it.frames_shed)),
            ("missing", sum(|it| it.frames_missing)),
        ],
        subscribers: subscribers().count() as u64,
        samples: vec![
            ("sent", subscribers().map(|it| it.sent_samples).sum()),
            ("skipped", subscribers().map(|it| it.skipped_samples).sum()),
        ],
        latencies: latencies(all),
    }
}

/// The slowest session's time at each stage: one that cannot keep up shows, however many others can.
fn latencies(all: &[SessionStatus]) -> Vec<(&'static str, &'static str, f64)> {
    let mut slowest: BTreeMap<(&'static str, &'static str), f64> = BTreeMap::new();
    for measured in all.iter().flat_map(|it| &it.latencies) {
        let latency = &measured.latency;
        let figures = [
            ("0.5", latency.p50_micros),
            ("0.99", latency.p99_micros),
            ("1", latency.max_micros),
        ];
        for (quantile, micros) in figures {
            let so_far = slowest.entry((measured.stage, quantile)).or_default();
            *so_far = so_far.max(micros);
        }
    }
    let flat = |((stage, quantile), micros)| (stage, quantile, micros);
    slowest.into_iter().map(flat).collect()
}
