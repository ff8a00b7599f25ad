//! The command line of Frontalis: `frontalis --help` shows what it can do.

mod cli;
mod commands;
mod json;
mod login_file;
mod measure;
mod private_file;
mod terminal;

use std::{io, process::ExitCode};

use clap::Parser as _;
use frontalis_client::error::ClientError;

use crate::{cli::Cli, commands::Context};

#[tokio::main]
async fn main() -> ExitCode {
    let cli = Cli::parse();
    let filter = tracing_subscriber::EnvFilter::try_from_env("FRONTALIS_LOG")
        .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new("error"));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(io::stderr)
        .init();
    let context = Context::new(cli.json, cli.connection);
    match commands::run(&context, cli.command).await {
        Ok(code) => code,
        // The reader of a pipe had enough, as with `| head`.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            report(&context, &error).await;
            ExitCode::FAILURE
        }
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|it| it.downcast_ref::<io::Error>())
        .any(|it| it.kind() == io::ErrorKind::BrokenPipe)
}

/// Says what failed, where, and what can be done about it.
async fn report(context: &Context, error: &anyhow::Error) {
    let refusal = error
        .chain()
        .find_map(|it| it.downcast_ref::<ClientError>());
    let advice = match context.advice(refusal).await {
        None => json::advice(error, refusal).map(str::to_owned),
        found => found,
    };
    if context.json {
        eprintln!("{}", json::error(error, refusal, advice.as_deref()));
        return;
    }
    eprintln!("error: {error:#}");
    if let Some(refusal) = refusal {
        for (key, value) in &refusal.metadata {
            eprintln!("  {key}: {value}");
        }
        if let Some(wait) = refusal.retry_after {
            eprintln!("  the server asks to wait {:.1} s", wait.as_secs_f64());
        }
    }
    if let Some(advice) = advice {
        eprintln!("  what to do: {advice}");
    }
}
