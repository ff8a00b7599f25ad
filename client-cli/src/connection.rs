//! One HTTP/2 connection to a server, in the clear or with TLS, and the token that travels with every call.
//!
//! CONTRACTS D-25: a half-open peer is found by a ping every 5 s that must be answered within 10 s.
//! CONTRACTS S-2, S-3: TLS 1.2 or newer, a certificate of the client where the server asks for one, a bearer token.

mod bearer;
pub(crate) mod failure;

use std::time::Duration;

use rustls::pki_types::{CertificateDer, PrivateKeyDer, pem::PemObject as _};
use tonic::{
    Code,
    service::interceptor::InterceptedService,
    transport::{self, Certificate, ClientTlsConfig, Endpoint, Identity},
};

pub use self::bearer::{Bearer, Token, TokenError};
use crate::error::ClientError;

const PING_INTERVAL: Duration = Duration::from_secs(5);
const PING_TIMEOUT: Duration = Duration::from_secs(10);
const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);

/// The address of a server that nobody changed.
pub const DEFAULT_SERVER: &str = "http://127.0.0.1:7400";

/// A connection whose every call carries the token.
pub type Channel = InterceptedService<transport::Channel, Bearer>;

/// What a client shows a server, and what it wants to be shown.
#[derive(Clone, Debug, Default)]
pub struct Credentials {
    /// Sent as `authorization: Bearer …` with every call; absent: nothing is sent.
    pub token: Option<Token>,
    /// Certificates in PEM that may have issued the server's; absent: those of the system.
    pub ca_pem: Option<String>,
    /// The client's own certificate.
    pub identity: Option<ClientIdentity>,
}

/// A certificate of the client and its key, both in PEM.
#[derive(Clone)]
pub struct ClientIdentity {
    /// The certificate, and what lies between it and its authority.
    pub certificate_pem: String,
    /// The private key.
    pub key_pem: String,
}

impl std::fmt::Debug for ClientIdentity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("ClientIdentity(***)")
    }
}

/// A channel that connects with the first call and again after every cut.
///
/// # Errors
///
/// When `server` is not an address of the form `http://HOST:PORT`.
pub fn lazy_channel(server: &str) -> Result<Channel, ClientError> {
    lazy_channel_with(server, &Credentials::default())
}

/// The same with credentials.
///
/// # Errors
///
/// When `server` is not an address, or a certificate or key cannot be read.
pub fn lazy_channel_with(server: &str, credentials: &Credentials) -> Result<Channel, ClientError> {
    let channel = endpoint(server, credentials)?.connect_lazy();
    Ok(with_token(channel, credentials))
}

/// A channel whose server answered.
///
/// # Errors
///
/// When `server` is not an address, or nobody answers there within 5 s.
pub async fn connect(server: &str) -> Result<Channel, ClientError> {
    connect_with(server, &Credentials::default()).await
}

/// The same with credentials.
///
/// # Errors
///
/// As [`connect`]; also when the server's certificate is not trusted or is of another name.
pub async fn connect_with(server: &str, credentials: &Credentials) -> Result<Channel, ClientError> {
    let connected = endpoint(server, credentials)?.connect().await;
    let channel = connected.map_err(|error| {
        let error = ClientError::from(error);
        ClientError {
            message: format!("cannot reach the server at {server}: {}", error.message),
            ..error
        }
    })?;
    Ok(with_token(channel, credentials))
}

/// Whether a server whose address says `http://` speaks TLS: why a call to it was cut without a word.
pub async fn speaks_tls(server: &str) -> bool {
    let server = with_scheme(server);
    let Some(rest) = server.strip_prefix("http://") else {
        return false;
    };
    match connect(&format!("https://{rest}")).await {
        Ok(_) => true,
        Err(error) => error.reason.is_some_and(|it| it != failure::NOT_SPOKEN),
    }
}

/// `http://HOST:PORT` of an address that may lack its scheme.
pub fn with_scheme(server: &str) -> String {
    if server.contains("://") {
        server.to_owned()
    } else {
        format!("http://{server}")
    }
}

/// A connection over which every call carries the token of `credentials`.
pub fn with_token(channel: transport::Channel, credentials: &Credentials) -> Channel {
    Channel::new(channel, Bearer::new(credentials.token.as_ref()))
}

/// How a server is reached: for those who connect over another network than the system's.
///
/// # Errors
///
/// As [`lazy_channel_with`].
pub fn endpoint(server: &str, credentials: &Credentials) -> Result<Endpoint, ClientError> {
    let not_an_address = || {
        invalid(format!(
            "{server:?} is not a server address; expected http://HOST:PORT or https://HOST:PORT"
        ))
    };
    let endpoint = Endpoint::from_shared(with_scheme(server)).map_err(|_| not_an_address())?;
    let endpoint = match endpoint.uri().scheme_str() {
        Some("https") => endpoint
            .tls_config(tls_config(credentials)?)
            .map_err(ClientError::from)?,
        Some("http") => endpoint,
        _ => return Err(not_an_address()),
    };
    Ok(endpoint
        .connect_timeout(CONNECT_TIMEOUT)
        .tcp_nodelay(true)
        .http2_keep_alive_interval(PING_INTERVAL)
        .keep_alive_timeout(PING_TIMEOUT)
        .keep_alive_while_idle(true))
}

fn tls_config(credentials: &Credentials) -> Result<ClientTlsConfig, ClientError> {
    let config = ClientTlsConfig::new();
    let config = match &credentials.ca_pem {
        Some(pem) => {
            check_certificates(pem)?;
            config.ca_certificate(Certificate::from_pem(pem))
        }
        None => config.with_native_roots(),
    };
    Ok(match &credentials.identity {
        Some(it) => {
            check_certificates(&it.certificate_pem)?;
            PrivateKeyDer::from_pem_slice(it.key_pem.as_bytes())
                .map_err(|_| invalid("no private key in PEM was found".to_owned()))?;
            config.identity(Identity::from_pem(&it.certificate_pem, &it.key_pem))
        }
        None => config,
    })
}

/// That the text holds certificates in PEM, and nothing broken.
///
/// # Errors
///
/// When it holds none, or one that cannot be read.
pub fn check_certificates(pem: &str) -> Result<(), ClientError> {
    let mut n_found = 0;
    for certificate in CertificateDer::pem_slice_iter(pem.as_bytes()) {
        certificate.map_err(|error| invalid(format!("not a certificate in PEM: {error}")))?;
        n_found += 1;
    }
    if n_found == 0 {
        return Err(invalid("no certificate in PEM was found".to_owned()));
    }
    Ok(())
}

fn invalid(message: String) -> ClientError {
    ClientError::local(Code::InvalidArgument, message)
}

#[cfg(test)]
mod tests;
