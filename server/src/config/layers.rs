//! Where a configuration comes from: the file, then the environment, then flags, each over the one before.
//!
//! The variable of a key is its path in capitals after `FRONTALIS_`, `__` between table and key:
//! `FRONTALIS_LISTEN`, `FRONTALIS_LIMITS__SESSIONS`.

use std::path::{Path, PathBuf};

use clap::Parser;
use serde::Deserialize as _;
use toml::{Table, Value};

use super::{Config, ConfigError};

const PREFIX: &str = "FRONTALIS_";

/// Variables of the client, the tests and the command line, which are no keys of the server.
const NOT_KEYS: [&str; 3] = ["FRONTALIS_CONFIG", "FRONTALIS_DATA", "FRONTALIS_SERVER"];

/// Takes facial motion capture in and streams muscle curves out, live.
#[derive(Clone, Debug, Default, Parser)]
#[command(name = "frontalis-server", version)]
pub struct Flags {
    /// Address of the one port [default: 127.0.0.1:7400]
    #[arg(long, value_name = "ADDR")]
    pub listen: Option<String>,
    /// Where actors and sessions are kept; ":memory:" keeps nothing [default: frontalis-data]
    #[arg(long, value_name = "DIR")]
    pub data_dir: Option<String>,
    /// Configuration file, see deploy/frontalis.toml
    #[arg(long, value_name = "FILE", env = "FRONTALIS_CONFIG")]
    pub config: Option<PathBuf>,
    /// Accept an address other than loopback without TLS and tokens
    #[arg(long)]
    pub allow_insecure: bool,
    /// Certificate of the port, PEM; with it the port speaks TLS
    #[arg(long, value_name = "FILE")]
    pub tls_cert: Option<String>,
    /// Private key of the certificate, PEM
    #[arg(long, value_name = "FILE")]
    pub tls_key: Option<String>,
    /// Believe certificates of clients that these authorities issued, PEM
    #[arg(long, value_name = "FILE")]
    pub tls_client_ca: Option<String>,
    /// Tokens that callers must present, see `frontalis token`
    #[arg(long, value_name = "FILE")]
    pub token_file: Option<String>,
    /// Filter of the log: error, warn, info, debug, trace, or by module [default: info]
    #[arg(long, value_name = "FILTER")]
    pub log: Option<String>,
    /// Check the configuration, print it with its worst-case memory, and exit
    #[arg(long)]
    pub check: bool,
}

/// The configuration that results, checked.
///
/// `environment` holds the process's variables; those without the prefix are ignored.
///
/// # Errors
///
/// [`ConfigError`] names the file, the variable or the key.
pub fn load(
    flags: &Flags,
    environment: impl IntoIterator<Item = (String, String)>,
) -> Result<Config, ConfigError> {
    let mut table = match &flags.config {
        Some(path) => read(path)?,
        None => Table::new(),
    };
    overlay_environment(&mut table, environment)?;
    overlay_flags(&mut table, flags);
    let config = Config::deserialize(table).map_err(ConfigError::Key)?;
    config.validate()?;
    Ok(config)
}

fn read(path: &Path) -> Result<Table, ConfigError> {
    let text = std::fs::read_to_string(path).map_err(|cause| ConfigError::File {
        path: path.to_owned(),
        cause,
    })?;
    text.parse().map_err(|cause| ConfigError::Syntax {
        path: path.to_owned(),
        cause,
    })
}

fn overlay_environment(
    table: &mut Table,
    environment: impl IntoIterator<Item = (String, String)>,
) -> Result<(), ConfigError> {
    let defaults = Table::try_from(Config::default()).expect("invariant: the defaults are a table");
    for (name, text) in environment {
        let Some(key) = name.strip_prefix(PREFIX) else {
            continue;
        };
        if NOT_KEYS.contains(&name.as_str()) {
            continue;
        }
        let path: Vec<String> = key.split("__").map(str::to_lowercase).collect();
        let value = typed(&defaults, &path, &name, &text)?;
        put(table, &path, value);
    }
    Ok(())
}

/// The text as a value of the type that the key's default has.
fn typed(defaults: &Table, path: &[String], name: &str, text: &str) -> Result<Value, ConfigError> {
    let unknown = || ConfigError::UnknownVariable {
        name: name.to_owned(),
    };
    let wanted = |wanted| ConfigError::Variable {
        name: name.to_owned(),
        wanted,
    };
    let default = match path {
        [key] => defaults.get(key),
        [table, key] => defaults.get(table).and_then(|it| it.get(key)),
        _ => None,
    };
    match default.ok_or_else(unknown)? {
        Value::String(_) => Ok(Value::String(text.to_owned())),
        Value::Integer(_) => text
            .parse()
            .map(Value::Integer)
            .map_err(|_| wanted("a whole number")),
        Value::Boolean(_) => text
            .parse()
            .map(Value::Boolean)
            .map_err(|_| wanted("true or false")),
        Value::Array(_) => Ok(Value::Array(listed(text))),
        _ => Err(unknown()),
    }
}

/// The entries of a list, which a variable separates by commas.
fn listed(text: &str) -> Vec<Value> {
    let entries = text.split(',').map(str::trim).filter(|it| !it.is_empty());
    entries.map(|it| Value::String(it.to_owned())).collect()
}

fn put(table: &mut Table, path: &[String], value: Value) {
    match path {
        [key] => {
            table.insert(key.clone(), value);
        }
        [first, rest @ ..] => {
            let inner = table
                .entry(first.clone())
                .or_insert_with(|| Table::new().into());
            // A file that says `limits = 3` is refused later, by its key.
            if let Value::Table(inner) = inner {
                put(inner, rest, value);
            }
        }
        [] => {}
    }
}

fn overlay_flags(table: &mut Table, flags: &Flags) {
    let texts = [
        ("listen", &flags.listen),
        ("data_dir", &flags.data_dir),
        ("log", &flags.log),
        ("token_file", &flags.token_file),
        ("tls.cert", &flags.tls_cert),
        ("tls.key", &flags.tls_key),
        ("tls.client_ca", &flags.tls_client_ca),
    ];
    for (key, text) in texts {
        if let Some(text) = text {
            let path: Vec<String> = key.split('.').map(str::to_owned).collect();
            put(table, &path, Value::String(text.clone()));
        }
    }
    if flags.allow_insecure {
        table.insert("allow_insecure".to_owned(), Value::Boolean(true));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_file(content: &str, environment: &[(&str, &str)]) -> Result<Config, ConfigError> {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("frontalis.toml");
        std::fs::write(&path, content).unwrap();
        let flags = Flags {
            config: Some(path),
            ..Flags::default()
        };
        load(&flags, pairs(environment))
    }

    fn pairs(environment: &[(&str, &str)]) -> Vec<(String, String)> {
        let owned = |(name, text): &(&str, &str)| ((*name).to_owned(), (*text).to_owned());
        environment.iter().map(owned).collect()
    }

    fn chain(error: &ConfigError) -> String {
        let cause = std::error::Error::source(error).map(ToString::to_string);
        format!("{error}: {}", cause.unwrap_or_default())
    }

    #[test]
    fn the_documented_file_says_the_defaults_and_every_key() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../deploy/frontalis.toml");
        let documented = read(&path).unwrap();
        let defaults = Table::try_from(Config::default()).unwrap();
        assert_eq!(documented, defaults);
    }

    #[test]
    fn flags_win_over_the_environment_and_that_over_the_file() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("frontalis.toml");
        std::fs::write(
            &path,
            "data_dir = \"file\"\nlog = \"warn\"\n[limits]\nsessions = 7\n",
        )
        .unwrap();
        let flags = Flags {
            config: Some(path),
            data_dir: Some("flag".to_owned()),
            ..Flags::default()
        };
        let environment = [
            ("FRONTALIS_DATA_DIR", "variable"),
            ("FRONTALIS_LOG", "debug"),
        ];
        let config = load(&flags, pairs(&environment)).unwrap();
        assert_eq!(config.data_dir, "flag");
        assert_eq!(config.log, "debug");
        assert_eq!(config.limits.sessions, 7);
        assert_eq!(config.limits.subscribers, 4_096);
    }

    #[test]
    fn an_unknown_key_of_the_file_is_named() {
        for content in ["sesions = 1", "[limits]\nsesions = 1"] {
            let error = with_file(content, &[]).unwrap_err();
            assert!(chain(&error).contains("sesions"), "{}", chain(&error));
        }
    }

    #[test]
    fn an_unknown_variable_is_named_and_a_foreign_one_ignored() {
        let error = with_file("", &[("FRONTALIS_LIMITS__SESIONS", "1")]).unwrap_err();
        assert!(error.to_string().contains("FRONTALIS_LIMITS__SESIONS"));
        with_file("", &[("HOME", "/"), ("FRONTALIS_DATA", "x")]).unwrap();
    }

    #[test]
    fn a_variable_of_another_type_is_named() {
        let error = with_file("", &[("FRONTALIS_LIMITS__SESSIONS", "many")]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the environment variable FRONTALIS_LIMITS__SESSIONS must be a whole number"
        );
    }

    #[test]
    fn a_list_is_separated_by_commas() {
        let variable = ("FRONTALIS_HTTP__HOSTS", "stage.example, rig");
        let config = with_file("", &[variable]).unwrap();
        assert_eq!(config.http.hosts, ["stage.example", "rig"]);
    }

    #[test]
    fn a_flag_reaches_a_table() {
        let flags = Flags {
            tls_cert: Some("cert.pem".to_owned()),
            tls_key: Some("key.pem".to_owned()),
            ..Flags::default()
        };
        let config = load(&flags, []).unwrap();
        assert_eq!(config.tls.key, "key.pem");
        assert!(config.tls.is_on());
    }

    #[test]
    fn a_variable_reaches_a_table_that_the_file_does_not_have() {
        let config = with_file("", &[("FRONTALIS_LIMITS__SESSIONS", "3")]).unwrap();
        assert_eq!(config.limits.sessions, 3);
    }
}
