//! What differs, as a table and as JSON.

use frontalis_client::take_difference::{ControlDifference, TakeDifference};
use serde_json::{Value, json};

use crate::terminal::tables;

/// Columns of the strip that shows where in the take a muscle differs.
const N_COLUMNS: usize = 32;

/// From nothing to the largest difference of any muscle.
const LEVELS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// Sentences, and one line a muscle that differs, the furthest apart first.
pub fn words(difference: &TakeDifference, [first, second]: [&str; 2]) -> String {
    let mut lines = vec![format!(
        "{first} (A) and {second} (B): {} frames in both, {} of them the same bit for bit",
        difference.n_frames, difference.n_same
    )];
    let onlys = [
        ("A", difference.n_only_first, &difference.only_first),
        ("B", difference.n_only_second, &difference.only_second),
    ];
    for (which, n_frames, muscles) in onlys {
        if n_frames > 0 {
            lines.push(format!("only in {which}: {n_frames} frames"));
        }
        if !muscles.is_empty() {
            lines.push(format!("only in {which}: {}", muscles.join(", ")));
        }
    }
    if difference.controls.iter().any(differs) {
        lines.push(table(difference));
    }
    lines.extend(unchanged(difference));
    lines.join("\n")
}

fn differs(control: &ControlDifference) -> bool {
    control.n_differing > 0
}

fn table(difference: &TakeDifference) -> String {
    let mut table = tables::table(&[
        "muscle",
        "largest",
        "A",
        "B",
        "at frame",
        "timecode",
        "RMS",
        "mean of B - A",
        "frames that differ (%)",
        "where in the take",
    ]);
    let controls = difference.controls.iter().enumerate();
    let mut rows: Vec<_> = controls.filter(|it| differs(it.1)).collect();
    rows.sort_by(|a, b| b.1.max().total_cmp(&a.1.max()));
    for (index, control) in rows {
        let Some(largest) = &control.largest else {
            continue;
        };
        table.add_row([
            control.name.clone(),
            activation(control.max()),
            activation(largest.first.into()),
            activation(largest.second.into()),
            largest.frame.to_string(),
            tables::timecode(largest.timecode.as_ref()),
            activation(control.rms()),
            format!("{:+.4}", control.mean()),
            format!("{:.1}", 100.0 * share(control, difference)),
            strip(difference, index),
        ]);
    }
    table.to_string()
}

/// Four digits, or as many as a smaller one needs.
fn activation(value: f64) -> String {
    if value == 0.0 || value.abs() >= 1e-4 {
        format!("{value:.4}")
    } else {
        format!("{value:.0e}")
    }
}

fn share(control: &ControlDifference, difference: &TakeDifference) -> f64 {
    control.n_differing as f64 / difference.n_frames.max(1) as f64
}

fn strip(difference: &TakeDifference, control: usize) -> String {
    let most = difference.max();
    let level = |distance: f32| {
        let highest = LEVELS.len() - 1;
        let share = f64::from(distance) / most * highest as f64;
        (0..highest)
            .find(|it| share <= *it as f64)
            .map_or(LEVELS[highest], |it| LEVELS[it])
    };
    let distances = difference.timeline.distances(control, N_COLUMNS);
    distances.into_iter().map(level).collect()
}

/// The muscles that are the same.
fn unchanged(difference: &TakeDifference) -> Option<String> {
    let same = difference.controls.iter().filter(|it| !differs(it));
    let names: Vec<_> = same.map(|it| it.name.as_str()).collect();
    if difference.n_frames == 0 || names.is_empty() {
        return None;
    }
    if names.len() < difference.controls.len() {
        return Some(format!("the same throughout: {}", names.join(", ")));
    }
    let also = if difference.n_same == difference.n_frames {
        ""
    } else {
        "; samples differ in what else they say: quality, head pose, errors or markers"
    };
    Some(format!(
        "all {} muscles are the same throughout{also}",
        names.len()
    ))
}

/// The same with the names that the API has for them.
pub fn json(difference: &TakeDifference) -> Value {
    let control = |it: &ControlDifference| {
        let largest = it.largest.as_ref().map(|largest| {
            json!({
                "frame": largest.frame,
                "timecode": largest.timecode,
                "first": largest.first,
                "second": largest.second,
            })
        });
        json!({
            "control": it.name,
            "max": it.max(),
            "rms": it.rms(),
            "mean": it.mean(),
            "nDiffering": it.n_differing,
            "largest": largest,
        })
    };
    json!({
        "nFrames": difference.n_frames,
        "nSame": difference.n_same,
        "nOnlyFirst": difference.n_only_first,
        "nOnlySecond": difference.n_only_second,
        "onlyFirst": difference.only_first,
        "onlySecond": difference.only_second,
        "controls": difference.controls.iter().map(control).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_differences_are_not_rounded_to_none() {
        assert_eq!(activation(0.0), "0.0000");
        assert_eq!(activation(0.25), "0.2500");
        assert_eq!(activation(2e-8), "2e-8");
    }
}
