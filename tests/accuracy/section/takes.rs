//! Real people's performances on a scan-derived face.

use std::{path::Path, sync::Arc};

use frontalis_analysis::face::actor::Actor;
use harness::{
    accuracy::{
        actors::{eyelids, scanned},
        blink::largest_peak_error,
        corruption::Corruption,
        curves::Curves,
        errors::{Errors, by_muscle},
        lag::Lags,
        marks,
        real_take::{CORRUPTION_SEEDS, RealTake},
        take::Take,
    },
    data_dir,
};

use crate::{
    figure::{error, mean, ratio, signed},
    methods::{Comparison, Method},
    parallel,
    picture::{bars, curves},
    report::Report,
    table::Table,
};

/// The take whose curves are drawn, and the one whose muscles' errors are.
const CURVES_OF: RealTake = RealTake::new("llv", "muscle16_27");
const MUSCLES_OF: RealTake = RealTake::new("ns164", "muscle16_27");

/// A summary, a table a take, pictures.
pub fn write(report: &mut Report, methods: &[Method]) {
    report.add(INTRODUCTION);
    let Some(data) = data_dir("accuracy: takes of real performances") else {
        return report.leave_out("takes of real performances: FRONTALIS_DATA is not there");
    };
    let of_package = |package| Subject::of_package(&data, package, methods);
    let subjects: Vec<Subject> = RealTake::PACKAGES
        .into_iter()
        .flat_map(of_package)
        .collect();
    let outcomes = outcomes(&subjects, methods);
    report.add(&summary(&subjects, &outcomes, methods).to_string());
    for (subject, outcome) in subjects.iter().zip(&outcomes) {
        report.add(&format!("### {}", subject.real.name()));
        report.add(&format!("Constants: {}.", subject.comparison.constants()));
        report.add(&table(subject, outcome).to_string());
    }
    draw(report, &subjects, &outcomes);
}

const INTRODUCTION: &str = "\
## Real performances

Curves recorded from real people's faces, put on a scan-derived face with head motion and marker noise; the curves are the truth.
`muscle16` has 16 muscles, `facs30` has 30 shapes of a facial action coding; the last number is that of the markers.

- **mean |error|**, **RMS**: over all frames and muscles.
- **active**: the mean of |error| where the true contraction is above .02, so that no method wins on muscles at rest.
- **bias**: the mean of found − true where the true contraction is between .02 and .1.
- **blink**: the mean over an eyelid's blinks of found peak − true peak, of the eyelid where it is larger.
- **late**: curves whose correlation with the truth peaks more than one frame off, of those whose truth has a standard deviation of .02 or more; the largest lag in frames follows, positive is late.
- **corrupted**: mean |error| with 10 % of the positions hidden in bursts of 7 frames and 2 % jumped by 5 to 20 mm after the neutral frames, the mean over five seeds; then its ratio to the clean figure.
- **neutral too**: the ratio when the neutral frames are corrupted like all others.";

/// A take and whose face it is on.
struct Subject {
    real: RealTake,
    actor: Arc<Actor>,
    take: Take,
    comparison: Arc<Comparison>,
}

impl Subject {
    fn of_package(data: &Path, package: &'static str, methods: &[Method]) -> Vec<Self> {
        let actor = scanned(data, package);
        let reals = RealTake::ALL.into_iter().filter(|it| it.package == package);
        let takes: Vec<_> = reals.map(|real| (real, real.read(data, &actor))).collect();
        let all: Vec<&Take> = takes.iter().map(|(_, take)| take).collect();
        let comparison = Arc::new(Comparison::tuned_on(&all, &actor, methods));
        println!("{package}: {}", comparison.constants());
        let subject = |(real, take)| Self {
            real,
            actor: Arc::clone(&actor),
            take,
            comparison: Arc::clone(&comparison),
        };
        takes.into_iter().map(subject).collect()
    }
}

/// What is done to a take before it is solved.
#[derive(Clone, Copy)]
enum Version {
    Clean,
    AfterNeutral(u64),
    Everywhere(u64),
}

impl Version {
    /// The clean take, then the corrupted ones.
    fn all() -> Vec<Self> {
        let after = CORRUPTION_SEEDS.map(Self::AfterNeutral);
        let everywhere = CORRUPTION_SEEDS.map(Self::Everywhere);
        [Self::Clean]
            .into_iter()
            .chain(after)
            .chain(everywhere)
            .collect()
    }

    fn of(self, take: &Take) -> Take {
        match self {
            Self::Clean => take.clone(),
            Self::AfterNeutral(seed) => Corruption::USUAL.after_neutral(take, seed),
            Self::Everywhere(seed) => Corruption::USUAL.everywhere(take, seed),
        }
    }
}

/// What one take gave: curves of the clean take by method, mean absolute errors of the corrupted ones by seed and method.
struct Outcome {
    clean: Vec<Curves>,
    after_neutral: Vec<Vec<f64>>,
    everywhere: Vec<Vec<f64>>,
}

fn outcomes(subjects: &[Subject], methods: &[Method]) -> Vec<Outcome> {
    let versions = Version::all();
    let jobs: Vec<(&Subject, Version)> = (subjects.iter())
        .flat_map(|subject| versions.iter().map(move |it| (subject, *it)))
        .collect();
    let curves = parallel::map(
        &jobs,
        || Comparison::helper(methods),
        |scipy, (subject, version)| {
            let take = version.of(&subject.take);
            println!("takes: {}", subject.real.name());
            subject.comparison.solve(scipy, &take, &subject.actor)
        },
    );
    let by_subject = curves.chunks_exact(versions.len()).zip(subjects);
    by_subject
        .map(|(curves, subject)| Outcome::of(curves, subject))
        .collect()
}

impl Outcome {
    fn of(curves: &[Vec<Curves>], subject: &Subject) -> Self {
        let error = |it: &Curves| Errors::of(it, &subject.take.truth).mean_absolute;
        let errors =
            |it: &[Vec<Curves>]| it.iter().map(|it| it.iter().map(error).collect()).collect();
        let (after_neutral, everywhere) = curves[1..].split_at(CORRUPTION_SEEDS.len());
        Self {
            clean: curves[0].clone(),
            after_neutral: errors(after_neutral),
            everywhere: errors(everywhere),
        }
    }
}

/// The mean over the seeds.
fn of_method(errors: &[Vec<f64>], method: usize) -> f64 {
    mean(&errors.iter().map(|it| it[method]).collect::<Vec<f64>>())
}

fn summary(subjects: &[Subject], outcomes: &[Outcome], methods: &[Method]) -> Table {
    let titles = methods.iter().map(|it| it.title());
    let mut table = Table::new(
        ["take, mean \\|error\\|"]
            .into_iter()
            .chain(titles)
            .chain(["mark"]),
    );
    for (subject, outcome) in subjects.iter().zip(outcomes) {
        let errors = outcome
            .clean
            .iter()
            .map(|it| Errors::of(it, &subject.take.truth));
        let mut row = vec![subject.real.name()];
        row.extend(errors.map(|it| error(it.mean_absolute)));
        let mark = marks::TAKES.iter().find(|(it, _)| *it == subject.real);
        row.push(mark.map_or("—".to_owned(), |(_, mark)| error(*mark)));
        println!("{}", row.join(" "));
        table.add(row);
    }
    table
}

fn table(subject: &Subject, outcome: &Outcome) -> Table {
    let mut table = Table::new([
        "method",
        "mean \\|error\\|",
        "RMS",
        "active",
        "bias",
        "blink",
        "late",
        "corrupted",
        "ratio",
        "neutral too",
    ]);
    for method in 0..subject.comparison.methods.len() {
        table.add(row(subject, outcome, method));
    }
    table
}

fn row(subject: &Subject, outcome: &Outcome, method: usize) -> Vec<String> {
    let (found, truth) = (&outcome.clean[method], &subject.take.truth);
    let corrupted = of_method(&outcome.after_neutral, method);
    let errors = Errors::of(found, truth);
    let blink = largest_peak_error(found, truth, &eyelids(&subject.actor), subject.take.rate_hz);
    let lags = Lags::of(found, truth);
    vec![
        subject.comparison.methods[method].title().to_owned(),
        error(errors.mean_absolute),
        error(errors.root_mean_square),
        error(errors.active),
        signed(errors.small_bias),
        blink.map_or("—".to_owned(), signed),
        format!("{} of {}, {:+}", lags.n_late, lags.n_curves, lags.largest),
        error(corrupted),
        ratio(corrupted / errors.mean_absolute),
        ratio(of_method(&outcome.everywhere, method) / errors.mean_absolute),
    ]
}

fn draw(report: &mut Report, subjects: &[Subject], outcomes: &[Outcome]) {
    let [plain, default] =
        [Method::Plain, Method::Default].map(|it| subjects[0].comparison.place(it));
    let of = |real| {
        subjects
            .iter()
            .zip(outcomes)
            .find(|(it, _)| it.real == real)
            .unwrap()
    };
    let (subject, outcome) = of(CURVES_OF);
    let chart = curves::Chart {
        title: &subject.real.name(),
        muscles: subject.actor.muscle_set().muscles(),
        rate_hz: subject.take.rate_hz,
        truth: &subject.take.truth,
        plain: &outcome.clean[plain],
        default: &outcome.clean[default],
    };
    report.add_picture(
        "take_curves",
        "Curves against truth, real performance",
        &chart.svg(),
    );
    let (subject, outcome) = of(MUSCLES_OF);
    let chart = bars::Chart {
        title: &subject.real.name(),
        muscles: subject.actor.muscle_set().muscles(),
        plain: &by_muscle(&outcome.clean[plain], &subject.take.truth),
        default: &by_muscle(&outcome.clean[default], &subject.take.truth),
    };
    report.add_picture(
        "take_muscles",
        "Error by muscle, real performance",
        &chart.svg(),
    );
}
