//! `docs/bad-input.md` says of each row whether a test shows it: that is true, in both directions.

use std::collections::{BTreeMap, BTreeSet};

use crate::layering::sources;

const ROWS: &str = include_str!("../../../docs/bad-input.md");

/// The crates whose tests are named after rows.
const CRATES: [&str; 5] = ["access", "analysis", "client-cli", "server", "tests"];

/// The state of each row that has one, by its id in small letters.
fn states() -> BTreeMap<String, String> {
    let cells = |line: &str| line.split(" | ").map(str::to_owned).collect::<Vec<_>>();
    ROWS.lines()
        .filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"))
        .map(cells)
        .filter(|it| it.len() == 5 && is_id(&it[0].to_lowercase()))
        .map(|it| (it[0].to_lowercase(), it[4].clone()))
        .collect()
}

fn is_id(word: &str) -> bool {
    let mut letters = word.chars();
    letters.next().is_some_and(|it| ('a'..='i').contains(&it))
        && word.len() > 1
        && letters.all(|it| it.is_ascii_digit())
}

/// The rows that tests of this source are named after.
fn tested(source: &str) -> impl Iterator<Item = String> {
    let attributes = ["#[test]", "#[tokio::test"];
    let tests = attributes
        .into_iter()
        .flat_map(|it| source.split(it).skip(1));
    let names = tests.filter_map(|it| it.split_once("fn ")?.1.split(['_', '(']).next());
    names.filter(|it| is_id(it)).map(str::to_owned)
}

#[test]
fn every_row_that_is_marked_as_tested_has_a_test_of_its_name_and_every_such_test_its_mark() {
    let states = states();
    assert!(states.len() > 100, "{} rows were found", states.len());
    let sources = CRATES.into_iter().flat_map(sources::of);
    let tested: BTreeSet<String> = sources
        .flat_map(|it| tested(&it.text).collect::<Vec<_>>())
        .collect();
    for (row, state) in &states {
        let marked = state.starts_with("tested");
        assert_eq!(marked, tested.contains(row), "{row} is said to be {state}");
        let known = marked || state == "built" || state.starts_with("not yet");
        assert!(known, "{row} is {state}, which the page does not explain");
    }
    for row in &tested {
        assert!(states.contains_key(row), "{row} is no row");
    }
}
