//! A person at a terminal: lines typed, and what comes of them.

use std::{
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use harness::program;
use tempfile::TempDir;

/// A person at a terminal, with an account of its own.
pub struct Person {
    program: PathBuf,
    home: TempDir,
}

impl Person {
    /// Somebody who has not been here before.
    pub fn new() -> Self {
        Self {
            program: program("frontalis"),
            home: tempfile::tempdir().unwrap(),
        }
    }

    /// Types a line, with `input` on standard input.
    pub async fn types(&self, line: &str, input: &str) -> Output {
        let mut child = Command::new(&self.program)
            .args(line.split_whitespace())
            .env("XDG_CONFIG_HOME", self.home.path())
            .env_remove("FRONTALIS_SERVER")
            .env_remove("FRONTALIS_TOKEN")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let input = input.to_owned();
        let waiting = tokio::task::spawn_blocking(move || {
            // A command that reads nothing may be gone already.
            drop(stdin.write_all(input.as_bytes()));
            drop(stdin);
            child.wait_with_output()
        });
        waiting.await.unwrap().unwrap()
    }

    /// A line that succeeds; what it printed.
    pub async fn does(&self, line: &str) -> String {
        self.does_with(line, "").await
    }

    /// The same with `input` on standard input.
    pub async fn does_with(&self, line: &str, input: &str) -> String {
        let output = self.types(line, input).await;
        let complained = text_of(&output.stderr);
        assert!(output.status.success(), "{line}\n{complained}");
        text_of(&output.stdout)
    }

    /// A line that fails; what it complained.
    pub async fn fails(&self, line: &str) -> String {
        let output = self.types(line, "").await;
        assert_eq!(output.status.code(), Some(1), "{line}");
        text_of(&output.stderr)
    }

    /// The folder that is theirs.
    pub fn home(&self) -> &Path {
        self.home.path()
    }

    /// Where a login is kept.
    pub fn login_file(&self) -> PathBuf {
        self.home.path().join("frontalis/credentials.toml")
    }
}

/// What a program wrote.
pub fn text_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
