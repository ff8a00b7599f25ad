//! CPU time of the same box QPs (27 markers, 16 muscles, regions split) by our methods and by two public solvers.

use std::hint::black_box;

use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver as _, SupportedConeT},
};
use frontalis_analysis::{
    face::basis::MarkerBasis,
    numeric::{box_qp::BoxQp, standing_qp::StandingQp},
    synthesis::reference_face,
};
use nalgebra::{DMatrix, DVector};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

mod cpu_clock;
#[path = "../tests/support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

/// Noise of each coordinate, uniform, centimeters: a standard deviation of 0.2 mm.
const NOISE_CM: f64 = 0.0346;

/// One region's Q, and c frame after frame.
struct Programs {
    q: DMatrix<f64>,
    cs: Vec<DVector<f64>>,
}

fn main() {
    let regions = regions();
    let n_frames = regions[0].cs.len() as f64;
    let product = cpu_clock::matrix_vector_nanos();
    let standing = standing_nanos(&regions) / n_frames;
    let rows = [
        ("exchanges from the minimum without bounds", standing),
        ("block pivoting, warm", general_nanos(&regions) / n_frames),
        ("quadprog, the crate", quadprog_nanos(&regions) / n_frames),
        ("clarabel, the crate", clarabel_nanos(&regions) / n_frames),
    ];
    println!("both regions' QPs of a frame, 6 and 10 unknowns:");
    for (name, nanos) in rows {
        cpu_clock::print_row(name, nanos, product);
        println!("{:>72.1} x exchanges", nanos / standing);
    }
}

fn regions() -> [Programs; 2] {
    let mut parts = reference_face::actor_parts();
    parts.markers.retain(|(marker, _)| !marker.head_fixed);
    let policy = frontalis_analysis::face::actor::RankPolicy::Refuse;
    let (actor, _) = frontalis_analysis::face::actor::Actor::new(parts, policy)
        .expect("the reference face is an actor");
    let truth = Performance::of(&actor, Stage::STILL).truth;
    let basis = MarkerBasis::at(&actor, actor.virtual_markers());
    let mut rng = Pcg64::seed_from_u64(2);
    frontalis_analysis::face::region::FaceRegion::ALL.map(|region| {
        let own = |it: &usize| actor.markers()[*it].region == region;
        let markers: Vec<usize> = (0..actor.markers().len()).filter(own).collect();
        let of_region = |it: &usize| actor.muscle_set().muscles()[*it].region == region;
        let muscles: Vec<usize> = (0..actor.muscle_set().len()).filter(of_region).collect();
        let d = DMatrix::from_fn(3 * markers.len(), muscles.len(), |row, column| {
            basis.of_marker_cm(markers[row / 3])[muscles[column]][row % 3]
        });
        let mut c = |truth: &Vec<f64>| {
            let x = DVector::from_iterator(muscles.len(), muscles.iter().map(|&it| truth[it]));
            let noise = DVector::from_fn(d.nrows(), |_, _| rng.random_range(-NOISE_CM..NOISE_CM));
            d.tr_mul(&(&d * x + noise))
        };
        let cs = truth.iter().map(&mut c).collect();
        Programs {
            q: d.tr_mul(&d),
            cs,
        }
    })
}

impl Programs {
    fn fill(&self, stride: usize) -> impl FnOnce(&mut [f64]) {
        move |to| {
            for (to, from) in to.chunks_exact_mut(stride).zip(self.q.column_iter()) {
                to[..from.len()].copy_from_slice(from.as_slice());
            }
        }
    }
}

fn standing_nanos(regions: &[Programs; 2]) -> f64 {
    let mut qps = regions.each_ref().map(|it| {
        let mut qp = StandingQp::new(it.q.nrows());
        qp.set_hessian(it.fill(qp.stride()));
        qp
    });
    let mut x = [0.0; 16];
    cpu_clock::median_nanos(|| {
        for (upper, lower) in regions[0].cs.iter().zip(&regions[1].cs) {
            for (qp, c) in qps.iter_mut().zip([upper, lower]) {
                qp.c_mut()[..c.len()].copy_from_slice(black_box(c.as_slice()));
                qp.start();
            }
            let [upper, lower] = &mut qps;
            while upper.advance() | lower.advance() {}
            for qp in &mut qps {
                let n = qp.len();
                black_box(qp.finish(&mut x[..n])).expect("Q is positive definite");
            }
        }
    })
}

fn general_nanos(regions: &[Programs; 2]) -> f64 {
    let of_region = |programs: &Programs| {
        let mut qp = BoxQp::new(programs.q.nrows());
        qp.set_hessian(programs.fill(qp.stride()));
        let mut x = vec![0.0; qp.len()];
        cpu_clock::median_nanos(|| {
            for c in &programs.cs {
                black_box(qp.solve(black_box(c.as_slice()), &mut x)).expect("Q is definite");
            }
        })
    };
    regions.iter().map(of_region).sum()
}

/// The crate overwrites Q, so each solve gets a copy.
fn quadprog_nanos(regions: &[Programs; 2]) -> f64 {
    let of_region = |programs: &Programs| {
        let m = programs.q.nrows();
        let mut rows = vec![0.0; 2 * m * m];
        for i in 0..m {
            rows[i * m + i] = -1.0;
            rows[(m + i) * m + i] = 1.0;
        }
        let limits: Vec<f64> = (0..2 * m).map(|it| f64::from(u8::from(it >= m))).collect();
        let linear: Vec<DVector<f64>> = programs.cs.iter().map(|it| -it).collect();
        let mut q = programs.q.clone();
        cpu_clock::median_nanos(|| {
            for c in &linear {
                q.copy_from(&programs.q);
                let (q, c) = (q.as_mut_slice(), black_box(c.as_slice()));
                let solved = quadprog::solve_qp(q, c, &rows, &limits, 0, false);
                black_box(&solved.expect("Q is positive definite"));
            }
        })
    };
    regions.iter().map(of_region).sum()
}

/// One solver a region, given each c anew.
fn clarabel_nanos(regions: &[Programs; 2]) -> f64 {
    let of_region = |programs: &Programs| {
        let m = programs.q.nrows();
        let dense = |n_rows: usize, entry: &dyn Fn(usize, usize) -> f64| {
            let row = |i| (0..m).map(|j| entry(i, j)).collect::<Vec<f64>>();
            let rows: Vec<Vec<f64>> = (0..n_rows).map(row).collect();
            CscMatrix::from(rows.iter())
        };
        let q = dense(m, &|i, j| if j >= i { programs.q[(i, j)] } else { 0.0 });
        let rows = dense(2 * m, &|i, j| match i % m == j {
            true if i < m => -1.0,
            true => 1.0,
            false => 0.0,
        });
        let limits: Vec<f64> = (0..2 * m).map(|it| f64::from(u8::from(it >= m))).collect();
        let linear: Vec<Vec<f64>> = programs
            .cs
            .iter()
            .map(|it| it.iter().map(|it| -it).collect())
            .collect();
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .presolve_enable(false)
            .build()
            .expect("the settings are sound");
        let cones = [SupportedConeT::NonnegativeConeT(2 * m)];
        let mut solver = DefaultSolver::new(&q, &linear[0], &rows, &limits, &cones, settings)
            .expect("the program is sound");
        cpu_clock::median_nanos(|| {
            for c in &linear {
                solver.update_q(black_box(c)).expect("c has m entries");
                solver.solve();
                black_box(&solver.solution.x);
            }
        })
    };
    regions.iter().map(of_region).sum()
}
