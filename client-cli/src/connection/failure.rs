//! Why a connection failed, in the words of a person who set it up.
//!
//! The libraries below say it somewhere in the chain of causes; what no waiting heals gets a reason of its own.

use std::{error::Error, io};

use rustls::CertificateError;

/// The server's certificate is of no authority that this client trusts.
pub(crate) const UNTRUSTED: &str = "TLS_UNTRUSTED";
/// The server's certificate is of another name.
pub(crate) const NAME: &str = "TLS_NAME";
/// The server's certificate is expired, or not valid yet.
pub(crate) const EXPIRED: &str = "TLS_EXPIRED";
/// The address says TLS, the server does not speak it.
pub(crate) const NOT_SPOKEN: &str = "TLS_NOT_SPOKEN";
/// The server wants a certificate of the client, or another one.
pub(crate) const CLIENT_CERTIFICATE: &str = "TLS_CLIENT_CERTIFICATE";
/// TLS failed for another cause.
pub(crate) const TLS: &str = "TLS";

/// What a server says of a client's certificate (RFC 8446, section 6.2).
const CLIENT_ALERTS: [&str; 8] = [
    "CertificateRequired",
    "BadCertificate",
    "UnknownCA",
    "CertificateUnknown",
    "CertificateExpired",
    "CertificateRevoked",
    "AccessDenied",
    "DecryptError",
];

/// A failure that trying again does not heal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Lasting {
    pub reason: &'static str,
    pub message: String,
}

/// What the chain of causes says for good; `None` when waiting may help.
pub(crate) fn lasting(error: &(dyn Error + 'static)) -> Option<Lasting> {
    let mut cause = Some(error);
    while let Some(error) = cause {
        if let Some(tls) = tls_error(error) {
            return Some(of_tls(tls));
        }
        if let Some(lasting) = error.downcast_ref::<io::Error>().and_then(of_alert) {
            return Some(lasting);
        }
        cause = error.source();
    }
    None
}

/// An `io::Error` names as its source the source of what it wraps, so that the wrapped error has to be asked for.
fn tls_error<'a>(error: &'a (dyn Error + 'static)) -> Option<&'a rustls::Error> {
    error.downcast_ref::<rustls::Error>().or_else(|| {
        error
            .downcast_ref::<io::Error>()
            .and_then(io::Error::get_ref)
            .and_then(|it| it.downcast_ref::<rustls::Error>())
    })
}

fn of_tls(error: &rustls::Error) -> Lasting {
    let (reason, what) = match error {
        rustls::Error::InvalidCertificate(it) => of_certificate(it),
        rustls::Error::InvalidMessage(_) => (NOT_SPOKEN, "what answers there does not speak TLS"),
        _ => (TLS, "the TLS connection failed"),
    };
    Lasting {
        reason,
        message: format!("{what} ({error})"),
    }
}

fn of_certificate(error: &CertificateError) -> (&'static str, &'static str) {
    match error {
        CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. } => {
            (NAME, "the server's certificate is of another name")
        }
        CertificateError::Expired
        | CertificateError::ExpiredContext { .. }
        | CertificateError::NotValidYet
        | CertificateError::NotValidYetContext { .. } => {
            (EXPIRED, "the server's certificate is not valid now")
        }
        _ => (UNTRUSTED, "the server's certificate is not trusted"),
    }
}

/// With TLS 1.3 a server refuses a client's certificate after the client has begun to speak; the layers between have
/// made a text of the alert by then.
fn of_alert(error: &io::Error) -> Option<Lasting> {
    let text = error.to_string();
    let alert = text.strip_prefix("received fatal alert: ")?;
    CLIENT_ALERTS.contains(&alert).then(|| Lasting {
        reason: CLIENT_CERTIFICATE,
        message: format!("the server wants a certificate of the client, or another one ({alert})"),
    })
}
