//! Synthetic performances on the reference face, under every condition.

use std::sync::Arc;

use frontalis_analysis::{analyzer::MarkerSettings, face::actor::Actor};
use harness::accuracy::{
    actors,
    condition::{Condition, FRESH_SEEDS},
    errors::{Errors, by_muscle},
    marks,
    take::N_NEUTRAL,
};

use crate::{
    figure::{mean, mean_and_spread},
    methods::{Comparison, Method},
    parallel,
    picture::{bars, curves},
    report::Report,
    table::Table,
};

/// Performances on which the constants of other methods are chosen.
const TUNING_SEEDS: [u64; 2] = [1, 2];

/// Tables, marks and pictures.
pub fn write(report: &mut Report, methods: &[Method]) {
    let actor = actors::reference();
    let tuning = TUNING_SEEDS.map(|seed| Condition::clean(0.5).take(&actor, seed));
    let comparison = &Comparison::tuned_on(&tuning.each_ref(), &actor, methods);
    println!("reference face: {}", comparison.constants());
    let conditions = Condition::all();
    let errors = errors(&conditions, comparison, &actor);
    report.add(&introduction(comparison));
    for (moving_head, title) in [(false, "### Still head"), (true, "### Moving head")] {
        report.add(title);
        report.add(&table(&conditions, &errors, comparison, moving_head).to_string());
    }
    report.add(REFERENCE_VALUES);
    report.add(&corrupted_neutral(&actor));
    draw(report, &actor);
}

fn introduction(comparison: &Comparison) -> String {
    let [plain, default] =
        [marks::PLAIN_RMS, marks::DEFAULT_RMS].map(|it| it.map(crate::figure::error).join(", "));
    format!(
        "\
## Synthetic performances

The reference face with its 27 markers, 16 muscles, 60 frames a second, half a second neutral and then 20 s.
Contractions of .5 to 2.2 s rise and fall as raised cosines with a hold, three of four on both sides, about two at any time; blinks last .22 s.
A moving head turns by about 10 degrees and shifts by a few centimeters.
Noise is Gaussian, its standard deviation given for each axis.
Hidden markers go in bursts of 7 frames; a marker that jumps is 5 to 20 mm off for one frame, in any direction.
The neutral frames are complete and without jumps, but have the noise.
Seeds {seeds}, on which nothing was tuned; the constants of other methods are {constants}.

The marks for the RMS error at 0.2, 0.5 and 1 mm under a moving head are {plain} for plain and {default} for default settings, and {corrupted} for default settings at 0.5 mm with 10 % hidden and 2 % jumped.",
        constants = comparison.constants(),
        seeds = FRESH_SEEDS.map(|it| it.to_string()).join(", "),
        corrupted = crate::figure::error(marks::CORRUPTED_RMS),
    )
}

const REFERENCE_VALUES: &str = "\
The last column has what the study behind the methods reached on performances of its own, 30 frames a second, in the order least squares, the QP, all terms; under a moving head the QP and all terms.
— says that it has no such figure.";

/// Figures of the study by head, noise (mm), share hidden and share jumped.
const STUDY: [(bool, f64, f64, f64, &str); 11] = [
    (false, 0.2, 0.0, 0.0, ".0218, .0126, .0100"),
    (false, 0.2, 0.1, 0.02, ".1242, .0652, .0270"),
    (false, 0.5, 0.0, 0.0, ".0545, .0313, .0226"),
    (false, 0.5, 0.1, 0.0, ".0616, .0364, .0274"),
    (false, 0.5, 0.1, 0.02, ".1356, .0715, .0333"),
    (false, 1.0, 0.0, 0.0, ".1089, .0621, .0389"),
    (false, 1.0, 0.1, 0.02, ".1704, .0905, .0456"),
    (true, 0.2, 0.0, 0.0, ".0134, .0084"),
    (true, 0.5, 0.0, 0.0, ".0333, .0172"),
    (true, 1.0, 0.0, 0.0, ".0659, .0302"),
    (true, 0.5, 0.1, 0.02, "—, .025"),
];

/// RMS errors by condition, method, seed.
fn errors(
    conditions: &[Condition],
    comparison: &Comparison,
    actor: &Arc<Actor>,
) -> Vec<Vec<Vec<f64>>> {
    let jobs: Vec<_> = (conditions.iter())
        .flat_map(|condition| FRESH_SEEDS.map(|seed| (condition, seed)))
        .collect();
    let by_job = parallel::map(
        &jobs,
        || Comparison::helper(&comparison.methods),
        |scipy, (condition, seed)| {
            let take = condition.take(actor, *seed);
            let truth = take.truth.from_frame(N_NEUTRAL);
            let curves = comparison.solve(scipy, &take, actor).into_iter();
            let errors = curves.map(|it| Errors::of(&it.from_frame(N_NEUTRAL), &truth));
            println!("synthetic: {condition}, seed {seed}");
            errors.map(|it| it.root_mean_square).collect::<Vec<f64>>()
        },
    );
    let by_condition = by_job.chunks_exact(FRESH_SEEDS.len());
    by_condition
        .map(|seeds| {
            let methods = 0..comparison.methods.len();
            methods
                .map(|method| seeds.iter().map(|it| it[method]).collect())
                .collect()
        })
        .collect()
}

fn table(
    conditions: &[Condition],
    errors: &[Vec<Vec<f64>>],
    comparison: &Comparison,
    moving_head: bool,
) -> Table {
    let methods = &comparison.methods;
    let titles = methods.iter().map(|it| it.title());
    let mut table = Table::new(
        ["noise, mm", "hidden", "jumped"]
            .into_iter()
            .chain(titles)
            .chain(["study"]),
    );
    let rows = conditions
        .iter()
        .zip(errors)
        .filter(|(it, _)| it.moving_head == moving_head);
    for (condition, errors) in rows {
        print_summary(condition, methods, errors);
        let percent = |share: f64| format!("{} %", 100.0 * share);
        let mut row = vec![
            condition.noise_mm.to_string(),
            percent(condition.corruption.occluded),
            percent(condition.corruption.outliers),
        ];
        row.extend(errors.iter().map(|it| mean_and_spread(it)));
        row.push(study(condition).to_owned());
        table.add(row);
    }
    table
}

#[expect(
    clippy::float_cmp,
    reason = "both sides are the same constants, never computed"
)]
fn study(condition: &Condition) -> &'static str {
    let corruption = condition.corruption;
    let found = STUDY
        .iter()
        .find(|(moving_head, noise, occluded, outliers, _)| {
            *moving_head == condition.moving_head
                && *noise == condition.noise_mm
                && *occluded == corruption.occluded
                && *outliers == corruption.outliers
        });
    found.map_or("—", |it| it.4)
}

fn print_summary(condition: &Condition, methods: &[Method], errors: &[Vec<f64>]) {
    let ours = methods
        .iter()
        .zip(errors)
        .filter(|(it, _)| matches!(it, Method::Plain | Method::Default));
    let figures: Vec<String> = ours
        .map(|(it, errors)| format!("{} {:.4}", it.title(), mean(errors)))
        .collect();
    println!("{condition}: RMS {}", figures.join(", "));
}

/// What it costs when the neutral frames are corrupted as well.
fn corrupted_neutral(actor: &Arc<Actor>) -> String {
    let condition = Condition::corrupted(0.5);
    let errors = |settings: &MarkerSettings| {
        FRESH_SEEDS.map(|seed| {
            let take = condition.take_from_corrupted_neutral(actor, seed);
            let found = take.curves(actor, settings).from_frame(N_NEUTRAL);
            Errors::of(&found, &take.truth.from_frame(N_NEUTRAL)).root_mean_square
        })
    };
    let [plain, default] = [MarkerSettings::plain(), MarkerSettings::default()]
        .map(|settings| mean_and_spread(&errors(&settings)));
    println!("{condition}, the neutral frames too: plain {plain}, default {default}");
    format!(
        "\
With neutral frames that are corrupted like all others, {condition}: {plain} for plain and {default} for default settings."
    )
}

/// The curves and the muscles' errors of the first seed at 0.5 mm with everything that goes wrong.
fn draw(report: &mut Report, actor: &Arc<Actor>) {
    let condition = Condition::corrupted(0.5);
    let take = condition.take(actor, FRESH_SEEDS[0]);
    let plain = &take.curves(actor, &MarkerSettings::plain());
    let default = &take.curves(actor, &MarkerSettings::default());
    let title = format!("Reference face, {condition}, seed {}", FRESH_SEEDS[0]);
    let chart = curves::Chart {
        title: &title,
        muscles: actor.muscle_set().muscles(),
        rate_hz: take.rate_hz,
        truth: &take.truth,
        plain,
        default,
    };
    report.add_picture(
        "synthetic_curves",
        "Curves against truth, synthetic performance",
        &chart.svg(),
    );
    let chart = bars::Chart {
        title: &title,
        muscles: actor.muscle_set().muscles(),
        plain: &by_muscle(plain, &take.truth),
        default: &by_muscle(default, &take.truth),
    };
    report.add_picture(
        "synthetic_muscles",
        "Error by muscle, synthetic performance",
        &chart.svg(),
    );
}
