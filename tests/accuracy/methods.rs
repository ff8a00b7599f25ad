//! The methods that are compared.
//!
//! Ours find alignment, head and contractions from the markers. The others are given alignment and head of our plain joint
//! solve, so that what differs is the objective.

mod deployed;
mod least_squares;
mod paper;
mod quadratic;
mod ridge;
mod scipy;
mod tuning;

use std::sync::Arc;

use frontalis_analysis::{analyzer::MarkerSettings, face::actor::Actor};
use harness::accuracy::{curves::Curves, take::Take};

use crate::{parallel, stabilized::Stabilized};

use deployed::Deployed;
use ridge::Ridge;
use scipy::Scipy;

/// One of the methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// No bounds at all.
    LeastSquares,
    /// Choe & Ko 2001: bounds, regions apart.
    Paper,
    /// Bounds and a penalty on the squares of the contractions.
    Ridge,
    /// Bounds and the penalties of a widely deployed blend-shape solver.
    Deployed,
    /// Bounds, by an independent program.
    Scipy,
    /// Ours, nothing added to least squares within bounds.
    Plain,
    /// Ours as it comes.
    Default,
}

impl Method {
    /// In the order of every table.
    pub const ALL: [Self; 7] = [
        Self::LeastSquares,
        Self::Paper,
        Self::Ridge,
        Self::Deployed,
        Self::Scipy,
        Self::Plain,
        Self::Default,
    ];

    /// The name in tables.
    pub fn title(self) -> &'static str {
        match self {
            Self::LeastSquares => "least squares",
            Self::Paper => "the paper's QP",
            Self::Ridge => "ridge",
            Self::Deployed => "deployed",
            Self::Scipy => "scipy",
            Self::Plain => "ours, plain",
            Self::Default => "ours, default",
        }
    }
}

/// The methods that can be run on this machine.
pub fn available() -> Vec<Method> {
    let has_scipy = Scipy::start().is_some();
    let runs = |it: &Method| *it != Method::Scipy || has_scipy;
    Method::ALL.into_iter().filter(runs).collect()
}

/// The methods on one face, the others with the constants that suit it best.
#[derive(Clone)]
pub struct Comparison {
    /// Those that can be run, in the order of all results.
    pub methods: Vec<Method>,
    ridge: Ridge,
    deployed: Deployed,
}

impl Comparison {
    /// With the constants that have the smallest error on these takes, whose truth is known to them.
    pub fn tuned_on(takes: &[&Take], actor: &Arc<Actor>, methods: &[Method]) -> Self {
        let problems = parallel::map(
            takes,
            || (),
            |(), take| {
                let plain = take.solve(actor, &MarkerSettings::plain());
                (Stabilized::of(take, actor, &plain), take.truth.clone())
            },
        );
        let (ridge, deployed) = tuning::best(&problems);
        Self {
            methods: methods.to_vec(),
            ridge,
            deployed,
        }
    }

    /// The constants in words.
    pub fn constants(&self) -> String {
        let Deployed { sparsity, temporal } = self.deployed;
        format!(
            "ridge {}, deployed μ = {sparsity}, λ = {temporal}",
            self.ridge.strength
        )
    }

    /// Where a method's results stand.
    pub fn place(&self, method: Method) -> usize {
        self.methods.iter().position(|it| *it == method).unwrap()
    }

    /// What a thread needs for [`Comparison::solve`].
    pub fn helper(methods: &[Method]) -> Option<Scipy> {
        methods
            .contains(&Method::Scipy)
            .then(Scipy::start)
            .flatten()
    }

    /// The curves of every method, in the order of `methods`.
    pub fn solve(&self, scipy: &mut Option<Scipy>, take: &Take, actor: &Arc<Actor>) -> Vec<Curves> {
        let plain = take.solve(actor, &MarkerSettings::plain());
        let stabilized = Stabilized::of(take, actor, &plain);
        let mut solve = |method| match method {
            Method::LeastSquares => least_squares::solve(&stabilized),
            Method::Paper => paper::solve(&stabilized),
            Method::Ridge => self.ridge.solve(&stabilized),
            Method::Deployed => self.deployed.solve(&stabilized),
            Method::Scipy => scipy.as_mut().unwrap().solve(&stabilized),
            Method::Plain => Curves::of(&plain.samples),
            Method::Default => take.curves(actor, &MarkerSettings::default()),
        };
        self.methods.iter().map(|it| solve(*it)).collect()
    }
}
