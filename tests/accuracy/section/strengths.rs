//! What each strength of the objective costs and gives.

use frontalis_analysis::analyzer::MarkerSettings;
use harness::accuracy::{
    actors,
    condition::{Condition, FRESH_SEEDS},
    errors::Errors,
    lag::{Lags, mean_lag},
    take::N_NEUTRAL,
};

use crate::{
    figure::{error, signed},
    parallel,
    report::Report,
    table::Table,
};

/// A setting by name, changed to a strength.
type Set = fn(&mut MarkerSettings, f64);

const STRENGTHS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Noise of the performances, millimeters.
const NOISE_MM: f64 = 0.5;

/// What one strength makes of the performances, means over the seeds.
#[derive(Default)]
struct Cost {
    root_mean_square: f64,
    active: f64,
    small_bias: f64,
    lag_frames: f64,
    n_late: usize,
}

/// The default with one strength changed at a time.
pub fn write(report: &mut Report) {
    report.add(INTRODUCTION);
    let settings: [(&str, Set); 3] = [
        ("smoothing", |it, strength| {
            it.objective.smoothing = strength;
        }),
        ("sparsity", |it, strength| it.objective.sparsity = strength),
        ("symmetry", |it, strength| it.objective.symmetry = strength),
    ];
    let jobs: Vec<_> = settings
        .iter()
        .flat_map(|it| STRENGTHS.map(|strength| (it, strength)))
        .collect();
    let costs = parallel::map(
        &jobs,
        || (),
        |(), ((_, set), strength)| cost(*set, *strength),
    );
    let mut table = Table::new([
        "setting",
        "strength",
        "RMS error",
        "active",
        "bias",
        "mean lag, frames",
        "late curves",
    ]);
    for (((name, _), strength), cost) in jobs.iter().zip(costs) {
        println!(
            "strengths: {name} {strength}: RMS {}",
            error(cost.root_mean_square)
        );
        table.add(vec![
            (*name).to_owned(),
            strength.to_string(),
            error(cost.root_mean_square),
            error(cost.active),
            signed(cost.small_bias),
            format!("{:+.2}", cost.lag_frames),
            cost.n_late.to_string(),
        ]);
    }
    report.add(&table.to_string());
}

const INTRODUCTION: &str = "\
## What the strengths cost

The default settings with one strength changed at a time, on synthetic performances at 0.5 mm under a moving head, means over the seeds above; `active` and `bias` as for the real takes.
The mean lag is where the parabola through the three largest correlations of a curve with its truth peaks, in frames of 1/60 s, the mean over all curves; late curves peak more than one frame off.";

fn cost(set: Set, strength: f64) -> Cost {
    let actor = actors::reference();
    let mut settings = MarkerSettings::default();
    set(&mut settings, strength);
    let mut sum = Cost::default();
    let n = FRESH_SEEDS.len() as f64;
    for seed in FRESH_SEEDS {
        let take = Condition::clean(NOISE_MM).take(&actor, seed);
        let found = take.curves(&actor, &settings).from_frame(N_NEUTRAL);
        let truth = take.truth.from_frame(N_NEUTRAL);
        let errors = Errors::of(&found, &truth);
        sum.root_mean_square += errors.root_mean_square / n;
        sum.active += errors.active / n;
        sum.small_bias += errors.small_bias / n;
        sum.lag_frames += mean_lag(&found, &truth) / n;
        sum.n_late += Lags::of(&found, &truth).n_late;
    }
    sum
}
