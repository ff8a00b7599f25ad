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
        coverage::Coverage,
        errors::Errors,
        lag::Lags,
        marks,
        real_take::RealTake,
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
    for (noise_mm, mark) in NOISE_MM.into_iter().zip(marks::DEFAULT_RMS) {
        check_synthetic(
            "default",
            &Condition::clean(noise_mm),
            &MarkerSettings::default(),
            mark,
        );
    }
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
}

#[test]
fn default_settings_keep_their_marks_on_real_takes() {
    let Some(data) = data_dir("accuracy::default_settings_keep_their_marks_on_real_takes") else {
        return;
    };
    for subject in Subject::all(&data) {
        let (name, take) = (subject.real.name(), &subject.take);
        let found = take.curves(&subject.actor, &MarkerSettings::default());
        let errors = Errors::of(&found, &take.truth);
        let lids = eyelids(&subject.actor);
        let blink = largest_peak_error(&found, &take.truth, &lids, take.rate_hz).unwrap_or(0.0);
        let lags = Lags::of(&found, &take.truth);
        println!(
            "{name}: mean absolute error {:.4} (mark {}), active {:.4}, bias {:+.4}, blinks {blink:+.3}, {lags:?}",
            errors.mean_absolute, subject.mark, errors.active, errors.small_bias,
        );
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
fn nor_does_it_on_real_takes() {
    let Some(data) = data_dir("accuracy::nor_does_it_on_real_takes") else {
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
