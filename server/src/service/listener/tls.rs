//! The port's certificate and whom it believes (CONTRACTS S-2), read again when the files change.
//!
//! TLS 1.3 and 1.2 with `h2` and `http/1.1`. New connections take what was read last; open ones keep the keys they began
//! with, but the certificate of their client is judged anew: one that was revoked since, or whose authority is no longer
//! believed, proves nothing any more. Files that do not
//! fit together change nothing: they are logged, counted, written down, and looked at again.

mod files;
mod fingerprint;
mod peer_certificate;
mod server_config;

use std::{
    io,
    sync::{Arc, PoisonError, RwLock},
    time::Duration,
};

use rustls::{AlertDescription, CertificateError, ServerConfig};
use tokio::{
    io::{AsyncRead, AsyncWrite},
    time::timeout,
};
use tokio_rustls::{TlsAcceptor, server::TlsStream};
use tokio_util::sync::CancellationToken;

use crate::{
    config,
    reload::{Occasion, Reloads},
    service::audit::{Audit, Entry},
    telemetry::{HandshakeFailure, Metrics},
};
use files::Files;
pub use files::TlsError;
use fingerprint::Fingerprint;
pub use peer_certificate::PeerCertificate;
use server_config::Judge;

/// What new connections are answered with; cheap to clone, clones share it.
#[derive(Clone)]
pub struct Tls(Arc<Inner>);

struct Inner {
    paths: config::Tls,
    current: RwLock<Arc<Loaded>>,
}

/// What one look at the files gave.
struct Loaded {
    fingerprint: Fingerprint,
    server: Arc<ServerConfig>,
    judge: Judge,
    /// Names that the certificate vouches for, in small letters.
    names: Vec<String>,
}

impl Tls {
    /// Reads the files.
    ///
    /// # Errors
    ///
    /// [`TlsError`] names the file and what is wrong with it.
    pub fn load(paths: &config::Tls) -> Result<Self, TlsError> {
        let files = Files::read(paths)?;
        files.warn_of_what_is_odd();
        let current = RwLock::new(Arc::new(load(&files)?));
        Ok(Self(Arc::new(Inner {
            paths: paths.clone(),
            current,
        })))
    }

    /// Whether the certificate vouches for a host of this name, which is in small letters.
    pub fn vouches_for(&self, host: &str) -> bool {
        self.current().names.iter().any(|name| covers(name, host))
    }

    /// Shakes hands with a peer.
    ///
    /// # Errors
    ///
    /// Why there is no connection.
    pub(super) async fn accept<S: AsyncRead + AsyncWrite + Unpin>(
        &self,
        stream: S,
        within: Duration,
    ) -> Result<(TlsStream<S>, Option<PeerCertificate>), Handshake> {
        let acceptor = TlsAcceptor::from(self.current().server.clone());
        match timeout(within, acceptor.accept(stream)).await {
            Ok(Ok(stream)) => {
                let certificate = PeerCertificate::of(self, stream.get_ref().1);
                Ok((stream, certificate))
            }
            Ok(Err(error)) => Err(Handshake::of(&error)),
            Err(_) => Err(Handshake::Stalled),
        }
    }

    /// Follows the files until the server closes.
    pub async fn follow(
        self,
        mut reloads: Reloads,
        metrics: Metrics,
        audit: Audit,
        end: CancellationToken,
    ) {
        let mut refused = None;
        loop {
            let occasion = tokio::select! {
                () = end.cancelled() => return,
                occasion = reloads.next() => occasion,
            };
            let tls = self.clone();
            let looked = tokio::task::spawn_blocking(move || tls.look(refused, occasion)).await;
            match looked {
                Ok(Look::Same) => refused = None,
                Ok(Look::StillRefused) => {}
                Ok(Look::New { changed }) => {
                    refused = None;
                    metrics.certificates_reloaded(true);
                    tracing::info!("the certificates were read again; new connections get them");
                    audit.note(Entry::of_server(CHANGE, &changed, "taken"));
                }
                Ok(Look::Refused { what, error }) => {
                    refused = Some(what);
                    metrics.certificates_reloaded(false);
                    let error = chain(&error);
                    tracing::error!(error, "the new certificates are refused, the old ones stay");
                    let changed = what.changed_since(self.current().fingerprint);
                    audit.note(Entry::of_server(
                        CHANGE,
                        &changed,
                        &format!("refused: {error}"),
                    ));
                }
                Err(error) => tracing::error!(%error, "the certificates could not be looked at"),
            }
        }
    }

    /// Takes over the files if they are others than before. Those that were refused are tried again only when asked.
    fn look(&self, refused: Option<Fingerprint>, occasion: Occasion) -> Look {
        let before = self.current().fingerprint;
        let read = Files::read(&self.0.paths);
        let what = read.as_ref().map_or(Fingerprint::NONE, Fingerprint::of);
        if what == before {
            return Look::Same;
        }
        if refused == Some(what) && occasion == Occasion::Routine {
            return Look::StillRefused;
        }
        match read.and_then(|files| self.take(&files)) {
            Ok(()) => Look::New {
                changed: what.changed_since(before),
            },
            Err(error) => Look::Refused { what, error },
        }
    }

    fn take(&self, files: &Files) -> Result<(), TlsError> {
        let loaded = Arc::new(load(files)?);
        files.warn_of_what_is_odd();
        let current = self.0.current.write();
        *current.unwrap_or_else(PoisonError::into_inner) = loaded;
        Ok(())
    }

    fn current(&self) -> Arc<Loaded> {
        self.0
            .current
            .read()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }
}

/// Event of the audit log.
const CHANGE: &str = "certificate_change";

/// What a look at the files came to.
enum Look {
    /// They are those that are in use.
    Same,
    /// They are those that were refused before.
    StillRefused,
    New {
        changed: String,
    },
    Refused {
        what: Fingerprint,
        error: TlsError,
    },
}

fn load(files: &Files) -> Result<Loaded, TlsError> {
    let (server, judge) = server_config::build(files)?;
    Ok(Loaded {
        fingerprint: Fingerprint::of(files),
        server: Arc::new(server),
        judge,
        names: files.names()?,
    })
}

/// Whether `name` of a certificate, perhaps `*.stage.example`, is or covers `host`.
fn covers(name: &str, host: &str) -> bool {
    match name.strip_prefix("*.") {
        Some(parent) => host
            .split_once('.')
            .is_some_and(|(first, rest)| !first.is_empty() && rest == parent),
        None => name == host,
    }
}

fn chain(error: &TlsError) -> String {
    let cause = std::error::Error::source(error).map(|it| format!(": {it}"));
    format!("{error}{}", cause.unwrap_or_default())
}

/// Why a handshake came to nothing.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Handshake {
    /// It took too long.
    Stalled,
    /// The peer's certificate is not believed, or there is none.
    Certificate(String),
    /// The peer does not speak TLS, or none that is spoken here, or it went away.
    Failed(String),
}

impl Handshake {
    fn of(error: &io::Error) -> Self {
        let cause = error
            .get_ref()
            .and_then(|it| it.downcast_ref::<rustls::Error>());
        match cause {
            Some(rustls::Error::NoCertificatesPresented) => {
                Self::Certificate("there is none".to_owned())
            }
            Some(rustls::Error::InvalidCertificate(reason)) => {
                Self::Certificate(certificate_word(reason).to_owned())
            }
            // The client does not believe the server's certificate; nothing is wrong with the client's.
            Some(rustls::Error::AlertReceived(alert)) => Self::Failed(alert_word(*alert)),
            Some(other) => Self::Failed(other.to_string()),
            None => Self::Failed(error.to_string()),
        }
    }

    /// As metrics call it.
    pub(super) fn kind(&self) -> HandshakeFailure {
        match self {
            Self::Stalled => HandshakeFailure::Stalled,
            Self::Certificate(_) => HandshakeFailure::Certificate,
            Self::Failed(_) => HandshakeFailure::Protocol,
        }
    }
}

fn alert_word(alert: AlertDescription) -> String {
    format!("the peer refused: {alert:?}")
}

/// The reason in words of this file: what the library prints of it may hold names of the certificate.
fn certificate_word(reason: &CertificateError) -> &'static str {
    match reason {
        CertificateError::Expired | CertificateError::ExpiredContext { .. } => "expired",
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            "not valid yet"
        }
        CertificateError::Revoked => "revoked",
        CertificateError::UnknownIssuer => "issued by an authority that is not believed",
        CertificateError::UnknownRevocationStatus => {
            "not in the domain of the list of revoked ones"
        }
        CertificateError::InvalidPurpose | CertificateError::InvalidPurposeContext { .. } => {
            "not made for clients"
        }
        CertificateError::BadEncoding => "not readable",
        CertificateError::BadSignature => "not signed with its key",
        _ => "not believed",
    }
}

#[cfg(test)]
pub(super) mod tests;
