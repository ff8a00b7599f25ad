//! What a person sees: tables, progress, live bars.

pub mod bars;
pub mod plain;
pub mod progress;
pub mod screen;
pub mod tables;
pub mod trust;

use std::io::{self, IsTerminal as _, Write as _};

/// Prints one line of results; a reader that left is an error, not a panic.
pub fn say(text: impl std::fmt::Display) -> io::Result<()> {
    writeln!(io::stdout().lock(), "{text}")
}

/// Whether a person looks at the results.
pub fn is_interactive() -> bool {
    io::stdout().is_terminal() && io::stdin().is_terminal()
}

/// Asks a question that only `yes` answers.
pub fn confirm(question: &str) -> io::Result<bool> {
    eprint!("{question} [type yes] ");
    let mut answer = String::new();
    io::stdin().read_line(&mut answer)?;
    Ok(answer.trim().eq_ignore_ascii_case("yes"))
}
