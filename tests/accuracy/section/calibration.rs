//! Whether standard errors keep what they claim.

use frontalis_analysis::analyzer::MarkerSettings;
use harness::accuracy::{
    actors,
    condition::{Condition, FRESH_SEEDS, NOISE_MM},
    coverage::Coverage,
    marks,
    settings::without_sparsity,
};

use crate::{
    figure::{error, percent},
    parallel,
    report::Report,
    table::Table,
};

/// Coverage of the claimed intervals.
pub fn write(report: &mut Report) {
    report.add(&introduction());
    let settings = [
        ("default without sparsity", without_sparsity()),
        ("plain", MarkerSettings::plain()),
    ];
    let jobs: Vec<_> = (settings.iter())
        .flat_map(|it| NOISE_MM.map(|noise_mm| (it, noise_mm)))
        .collect();
    let coverages = parallel::map(
        &jobs,
        || (),
        |(), ((_, settings), noise_mm)| coverage(settings, *noise_mm),
    );
    let mut table = Table::new([
        "settings",
        "noise, mm",
        "within the 68 % interval",
        "within the 95 % interval",
        "RMS error",
        "RMS standard error",
    ]);
    for (((title, _), noise_mm), coverage) in jobs.iter().zip(coverages) {
        let shares = coverage.shares().map(percent);
        println!("calibration: {title}, {noise_mm} mm: {}", shares.join(", "));
        let sizes = coverage.error_and_claim().map(error);
        let settings = [(*title).to_owned(), noise_mm.to_string()];
        table.add([settings, shares, sizes].concat());
    }
    report.add(&table.to_string());
}

fn introduction() -> String {
    let [usual, wide] = marks::COVERAGE.map(|it| {
        let (low, high) = it.into_inner();
        format!("{:.0} to {:.0} %", 100.0 * low, 100.0 * high)
    });
    format!(
        "\
## Standard errors

How often the truth lies within one and within 1.96 standard errors of the found contraction, where the true contraction is between .05 and .95.
The sparsity term, which pulls towards 0 on purpose, is off, and the markers' noise is that of the model: the same for all, Gaussian, with nothing hidden and nothing jumped; the head moves.
Seeds as above.
The marks for the default without sparsity are {usual} and {wide}."
    )
}

fn coverage(settings: &MarkerSettings, noise_mm: f64) -> Coverage {
    let actor = actors::reference();
    let mut coverage = Coverage::default();
    for seed in FRESH_SEEDS {
        let take = Condition::clean(noise_mm).take(&actor, seed);
        coverage.add(&take.solve(&actor, settings).samples, &take.truth);
    }
    coverage
}
