//! What `frontalis login` keeps: `$XDG_CONFIG_HOME/frontalis/credentials.toml`, read by its owner alone.
//!
//! A stored token goes to the server it was stored for and to no other: scheme, host and port have to be the same.

use std::{
    collections::BTreeMap,
    env,
    path::{Path, PathBuf},
};

use anyhow::Context as _;
use frontalis_client::connection::{Token, with_scheme};
use serde::{Deserialize, Serialize};

use crate::private_file;

/// Servers and their tokens.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoginFile {
    /// The server of the last login: that of commands without `--server`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub current: Option<String>,
    /// By origin: `https://stage.example:7400`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    servers: BTreeMap<String, StoredServer>,
}

/// What a server is shown.
#[derive(Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredServer {
    #[serde(skip_serializing_if = "Option::is_none")]
    token: Option<String>,
    /// Certificates that may have issued the server's; absent: those of the system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ca_pem: Option<String>,
    /// Where the client's own certificate is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub client_cert: Option<PathBuf>,
    /// Where its key is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub client_key: Option<PathBuf>,
}

impl std::fmt::Debug for StoredServer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("StoredServer(***)")
    }
}

impl StoredServer {
    pub fn new(token: Option<&Token>) -> Self {
        Self {
            token: token.map(|it| it.secret().to_owned()),
            ..Self::default()
        }
    }

    /// The stored token.
    pub fn token(&self) -> anyhow::Result<Option<Token>> {
        self.token
            .as_deref()
            .map(Token::parse)
            .transpose()
            .context("the stored token cannot be used: `frontalis login` stores another")
    }
}

impl LoginFile {
    /// What is stored; empty when nothing is.
    pub fn read() -> anyhow::Result<Self> {
        match path() {
            Some(path) => Self::parse(private_file::read(&path)?, &path),
            None => Ok(Self::default()),
        }
    }

    /// What is stored for this server.
    pub fn server(&self, server: &str) -> Option<StoredServer> {
        self.servers.get(&origin(server)).cloned()
    }

    /// Servers with something stored.
    pub fn origins(&self) -> impl Iterator<Item = &str> {
        self.servers.keys().map(String::as_str)
    }

    /// Stores a login, and makes its server that of commands without `--server`.
    pub async fn store(server: &str, stored: StoredServer) -> anyhow::Result<PathBuf> {
        Self::change(|file| {
            let origin = origin(server);
            file.current = Some(origin.clone());
            file.servers.insert(origin, stored);
        })
        .await
    }

    /// Forgets the logins that `is_forgotten` picks by their origin; nothing is made where nothing was.
    pub async fn forget(is_forgotten: impl Fn(&str) -> bool) -> anyhow::Result<()> {
        if path().is_none_or(|it| !it.exists()) {
            return Ok(());
        }
        Self::change(|file| {
            file.servers.retain(|origin, _| !is_forgotten(origin));
            file.current = file.current.take().filter(|it| !is_forgotten(it));
        })
        .await
        .map(drop)
    }

    async fn change(change: impl FnOnce(&mut Self)) -> anyhow::Result<PathBuf> {
        let path = path().context(
            "there is no folder to store a login in: neither XDG_CONFIG_HOME nor HOME is set",
        )?;
        private_file::create_folder(path.parent().unwrap_or(&path))?;
        private_file::update(&path, |before| {
            let mut file = Self::parse(before, &path)?;
            change(&mut file);
            Ok((toml::to_string(&file)?, ()))
        })
        .await?;
        Ok(path)
    }

    fn parse(text: Option<String>, path: &Path) -> anyhow::Result<Self> {
        // The parser quotes the line it stops at, which may hold a token.
        toml::from_str(&text.unwrap_or_default()).map_err(|error| {
            let message = error.message();
            anyhow::anyhow!(
                "{} cannot be read ({message}): remove it and log in again",
                path.display()
            )
        })
    }
}

/// The file; `None` where a user has no folder for configuration.
fn path() -> Option<PathBuf> {
    // The base directory specification has relative paths ignored.
    let absolute = |name: &str| {
        env::var_os(name)
            .map(PathBuf::from)
            .filter(|it| it.is_absolute())
    };
    let config = absolute("XDG_CONFIG_HOME").or_else(|| Some(absolute("HOME")?.join(".config")))?;
    Some(config.join("frontalis").join("credentials.toml"))
}

/// Scheme, host and port, in lower case.
pub fn origin(server: &str) -> String {
    let server = with_scheme(server).to_ascii_lowercase();
    match server.split_once("://") {
        Some((scheme, rest)) => {
            let authority = rest.split('/').next().unwrap_or_default();
            format!("{scheme}://{authority}")
        }
        None => server,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_login_is_of_one_scheme_host_and_port() {
        assert_eq!(origin("HTTPS://Stage:7400/"), "https://stage:7400");
        assert_eq!(origin("stage:7400"), "http://stage:7400");
        let token = Token::parse("secret-1").unwrap();
        let mut file = LoginFile::default();
        file.servers.insert(
            origin("https://stage:7400"),
            StoredServer::new(Some(&token)),
        );
        assert!(file.server("https://stage:7400/").is_some());
        for other in ["http://stage:7400", "https://stage:7401", "https://stage"] {
            assert!(file.server(other).is_none(), "{other}");
        }
    }

    #[test]
    fn the_file_reads_back_and_debug_shows_no_token() {
        let token = Token::parse("secret-1").unwrap();
        let mut file = LoginFile {
            current: Some(origin("https://stage:7400")),
            ..LoginFile::default()
        };
        let stored = StoredServer {
            ca_pem: Some("-----BEGIN CERTIFICATE-----\n".to_owned()),
            ..StoredServer::new(Some(&token))
        };
        file.servers.insert(origin("https://stage:7400"), stored);
        let text = toml::to_string(&file).unwrap();
        let read = LoginFile::parse(Some(text), Path::new("x")).unwrap();
        assert_eq!(read, file);
        assert!(!format!("{read:?}").contains("secret-1"));
        let stored = read.server("https://stage:7400").unwrap();
        assert_eq!(stored.token().unwrap(), Some(token));
    }

    #[test]
    fn a_broken_file_is_told_without_its_content() {
        let broken = Some("[servers.\"x\"]\ntoken = secret-1".to_owned());
        let error = LoginFile::parse(broken, Path::new("/c/credentials.toml")).unwrap_err();
        let error = format!("{error:#}");
        assert!(error.contains("/c/credentials.toml"), "{error}");
        assert!(!error.contains("secret-1"), "{error}");
    }
}
