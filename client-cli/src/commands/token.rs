//! `frontalis token …`: who may use a server, in the file that `frontalis-server --token-file` names.
//!
//! CONTRACTS S-3: the file holds hashes; the token itself is printed once, when it is made.

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
    time::SystemTime,
};

use anyhow::{Context as _, bail};
use clap::{
    Args, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser as _},
};
use frontalis_access::{NewToken, Role, Scope, Token, TokenFile, TokenRecord, UnixTime};
use serde_json::{Value, json};

use super::{Context, expiry};
use crate::{
    private_file,
    terminal::{self, say, tables},
};

#[derive(Debug, Subcommand)]
pub enum TokenCommand {
    /// Make a token and print it, this once
    Create(CreateArgs),
    /// List the tokens: roles, sessions, which are expired or revoked
    List(ListArgs),
    /// Take a token back; its streams end within 30 s
    Revoke(RevokeArgs),
}

#[derive(Debug, Args)]
#[command(after_help = "\
The token is printed on standard output and kept nowhere: the file holds a hash of it. The file is made when it is
not there, readable by its owner alone. A running server reads it again by itself. Comments in it are not kept.

Roles: operator does everything; publisher has its own sessions (create, publish, calibrate, subscribe, end);
renderer subscribes to sessions and reads their actors; viewer sees the state of sessions.

Examples:
  frontalis token create --token-file tokens.toml --name 'Stage A' --role publisher --sessions 'stage-a-*' > stage-a.token
  frontalis token create --token-file tokens.toml --name Anna --role operator --expires 90d")]
pub struct CreateArgs {
    #[command(flatten)]
    file: TokenFileArgs,
    /// For people: who or what holds the token
    #[arg(long)]
    name: String,
    /// What the holder may do
    #[arg(long, value_parser = role_parser())]
    role: Role,
    /// Session ids, and prefixes that end with *, separated by commas [default: '*' for an operator, needed for others]
    #[arg(long, value_name = "IDS")]
    sessions: Option<Scope>,
    /// When it stops to hold: 12h, 90d, 2027-01-31T18:00:00Z [default: never]
    #[arg(long, value_name = "WHEN")]
    expires: Option<expiry::Expiry>,
    /// Id of the token in the file and in the server's logs [default: one is made]
    #[arg(long)]
    id: Option<String>,
    /// Let this operator read raw images too
    #[arg(long)]
    images: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  frontalis token list --token-file tokens.toml --json")]
pub struct ListArgs {
    #[command(flatten)]
    file: TokenFileArgs,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  frontalis token revoke t-5f0c2a91 --token-file tokens.toml --yes")]
pub struct RevokeArgs {
    /// The token's id, as `frontalis token list` shows it
    id: String,
    #[command(flatten)]
    file: TokenFileArgs,
    /// Do not ask; needed without a terminal
    #[arg(long, short)]
    yes: bool,
}

/// Takes the place of the flag of the same name, which holds the token of a caller.
#[derive(Debug, Args)]
struct TokenFileArgs {
    /// The server's token file, as `frontalis-server --token-file` names it
    #[arg(long, value_name = "FILE", required = true)]
    token_file: Option<PathBuf>,
}

impl TokenFileArgs {
    fn path(&self) -> anyhow::Result<&Path> {
        self.token_file.as_deref().context("--token-file is needed")
    }
}

fn role_parser() -> impl clap::builder::TypedValueParser<Value = Role> {
    PossibleValuesParser::new(Role::ALL.map(Role::name)).try_map(|it| it.parse::<Role>())
}

pub async fn run(context: &Context, command: TokenCommand) -> anyhow::Result<ExitCode> {
    match command {
        TokenCommand::Create(args) => create(context, args).await,
        TokenCommand::List(args) => list(context, &args),
        TokenCommand::Revoke(args) => revoke(context, &args).await,
    }
}

fn now() -> UnixTime {
    UnixTime::from(SystemTime::now())
}

async fn create(context: &Context, args: CreateArgs) -> anyhow::Result<ExitCode> {
    let path = args.file.path()?.to_owned();
    let (token, record) = add(&path, args.into_new(now())?, now()).await?;
    if context.json {
        let mut value = as_json(&record, now());
        value["token"] = json!(token.reveal());
        say(value)?;
    } else {
        say(token.reveal())?;
        explain(&path, &record);
    }
    Ok(ExitCode::SUCCESS)
}

impl CreateArgs {
    fn into_new(self, now: UnixTime) -> anyhow::Result<NewToken> {
        let scope = match (self.sessions, self.role) {
            (Some(scope), _) => scope,
            (None, Role::Operator) => Scope::all(),
            (None, role) => bail!(
                "--sessions is needed for a {role}: ids and prefixes, for example 'stage-a-*,desk-1'; '*' is all"
            ),
        };
        Ok(NewToken {
            id: self.id,
            images: self.images,
            expire_time: self.expires.map(|it| it.at(now)),
            ..NewToken::new(&self.name, self.role, scope)
        })
    }
}

/// Adds the token's hash to the file, which is made when it is not there.
async fn add(path: &Path, new: NewToken, now: UnixTime) -> anyhow::Result<(Token, TokenRecord)> {
    private_file::update(path, |text| {
        let mut file = parse(path, &text.unwrap_or_default())?;
        let token = file.create(new, now).context("no token was made")?;
        let record = file.tokens().last().cloned();
        let record = record.context("no token was made")?;
        Ok((file.to_toml(), (token, record)))
    })
    .await
}

/// On standard error, so that standard output holds the token alone.
fn explain(path: &Path, record: &TokenRecord) {
    let expires = record.expire_time.map_or_else(
        || "does not expire".to_owned(),
        |it| format!("expires {it}"),
    );
    eprintln!(
        "token {} ({:?}): {} of {}, {expires}; in {} as a hash",
        record.id,
        record.name,
        record.role,
        record.scope,
        path.display()
    );
    eprintln!(
        "The line above is the token. It is shown this once: hand it over now, by a way that others cannot read."
    );
    eprintln!(
        "Its holder types `frontalis login --server URL`, or sends `Authorization: Bearer TOKEN`."
    );
}

fn list(context: &Context, args: &ListArgs) -> anyhow::Result<ExitCode> {
    let path = args.file.path()?;
    let text = private_file::read(path)?;
    let file = parse(path, &text.with_context(|| no_file(path))?)?;
    let now = now();
    if context.json {
        let tokens: Vec<_> = file.tokens().iter().map(|it| as_json(it, now)).collect();
        say(json!({ "tokens": tokens }))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut table = tables::table(&[
        "id",
        "name",
        "role",
        "sessions",
        "made (UTC)",
        "expires (UTC)",
        "state",
    ]);
    for it in file.tokens() {
        table.add_row([
            it.id.clone(),
            it.name.clone(),
            it.role.to_string(),
            it.scope.to_string(),
            it.create_time.to_string(),
            it.expire_time
                .map_or_else(|| "never".to_owned(), |it| it.to_string()),
            state(it, now).to_owned(),
        ]);
    }
    say(table)?;
    Ok(ExitCode::SUCCESS)
}

async fn revoke(context: &Context, args: &RevokeArgs) -> anyhow::Result<ExitCode> {
    let path = args.file.path()?;
    let text = private_file::read(path)?.with_context(|| no_file(path))?;
    let file = parse(path, &text)?;
    let record = file.token(&args.id);
    let record = record.with_context(|| {
        format!(
            "{} has no token {}: `frontalis token list` shows the ids",
            path.display(),
            args.id
        )
    })?;
    let question = format!(
        "Take back token {} ({:?}, {})?",
        record.id, record.name, record.role
    );
    if !args.yes && !terminal::is_interactive() {
        bail!("nobody can be asked without a terminal, nothing was revoked: give --yes");
    }
    if !args.yes && !terminal::confirm(&question)? {
        eprintln!("nothing was revoked");
        return Ok(ExitCode::FAILURE);
    }
    take_back(path, &args.id).await?;
    if context.json {
        say(json!({ "revoked": args.id }))?;
    } else {
        say(format_args!(
            "revoked {}; a running server ends its streams within 30 s",
            args.id
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Reads the file again under its lock: somebody may have changed it since the question.
async fn take_back(path: &Path, id: &str) -> anyhow::Result<()> {
    private_file::update(path, |text| {
        let mut file = parse(path, &text.unwrap_or_default())?;
        file.revoke(id)?;
        Ok((file.to_toml(), ()))
    })
    .await
}

fn parse(path: &Path, text: &str) -> anyhow::Result<TokenFile> {
    TokenFile::parse(text).with_context(|| format!("cannot use --token-file {}", path.display()))
}

fn no_file(path: &Path) -> String {
    format!("--token-file {} does not exist", path.display())
}

fn state(record: &TokenRecord, now: UnixTime) -> &'static str {
    match (record.revoked, record.is_valid(now)) {
        (true, _) => "revoked",
        (false, false) => "expired",
        (false, true) => "valid",
    }
}

fn as_json(record: &TokenRecord, now: UnixTime) -> Value {
    let mut value = json!({
        "id": record.id,
        "name": record.name,
        "role": record.role.name(),
        "sessions": record.scope.entries(),
        "images": record.images,
        "createTime": record.create_time.to_string(),
        "state": state(record, now),
    });
    if let Some(at) = record.expire_time {
        value["expireTime"] = json!(at.to_string());
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW: UnixTime = UnixTime::from_secs(1_800_000_000);

    fn publisher(name: &str) -> NewToken {
        NewToken::new(name, Role::Publisher, "stage-a-*,desk-1".parse().unwrap())
    }

    #[tokio::test]
    async fn a_token_opens_until_it_is_taken_back_and_is_not_in_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tokens.toml");
        let (token, record) = add(&path, publisher("Stage A"), NOW).await.unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(!text.contains(token.reveal()));
        let who = |path: &Path| {
            let text = std::fs::read_to_string(path).unwrap();
            let file = TokenFile::parse(&text).unwrap();
            file.authenticate(token.reveal().as_bytes(), NOW).ok()
        };
        assert_eq!(who(&path).unwrap().role, Role::Publisher);
        take_back(&path, &record.id).await.unwrap();
        assert_eq!(who(&path), None);
        assert!(take_back(&path, "nobody").await.is_err());
    }

    #[tokio::test]
    async fn the_list_tells_valid_expired_and_revoked_and_no_secrets() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tokens.toml");
        let expiring = NewToken {
            expire_time: Some(NOW.after(std::time::Duration::from_mins(1))),
            ..publisher("b")
        };
        let (token, mut record) = add(&path, expiring, NOW).await.unwrap();
        assert_eq!(state(&record, NOW), "valid");
        let later = NOW.after(std::time::Duration::from_secs(61));
        assert_eq!(state(&record, later), "expired");
        let shown = as_json(&record, NOW).to_string();
        assert!(
            !shown.contains(token.reveal()) && !shown.contains("sha256"),
            "{shown}"
        );
        record.revoked = true;
        assert_eq!(state(&record, later), "revoked");
    }

    #[tokio::test]
    async fn a_file_that_is_no_token_file_is_left_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tokens.toml");
        std::fs::write(&path, "hello").unwrap();
        let error = add(&path, publisher("a"), NOW).await.unwrap_err();
        assert!(format!("{error:#}").contains("--token-file"), "{error:#}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "hello");
    }
}
