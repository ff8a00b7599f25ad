//! What `--json` prints: the messages of the wire in the protobuf JSON mapping, as the server's HTTP doors do.
//!
//! What is no message has names in the same style: camel case, 64-bit numbers as strings.

use frontalis_client::{
    capture_client::report::PublishReport,
    curve_client::CurveEvent,
    error::ClientError,
    proto::{Gap, SubscribeResponse},
    solve::SolveError,
};
use serde_json::{Map, Value, json};

/// An error, with the server's reason and figures when it refused.
pub fn error(error: &anyhow::Error, refusal: Option<&ClientError>, advice: Option<&str>) -> Value {
    let mut value = json!({ "error": format!("{error:#}") });
    if let Some(refusal) = refusal {
        value["code"] = json!(code_name(refusal.code));
        value["reason"] = json!(refusal.reason);
        value["metadata"] = json!(refusal.metadata);
        value["retryAfterSecs"] = json!(refusal.retry_after.map(|it| it.as_secs_f64()));
    }
    if refusal.is_some() || advice.is_some() {
        value["advice"] = json!(advice);
    }
    value
}

/// `NOT_FOUND` of `NotFound`: the names of `google.rpc.Code`.
fn code_name(code: tonic::Code) -> String {
    let mut name = String::new();
    for letter in format!("{code:?}").chars() {
        if letter.is_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.push(letter.to_ascii_uppercase());
    }
    name
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

/// What became of a publication.
pub fn publication(session: &str, report: &PublishReport, failure: Option<&ClientError>) -> Value {
    let rejected: Map<_, _> = report
        .rejected
        .iter()
        .map(|(reason, it)| {
            let figures = json!({
                "frames": it.frames.to_string(),
                "firstFrame": it.first_frame.to_string(),
                "firstDetail": it.first_detail,
            });
            (reason.clone(), figures)
        })
        .collect();
    let lost: Vec<_> = report.lost.as_pairs().iter().map(gap).collect();
    json!({
        "session": session,
        "run": report.run.to_string(),
        "sentFrames": report.sent_frames.to_string(),
        "resentFrames": report.resent_frames.to_string(),
        "acceptedFrames": report.accepted_frames.to_string(),
        "knownFrames": report.known_frames.to_string(),
        "rejectedFrames": report.rejected_frames().to_string(),
        "rejected": rejected,
        "shedFrames": report.shed_frames.to_string(),
        "lostFrames": report.lost.n_frames().to_string(),
        "lost": lost,
        "unacknowledgedFrames": report.unacknowledged_frames.to_string(),
        "reconnections": report.reconnections.to_string(),
        "newRuns": report.new_runs.to_string(),
        "failure": failure.map(|it| json!({ "message": it.message, "reason": it.reason })),
    })
}

/// One event of a subscription: a `SubscribeResponse`, or what only the client knows.
pub fn event(event: CurveEvent) -> serde_json::Result<Value> {
    let mut response = SubscribeResponse::default();
    match event {
        CurveEvent::Header(it) => response.header = Some(it),
        CurveEvent::Sample(it) => response.samples = vec![it],
        CurveEvent::Gap(it) => response.gaps = vec![it],
        CurveEvent::Skipped(it) => response.skipped_samples = it,
        CurveEvent::State(it) => response.state = Some(it),
        CurveEvent::End(it) => response.end = Some(it),
        CurveEvent::Lost {
            first_sequence,
            last_sequence,
        } => return Ok(json!({ "lost": gap(&(first_sequence, last_sequence)) })),
        CurveEvent::NewRun { previous, present } => {
            let runs = json!({ "previous": previous.to_string(), "present": present.to_string() });
            return Ok(json!({ "newRun": runs }));
        }
        CurveEvent::Reconnecting { cause, wait } => {
            let why = json!({ "cause": cause.to_string(), "waitSecs": wait.as_secs_f64() });
            return Ok(json!({ "reconnecting": why }));
        }
    }
    serde_json::to_value(response)
}

/// A range, both ends included.
fn gap(&(first, last): &(u64, u64)) -> Value {
    json!(Gap {
        first,
        last,
        ..Gap::default()
    })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use frontalis_client::proto::{CurveSample, Quality};

    use super::*;

    #[test]
    fn an_event_is_the_message_that_the_servers_doors_send() {
        let sample = CurveSample {
            frame: 7,
            sequence: 3,
            activations: vec![0.25, 0.0],
            quality: Quality::Held.into(),
            ..CurveSample::default()
        };
        let printed = event(CurveEvent::Sample(sample.clone())).unwrap();
        assert_eq!(printed["samples"][0]["frame"], "7");
        assert_eq!(printed["samples"][0]["quality"], "QUALITY_HELD");
        let read: SubscribeResponse = serde_json::from_value(printed).unwrap();
        assert_eq!(read.samples, [sample]);
    }

    #[test]
    fn what_only_the_client_knows_is_in_the_same_style() {
        let lost = CurveEvent::Lost {
            first_sequence: 2,
            last_sequence: 1 << 60,
        };
        let expected = json!({ "lost": { "first": "2", "last": "1152921504606846976" } });
        assert_eq!(event(lost).unwrap(), expected);
        let run = CurveEvent::NewRun {
            previous: 1,
            present: 2,
        };
        assert_eq!(
            event(run).unwrap(),
            json!({ "newRun": { "previous": "1", "present": "2" } })
        );
        let cut = CurveEvent::Reconnecting {
            cause: ClientError::local(tonic::Code::Unavailable, "gone"),
            wait: Duration::from_millis(250),
        };
        assert_eq!(event(cut).unwrap()["reconnecting"]["waitSecs"], 0.25);
    }

    #[test]
    fn a_code_has_its_public_name() {
        assert_eq!(code_name(tonic::Code::NotFound), "NOT_FOUND");
        assert_eq!(code_name(tonic::Code::Unauthenticated), "UNAUTHENTICATED");
    }
}
