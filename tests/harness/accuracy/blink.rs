//! Whether blinks keep their height.

use super::curves::Curves;

/// An eyelid that is closed this far blinks.
const CLOSED: f64 = 0.3;

/// A longer closure is not a blink, seconds.
const LONGEST_SECONDS: f64 = 0.5;

/// How far the found peak may stand from the true one, frames.
const REACH: usize = 2;

/// The mean over one eyelid's blinks of found peak − true peak; of the given eyelids the one where it is largest in size.
///
/// `None` when there is no blink.
pub fn largest_peak_error(
    found: &Curves,
    truth: &Curves,
    eyelids: &[usize],
    rate_hz: f64,
) -> Option<f64> {
    let errors = eyelids.iter().filter_map(|&muscle| {
        mean_peak_error(&found.of_muscle(muscle), &truth.of_muscle(muscle), rate_hz)
    });
    errors.max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

fn mean_peak_error(found: &[f64], truth: &[f64], rate_hz: f64) -> Option<f64> {
    let peak = |curve: &[f64]| curve.iter().copied().fold(0.0, f64::max);
    let errors: Vec<f64> = blinks(truth, rate_hz)
        .map(|(start, end)| {
            let around = start.saturating_sub(REACH)..(end + REACH).min(found.len());
            peak(&found[around]) - peak(&truth[start..end])
        })
        .collect();
    let count = errors.len() as f64;
    (count > 0.0).then(|| errors.iter().sum::<f64>() / count)
}

/// First and one past the last frame of every blink.
fn blinks(truth: &[f64], rate_hz: f64) -> impl Iterator<Item = (usize, usize)> {
    let mut start = 0;
    let runs = truth.chunk_by(|a, b| (*a >= CLOSED) == (*b >= CLOSED));
    runs.filter_map(move |run| {
        let first = start;
        start += run.len();
        let closed = run[0] >= CLOSED && run.len() as f64 <= LONGEST_SECONDS * rate_hz;
        closed.then_some((first, start))
    })
}
