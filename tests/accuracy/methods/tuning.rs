//! The constants of the methods that have some: those with the smallest error on given performances.

use harness::accuracy::{curves::Curves, errors::Errors};

use super::{Deployed, Ridge};
use crate::{parallel, stabilized::Stabilized};

/// What is tried: from hardly any to too much.
const RIDGES: [f64; 7] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1];
const SPARSITIES: [f64; 5] = [1e-4, 5e-4, 2e-3, 1e-2, 5e-2];
const TEMPORALS: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];

/// The best ridge and the best deployed solver by the mean absolute error on `problems`, each with its truth.
pub fn best(problems: &[(Stabilized, Curves)]) -> (Ridge, Deployed) {
    let error = |solve: &dyn Fn(&Stabilized) -> Curves| -> f64 {
        let errors = problems
            .iter()
            .map(|(problem, truth)| Errors::of(&solve(problem), truth));
        errors.map(|it| it.mean_absolute).sum()
    };
    let ridges = RIDGES.map(|strength| Ridge { strength });
    let deployed: Vec<Deployed> = (SPARSITIES.iter())
        .flat_map(|&sparsity| TEMPORALS.map(|temporal| Deployed { sparsity, temporal }))
        .collect();
    (
        smallest(&ridges, |it| error(&|problem| it.solve(problem))),
        smallest(&deployed, |it| error(&|problem| it.solve(problem))),
    )
}

fn smallest<T: Copy + Sync>(candidates: &[T], error: impl Fn(&T) -> f64 + Sync) -> T {
    let errors = parallel::map(candidates, || (), |(), it| error(it));
    let ranked = candidates.iter().zip(errors);
    *ranked.min_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap().0
}
