//! The paper's method: least squares within [0, 1], upper and lower region apart (Choe & Ko 2001, section 4.1.2).

use frontalis_analysis::face::region::FaceRegion;
use harness::accuracy::curves::Curves;

use super::quadratic::Quadratic;
use crate::stabilized::Stabilized;

pub fn solve(problem: &Stabilized) -> Curves {
    problem.each_frame(|d, x| {
        for region in FaceRegion::ALL {
            solve_region(problem, region, d, x);
        }
    })
}

fn solve_region(problem: &Stabilized, region: FaceRegion, d: &[f64], x: &mut [f64]) {
    let muscles: Vec<usize> = (0..problem.n_muscles())
        .filter(|&it| problem.muscle_regions[it] == region)
        .collect();
    let own = |row: usize| problem.row_regions[row] == region;
    let mut part: Vec<f64> = muscles.iter().map(|&it| x[it]).collect();
    Quadratic::of(problem, d, own, &muscles).minimize(0.0, 1.0, &mut part);
    for (&muscle, part) in muscles.iter().zip(part) {
        x[muscle] = part;
    }
}
