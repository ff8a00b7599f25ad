//! One module a command, and what they share.

pub mod actor;
pub mod completions;
pub mod demo;
mod interrupt;
mod marker_check;
mod names;
mod numbers;
pub mod publish;
mod publish_summary;
pub mod session;
mod settings;
pub mod simulate;
pub mod solve;
mod stage_run;
pub mod watch;

use std::process::ExitCode;

use frontalis_client::{connection, error::ClientError};
use tonic::transport::Channel;

pub use self::names::{actor_name, session_name, short_id};
use crate::cli::{Cli, Command};

/// What every command may use.
#[derive(Clone, Debug)]
pub struct Context {
    /// Address of the server.
    pub server: String,
    /// Answer in JSON.
    pub json: bool,
}

impl Context {
    /// A channel to the server, once it answered.
    async fn connect(&self) -> Result<Channel, ClientError> {
        connection::connect(&self.server).await
    }
}

/// Runs one command.
pub async fn run(cli: Cli) -> anyhow::Result<ExitCode> {
    let context = Context {
        server: cli.server,
        json: cli.json,
    };
    match cli.command {
        Command::Actor(command) => actor::run(&context, command).await,
        Command::Session(command) => session::run(&context, command).await,
        Command::Publish(args) => publish::run(&context, args).await,
        Command::Watch(args) => watch::run(&context, args).await,
        Command::Solve(args) => solve::run(&context, &args),
        Command::Simulate(args) => simulate::run(&context, args).await,
        Command::Demo(args) => demo::run(&context, args).await,
        Command::Completions(args) => completions::run(&args),
    }
}
