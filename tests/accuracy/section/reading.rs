//! What the page is, and how it is read.

use crate::{methods::Method, report::Report};

/// Title, what the figures mean, and the methods.
pub fn write(report: &mut Report, methods: &[Method]) {
    report.add(INTRODUCTION);
    report.add(METHODS);
    if !methods.contains(&Method::Scipy) {
        report.leave_out("scipy: python3 with venv and pip is needed to make .venv-accuracy");
    }
}

const INTRODUCTION: &str = "\
# Accuracy

How far the curves are from contractions that are known, beside the methods that others use.
`make accuracy` writes this page and its pictures; the same machine gives the same bytes every time.
Synthetic performances come from the reference face, so everybody can make them.
Takes of real people lie in a data bundle beside the repository and are left out, by name, where it is not.

## How to read it

A contraction is 0 when a muscle is relaxed and 1 when it is fully contracted, so an error of .01 is one per cent of full contraction.
Synthetic tables give the root mean square (RMS) of found − true over all frames and muscles after the neutral frames, as mean ± standard deviation over the seeds.
Tables of real takes give the mean of |found − true| over all frames and muscles.
Smaller is better everywhere.
";

const METHODS: &str = "\
## The methods

- **least squares**: the best fit to the markers without bounds.
- **the paper's QP**: least squares within [0, 1], upper and lower region apart (Choe & Ko 2001, section 4.1.2).
- **ridge**: least squares within [0, 1] and a penalty on Σ xᵢ², as a share of s, the mean of the diagonal of DᵀD.
- **deployed**: the objective of a widely deployed blend-shape solver, within [0, 1].
  Sparsity is a penalty on (Σ xᵢ)², μ s in every entry of DᵀD; the temporal term adds 100 λ s to the diagonal and λ s x of the frame before to the right side.
- **scipy**: least squares within [0, 1] by `scipy.optimize.lsq_linear` (BVLS), an independent program.
- **ours, plain**: least squares within [0, 1] and the head's pose in one problem (`--plain`).
- **ours, default**: the settings that a session has when nothing is said.

Ridge and deployed have, on each face, the constants that suit them best: those with the smallest mean of |error|, the truth being known, among seven strengths of the one and twenty pairs of the other.
On the reference face that is on two performances of their own at 0.5 mm, on the scanned ones on the very takes that are shown.
Ours finds alignment, head and contractions from the markers, with the same constants everywhere.
The other methods are given the alignment and, in every frame, the head's pose of our plain solve, so that what differs is the objective.
In a frame for which the plain solve knows no pose, their values stay.";
