//! Writes `docs/accuracy.md` and its pictures: the error of the curves beside that of other methods, where the truth is known.
//!
//! `accuracy`: takes no arguments; the data bundle and Python are used where they are.
#![expect(
    clippy::unwrap_used,
    reason = "a report that cannot be written has nothing to say"
)]

mod figure;
mod methods;
mod parallel;
mod picture;
mod report;
mod section;
mod stabilized;
mod table;

use std::path::Path;

use report::Report;

fn main() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut report = Report::new(repository.join("docs"));
    let methods = methods::available();
    section::reading::write(&mut report, &methods);
    section::synthetic::write(&mut report, &methods);
    section::takes::write(&mut report, &methods);
    section::strengths::write(&mut report);
    section::wrong_bases::write(&mut report);
    section::calibration::write(&mut report);
    report.save();
}
