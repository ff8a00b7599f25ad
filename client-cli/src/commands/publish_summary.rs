//! What became of a publication, for a person or a program.

use std::{process::ExitCode, time::Duration};

use frontalis_client::{
    capture_client::{Published, report::PublishReport},
    error::advice_on,
};

use super::Context;
use crate::{json, terminal::say};

/// Prints the counts; fails when the publication did, or when frames got lost.
pub fn print(
    context: &Context,
    session: &str,
    published: &Published,
    elapsed: Duration,
    what: &str,
) -> anyhow::Result<ExitCode> {
    let report = &published.report;
    if context.json {
        let mut value = json::publication(session, report, published.failure.as_ref());
        value["elapsedSecs"] = serde_json::json!(elapsed.as_secs_f64());
        say(value)?;
    } else {
        for line in lines(session, report, elapsed, what) {
            say(line)?;
        }
    }
    if let Some(failure) = &published.failure {
        return Err(anyhow::Error::new(failure.clone())
            .context(format!("publishing into {session} was ended")));
    }
    let is_whole = report.lost.is_empty() && report.unacknowledged_frames == 0;
    Ok(if is_whole {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

fn lines(session: &str, report: &PublishReport, elapsed: Duration, what: &str) -> Vec<String> {
    let secs = elapsed.as_secs_f64();
    let rate = report.sent_frames as f64 / secs.max(1e-9);
    let mut lines = vec![format!(
        "{what} -> {session}: {} frames sent in {secs:.2} s ({rate:.1} frames/s), {} accepted, {} rejected, {} shed",
        report.sent_frames,
        report.accepted_frames,
        report.rejected_frames(),
        report.shed_frames,
    )];
    if report.known_frames > 0 {
        lines.push(format!(
            "  {} frames have numbers that the session had before (--renumber goes on after them)",
            report.known_frames
        ));
    }
    for (reason, it) in &report.rejected {
        lines.push(format!(
            "  rejected {reason}: {} frames, the first {}: {}",
            it.frames, it.first_frame, it.first_detail
        ));
        lines.extend(advice_on(reason).map(|it| format!("    what to do: {it}")));
    }
    if report.reconnections > 0 {
        lines.push(format!(
            "  reconnected {} times, {} frames sent again, {} new runs of the session",
            report.reconnections, report.resent_frames, report.new_runs
        ));
    }
    if !report.lost.is_empty() {
        lines.push(format!(
            "  lost {} frames while the server was away: {}",
            report.lost.n_frames(),
            report.lost
        ));
    }
    if let Some(last) = report.recorded_through {
        lines.push(format!(
            "  the session's recording ended meanwhile: the take has frames through {last} (`frontalis take list` says why)"
        ));
    }
    if report.unacknowledged_frames > 0 {
        lines.push(format!(
            "  {} frames without an answer",
            report.unacknowledged_frames
        ));
    }
    lines
}
