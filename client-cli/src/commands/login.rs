//! `frontalis login` and `frontalis logout`: a server's token, kept for this user.

use std::{
    io::{self, IsTerminal as _, Read as _},
    path::{Path, PathBuf},
    process::ExitCode,
};

use anyhow::Context as _;
use clap::Args;
use frontalis_client::{connection::Token, proto};

use super::{Context, server};
use crate::{
    login_file::{LoginFile, StoredServer, origin},
    terminal::{say, tables},
};

/// More than any token has.
const MAX_INPUT_BYTES: u64 = 64 << 10;

/// Check a token with a server and keep it for this user
#[derive(Debug, Args)]
#[command(
    after_help = "The token is asked for without showing it, or read from standard input. It is stored in
$XDG_CONFIG_HOME/frontalis/credentials.toml (or ~/.config/...), which only you can read, with --ca-cert,
--client-cert and --client-key, and is sent to this server alone. Commands without --server use it from then on.

Examples:
  frontalis login --server https://stage.example:7400 --ca-cert ca.pem
  frontalis login --server https://stage.example:7400 < token.txt"
)]
pub struct LoginArgs {}

/// Forget the token of a server
#[derive(Debug, Args)]
#[command(
    after_help = "The token itself stays valid: `frontalis token revoke` ends it.

Example:
  frontalis logout --server https://stage.example:7400"
)]
pub struct LogoutArgs {
    /// Forget every server
    #[arg(long)]
    all: bool,
}

pub async fn login(context: &Context, _: LoginArgs) -> anyhow::Result<ExitCode> {
    let address = context.server()?;
    let token = token(context, &address)?;
    let mut stored = StoredServer::new(token.as_ref());
    stored.ca_pem = context.typed_ca()?;
    stored.client_cert = absolute(context.connection().client_cert.as_deref())?;
    stored.client_key = absolute(context.connection().client_key.as_deref())?;
    let channel = context.connect_for_login(&address, token).await?;
    let found = server::get(channel)
        .await
        .with_context(|| format!("{address} did not accept the login, nothing was stored"))?;
    let path = LoginFile::store(&address, stored).await?;
    report(context, &address, &found, &path)?;
    Ok(ExitCode::SUCCESS)
}

fn report(
    context: &Context,
    address: &str,
    found: &proto::Server,
    path: &Path,
) -> anyhow::Result<()> {
    server::warn(found);
    if context.json {
        say(serde_json::to_value(found)?)?;
        return Ok(());
    }
    say(tables::server(address, found))?;
    say(format_args!(
        "logged in to {}; kept in {}",
        origin(address),
        path.display()
    ))?;
    if !found.tokens {
        say("this server asks nobody for a token")?;
    }
    Ok(())
}

/// From `--token-file`, the terminal, or standard input; none when nothing was entered.
fn token(context: &Context, address: &str) -> anyhow::Result<Option<Token>> {
    if context.connection().token_file.is_some() {
        return context.typed_token();
    }
    let text = if io::stdin().is_terminal() {
        rpassword::prompt_password(format!("token for {address} (not shown): "))
            .context("cannot ask for the token")?
    } else {
        let mut text = String::new();
        io::stdin()
            .take(MAX_INPUT_BYTES)
            .read_to_string(&mut text)
            .context("cannot read the token from standard input")?;
        text
    };
    if text.trim().is_empty() {
        return Ok(None);
    }
    Token::parse(&text)
        .map(Some)
        .context("what was entered is no token")
}

/// Commands run in other folders later.
fn absolute(path: Option<&Path>) -> anyhow::Result<Option<PathBuf>> {
    Ok(path.map(std::path::absolute).transpose()?)
}

pub async fn logout(context: &Context, args: &LogoutArgs) -> anyhow::Result<ExitCode> {
    let before: Vec<String> = LoginFile::read()?.origins().map(str::to_owned).collect();
    let forgotten: Vec<String> = if args.all {
        before
    } else {
        let server = origin(&context.server()?);
        before.into_iter().filter(|it| *it == server).collect()
    };
    LoginFile::forget(|origin| forgotten.iter().any(|it| it == origin)).await?;
    if context.json {
        say(serde_json::json!({ "forgotten": forgotten }))?;
    } else if forgotten.is_empty() {
        say("no login was stored")?;
    } else {
        say(format_args!("logged out of {}", forgotten.join(", ")))?;
    }
    Ok(ExitCode::SUCCESS)
}
