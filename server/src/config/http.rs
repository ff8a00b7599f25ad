//! `[http]`: by which names the server is called, and whose pages may call it (CONTRACTS S-8).

use std::{fmt, str::FromStr};

use http::Uri;
use serde::{Deserialize, Serialize};

use super::ConfigError;

/// Names and origins; `localhost`, addresses and the names in the certificate need no entry.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Http {
    /// Names of this server.
    pub hosts: Vec<String>,
    /// Origins of pages that may call this server from a browser, besides its own.
    pub origins: Vec<String>,
}

/// Where a page comes from (RFC 6454): scheme, host and port, written in one way only.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Origin {
    scheme: &'static str,
    host: String,
    port: u16,
}

impl Http {
    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let wrong_host = self.hosts.iter().find(|it| !is_host(it));
        let wrong_origin = self.origins.iter().find(|it| Origin::from_str(it).is_err());
        let refusal = |key, found: &String, wanted| {
            Err(ConfigError::Text {
                key,
                found: found.clone(),
                wanted,
            })
        };
        if let Some(found) = wrong_host {
            return refusal("http.hosts", found, "names of hosts without a port");
        }
        match wrong_origin {
            Some(found) => refusal(
                "http.origins",
                found,
                "origins such as https://dashboard.example:8443, never *",
            ),
            None => Ok(()),
        }
    }
}

fn is_host(text: &str) -> bool {
    let allowed = |it: char| it.is_ascii_alphanumeric() || "-._".contains(it);
    !text.is_empty() && text.chars().all(allowed)
}

/// A text that is no origin: also `null` and `*`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("this is no origin of http or https")]
pub struct NoOrigin;

impl FromStr for Origin {
    type Err = NoOrigin;

    fn from_str(text: &str) -> Result<Self, NoOrigin> {
        let uri: Uri = text.parse().map_err(|_| NoOrigin)?;
        let scheme = match uri.scheme_str() {
            Some("http") => "http",
            Some("https") => "https",
            _ => return Err(NoOrigin),
        };
        let authority = uri.authority().ok_or(NoOrigin)?;
        let has_more = uri.query().is_some()
            || !matches!(uri.path(), "" | "/")
            || text.ends_with('/')
            || authority.as_str().contains('@');
        if has_more {
            return Err(NoOrigin);
        }
        Ok(Self::new(
            scheme == "https",
            authority.host(),
            authority.port_u16(),
        ))
    }
}

impl Origin {
    /// The origin of pages that a server of this name hands out; without a port its scheme's own.
    pub fn new(is_tls: bool, host: &str, port: Option<u16>) -> Self {
        let (scheme, usual) = if is_tls { ("https", 443) } else { ("http", 80) };
        Self {
            scheme,
            host: host.to_ascii_lowercase(),
            port: port.unwrap_or(usual),
        }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}://{}:{}", self.scheme, self.host, self.port)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_origin_is_the_same_however_it_is_written() {
        let same = |one: &str, other: &str| {
            assert_eq!(
                Origin::from_str(one).unwrap(),
                Origin::from_str(other).unwrap()
            );
        };
        same("https://Stage.Example", "https://stage.example:443");
        same("http://stage.example:80", "http://stage.example");
        let own = Origin::new(false, "127.0.0.1", Some(7400));
        assert_eq!("http://127.0.0.1:7400".parse(), Ok(own));
    }

    #[test]
    fn what_is_no_origin_is_refused() {
        for text in [
            "*",
            "null",
            "",
            "stage.example",
            "file:///x",
            "https://stage.example/",
            "https://stage.example/path",
            "https://user@stage.example",
            "https://*.example/x",
        ] {
            assert_eq!(Origin::from_str(text), Err(NoOrigin), "{text}");
        }
    }

    #[test]
    fn a_wrong_entry_is_named_with_what_would_be_taken() {
        let http = Http {
            hosts: Vec::new(),
            origins: vec!["*".to_owned()],
        };
        let message = http.validate().unwrap_err().to_string();
        assert!(message.starts_with("http.origins has \"*\""), "{message}");
        let http = Http {
            hosts: vec!["stage.example:7400".to_owned()],
            origins: Vec::new(),
        };
        let message = http.validate().unwrap_err().to_string();
        assert!(message.starts_with("http.hosts has"), "{message}");
    }
}
