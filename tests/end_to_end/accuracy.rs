//! The marks of accuracy: how far curves may be from contractions that are known.
//!
//! `make accuracy` prints the same measures beside other methods, in docs/accuracy.md.

mod measures;

use std::{path::Path, sync::Arc};

use frontalis_analysis::{analyzer::MarkerSettings, face::actor::Actor};
use harness::{
    accuracy::{
        actors::{eyelids, reference, scanned},
        blink::largest_peak_error,
        condition::{Condition, FRESH_SEEDS, NOISE_MM},
        corruption::Corruption,
        coverage::Coverage,
        errors::Errors,
        lag::Lags,
        marks,
        real_take::{CORRUPTION_SEEDS, RealTake},
        settings::without_sparsity,
        take::{N_NEUTRAL, Take},
        wrong_basis::{RELATIVE_ERROR, WRONG_SEEDS, error_at_markers, wrong_actor},
        wrong_case::WrongCase,
    },
    data_dir,
};

/// The mean over fresh seeds of the RMS error after the neutral frames.
fn rms(condition: &Condition, settings: &MarkerSettings) -> f64 {
    let actor = reference();
    let errors = FRESH_SEEDS.map(|seed| {
        let take = condition.take(&actor, seed);
        let found = take.curves(&actor, settings).from_frame(N_NEUTRAL);
        Errors::of(&found, &take.truth.from_frame(N_NEUTRAL)).root_mean_square
    });
    errors.iter().sum::<f64>() / errors.len() as f64
}

fn check_synthetic(name: &str, condition: &Condition, settings: &MarkerSettings, mark: f64) {
    let rms = rms(condition, settings);
    println!("{name}, {condition}: RMS {rms:.4} (mark {mark})");
    assert!(rms <= mark, "{name}, {condition}: {rms:.4}");
}

#[test]
fn plain_settings_keep_their_marks_on_synthetic_performances() {
    for (noise_mm, mark) in NOISE_MM.into_iter().zip(marks::PLAIN_RMS) {
        check_synthetic(
            "plain",
            &Condition::clean(noise_mm),
            &MarkerSettings::plain(),
            mark,
        );
    }
}

#[test]
fn default_settings_keep_their_marks_on_synthetic_performances() {
    let settings = MarkerSettings::default();
    for (noise_mm, mark) in NOISE_MM.into_iter().zip(marks::DEFAULT_RMS) {
        check_synthetic("default", &Condition::clean(noise_mm), &settings, mark);
    }
}

#[test]
fn hidden_and_jumping_markers_do_not_carry_the_default_away() {
    let condition = Condition::corrupted(0.5);
    check_synthetic(
        "default",
        &condition,
        &MarkerSettings::default(),
        marks::CORRUPTED_RMS,
    );
}

/// A real take with its actor and mark.
struct Subject {
    real: RealTake,
    mark: f64,
    actor: Arc<Actor>,
    take: Take,
}

impl Subject {
    fn all(data: &Path) -> Vec<Self> {
        let of_mark = |(real, mark): (RealTake, f64)| {
            let actor = scanned(data, real.package);
            let take = real.read(data, &actor);
            Self {
                real,
                mark,
                actor,
                take,
            }
        };
        marks::TAKES.map(of_mark).into()
    }

    fn has_16_muscles(&self) -> bool {
        self.take.truth.n_muscles() == 16
    }

    /// The mean absolute error of the default on a take that was made of this one.
    fn error_on(&self, take: &Take) -> f64 {
        let found = take.curves(&self.actor, &MarkerSettings::default());
        Errors::of(&found, &take.truth).mean_absolute
    }
}

/// What the default settings make of a take.
struct Measured {
    errors: Errors,
    blink: f64,
    lags: Lags,
}

impl Measured {
    fn of(subject: &Subject) -> Self {
        let Subject {
            real,
            mark,
            actor,
            take,
        } = subject;
        let found = take.curves(actor, &MarkerSettings::default());
        let errors = Errors::of(&found, &take.truth);
        let blink = largest_peak_error(&found, &take.truth, &eyelids(actor), take.rate_hz);
        let (blink, lags) = (blink.unwrap_or(0.0), Lags::of(&found, &take.truth));
        println!(
            "{}: mean absolute error {:.4} (mark {mark}), active {:.4}, bias {:+.4}, blinks {blink:+.3}, {lags:?}",
            real.name(),
            errors.mean_absolute,
            errors.active,
            errors.small_bias,
        );
        Self {
            errors,
            blink,
            lags,
        }
    }
}

#[test]
fn default_settings_keep_their_marks_on_real_takes() {
    let Some(data) = data_dir("accuracy::default_settings_keep_their_marks_on_real_takes") else {
        return;
    };
    let subjects = Subject::all(&data);
    // All are printed before one fails.
    let measured: Vec<Measured> = subjects.iter().map(Measured::of).collect();
    for (
        subject,
        Measured {
            errors,
            blink,
            lags,
        },
    ) in subjects.iter().zip(measured)
    {
        let name = subject.real.name();
        assert!(errors.mean_absolute <= subject.mark, "{name}: {errors:?}");
        assert!(
            errors.small_bias.abs() <= marks::SMALL_BIAS,
            "{name}: {errors:?}"
        );
        assert!(blink.abs() <= marks::BLINK_PEAK, "{name}: {blink}");
        assert!(
            lags.n_late == 0 || !subject.has_16_muscles(),
            "{name}: {lags:?}"
        );
    }
}

#[test]
fn a_corrupted_real_take_is_solved_almost_as_well_as_the_clean_one() {
    let Some(data) =
        data_dir("accuracy::a_corrupted_real_take_is_solved_almost_as_well_as_the_clean_one")
    else {
        return;
    };
    let ratios = Subject::all(&data).into_iter().map(|subject| {
        let clean = subject.error_on(&subject.take);
        let corrupted = CORRUPTION_SEEDS.map(|seed| {
            let take = Corruption::USUAL.after_neutral(&subject.take, seed);
            subject.error_on(&take)
        });
        let name = subject.real.name();
        let ratio = corrupted.iter().sum::<f64>() / corrupted.len() as f64 / clean;
        println!("{name}: clean {clean:.4}, corrupted {corrupted:.4?}, ratio {ratio:.3}");
        (name, ratio)
    });
    for (name, ratio) in ratios.collect::<Vec<_>>() {
        assert!(ratio <= marks::CORRUPTED_RATIO, "{name}: {ratio:.3}");
    }
}

#[test]
fn wrong_bases_are_as_wrong_as_they_claim() {
    let right = reference();
    for seed in WRONG_SEEDS {
        let error = error_at_markers(&wrong_actor(&right, seed), &right);
        assert!((error - RELATIVE_ERROR).abs() < 1e-3, "{seed}: {error}");
    }
}

#[test]
fn a_wrong_basis_does_not_make_the_default_worse_than_robust_weights_alone() {
    check_wrong(&WrongCase::synthetic());
}

#[test]
fn a_wrong_basis_does_not_make_the_default_worse_on_real_takes() {
    let Some(data) =
        data_dir("accuracy::a_wrong_basis_does_not_make_the_default_worse_on_real_takes")
    else {
        return;
    };
    check_wrong(&WrongCase::real(&data));
}

fn check_wrong(cases: &[WrongCase]) {
    let mut largest = 0.0_f64;
    for case in cases {
        let errors = case.errors();
        println!(
            "{}, basis {}: ratio {:.3}, {errors:.4?}",
            case.name,
            case.seed,
            errors.ratio()
        );
        largest = largest.max(errors.ratio());
    }
    assert!(largest <= marks::WRONG_BASIS_RATIO, "{largest:.3}");
}

#[test]
fn standard_errors_cover_as_often_as_they_claim() {
    let actor = reference();
    for noise_mm in NOISE_MM {
        let mut coverage = Coverage::default();
        for seed in FRESH_SEEDS {
            let take = Condition::clean(noise_mm).take(&actor, seed);
            coverage.add(
                &take.solve(&actor, &without_sparsity()).samples,
                &take.truth,
            );
        }
        let shares = coverage.shares();
        println!("{noise_mm} mm: coverage {shares:.3?}, {coverage:?}");
        for (share, mark) in shares.iter().zip(marks::COVERAGE) {
            assert!(
                mark.contains(share),
                "{noise_mm} mm: {share:.3} outside {mark:?}"
            );
        }
    }
}
