//! `docs/api.md` shows nothing that is not run: every block of code is a part of a client that a test runs.

use std::{fs, path::Path};

/// The clients whose parts the page shows.
const CLIENTS: [&str; 5] = [
    "curl/client.sh",
    "python/grpc_client.py",
    "python/http_client.py",
    "typescript/grpc_client.ts",
    "typescript/web_client.ts",
];

#[test]
fn every_block_of_code_is_a_part_of_a_client_that_is_run() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = fs::read_to_string(repository.join("docs/api.md")).unwrap();
    let clients = CLIENTS.map(|it| {
        let client = repository.join("tests/clients").join(it);
        trimmed(&fs::read_to_string(client).unwrap())
    });
    let blocks = blocks(&page);
    assert!(blocks.len() > 10, "{} blocks", blocks.len());
    for block in blocks {
        let lines = trimmed(block);
        let is_shown = |client: &Vec<String>| client.windows(lines.len()).any(|it| it == lines);
        assert!(clients.iter().any(is_shown), "no client holds\n{block}");
    }
}

/// What stands between fences, without their language.
fn blocks(page: &str) -> Vec<&str> {
    let fenced = page.split("\n```").skip(1).step_by(2);
    fenced
        .map(|it| it.split_once('\n').map_or("", |(_language, code)| code))
        .collect()
}

/// Lines without their indentation.
fn trimmed(text: &str) -> Vec<String> {
    text.lines().map(|it| it.trim().to_owned()).collect()
}
