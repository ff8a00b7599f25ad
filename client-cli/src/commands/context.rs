//! Which server a command talks to, and what it shows that server: the one place where commands connect.
//!
//! CONTRACTS S-11: a token comes from a file, the environment or what `frontalis login` stored, never from an argument.

use std::{
    env, fs,
    path::{Path, PathBuf},
};

use anyhow::Context as _;
use clap::Args;
use frontalis_client::{
    connection::{
        self, Channel, ClientIdentity, Credentials, DEFAULT_SERVER, Token, check_certificates,
    },
    error::ClientError,
};
use tonic::Code;

use crate::login_file::{LoginFile, StoredServer};

/// Holds a token, where no file does.
const TOKEN_VARIABLE: &str = "FRONTALIS_TOKEN";

/// What every command understands about its server.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Everywhere")]
pub struct ConnectionArgs {
    /// Address of the server, http:// or https:// [default: that of the last `frontalis login`, or 127.0.0.1:7400]
    #[arg(long, global = true, value_name = "URL", env = "FRONTALIS_SERVER")]
    pub server: Option<String>,

    /// Certificates (PEM) that may have issued the server's, instead of the system's
    #[arg(long, global = true, value_name = "FILE", env = "FRONTALIS_CA_CERT")]
    pub ca_cert: Option<PathBuf>,

    /// This client's certificate (PEM), for servers that ask for one
    #[arg(
        long,
        global = true,
        value_name = "FILE",
        env = "FRONTALIS_CLIENT_CERT"
    )]
    pub client_cert: Option<PathBuf>,

    /// The key (PEM) of --client-cert
    #[arg(long, global = true, value_name = "FILE", env = "FRONTALIS_CLIENT_KEY")]
    pub client_key: Option<PathBuf>,

    /// File that holds one token [default: the variable `FRONTALIS_TOKEN`, or what `frontalis login` stored]
    #[arg(long, global = true, value_name = "FILE")]
    pub token_file: Option<PathBuf>,
}

/// What every command may use.
#[derive(Clone, Debug)]
pub struct Context {
    /// Answer in JSON.
    pub json: bool,
    connection: ConnectionArgs,
}

impl Context {
    pub fn new(json: bool, connection: ConnectionArgs) -> Self {
        Self { json, connection }
    }

    /// What was typed about the server.
    pub fn connection(&self) -> &ConnectionArgs {
        &self.connection
    }

    /// Address of the server.
    pub fn server(&self) -> anyhow::Result<String> {
        if let Some(server) = &self.connection.server {
            return Ok(server.clone());
        }
        let current = LoginFile::read()?.current;
        Ok(current.unwrap_or_else(|| DEFAULT_SERVER.to_owned()))
    }

    /// A channel to the server, once it answered.
    pub async fn connect(&self) -> anyhow::Result<Channel> {
        let server = self.server()?;
        let credentials = self.credentials(&server)?;
        open(&server, &credentials).await
    }

    /// A channel with this token and what was typed, whatever is stored.
    pub async fn connect_for_login(
        &self,
        server: &str,
        token: Option<Token>,
    ) -> anyhow::Result<Channel> {
        let credentials = Credentials {
            token,
            ca_pem: self.typed_ca()?,
            identity: self.typed_identity()?,
        };
        open(server, &credentials).await
    }

    /// What the server is shown: flags first, then the environment, then what was stored for exactly this server.
    fn credentials(&self, server: &str) -> anyhow::Result<Credentials> {
        let stored = LoginFile::read()?.server(server);
        let stored = stored.unwrap_or_default();
        let token = match self.typed_token()? {
            Some(token) => Some(token),
            None => stored.token()?,
        };
        let identity = match self.typed_identity()? {
            Some(identity) => Some(identity),
            None => stored_identity(&stored)?,
        };
        Ok(Credentials {
            token,
            ca_pem: self.typed_ca()?.or(stored.ca_pem),
            identity,
        })
    }

    /// What to do about a connection that was cut without a word, when it turns out that the server speaks TLS.
    pub async fn advice(&self, refusal: Option<&ClientError>) -> Option<String> {
        let cut = refusal.filter(|it| it.reason.is_none() && it.is_transient())?;
        let server = self.server().ok()?;
        let rest = server.strip_prefix("http://").unwrap_or(&server);
        if cut.code == Code::DeadlineExceeded || !connection::speaks_tls(&server).await {
            return None;
        }
        Some(format!("the server speaks TLS: --server https://{rest}"))
    }

    /// The certificates of `--ca-cert`.
    pub fn typed_ca(&self) -> anyhow::Result<Option<String>> {
        let Some(path) = &self.connection.ca_cert else {
            return Ok(None);
        };
        let pem = read("--ca-cert", path)?;
        check_certificates(&pem).with_context(|| format!("--ca-cert {}", path.display()))?;
        Ok(Some(pem))
    }

    /// The token of `--token-file` or of the environment.
    pub fn typed_token(&self) -> anyhow::Result<Option<Token>> {
        if let Some(path) = &self.connection.token_file {
            let text = read("--token-file", path)?;
            let token =
                Token::parse(&text).with_context(|| format!("--token-file {}", path.display()))?;
            return Ok(Some(token));
        }
        match env::var(TOKEN_VARIABLE) {
            Ok(text) if !text.trim().is_empty() => {
                Ok(Some(Token::parse(&text).context(TOKEN_VARIABLE)?))
            }
            _ => Ok(None),
        }
    }

    fn typed_identity(&self) -> anyhow::Result<Option<ClientIdentity>> {
        match (&self.connection.client_cert, &self.connection.client_key) {
            (Some(certificate), Some(key)) => identity(certificate, key).map(Some),
            (None, None) => Ok(None),
            (Some(_), None) => anyhow::bail!("--client-cert needs --client-key"),
            (None, Some(_)) => anyhow::bail!("--client-key needs --client-cert"),
        }
    }
}

async fn open(server: &str, credentials: &Credentials) -> anyhow::Result<Channel> {
    if credentials.token.is_some() && is_readable_on_the_way(server) {
        eprintln!("warning: the token travels to {server} unencrypted; https:// protects it");
    }
    Ok(connection::connect_with(server, credentials).await?)
}

fn stored_identity(stored: &StoredServer) -> anyhow::Result<Option<ClientIdentity>> {
    match (&stored.client_cert, &stored.client_key) {
        (Some(certificate), Some(key)) => identity(certificate, key).map(Some),
        _ => Ok(None),
    }
}

fn identity(certificate: &Path, key: &Path) -> anyhow::Result<ClientIdentity> {
    let certificate_pem = read("--client-cert", certificate)?;
    check_certificates(&certificate_pem)
        .with_context(|| format!("--client-cert {}", certificate.display()))?;
    Ok(ClientIdentity {
        certificate_pem,
        key_pem: read("--client-key", key)?,
    })
}

fn read(flag: &str, path: &Path) -> anyhow::Result<String> {
    fs::read_to_string(path).with_context(|| format!("cannot read {flag} {}", path.display()))
}

/// Whether others can read along: no TLS, and not this machine.
fn is_readable_on_the_way(server: &str) -> bool {
    let server = connection::with_scheme(server);
    let Some(rest) = server.strip_prefix("http://") else {
        return false;
    };
    let authority = rest.split('/').next().unwrap_or_default();
    let host = match authority.strip_prefix('[') {
        Some(v6) => v6.split(']').next().unwrap_or_default(),
        None => authority.split(':').next().unwrap_or_default(),
    };
    let is_loopback = host
        .parse::<std::net::IpAddr>()
        .is_ok_and(|it| it.is_loopback());
    !is_loopback && host != "localhost"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_plain_connection_to_another_machine_can_be_read_on_the_way() {
        for server in [
            "127.0.0.1:7400",
            "http://[::1]:7400",
            "http://localhost:7400/",
            "https://stage.example:7400",
        ] {
            assert!(!is_readable_on_the_way(server), "{server}");
        }
        for server in ["http://10.0.0.5:7400", "stage:7400", "http://[fe80::1]:1"] {
            assert!(is_readable_on_the_way(server), "{server}");
        }
    }

    #[test]
    fn an_unreadable_file_is_told_with_its_flag() {
        let missing = Some(PathBuf::from("/nowhere/file"));
        let connection = ConnectionArgs {
            server: Some("https://127.0.0.1:1".to_owned()),
            ..ConnectionArgs::default()
        };
        let check = |connection: ConnectionArgs, flag: &str| {
            let context = Context::new(false, connection);
            let typed = context
                .typed_ca()
                .map(drop)
                .and_then(|()| context.typed_token().map(drop))
                .and_then(|()| context.typed_identity().map(drop));
            let error = format!("{:#}", typed.unwrap_err());
            assert!(error.contains(flag), "{error}");
        };
        check(
            ConnectionArgs {
                ca_cert: missing.clone(),
                ..connection.clone()
            },
            "--ca-cert /nowhere/file",
        );
        check(
            ConnectionArgs {
                token_file: missing.clone(),
                ..connection.clone()
            },
            "--token-file /nowhere/file",
        );
        check(
            ConnectionArgs {
                client_cert: missing,
                ..connection
            },
            "--client-key",
        );
    }
}
