//! What comments cite of `docs/contracts.md` stands there, and is in force.

use std::collections::{BTreeMap, BTreeSet};

use crate::layering::sources;

const PAGE: &str = include_str!("../../docs/contracts.md");

const NOT_IN_FORCE: &str = "Not in force yet";

/// Whose comments cite.
const CRATES: [&str; 5] = ["access", "analysis", "client-cli", "server", "tests"];

/// The id at the beginning of a text, `D-14a`.
fn id(text: &str) -> Option<&str> {
    let rest = text.strip_prefix(|it: char| it.is_ascii_uppercase())?;
    let digits = rest.strip_prefix('-')?;
    let n_digits = digits.len()
        - digits
            .trim_start_matches(|it: char| it.is_ascii_digit())
            .len();
    let has_letter = digits[n_digits..].starts_with(|it: char| it.is_ascii_lowercase());
    let end = 2 + n_digits + usize::from(has_letter);
    (n_digits > 0).then(|| &text[..end])
}

/// All ids in a text.
fn ids(text: &str) -> BTreeSet<String> {
    let words = text.split(|it: char| !it.is_ascii_alphanumeric() && it != '-');
    words.filter_map(id).map(str::to_owned).collect()
}

/// Every statement, and whether it is in force: all of it, or a part.
fn statements() -> BTreeMap<String, bool> {
    let mut statements = BTreeMap::new();
    let (mut section_is_in_force, mut last) = (true, String::new());
    for line in PAGE.lines() {
        let line = line.trim();
        if line.starts_with('#') {
            section_is_in_force = !line.contains(NOT_IN_FORCE);
        } else if let Some(id) = line.strip_prefix("- **").and_then(id) {
            id.clone_into(&mut last);
            statements
                .entry(last.clone())
                .or_insert(section_is_in_force);
        } else if let Some(said) = line
            .strip_prefix('*')
            .and_then(|it| it.strip_prefix(NOT_IN_FORCE))
        {
            // Of the statements that it names, which follow; of the one that it stands in; or of a part of that.
            match said.chars().next() {
                Some(':') => statements.extend(ids(said).into_iter().map(|it| (it, false))),
                Some('.' | ';') => drop(statements.insert(last.clone(), false)),
                _ => {}
            }
        }
    }
    statements
}

/// The statements that a source cites, one or several in a row.
fn cited(source: &str) -> BTreeSet<String> {
    let citations = source.split("CONTRACTS ").skip(1);
    citations
        .flat_map(|it| {
            let is_over = |it: char| matches!(it, ')' | ':' | ';' | '.' | '\n');
            ids(it.split(is_over).next().unwrap_or_default())
        })
        .collect()
}

#[test]
fn what_is_cited_of_the_contracts_stands_there_and_is_in_force() {
    let statements = statements();
    assert!(statements.len() > 80, "{} statements", statements.len());
    let n_waiting = statements.values().filter(|it| !**it).count();
    assert!(n_waiting > 0, "{n_waiting} statements wait");
    for source in CRATES.into_iter().flat_map(sources::of) {
        for id in cited(&source.text) {
            let is_in_force = statements.get(&id).copied();
            assert_eq!(is_in_force, Some(true), "{} cites {id}", source.path);
        }
    }
}
