//! `docs/bad-input.md` says of each row whether a test shows it: that is true, in both directions.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

const ROWS: &str = include_str!("../../../docs/bad-input.md");

/// The crates whose tests are named after rows.
const CRATES: [&str; 4] = ["access", "analysis", "server", "tests"];

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

/// The rows that functions of these sources are named after.
fn collect_tested(path: &Path, tested: &mut BTreeSet<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).unwrap() {
            collect_tested(&entry.unwrap().path(), tested);
        }
    } else if path.extension().is_some_and(|it| it == "rs") {
        let text = fs::read_to_string(path).unwrap();
        let attributes = text.split("#[test]").skip(1);
        let tokio = text.split("#[tokio::test").skip(1);
        let names = attributes.chain(tokio).filter_map(|it| {
            let name = it.split_once("fn ")?.1;
            name.split(['_', '(']).next()
        });
        tested.extend(names.filter(|it| is_id(it)).map(str::to_owned));
    }
}

#[test]
fn every_row_that_is_marked_as_tested_has_a_test_of_its_name_and_every_such_test_its_mark() {
    let states = states();
    assert!(states.len() > 100, "{} rows were found", states.len());
    let mut tested = BTreeSet::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for name in CRATES {
        collect_tested(&root.join(name), &mut tested);
    }
    for (row, state) in &states {
        let marked = state.starts_with("tested");
        assert_eq!(marked, tested.contains(row), "{row} is said to be {state}");
    }
    for row in &tested {
        assert!(states.contains_key(row), "{row} is no row");
    }
}
