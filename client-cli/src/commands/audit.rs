//! `frontalis audit …`: whether a server's audit log is the one that it wrote (CONTRACTS S-12).

use std::{
    fs::File,
    io::BufReader,
    path::{Path, PathBuf},
    process::ExitCode,
};

use anyhow::Context as _;
use clap::{Args, Subcommand};
use frontalis_access::{ChainReport, verify_chain};
use serde_json::{Value, json};

use super::Context;
use crate::terminal::say;

#[derive(Debug, Subcommand)]
pub enum AuditCommand {
    /// Check that no line was changed, moved or removed
    Verify(VerifyArgs),
}

#[derive(Debug, Args)]
#[command(after_help = "\
Each line of the log holds the hash of the one before and its own: a line that was changed, moved, inserted or removed
breaks the chain, and the first such line is named. Lines that are cut off at the end leave no trace in the file itself:
a server logs the newest entry and its hash at every start, and that hash must still be in the file.

Exit status: 0 the chain holds, 1 it is broken or the file cannot be read.

Examples:
  frontalis audit verify /var/lib/frontalis/audit.log
  frontalis audit verify audit.log --json")]
pub struct VerifyArgs {
    /// The log: audit.log in the server's data directory, or a copy of it
    file: PathBuf,
}

pub fn run(context: &Context, command: &AuditCommand) -> anyhow::Result<ExitCode> {
    match command {
        AuditCommand::Verify(args) => verify(context, &args.file),
    }
}

fn verify(context: &Context, path: &Path) -> anyhow::Result<ExitCode> {
    let report = read(path).with_context(|| format!("cannot read {}", path.display()))?;
    if context.json {
        say(as_json(&report))?;
    } else {
        say(in_words(path, &report))?;
    }
    Ok(match report.first_broken {
        None => ExitCode::SUCCESS,
        Some(_) => ExitCode::FAILURE,
    })
}

fn read(path: &Path) -> std::io::Result<ChainReport> {
    verify_chain(BufReader::new(File::open(path)?))
}

fn in_words(path: &Path, report: &ChainReport) -> String {
    let ChainReport { n_lines, end, .. } = report;
    let found = match report.first_broken {
        None => "the chain holds".to_owned(),
        Some(line) => {
            format!("line {line} is not the one that was written, or one before it is missing")
        }
    };
    format!(
        "{}: {n_lines} lines; {found}\nnewest entry of the chain: {}, hash {}",
        path.display(),
        end.sequence,
        end.hash
    )
}

fn as_json(report: &ChainReport) -> Value {
    json!({
        "lines": report.n_lines.to_string(),
        "firstBrokenLine": report.first_broken.map(|it| it.to_string()),
        "newestEntry": report.end.sequence.to_string(),
        "newestHash": report.end.hash,
    })
}
