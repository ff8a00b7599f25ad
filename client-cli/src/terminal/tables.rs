//! Actors, sessions and takes as tables, with units in the headings.

use comfy_table::{ContentArrangement, Table, presets};
use frontalis_client::proto::{
    Actor, CaptureKind, ControlRange, FaceRegion, RegionMode, Role, Server, Session,
    SessionSettings, SessionState, SessionStatus, Take, Timecode,
};

use super::trust;
use crate::commands::short_id;

/// A table with these headings.
pub fn table(headings: &[&str]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_FULL_CONDENSED)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_header(headings);
    table
}

/// Two columns: what, and its value.
fn facts(rows: impl IntoIterator<Item = (&'static str, String)>) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_FULL_CONDENSED)
        .set_content_arrangement(ContentArrangement::Dynamic);
    for (what, value) in rows {
        table.add_row([what.to_owned(), value]);
    }
    table
}

/// One line an actor.
pub fn actors(actors: &[Actor]) -> Table {
    let mut table = table(&[
        "actor",
        "display name",
        "revision",
        "muscle set",
        "muscles",
        "markers",
        "vertices",
        "created (UTC)",
    ]);
    for actor in actors {
        table.add_row([
            short_id(&actor.name).to_owned(),
            actor.display_name.clone(),
            actor.revision.to_string(),
            actor.muscle_set.clone(),
            actor.muscles.len().to_string(),
            actor.markers.len().to_string(),
            actor.n_vertices.to_string(),
            timestamp(actor.create_time.as_ref()),
        ]);
    }
    table
}

/// Everything about one actor.
pub fn actor(actor: &Actor) -> String {
    let basis = actor.basis.clone().unwrap_or_default();
    let summary = facts([
        ("actor", short_id(&actor.name).to_owned()),
        ("display name", actor.display_name.clone()),
        ("newest revision", actor.revision.to_string()),
        ("created (UTC)", timestamp(actor.create_time.as_ref())),
        ("vertices", actor.n_vertices.to_string()),
        ("triangles", actor.n_triangles.to_string()),
        ("muscle set", actor.muscle_set.clone()),
        (
            "condition of the basis, upper face",
            format!("{:.1}", basis.condition_upper),
        ),
        (
            "condition of the basis, lower face",
            format!("{:.1}", basis.condition_lower),
        ),
    ]);
    let mut muscles = table(&["muscle", "region"]);
    for muscle in &actor.muscles {
        muscles.add_row([muscle.name.as_str(), region(muscle.region())]);
    }
    let mut markers = table(&["marker", "region", "head-fixed"]);
    for marker in &actor.markers {
        let head_fixed = if marker.head_fixed { "yes" } else { "" };
        markers.add_row([marker.name.as_str(), region(marker.region()), head_fixed]);
    }
    let mut parts = vec![
        summary.to_string(),
        muscles.to_string(),
        markers.to_string(),
    ];
    parts.extend(basis.ambiguous.iter().map(|pair| {
        format!(
            "the markers hardly tell {} and {} apart (correlation {:.3})",
            pair.first, pair.second, pair.correlation
        )
    }));
    parts.join("\n")
}

/// One line a take.
pub fn takes(takes: &[Take]) -> Table {
    let mut table = table(&[
        "take",
        "session",
        "actor",
        "slate",
        "number",
        "starts at",
        "state",
        "frames",
        "first",
        "last",
        "size (MB)",
        "circled",
        "notes",
    ]);
    for take in takes {
        let name = take.state().as_str_name().trim_start_matches("TAKE_STATE_");
        let state = name.to_ascii_lowercase().replace('_', " ");
        let resolved = match take.resolved_from.as_str() {
            "" => String::new(),
            from => format!(", solved from {}", short_id(from)),
        };
        let recovered = if take.recovered { ", recovered" } else { "" };
        table.add_row([
            short_id(&take.name).to_owned(),
            short_id(&take.session).to_owned(),
            short_id(&take.actor).to_owned(),
            take.slate.clone(),
            take.number.to_string(),
            timecode(take.start_timecode.as_ref()),
            format!("{state}{recovered}{resolved}"),
            take.n_frames.to_string(),
            take.first_frame.to_string(),
            take.last_frame.to_string(),
            format!("{:.1}", take.n_bytes as f64 / 1e6),
            if take.circled { "yes" } else { "" }.to_owned(),
            take.notes.clone(),
        ]);
    }
    table
}

/// As a clock on the stage shows it: `;` before the frames where labels are dropped; empty without one.
pub fn timecode(timecode: Option<&Timecode>) -> String {
    timecode.map_or_else(String::new, |it| {
        let mark = if it.drop_frame { ';' } else { ':' };
        format!(
            "{:02}:{:02}:{:02}{mark}{:02}",
            it.hours, it.minutes, it.seconds, it.frames
        )
    })
}

/// One line a session.
pub fn sessions(sessions: &[Session]) -> Table {
    let mut table = table(&[
        "session",
        "actor",
        "state",
        "run",
        "last frame",
        "rate (frames/s)",
        "received",
        "rejected",
        "shed",
        "missing",
        "subscribers",
    ]);
    for session in sessions {
        let status = session.status.clone().unwrap_or_default();
        table.add_row([
            short_id(&session.name).to_owned(),
            short_id(&session.actor).to_owned(),
            state(status.state()).to_owned(),
            status.run.to_string(),
            status.last_frame.to_string(),
            format!("{:.1}", status.frame_rate_hz),
            status.frames_received.to_string(),
            status.frames_rejected.to_string(),
            status.frames_shed.to_string(),
            status.frames_missing.to_string(),
            status.subscribers.len().to_string(),
        ]);
    }
    table
}

/// Everything about one session.
pub fn session(session: &Session) -> String {
    let status = session.status.clone().unwrap_or_default();
    let mut parts = vec![facts(session_facts(session, &status)).to_string()];
    if !status.latencies.is_empty() && status.frames_received > 0 {
        let mut latencies = table(&["latency", "p50 (µs)", "p99 (µs)", "max (µs)"]);
        for it in &status.latencies {
            let latency = it.latency.unwrap_or_default();
            latencies.add_row([
                it.stage.clone(),
                format!("{:.0}", latency.p50_micros),
                format!("{:.0}", latency.p99_micros),
                format!("{:.0}", latency.max_micros),
            ]);
        }
        parts.push(latencies.to_string());
    }
    if !status.subscribers.is_empty() {
        let mut subscribers = table(&["subscriber", "protocol", "sent", "skipped", "lag (frames)"]);
        for it in &status.subscribers {
            subscribers.add_row([
                it.subscriber.clone(),
                it.protocol.clone(),
                it.sent_samples.to_string(),
                it.skipped_samples.to_string(),
                it.lag_frames.to_string(),
            ]);
        }
        parts.push(subscribers.to_string());
    }
    if !status.ranges.is_empty() {
        parts.push(trust::ranges(&status.ranges).to_string());
        let judged: Vec<_> = status.ranges.iter().map(judged).collect();
        parts.extend(trust::findings(&judged));
    }
    if let Some(doubt) = &status.neutral_doubt {
        let id = short_id(&session.name);
        let advice = format!(
            "{} (frontalis session recenter {id}, with --quietest for the quietest frames)",
            doubt.advice
        );
        parts.push(trust::doubt(doubt, &advice));
    }
    parts.join("\n")
}

fn judged(range: &ControlRange) -> trust::Judged<'_> {
    trust::Judged {
        muscle: &range.control,
        verdict: range.verdict(),
        sentence: &range.sentence,
    }
}

fn session_facts(session: &Session, status: &SessionStatus) -> Vec<(&'static str, String)> {
    let settings = session.settings.clone().unwrap_or_default();
    let mut rows = vec![
        ("session", short_id(&session.name).to_owned()),
        ("display name", session.display_name.clone()),
        ("actor", short_id(&session.actor).to_owned()),
        ("actor revision", status.actor_revision.to_string()),
        ("captures", kind(session.kind()).to_owned()),
        ("created (UTC)", timestamp(session.create_time.as_ref())),
        ("state", state(status.state()).to_owned()),
        ("run", status.run.to_string()),
        ("last frame", status.last_frame.to_string()),
        ("rate (frames/s)", format!("{:.2}", status.frame_rate_hz)),
        ("frames received", status.frames_received.to_string()),
        ("frames rejected", status.frames_rejected.to_string()),
        ("frames shed", status.frames_shed.to_string()),
        ("frames missing", status.frames_missing.to_string()),
        (
            "neutral frames",
            settings.neutral_frames.unwrap_or_default().to_string(),
        ),
        ("regions", region_mode(settings.region_mode()).to_owned()),
        (
            "exaggeration",
            yes(settings.allow_exaggeration.unwrap_or_default()),
        ),
        (
            "solves for head motion",
            yes(settings.stabilize_head.unwrap_or_default()),
        ),
        (
            "aligns on request",
            yes(settings.align_on_request.unwrap_or_default()),
        ),
        ("records itself", yes(settings.record())),
        ("objective", objective(&settings)),
        ("bounds of its own", own_bounds(&settings)),
        ("exclusive pairs", exclusive_pairs(&settings)),
        ("stale after (s)", duration(settings.stale_after)),
        (
            "publisher timeout (s)",
            duration(settings.publisher_timeout),
        ),
    ];
    if let Some(alignment) = status.alignment {
        rows.push(("alignment: markers", alignment.n_markers.to_string()));
        rows.push(("alignment: scale", format!("{:.5}", alignment.scale)));
        rows.push((
            "alignment: residual (mm)",
            format!("{:.3}", alignment.rms_residual_cm * 10.0),
        ));
    }
    if let Some(clock) = status.clock {
        let millis = |nanos: f64| format!("{:.3}", nanos * 1e-6);
        rows.push((
            "capture clock: offset (ms)",
            format!(
                "{} ± {}",
                millis(clock.offset_nanos as f64),
                millis(clock.uncertainty_nanos as f64)
            ),
        ));
        rows.push((
            "capture clock: drift (ppm)",
            format!("{:.1}", clock.drift_ppm),
        ));
        rows.push((
            "capture clock: round trip (ms)",
            millis(clock.round_trip_nanos as f64),
        ));
    }
    if !status.alignment_problem.is_empty() {
        rows.push(("alignment failed", status.alignment_problem.clone()));
    }
    if !status.failure.is_empty() {
        rows.push(("failed", status.failure.clone()));
    }
    if !status.unknown_markers.is_empty() {
        rows.push((
            "markers not of this actor",
            status.unknown_markers.join(", "),
        ));
    }
    rows
}

/// `plain`, or the terms that are on.
fn objective(settings: &SessionSettings) -> String {
    if settings.plain() {
        return "plain".to_owned();
    }
    let strengths = [
        ("smoothing", settings.smoothing()),
        ("sparsity", settings.sparsity()),
        ("symmetry", settings.symmetry()),
    ];
    let robust = settings.robust().then(|| "robust".to_owned());
    let on = strengths.iter().filter(|(_, strength)| *strength > 0.0);
    let on = on.map(|(name, strength)| format!("{name} {strength}"));
    robust.into_iter().chain(on).collect::<Vec<_>>().join(", ")
}

fn own_bounds(settings: &SessionSettings) -> String {
    let bounds = settings.bounds.iter();
    let bounds = bounds.map(|it| format!("{} {}..{}", it.control, it.lower, it.upper));
    bounds.collect::<Vec<_>>().join(", ")
}

fn exclusive_pairs(settings: &SessionSettings) -> String {
    let pairs = settings.exclusive_pairs.iter();
    let pairs = pairs.map(|it| format!("{} or {}", it.first, it.second));
    pairs.collect::<Vec<_>>().join(", ")
}

/// Everything about the server, and who asks.
pub fn server(address: &str, server: &Server) -> Table {
    let caller = server.caller.clone().unwrap_or_default();
    let expires = timestamp(caller.expire_time.as_ref());
    let mut rows = vec![
        ("server", address.to_owned()),
        ("version", server.version.clone()),
        ("running since (UTC)", timestamp(server.start_time.as_ref())),
        ("TLS", yes(server.tls)),
        ("asks for tokens", yes(server.tokens)),
        ("you are", caller.name.clone()),
        ("your role", role(caller.role()).to_owned()),
        ("your sessions", caller.sessions.join(", ")),
        (
            "your token expires (UTC)",
            if expires.is_empty() {
                "never".to_owned()
            } else {
                expires
            },
        ),
    ];
    if server.insecure {
        rows.push((
            "INSECURE",
            "other machines can reach it unprotected".to_owned(),
        ));
    }
    if server.draining {
        rows.push(("shutting down", "yes".to_owned()));
    }
    facts(rows)
}

/// `operator`, `publisher`, `renderer` or `viewer`.
pub fn role(role: Role) -> &'static str {
    match role {
        Role::Unspecified => "none",
        Role::Operator => "operator",
        Role::Publisher => "publisher",
        Role::Renderer => "renderer",
        Role::Viewer => "viewer",
    }
}

/// `waiting`, `aligning`, `live`, `stale`, `ended`, `failed`.
pub fn state(state: SessionState) -> &'static str {
    match state {
        SessionState::Unspecified => "unspecified",
        SessionState::Waiting => "waiting",
        SessionState::Aligning => "aligning",
        SessionState::Live => "live",
        SessionState::Stale => "stale",
        SessionState::Ended => "ended",
        SessionState::Failed => "failed",
    }
}

/// `upper` or `lower`.
pub fn region(region: FaceRegion) -> &'static str {
    match region {
        FaceRegion::Unspecified => "",
        FaceRegion::Upper => "upper",
        FaceRegion::Lower => "lower",
    }
}

/// `joint` or `split`.
pub fn region_mode(mode: RegionMode) -> &'static str {
    match mode {
        RegionMode::Unspecified | RegionMode::Joint => "joint",
        RegionMode::Split => "split",
    }
}

/// `markers` or `images`.
pub fn kind(kind: CaptureKind) -> &'static str {
    match kind {
        CaptureKind::Unspecified | CaptureKind::Markers => "markers",
        CaptureKind::Images => "images",
    }
}

fn yes(it: bool) -> String {
    if it { "yes" } else { "no" }.to_owned()
}

fn duration(duration: Option<pbjson_types::Duration>) -> String {
    duration.map_or_else(
        || "automatic".to_owned(),
        |it| format!("{:.3}", seconds(it)),
    )
}

/// Seconds of a wire duration.
pub fn seconds(duration: pbjson_types::Duration) -> f64 {
    duration.seconds as f64 + f64::from(duration.nanos) * 1e-9
}

/// `2026-11-22T16:59:09Z`, or nothing.
pub fn timestamp(time: Option<&frontalis_proto::Timestamp>) -> String {
    time.map(|it| frontalis_proto::Timestamp { nanos: 0, ..*it }.to_rfc3339())
        .unwrap_or_default()
}
