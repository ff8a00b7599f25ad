//! One module a command, and what they share.

pub mod actor;
pub mod audit;
pub mod completions;
mod context;
pub mod demo;
mod expiry;
mod interrupt;
pub mod login;
mod marker_check;
mod names;
mod numbers;
mod objective;
pub mod publish;
mod publish_summary;
pub mod server;
pub mod session;
mod settings;
pub mod simulate;
pub mod solve;
mod solve_report;
mod stage_run;
pub mod take;
pub mod token;
mod unit;
pub mod watch;

use std::process::ExitCode;

pub use self::{
    context::{ConnectionArgs, Context},
    names::{actor_name, session_name, short_id},
};
use crate::cli::Command;

/// Runs one command.
pub async fn run(context: &Context, command: Command) -> anyhow::Result<ExitCode> {
    match command {
        Command::Actor(command) => actor::run(context, command).await,
        Command::Session(command) => session::run(context, command).await,
        Command::Take(command) => take::run(context, command).await,
        Command::Publish(args) => publish::run(context, args).await,
        Command::Watch(args) => watch::run(context, args).await,
        Command::Solve(args) => solve::run(context, &args),
        Command::Simulate(args) => simulate::run(context, args).await,
        Command::Demo(args) => demo::run(context, args).await,
        Command::Login(args) => login::login(context, args).await,
        Command::Logout(args) => login::logout(context, &args).await,
        Command::Token(command) => token::run(context, command).await,
        Command::Audit(command) => audit::run(context, &command),
        Command::Server(args) => server::run(context, args).await,
        Command::Completions(args) => completions::run(&args),
    }
}
