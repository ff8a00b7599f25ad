//! The programs under test, built as a person would build them.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    process::Command,
    sync::Mutex,
};

/// Beginnings of the variables that cargo sets for a package that it runs.
const OF_THIS_PACKAGE: [&str; 4] = [
    "CARGO_PKG_",
    "CARGO_MANIFEST_",
    "CARGO_CRATE_",
    "CARGO_BIN_",
];

/// The path of one of the workspace's programs, `frontalis` or `frontalis-server`.
///
/// A test brings it up to date. A measuring program, which stands beside it, takes the one that was built with it.
pub fn program(name: &str) -> PathBuf {
    // Once a process: a test that starts the program again starts the same one.
    static BUILT: Mutex<BTreeMap<String, PathBuf>> = Mutex::new(BTreeMap::new());
    let mut built = BUILT.lock().unwrap();
    let path = built.entry(name.to_owned()).or_insert_with(|| build(name));
    path.clone()
}

fn build(name: &str) -> PathBuf {
    let beside = std::env::current_exe().unwrap().with_file_name(name);
    if beside.exists() {
        return beside;
    }
    let target = target_folder();
    let mut build = Command::new(env!("CARGO"));
    // What describes this test's package would be news to build scripts that look at it, and make them run again.
    for (name, _) in std::env::vars_os() {
        let name = name.to_string_lossy().into_owned();
        if OF_THIS_PACKAGE.iter().any(|it| name.starts_with(it)) {
            build.env_remove(name);
        }
    }
    let built = build
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        // With the whole workspace and its tests, so that dependencies have the features they were built with before.
        .args(["build", "--quiet", "--locked", "--workspace", "--tests"])
        .args(["--bin", name])
        .arg("--target-dir")
        .arg(&target)
        .status()
        .unwrap();
    assert!(built.success(), "{name} does not build");
    target.join("debug").join(name)
}

/// The target folder that this test itself was built in: `target/debug/deps/end_to_end-…` is three levels below it.
fn target_folder() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    test.ancestors().nth(3).unwrap().to_owned()
}
