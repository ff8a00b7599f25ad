//! Who may do what (CONTRACTS S-3 to S-5, S-10): the one check that every door passes.
//!
//! [`authenticate()`] asks each request who sent it and puts the [`Caller`] into its extensions; every method of every
//! service asks the caller whether it may. Without a token file everybody who reaches the port is let in.

mod attempts;
mod authenticate;
mod caller;
mod policy;
mod presented;
mod token_source;
mod while_valid;

use std::{
    fmt,
    net::{IpAddr, SocketAddr},
    sync::Arc,
    time::Duration,
};

use axum::extract::ConnectInfo;
use frontalis_access::{Principal, Refused, UnixTime};
use http::{Extensions, HeaderMap};
use tokio::sync::watch;
use tonic::{Code, Status};

use self::{attempts::Attempts, presented::Presented, token_source::TokenSource};
use super::{
    audit::{Audit, Entry},
    grpc::status::Refusal,
    listener::PeerCertificate,
    peer::{Peer, network_of},
};
use crate::{clock::wall_now, config::Limits, telemetry::Metrics};

pub use authenticate::{authenticate, while_valid_grpc};
pub use caller::{Action, Caller, unauthenticated};
pub use token_source::{TokenSourceError, follow};

/// What is behind the one check; cheap to clone, clones share it.
#[derive(Clone)]
pub struct Access(Arc<Inner>);

struct Inner {
    /// None: nobody is asked.
    tokens: Option<TokenSource>,
    failures_by_address: Attempts<IpAddr>,
    failures_by_token: Attempts<String>,
    creations: Attempts<String>,
    audit: Audit,
    metrics: Metrics,
}

impl Access {
    /// Asks nobody who they are.
    pub fn open(limits: &Limits, audit: Audit, metrics: Metrics) -> Self {
        Self::new(None, limits, audit, metrics)
    }

    /// Asks for the tokens of this file.
    ///
    /// # Errors
    ///
    /// [`TokenSourceError`] when it cannot be read, or is refused.
    pub fn with_tokens(
        path: &std::path::Path,
        limits: &Limits,
        audit: Audit,
        metrics: Metrics,
    ) -> Result<Self, TokenSourceError> {
        let source = TokenSource::read(path)?;
        Ok(Self::new(Some(source), limits, audit, metrics))
    }

    fn new(tokens: Option<TokenSource>, limits: &Limits, audit: Audit, metrics: Metrics) -> Self {
        let failures = limits.auth_failures_per_minute;
        Self(Arc::new(Inner {
            tokens,
            failures_by_address: Attempts::new(failures),
            failures_by_token: Attempts::new(failures),
            creations: Attempts::new(limits.session_creations_per_minute),
            audit,
            metrics,
        }))
    }

    /// Who sent this.
    ///
    /// # Errors
    ///
    /// `UNAUTHENTICATED`, the same for every reason; `RESOURCE_EXHAUSTED` after too many of them.
    fn caller(&self, headers: &HeaderMap, extensions: &Extensions) -> Result<Caller, Status> {
        let certificate = extensions.get::<PeerCertificate>();
        if certificate.is_some_and(|it| !it.is_believed()) {
            let refused = not_believed();
            return Err(self.refuse(refused, extensions));
        }
        let Some(source) = &self.0.tokens else {
            return Ok(Caller::anyone().behind(certificate.cloned()));
        };
        let (file, now) = (source.current(), UnixTime::from(wall_now()));
        let proven = match (presented::token(headers), certificate) {
            (Presented::Token(token), _) => file.authenticate(token, now),
            (Presented::Nothing, Some(certificate)) => {
                file.authenticate_certificate(certificate.der(), now)
            }
            (found, _) => {
                // Looked up all the same, so that no answer comes sooner than another.
                file.authenticate(b"", now).and(Err(no_token(found)))
            }
        };
        match proven {
            Ok(principal) => {
                let caller = Caller::known(principal, self.clone());
                Ok(caller.behind(certificate.cloned()))
            }
            Err(refused) => Err(self.refuse(refused, extensions)),
        }
    }

    /// Counts a failure, writes it down, and says what is answered.
    fn refuse(&self, refused: Refused, extensions: &Extensions) -> Status {
        let Inner { audit, metrics, .. } = &*self.0;
        metrics.authentication_failed();
        let peer = Peer::of(extensions);
        if let Err(wait) = self.count_failure(&refused, extensions) {
            audit.suppressed();
            return too_many(
                "limits.auth_failures_per_minute",
                self.0.failures_by_address.per_minute(),
                wait,
            );
        }
        let object = refused.token_id.unwrap_or_default();
        audit.failure(Entry::new("auth_failure", &peer, &object, refused.why));
        unauthenticated()
    }

    fn count_failure(&self, refused: &Refused, extensions: &Extensions) -> Result<(), Duration> {
        let address = extensions.get::<ConnectInfo<SocketAddr>>();
        if let Some(ConnectInfo(address)) = address {
            self.0.failures_by_address.count(network_of(address.ip()))?;
        }
        match &refused.token_id {
            Some(id) => self.0.failures_by_token.count(id.clone()),
            None => Ok(()),
        }
    }

    /// Whether the principal's proof still stands.
    fn still_stands(&self, principal: &Principal) -> bool {
        let source = self.0.tokens.as_ref();
        source.is_some_and(|it| it.current().still_stands(principal, wall_now().into()))
    }

    /// Changes when the token file does.
    fn changes(&self) -> watch::Receiver<u64> {
        match &self.0.tokens {
            Some(source) => source.changes(),
            None => watch::channel(0).1,
        }
    }
}

impl Caller {
    /// Counts the creation of a session (CONTRACTS S-10). Whoever is an operator, or was not asked, is not counted.
    ///
    /// # Errors
    ///
    /// `RESOURCE_EXHAUSTED` with the delay.
    pub fn count_creation(&self) -> Result<(), Status> {
        let Some(known) = self.as_known() else {
            return Ok(());
        };
        if known.principal.role == frontalis_access::Role::Operator {
            return Ok(());
        }
        let creations = &known.access.0.creations;
        let counted = creations.count(known.principal.key.clone());
        counted.map_err(|wait| {
            too_many(
                "limits.session_creations_per_minute",
                creations.per_minute(),
                wait,
            )
        })
    }
}

/// Until the principal's proof expires by itself.
fn time_left(principal: &Principal) -> Option<Duration> {
    let at = principal.expire_time?;
    let left = at.secs().saturating_sub(UnixTime::from(wall_now()).secs());
    Some(Duration::from_secs(u64::try_from(left).unwrap_or(0)))
}

fn not_believed() -> Refused {
    Refused {
        token_id: None,
        why: "the connection's certificate is no longer believed",
    }
}

fn no_token(found: Presented<'_>) -> Refused {
    Refused {
        token_id: None,
        why: match found {
            Presented::Nothing => "no token",
            _ => "no bearer token",
        },
    }
}

fn too_many(what: &'static str, per_minute: u32, wait: Duration) -> Status {
    let message = format!("{what} is {per_minute}, and that many came in a minute");
    Refusal::new(Code::ResourceExhausted, "RATE_LIMIT", message)
        .with("limit", &what)
        .with("value", &per_minute)
        .retry_after(wait)
        .into_status()
}

impl fmt::Debug for Access {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("Access(***)")
    }
}

#[cfg(test)]
mod tests;
