//! One performance under one wrong basis: the markers come from the right one.

use std::{path::Path, sync::Arc};

use frontalis_analysis::{analyzer::MarkerSettings, face::actor::Actor};

use super::{
    actors,
    condition::{Condition, NOISE_MM},
    curves::Curves,
    errors::Errors,
    real_take::RealTake,
    settings::robust_only,
    take::{N_NEUTRAL, Take},
    wrong_basis::{WRONG_SEEDS, wrong_actor},
};

/// A take and the wrong actor that the solver is given.
pub struct WrongCase {
    /// The performance.
    pub name: String,
    /// Seed of the wrong basis.
    pub seed: u64,
    wrong: Arc<Actor>,
    take: Arc<Take>,
    measure: Measure,
}

/// What counts as the error of a performance.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Measure {
    /// RMS after the neutral frames, for synthetic performances.
    RootMeanSquare,
    /// Mean of |found − true|, for takes.
    MeanAbsolute,
}

/// What the settings make of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrongErrors {
    /// Error of plain settings with robust weights.
    pub robust: f64,
    /// Error of default settings.
    pub default: f64,
    /// The ratio of the two by the other measure: mean |error| for synthetic performances, RMS for takes.
    pub other_ratio: f64,
}

impl WrongErrors {
    /// The default's error as a multiple of the robust one's.
    pub fn ratio(&self) -> f64 {
        self.default / self.robust
    }
}

impl WrongCase {
    /// The reference face under every level of noise and a moving head, each wrong basis with a performance of its own.
    pub fn synthetic() -> Vec<Self> {
        let right = actors::reference();
        let wrong = WRONG_SEEDS.map(|seed| (seed, wrong_actor(&right, seed)));
        let of_noise = |noise_mm: f64| {
            let right = &right;
            wrong.clone().map(|(seed, wrong)| Self {
                name: format!("reference face, {noise_mm} mm"),
                seed,
                wrong,
                take: Arc::new(Condition::clean(noise_mm).take(right, seed)),
                measure: Measure::RootMeanSquare,
            })
        };
        NOISE_MM.into_iter().flat_map(of_noise).collect()
    }

    /// Every real take under every wrong basis of its actor.
    ///
    /// # Panics
    ///
    /// When the bundle lacks a take.
    pub fn real(data: &Path) -> Vec<Self> {
        let of_package = |package| {
            let right = actors::scanned(data, package);
            let wrong = WRONG_SEEDS.map(|seed| (seed, wrong_actor(&right, seed)));
            let takes = RealTake::ALL
                .into_iter()
                .filter(move |it| it.package == package);
            takes.flat_map(move |real| {
                let take = Arc::new(real.read(data, &right));
                wrong.clone().map(|(seed, wrong)| Self {
                    name: real.name(),
                    seed,
                    wrong,
                    take: Arc::clone(&take),
                    measure: Measure::MeanAbsolute,
                })
            })
        };
        RealTake::PACKAGES
            .into_iter()
            .flat_map(of_package)
            .collect()
    }

    /// The errors of both settings.
    pub fn errors(&self) -> WrongErrors {
        let start = match self.measure {
            Measure::RootMeanSquare => N_NEUTRAL,
            Measure::MeanAbsolute => 0,
        };
        let truth = self.take.truth.from_frame(start);
        let of = |found: Curves| Errors::of(&found.from_frame(start), &truth);
        let robust = of(self.take.curves(&self.wrong, &robust_only()));
        let default = of(self.take.curves(&self.wrong, &MarkerSettings::default()));
        let ratio = |of: fn(&Errors) -> f64| of(&default) / of(&robust);
        match self.measure {
            Measure::RootMeanSquare => WrongErrors {
                robust: robust.root_mean_square,
                default: default.root_mean_square,
                other_ratio: ratio(|it| it.mean_absolute),
            },
            Measure::MeanAbsolute => WrongErrors {
                robust: robust.mean_absolute,
                default: default.mean_absolute,
                other_ratio: ratio(|it| it.root_mean_square),
            },
        }
    }
}
