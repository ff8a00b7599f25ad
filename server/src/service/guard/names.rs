//! By which name a request asks for the server.

use std::net::{Ipv4Addr, Ipv6Addr};

use axum::{
    extract::Request,
    http::{header, uri::Authority},
};

use crate::config::Origin;

/// The host that a request names, in small letters, and its port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Asked {
    host: String,
    port: Option<u16>,
}

/// A request names several hosts, or none that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unclear;

/// The one host that the request line and the header name; none where neither does.
pub(super) fn asked(request: &Request) -> Result<Option<Asked>, Unclear> {
    let in_target = request.uri().authority().map(Asked::of).transpose()?;
    let mut in_header = None;
    for value in request.headers().get_all(header::HOST) {
        let authority = value.to_str().map_err(|_| Unclear)?.parse();
        let asked = Asked::of(&authority.map_err(|_| Unclear)?)?;
        if in_header.replace(asked).is_some() {
            return Err(Unclear);
        }
    }
    match (in_target, in_header) {
        (Some(one), Some(other)) if one != other => Err(Unclear),
        (one, other) => Ok(one.or(other)),
    }
}

impl Asked {
    fn of(authority: &Authority) -> Result<Self, Unclear> {
        if authority.as_str().contains('@') || authority.host().is_empty() {
            return Err(Unclear);
        }
        Ok(Self {
            host: authority.host().to_ascii_lowercase(),
            port: authority.port_u16(),
        })
    }

    /// The name without the dot of the root; none: it is an address, which no foreign name service hands out.
    pub(super) fn name(&self) -> Option<&str> {
        let is_v6 = || {
            let inner = self.host.strip_prefix('[')?.strip_suffix(']')?;
            inner.parse::<Ipv6Addr>().ok()
        };
        if self.host.parse::<Ipv4Addr>().is_ok() || is_v6().is_some() {
            return None;
        }
        Some(self.host.strip_suffix('.').unwrap_or(&self.host))
    }

    /// Whether it is a name of its own, which means one server: neither an address nor `localhost`.
    pub(super) fn is_a_name(&self) -> bool {
        self.name().is_some_and(|it| it != "localhost")
    }

    /// The origin of the pages that this server hands out under that name.
    pub(super) fn origin(&self, is_tls: bool) -> Origin {
        Origin::new(is_tls, &self.host, self.port)
    }
}
