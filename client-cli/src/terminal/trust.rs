//! What a performance says of the actor's shapes and of the neutral face: a table, and sentences.

use comfy_table::Table;
use frontalis_client::proto::{ControlRange, NeutralDoubt, RangeVerdict};

use super::tables::table;

/// One line a muscle.
pub fn ranges(ranges: &[ControlRange]) -> Table {
    let mut table = table(&[
        "muscle",
        "verdict on its shape",
        "sent: least",
        "most",
        "p1",
        "p99",
        "without bounds: p1",
        "p99",
        "out of range (%)",
        "frames",
    ]);
    for it in ranges {
        let bounded = it.bounded.unwrap_or_default();
        let unbounded = it.unbounded.unwrap_or_default();
        let figure = |value: f32| format!("{value:.2}");
        table.add_row([
            it.control.clone(),
            verdict(it.verdict()),
            figure(it.min),
            figure(it.max),
            figure(bounded.p1),
            figure(bounded.p99),
            figure(unbounded.p1),
            figure(unbounded.p99),
            format!("{:.1}", it.out_of_range * 100.0),
            it.n_frames.to_string(),
        ]);
    }
    table
}

/// `too weak` of `RANGE_VERDICT_TOO_WEAK`.
pub fn verdict(verdict: RangeVerdict) -> String {
    let name = verdict.as_str_name();
    let name = name.strip_prefix("RANGE_VERDICT_").unwrap_or(name);
    name.to_ascii_lowercase().replace('_', " ")
}

/// A muscle's verdict, and what it says to the artist.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'a> {
    pub muscle: &'a str,
    pub verdict: RangeVerdict,
    pub sentence: &'a str,
}

/// A line for each muscle whose shape is not sound, and one for all that were not seen enough.
pub fn findings(judged: &[Judged<'_>]) -> Vec<String> {
    let (unseen, seen): (Vec<_>, Vec<_>) = judged
        .iter()
        .filter(|it| !says_nothing(it.verdict))
        .partition(|it| it.verdict == RangeVerdict::NotYetSeen);
    let finding =
        |it: &&Judged<'_>| format!("{}: {}. {}", it.muscle, verdict(it.verdict), it.sentence);
    let mut findings: Vec<_> = seen.iter().map(finding).collect();
    if !unseen.is_empty() {
        let names: Vec<_> = unseen.iter().map(|it| it.muscle).collect();
        let names = names.join(", ");
        findings.push(format!(
            "too little was seen to judge the shapes of: {names}"
        ));
    }
    findings
}

/// Of a neutral face in doubt is said in a line of its own.
fn says_nothing(verdict: RangeVerdict) -> bool {
    matches!(
        verdict,
        RangeVerdict::Sound | RangeVerdict::NeutralInDoubt | RangeVerdict::Unspecified
    )
}

/// The doubt with its figures; `advice` says what to do.
pub fn doubt(doubt: &NeutralDoubt, advice: &str) -> String {
    format!(
        "the neutral face is in doubt: {:.2} mm from the actor's, {:.2} mm expected\n  what to do: {advice}",
        doubt.residual_cm * 10.0,
        doubt.expected_cm * 10.0,
    )
}

#[cfg(test)]
mod tests {
    use frontalis_client::proto::Percentiles;

    use super::*;

    #[test]
    fn only_what_is_not_sound_is_a_finding_and_the_unseen_share_a_line() {
        let judged = [
            ("jaw", RangeVerdict::Sound),
            ("kiss", RangeVerdict::TooWeak),
            ("smile_left", RangeVerdict::NotYetSeen),
            ("smile_right", RangeVerdict::NotYetSeen),
        ];
        let judged = judged.map(|(muscle, verdict)| Judged {
            muscle,
            verdict,
            sentence: verdict.sentence(),
        });
        let findings = findings(&judged);
        assert_eq!(findings.len(), 2, "{findings:?}");
        assert!(findings[0].starts_with("kiss: too weak. Full contractions"));
        assert!(findings[1].ends_with("smile_left, smile_right"));
    }

    #[test]
    fn a_range_shows_its_verdict_and_percentiles() {
        let mut range = ControlRange {
            control: "jaw".into(),
            out_of_range: 0.125,
            n_frames: 600,
            unbounded: Some(Percentiles {
                p1: -0.02,
                p99: 1.31,
            }),
            ..ControlRange::default()
        };
        range.set_verdict(RangeVerdict::HardlyObservable);
        let table = ranges(&[range]).to_string();
        for part in ["jaw", "hardly observable", "-0.02", "1.31", "12.5", "600"] {
            assert!(table.contains(part), "{part} in\n{table}");
        }
    }
}
