//! What a wrong basis does to the default, beside plain settings with robust weights.

use harness::{
    accuracy::{
        marks,
        wrong_basis::{RELATIVE_ERROR, WRONG_SEEDS},
        wrong_case::{WrongCase, WrongErrors},
    },
    data_dir,
};

use crate::{
    figure::{error, mean, percent, ratio},
    parallel,
    report::Report,
    table::Table,
};

/// Ratios of the default to plain settings with robust weights, basis by basis.
pub fn write(report: &mut Report) {
    report.add(&introduction());
    let mut cases = WrongCase::synthetic();
    match data_dir("accuracy: takes under wrong bases") {
        Some(data) => cases.extend(WrongCase::real(&data)),
        None => report.leave_out("takes under wrong bases: FRONTALIS_DATA is not there"),
    }
    let errors = parallel::map(
        &cases,
        || (),
        |(), case| {
            let errors = case.errors();
            println!("wrong bases: {}, basis {}", case.name, case.seed);
            errors
        },
    );
    report.add(&table(&cases, &errors).to_string());
}

fn introduction() -> String {
    format!(
        "\
## Wrong bases

The markers come from the right basis, the solver has one that is {wrong} wrong at the markers (|D′ − D| / |D|, Frobenius): every muscle has another gain, direction and place, smooth over the face.
Each of the columns 1 to {n} is one wrong basis: the error of default settings divided by that of plain settings with robust weights alone.
The error is the RMS of synthetic performances, whose head moves, and the mean of |error| of takes; the mark is {mark}.
The two columns before have the mean errors over the bases, the last column has the largest ratio by the other of the two measures.",
        wrong = percent(RELATIVE_ERROR),
        n = WRONG_SEEDS.len(),
        mark = ratio(marks::WRONG_BASIS_RATIO),
    )
}

fn table(cases: &[WrongCase], errors: &[WrongErrors]) -> Table {
    let bases = (1..=WRONG_SEEDS.len()).map(|it| it.to_string());
    let titles = ["performance", "robust", "default"]
        .map(str::to_owned)
        .into_iter();
    let last = ["largest", "by the other measure"].map(str::to_owned);
    let mut table = Table::new(titles.chain(bases).chain(last));
    let rows = cases.chunk_by(|a, b| a.name == b.name);
    let mut rest = errors;
    for cases in rows {
        let (own, others) = rest.split_at(cases.len());
        rest = others;
        table.add(row(&cases[0].name, own));
    }
    table
}

fn row(name: &str, errors: &[WrongErrors]) -> Vec<String> {
    let largest = |of: fn(&WrongErrors) -> f64| errors.iter().map(of).fold(0.0, f64::max);
    let means: [fn(&WrongErrors) -> f64; 2] = [|it| it.robust, |it| it.default];
    let mut row = vec![name.to_owned()];
    row.extend(means.map(|of| error(mean(&errors.iter().map(of).collect::<Vec<_>>()))));
    row.extend(errors.iter().map(|it| ratio(it.ratio())));
    row.push(ratio(largest(WrongErrors::ratio)));
    row.push(ratio(largest(|it| it.other_ratio)));
    println!("{}", row.join(" "));
    row
}
