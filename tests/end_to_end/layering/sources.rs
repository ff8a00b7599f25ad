//! The repository's source files as text, and which modules and libraries each of them names.
//!
//! A reader of names, not of Rust: comments are cut, then `crate::x`, `crate::{x, y::z}` and `library::` are looked for.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

/// One `.rs` file.
pub struct SourceFile {
    /// Relative to the repository, with `/`.
    pub path: String,
    /// As it stands.
    pub text: String,
    /// Without line comments.
    pub code: String,
}

/// The root of the repository.
pub fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Every `.rs` file under `folder` of the repository, sorted.
pub fn of(folder: &str) -> impl Iterator<Item = SourceFile> + use<> {
    let mut paths = Vec::new();
    walk(&repository().join(folder), &mut paths);
    paths.sort();
    assert!(!paths.is_empty(), "{folder} holds no source file");
    paths.into_iter().map(|it| SourceFile::read(&it))
}

fn walk(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            walk(&path, paths);
        } else if path.extension().is_some_and(|it| it == "rs") {
            paths.push(path);
        }
    }
}

impl SourceFile {
    fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let code = text
            .lines()
            .map(|line| line.split("//").next().unwrap_or_default())
            .collect::<Vec<_>>()
            .join("\n");
        let path = path.strip_prefix(repository()).unwrap();
        Self {
            path: path.to_str().unwrap().replace('\\', "/"),
            text,
            code,
        }
    }

    /// The top-level module of the crate that the file belongs to: `hub` for `src/hub.rs` and `src/hub/window.rs`.
    pub fn room(&self) -> &str {
        let inside = self.path.split_once("/src/").unwrap().1;
        inside.split(['/', '.']).next().unwrap()
    }

    /// The top-level modules of its own crate that the file names.
    pub fn crate_modules(&self) -> BTreeSet<String> {
        self.children_of("crate")
            .into_iter()
            .filter(|it| it.starts_with(|first: char| first.is_ascii_lowercase()))
            .collect()
    }

    /// Whether the file names `library`, given with its `::`.
    pub fn names_library(&self, library: &str) -> bool {
        self.code.match_indices(library).any(|(at, _)| {
            !self.code[..at]
                .ends_with(|before: char| before.is_alphanumeric() || matches!(before, '_' | ':'))
        })
    }

    /// Whether the file names the item `path`, directly or inside braces.
    pub fn names_item(&self, path: &[&str]) -> bool {
        let (item, parents) = path.split_last().unwrap();
        let full = format!("{}::", parents.join("::"));
        self.children_of(full.trim_end_matches("::"))
            .contains(*item)
            || self
                .groups_of(parents[0])
                .iter()
                .any(|it| names_in_group(it, &path[1..]))
    }

    fn children_of(&self, parent: &str) -> BTreeSet<String> {
        let prefix = format!("{parent}::");
        let mut found = BTreeSet::new();
        for (at, _) in self.code.match_indices(&prefix) {
            let rest = &self.code[at + prefix.len()..];
            match rest.strip_prefix('{') {
                Some(group) => found.extend(heads(group)),
                None => found.extend(first_name(rest)),
            }
        }
        found
    }

    fn groups_of(&self, parent: &str) -> Vec<&str> {
        let prefix = format!("{parent}::{{");
        self.code
            .match_indices(&prefix)
            .map(|(at, _)| &self.code[at + prefix.len()..])
            .collect()
    }
}

/// Whether the group that opens at the start of `group` holds the path, such as `time::{Duration, Instant}`.
fn names_in_group(group: &str, path: &[&str]) -> bool {
    entries(group).iter().any(|entry| {
        let mut rest = entry.trim();
        for (depth, name) in path.iter().enumerate() {
            let Some(after) = rest.strip_prefix(name) else {
                return false;
            };
            if depth + 1 == path.len() {
                return !after.starts_with(|next: char| next.is_alphanumeric() || next == '_');
            }
            let Some(after) = after.strip_prefix("::") else {
                return false;
            };
            if let Some(inner) = after.strip_prefix('{') {
                return names_in_group(inner, &path[depth + 1..]);
            }
            rest = after;
        }
        false
    })
}

/// The first name of each entry of a brace group; `group` starts behind the opening brace.
fn heads(group: &str) -> Vec<String> {
    entries(group)
        .into_iter()
        .filter_map(|it| first_name(it.trim()))
        .collect()
}

/// The comma-separated entries of a brace group, nested groups kept whole.
fn entries(group: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut depth, mut start) = (1, 0);
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 || (depth == 1 && letter == ',') {
            found.push(&group[start..at]);
            start = at + 1;
        }
        if depth == 0 {
            break;
        }
    }
    found
}

fn first_name(text: &str) -> Option<String> {
    let name: String = text
        .chars()
        .take_while(|it| it.is_alphanumeric() || *it == '_')
        .collect();
    (!name.is_empty()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(code: &str) -> SourceFile {
        SourceFile {
            path: "server/src/hub/window.rs".to_owned(),
            text: code.to_owned(),
            code: code.to_owned(),
        }
    }

    #[test]
    fn a_nested_use_names_every_head() {
        let found =
            file("use crate::{\n  hub::{A, b::C},\n  wire::D,\n};\nfn f() { crate::clock::now() }");
        let found: Vec<_> = found.crate_modules().into_iter().collect();
        assert_eq!(found, ["clock", "hub", "wire"]);
    }

    #[test]
    fn an_item_is_found_inside_braces() {
        let path = ["std", "time", "Instant"];
        assert!(file("use std::{sync::Arc, time::{Duration, Instant}};").names_item(&path));
        assert!(file("use std::time::{Duration, Instant};").names_item(&path));
        assert!(file("let t: std::time::Instant;").names_item(&path));
        assert!(!file("use std::time::Duration; use tokio::time::Instant;").names_item(&path));
    }

    #[test]
    fn a_library_is_not_found_inside_another_name() {
        assert!(file("use tonic::Status;").names_library("tonic::"));
        assert!(!file("use my_tonic::Status;").names_library("tonic::"));
    }
}
