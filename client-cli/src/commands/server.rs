//! `frontalis server`: what answers there, and what the caller may do.

use std::process::ExitCode;

use anyhow::Context as _;
use clap::Args;
use frontalis_client::{connection::Channel, error::ClientError, proto};
use proto::server_service_client::ServerServiceClient;

use super::Context;
use crate::terminal::{say, tables};

/// Show the server: version, TLS, tokens, and who you are to it
#[derive(Debug, Args)]
#[command(after_help = "Example:
  frontalis server --server https://stage.example:7400 --ca-cert ca.pem")]
pub struct ServerArgs {}

pub async fn run(context: &Context, _: ServerArgs) -> anyhow::Result<ExitCode> {
    let address = context.server()?;
    let server = get(context.connect().await?)
        .await
        .with_context(|| format!("cannot ask the server at {address}"))?;
    warn(&server);
    if context.json {
        say(serde_json::to_value(&server)?)?;
    } else {
        say(tables::server(&address, &server))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The server, as it describes itself to this caller.
pub async fn get(channel: Channel) -> Result<proto::Server, ClientError> {
    let response = ServerServiceClient::new(channel)
        .get_server(proto::GetServerRequest {})
        .await?;
    Ok(response.into_inner().server.unwrap_or_default())
}

/// Says loudly what a person who set the server up should know.
pub fn warn(server: &proto::Server) {
    if server.insecure {
        let missing = match (server.tls, server.tokens) {
            (false, false) => {
                "without TLS and without tokens: anyone there can read and change everything"
            }
            (false, true) => "without TLS: anyone on the way can read faces and tokens",
            (true, _) => "without tokens: anyone there can read and change everything",
        };
        eprintln!("INSECURE: other machines can reach this server {missing}");
    }
    if server.draining {
        eprintln!("the server is shutting down and takes nothing new");
    }
}
