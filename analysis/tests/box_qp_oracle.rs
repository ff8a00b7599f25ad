//! The box QP against an independent interior-point solver on random problems.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver as _, SupportedConeT},
};
use frontalis_analysis::numeric::box_qp::BoxQp;
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

const PROBLEMS: u64 = 1_000;
const LARGEST_CONDITION: f64 = 1e6;

struct Problem {
    m: usize,
    /// Columns m apart.
    hessian: Vec<f64>,
    c: Vec<f64>,
    planted: Vec<f64>,
    upper: f64,
}

/// Q = V diag(λ) Vᵀ with a random orthogonal V and a condition number of up to 1e6; c makes a random point of the box the
/// solution, with multipliers that are not close to zero: where they are, an interior point method is off by more than
/// this test asks of ours, and the KKT residual is the judge.
fn random_problem(rng: &mut Pcg64) -> Problem {
    let m = rng.random_range(1..=60);
    let v = nalgebra::DMatrix::from_fn(m, m, |_, _| rng.random_range(-1.0..1.0))
        .qr()
        .q();
    let decades = rng.random_range(0.0..=LARGEST_CONDITION.log10());
    let eigenvalues = nalgebra::DVector::from_fn(m, |_, _| {
        10_f64.powf(-decades * rng.random_range(0.0..=1.0))
    });
    let q = &v * nalgebra::DMatrix::from_diagonal(&eigenvalues) * v.transpose();
    let q = (&q + q.transpose()) * 0.5;
    let upper = if rng.random_bool(0.5) { 1.0 } else { 2.0 };
    let mut x = nalgebra::DVector::zeros(m);
    let mut multipliers = nalgebra::DVector::zeros(m);
    for i in 0..m {
        match rng.random_range(0..3) {
            0 => multipliers[i] = rng.random_range(0.1..1.0),
            1 => (x[i], multipliers[i]) = (upper, -rng.random_range(0.1..1.0)),
            _ => x[i] = upper * rng.random_range(0.05..0.95),
        }
    }
    let c = &q * &x - multipliers;
    Problem {
        m,
        hessian: q.as_slice().to_vec(),
        c: c.as_slice().to_vec(),
        planted: x.as_slice().to_vec(),
        upper,
    }
}

fn interior_point(problem: &Problem) -> Vec<f64> {
    let m = problem.m;
    let full: Vec<Vec<f64>> = (0..m)
        .map(|i| {
            (0..m)
                .map(|j| {
                    if j >= i {
                        problem.hessian[j * m + i]
                    } else {
                        0.0
                    }
                })
                .collect()
        })
        .collect();
    let hessian = CscMatrix::from(full.iter());
    let rows: Vec<Vec<f64>> = (0..2 * m)
        .map(|row| {
            let mut entries = vec![0.0; m];
            entries[row % m] = if row < m { -1.0 } else { 1.0 };
            entries
        })
        .collect();
    let constraints = CscMatrix::from(rows.iter());
    let limits: Vec<f64> = (0..2 * m)
        .map(|row| if row < m { 0.0 } else { problem.upper })
        .collect();
    let linear: Vec<f64> = problem.c.iter().map(|it| -it).collect();
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-12)
        .tol_gap_rel(1e-12)
        .tol_feas(1e-12)
        .max_iter(200)
        .build()
        .unwrap();
    let cones = [SupportedConeT::NonnegativeConeT(2 * m)];
    let mut solver =
        DefaultSolver::new(&hessian, &linear, &constraints, &limits, &cones, settings).unwrap();
    solver.solve();
    solver.solution.x.clone()
}

#[test]
fn agrees_with_an_interior_point_solver_on_a_thousand_random_problems() {
    let mut rng = Pcg64::seed_from_u64(20_011_101);
    let (mut largest_difference, mut largest_error, mut largest_kkt) = (0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..PROBLEMS {
        let problem = random_problem(&mut rng);
        let mut qp = BoxQp::new(problem.m);
        let stride = qp.stride();
        qp.set_hessian(|it| {
            for (to, from) in it
                .chunks_exact_mut(stride)
                .zip(problem.hessian.chunks_exact(problem.m))
            {
                to[..problem.m].copy_from_slice(from);
            }
        });
        for i in 0..problem.m {
            qp.set_bounds(i, 0.0, problem.upper);
        }
        let mut x: Vec<f64> = (0..problem.m)
            .map(|_| rng.random_range(-0.2..1.2))
            .collect();
        let report = qp.solve(&problem.c, &mut x).unwrap();
        largest_kkt = largest_kkt.max(report.kkt_residual);
        for (ours, theirs) in x.iter().zip(interior_point(&problem)) {
            largest_difference = largest_difference.max((ours - theirs).abs());
        }
        for (ours, planted) in x.iter().zip(&problem.planted) {
            largest_error = largest_error.max((ours - planted).abs());
        }
    }
    println!(
        "{PROBLEMS} problems, m 1..60: largest difference from the interior point {largest_difference:.1e}, from the planted solution {largest_error:.1e}, largest KKT residual {largest_kkt:.2e}"
    );
    assert!(largest_difference <= 1e-7, "{largest_difference:e}");
    assert!(largest_error <= 1e-8, "{largest_error:e}");
    assert!(largest_kkt <= 1e-10, "{largest_kkt:e}");
}
