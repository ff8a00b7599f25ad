//! What `frontalis solve` says at its end: counts, errors, and what the curves say of the shapes and of the neutral face.

use frontalis_analysis::{
    curve::{CurveSample, Quality},
    face::actor::Actor,
    marker_analysis::{neutral_watch::NeutralDoubt, range::MuscleRange},
};
use frontalis_client::{
    proto::{self, NeutralDoubtCause, RangeVerdict},
    solve::Solved,
};

use crate::terminal::trust;

/// One line of counts and errors.
pub fn summary(solved: &Solved, n_frames: usize) -> String {
    let count = |quality| count(solved, |it| it.quality == quality);
    let mean_error = |region: usize| {
        let error_cm = solved.mean_marker_error_cm(region);
        error_cm.map_or("-".to_owned(), |it| format!("{:.3} mm", it * 10.0))
    };
    format!(
        "{n_frames} frames, {} samples: {} solved, {} partial, {} held; mean marker error upper {}, lower {} (--csv prints the curves)",
        solved.samples.len(),
        count(Quality::Solved),
        count(Quality::Partial),
        count(Quality::Held),
        mean_error(0),
        mean_error(1),
    )
}

/// What a person should know before the curves are trusted, line by line; nothing when there is nothing.
pub fn findings(actor: &Actor, solved: &Solved) -> Vec<String> {
    let mut lines = Vec::new();
    let n_outlying = count(solved, |it| !it.outliers.is_empty());
    if n_outlying > 0 {
        lines.push(format!(
            "{n_outlying} frames had markers that were masked as outliers{}",
            worst_marker(actor, solved)
        ));
    }
    let n_relabeled = count(solved, |it| !it.relabeled.is_empty());
    if n_relabeled > 0 {
        lines.push(format!(
            "in {n_relabeled} frames the labels of two markers were swapped, and have been put right"
        ));
    }
    let judged: Vec<_> = solved
        .ranges
        .iter()
        .filter_map(|it| judged(actor, it))
        .collect();
    lines.extend(trust::findings(&judged));
    lines.extend(solved.neutral_doubt.as_ref().map(doubt));
    lines
}

fn count(solved: &Solved, is_counted: impl Fn(&CurveSample) -> bool) -> usize {
    solved.samples.iter().filter(|it| is_counted(it)).count()
}

/// Which marker lay outside most often.
fn worst_marker(actor: &Actor, solved: &Solved) -> String {
    let n_frames = |marker: usize| count(solved, |it| it.outliers.contains(&marker));
    let markers = actor.markers().iter().enumerate();
    let worst = markers.max_by_key(|(marker, _)| n_frames(*marker));
    worst.map_or_else(String::new, |(marker, it)| {
        format!(", {} most often ({})", it.name, n_frames(marker))
    })
}

fn judged<'a>(actor: &'a Actor, range: &MuscleRange) -> Option<trust::Judged<'a>> {
    // The identifiers of the analysis are those of the wire.
    let name = format!("RANGE_VERDICT_{}", range.verdict.identifier());
    let verdict = RangeVerdict::from_str_name(&name)?;
    Some(trust::Judged {
        muscle: &actor.muscle_set().muscles().get(range.muscle)?.name,
        verdict,
        sentence: verdict.sentence(),
    })
}

fn doubt(doubt: &NeutralDoubt) -> String {
    let name = format!("NEUTRAL_DOUBT_CAUSE_{}", doubt.cause.identifier());
    let cause = NeutralDoubtCause::from_str_name(&name).unwrap_or_default();
    let figures = proto::NeutralDoubt {
        residual_cm: doubt.residual_cm,
        expected_cm: doubt.expected_cm,
        ..proto::NeutralDoubt::default()
    };
    let advice = format!(
        "{} Cut the take so that it begins with a relaxed face, or let --neutral-frames take fewer frames.",
        cause.sentence()
    );
    trust::doubt(&figures, &advice)
}

#[cfg(test)]
mod tests {
    use frontalis_analysis::marker_analysis::{
        neutral_watch::DoubtCause,
        range::{Percentiles, Verdict},
    };
    use frontalis_analysis::synthesis::reference_face;

    use super::*;

    fn range(muscle: usize, verdict: Verdict) -> MuscleRange {
        MuscleRange {
            muscle,
            n_frames: 100,
            bounded: Percentiles::default(),
            unbounded: Percentiles::default(),
            out_of_range: 0.0,
            verdict,
        }
    }

    #[test]
    fn a_sound_take_has_no_findings() {
        let actor = reference_face::actor();
        let solved = Solved {
            ranges: vec![range(0, Verdict::Sound)],
            ..Solved::default()
        };
        assert!(findings(&actor, &solved).is_empty());
    }

    #[test]
    fn verdicts_and_doubt_are_said_by_name() {
        let actor = reference_face::actor();
        let solved = Solved {
            ranges: vec![range(1, Verdict::WrongDirection)],
            neutral_doubt: Some(NeutralDoubt {
                cause: DoubtCause::LooksContracted,
                residual_cm: 0.1,
                expected_cm: 0.02,
            }),
            ..Solved::default()
        };
        let lines = findings(&actor, &solved);
        let name = &actor.muscle_set().muscles()[1].name;
        assert!(
            lines[0].starts_with(&format!("{name}: wrong direction. ")),
            "{lines:?}"
        );
        assert!(
            lines[1].contains("1.00 mm") && lines[1].contains("0.20 mm"),
            "{lines:?}"
        );
    }
}
