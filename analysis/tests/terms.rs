//! What each term of the objective promises, where the contractions that made the markers are known.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::sync::{Arc, LazyLock};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, MuscleBounds, Objective, RegionMode},
    curve::CurveSample,
    face::actor::Actor,
    space::LengthUnit,
    synthesis::reference_face,
};

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

/// Largest KKT residual that any frame may have, relative to the largest diagonal entry of Q.
const KKT_LIMIT: f64 = 1e-10;

const NOISY: Stage = Stage {
    n_frames: 360,
    moving_head: true,
    noise_cm: 0.05,
    seed: 77,
    ..Stage::STILL
};

/// The reference face, made once.
fn actor() -> Arc<Actor> {
    static ACTOR: LazyLock<Arc<Actor>> = LazyLock::new(|| Arc::new(reference_face::actor()));
    Arc::clone(&ACTOR)
}

fn solve_with(performance: &Performance, settings: MarkerSettings) -> Vec<CurveSample> {
    let mut analyzer = MarkerAnalyzer::new(actor(), settings, LengthUnit::Centimeter, 60.0);
    let mut samples = Vec::new();
    for frame in &performance.frames {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    for sample in &samples {
        assert!(
            sample.kkt_residual <= KKT_LIMIT,
            "{:e}",
            sample.kkt_residual
        );
    }
    samples
}

fn solve(performance: &Performance, objective: Objective) -> Vec<CurveSample> {
    let settings = MarkerSettings {
        objective,
        ..MarkerSettings::default()
    };
    solve_with(performance, settings)
}

fn muscle(name: &str) -> usize {
    actor().muscle_set().index_of(name).unwrap()
}

/// Root mean square of what `of` says of each sample and its truth.
fn rms(samples: &[CurveSample], truth: &[Vec<f64>]) -> f64 {
    let pairs = samples.iter().zip(truth);
    let errors = pairs.flat_map(|(it, truth)| it.activations.iter().zip(truth));
    let (sum, count) = errors.fold((0.0, 0.0), |(sum, count), (a, b)| {
        (sum + (a - b).powi(2), count + 1.0)
    });
    (sum / f64::max(count, 1.0)).sqrt()
}

#[test]
fn each_term_helps_and_all_together_help_most() {
    let performance = Performance::of(&actor(), NOISY);
    let plain = Objective::plain;
    let [none, smooth, sparse, all] = [
        plain(),
        Objective {
            smoothing: 0.5,
            ..plain()
        },
        Objective {
            sparsity: 0.5,
            ..plain()
        },
        Objective::default(),
    ]
    .map(|objective| rms(&solve(&performance, objective), &performance.truth));
    println!(
        "RMS error: plain {none:.4}, smooth {smooth:.4}, sparse {sparse:.4}, default {all:.4}"
    );
    assert!(smooth < none && sparse < none && all < smooth.min(sparse));
}

#[test]
fn regions_apart_take_the_terms_too() {
    let performance = Performance::of(&actor(), NOISY);
    for stabilize_head in [true, false] {
        let stage = Stage {
            moving_head: stabilize_head,
            ..NOISY
        };
        let performance = Performance::of(&actor(), stage);
        let [plain, default] = [Objective::plain(), Objective::default()].map(|objective| {
            let settings = MarkerSettings {
                region_mode: RegionMode::Split,
                stabilize_head,
                objective,
                ..MarkerSettings::default()
            };
            rms(&solve_with(&performance, settings), &performance.truth)
        });
        println!(
            "regions apart, head solved {stabilize_head}: plain {plain:.4}, default {default:.4}"
        );
        assert!(default < 0.7 * plain);
    }
    assert_eq!(performance.frames.len(), NOISY.n_frames);
}

#[test]
fn more_smoothing_makes_calmer_holds_and_more_sparsity_more_zeros() {
    let performance = Performance::of(&actor(), NOISY);
    let jitter = |smoothing: f64| {
        let samples = solve(
            &performance,
            Objective {
                smoothing,
                sparsity: 0.0,
                ..Objective::default()
            },
        );
        let steps = samples.windows(2).flat_map(|it| {
            let pairs = it[0].activations.iter().zip(&it[1].activations);
            pairs.map(|(a, b)| (a - b).powi(2)).collect::<Vec<_>>()
        });
        steps.sum::<f64>()
    };
    let jitters = [0.0, 0.25, 0.5, 0.75, 1.0].map(jitter);
    println!("squared steps over smoothing 0 to 1: {jitters:.2?}");
    assert!(jitters.is_sorted_by(|a, b| a > b));
    let zeros = |sparsity: f64| {
        let objective = Objective {
            sparsity,
            ..Objective::default()
        };
        let samples = solve(&performance, objective);
        let values = samples.iter().flat_map(|it| &it.activations);
        values.filter(|it| **it <= 0.0).count()
    };
    let zeros = [0.0, 0.25, 0.5, 0.75, 1.0].map(zeros);
    println!("relaxed values over sparsity 0 to 1: {zeros:?}");
    assert!(zeros.is_sorted());
}

#[test]
fn every_muscle_keeps_its_own_bounds() {
    let performance = Performance::of(&actor(), NOISY);
    let [jaw, smile] = ["jaw_rotation", "zygomatic_major_left"];
    let bounds = vec![
        MuscleBounds {
            muscle: jaw.to_owned(),
            lower: 0.1,
            upper: 0.4,
        },
        MuscleBounds {
            muscle: smile.to_owned(),
            lower: 0.0,
            upper: 1.5,
        },
    ];
    for objective in [Objective::plain(), Objective::default()] {
        let objective = Objective {
            bounds: bounds.clone(),
            ..objective
        };
        for sample in solve(&performance, objective) {
            assert!((0.1..=0.4).contains(&sample.activations[muscle(jaw)]));
            assert!((0.0..=1.5).contains(&sample.activations[muscle(smile)]));
        }
    }
}

#[test]
fn of_an_exclusive_pair_one_at_most_is_active() {
    let performance = Performance::of(&actor(), NOISY);
    let pairs = [
        ["jaw_rotation", "lips_pressor"],
        ["zygomatic_major_left", "risorius_left"],
    ];
    let names = |it: [&str; 2]| it.map(str::to_owned);
    for objective in [Objective::plain(), Objective::default()] {
        let free = solve(&performance, objective.clone());
        let apart = solve(
            &performance,
            Objective {
                exclusive_pairs: pairs.map(names).to_vec(),
                ..objective
            },
        );
        let both = |samples: &[CurveSample]| {
            let both = |it: &&CurveSample, pair: [&str; 2]| {
                pair.iter().all(|name| it.activations[muscle(name)] > 0.0)
            };
            let of_pair = |pair| samples.iter().filter(|it| both(it, pair)).count();
            pairs.map(of_pair).iter().sum::<usize>()
        };
        assert!(both(&free) > 0);
        assert_eq!(both(&apart), 0);
    }
}

#[test]
fn symmetry_draws_mirror_images_together() {
    let performance = Performance::of(&actor(), NOISY);
    let [left, right] = ["frontalis_left", "frontalis_right"].map(muscle);
    let apart = |symmetry: f64| {
        let objective = Objective {
            symmetry,
            ..Objective::default()
        };
        let samples = solve(&performance, objective);
        let differences = samples
            .iter()
            .map(|it| it.activations[left] - it.activations[right]);
        differences.map(|it| it * it).sum::<f64>()
    };
    let apart = [0.0, 0.25, 0.5, 0.75, 1.0].map(apart);
    println!("squared differences over symmetry 0 to 1: {apart:.3?}");
    assert!(apart.is_sorted_by(|a, b| a > b));
    assert!(apart[4] < 0.01 * apart[0]);
}

#[test]
fn the_claim_of_the_standard_errors_is_calibrated() {
    for noise_cm in [0.02, 0.05, 0.1] {
        let (mut one, mut two, mut count) = (0.0, 0.0, 0.0);
        for seed in 501..506 {
            let stage = Stage {
                n_frames: 600,
                noise_cm,
                seed,
                ..NOISY
            };
            let performance = Performance::of(&actor(), stage);
            let objective = Objective {
                sparsity: 0.0,
                ..Objective::default()
            };
            for (sample, truth) in solve(&performance, objective)
                .iter()
                .zip(&performance.truth)
            {
                let values = sample.activations.iter().zip(&sample.standard_errors);
                for ((value, sigma), truth) in values.zip(truth) {
                    if *truth > 0.05 && *truth < 0.95 {
                        let error = (value - truth).abs();
                        one += f64::from(u8::from(error <= *sigma));
                        two += f64::from(u8::from(error <= 1.96 * sigma));
                        count += 1.0;
                    }
                }
            }
        }
        let (one, two) = (one / count, two / count);
        println!("noise {noise_cm} cm: {one:.3} within one sigma, {two:.3} within 1.96");
        assert!((0.60..=0.76).contains(&one), "{one}");
        assert!((0.90..=0.98).contains(&two), "{two}");
    }
}

#[test]
fn the_same_frames_give_the_same_bits_on_any_thread() {
    let stage = Stage {
        occluded: 0.1,
        ..NOISY
    };
    let performance = Performance::of(&actor(), stage);
    let bits = || {
        let samples = solve(&performance, Objective::default());
        let values = samples
            .iter()
            .flat_map(|it| it.activations.iter().chain(&it.standard_errors));
        values.map(|it| it.to_bits()).collect::<Vec<_>>()
    };
    let alone = bits();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(bits)).collect();
        for thread in threads {
            assert!(thread.join().unwrap() == alone);
        }
    });
}
