//! How the port speaks TLS, from what the files hold.

use std::sync::Arc;

use rustls::{
    RootCertStore, ServerConfig,
    crypto::{CryptoProvider, ring},
    server::{NoServerSessionStorage, WebPkiClientVerifier, danger::ClientCertVerifier},
};

use super::files::{CERTIFICATE, Content, Files, TlsError};

/// What is spoken inside, the better one first.
const PROTOCOLS: [&[u8]; 2] = [b"h2", b"http/1.1"];

/// The judge of client certificates, where they are asked for.
pub(super) type Judge = Option<Arc<dyn ClientCertVerifier>>;

pub(super) fn build(files: &Files) -> Result<(ServerConfig, Judge), TlsError> {
    let provider = Arc::new(ring::default_provider());
    let refused = |cause| refused(files, cause);
    let builder = ServerConfig::builder_with_provider(provider.clone())
        .with_safe_default_protocol_versions()
        .map_err(refused)?;
    let authorities = files.client_ca.as_ref();
    let judge = authorities.map(|it| verifier(files, it, provider));
    let judge = judge.transpose()?;
    let builder = match &judge {
        Some(judge) => builder.with_client_cert_verifier(Arc::clone(judge)),
        None => builder.with_no_client_auth(),
    };
    let mut server = builder
        .with_single_cert(files.cert.certificates()?, files.key.private_key()?)
        .map_err(refused)?;
    server.alpn_protocols = PROTOCOLS.map(<[u8]>::to_vec).to_vec();
    if files.client_ca.is_some() {
        // A resumed session would bring back a certificate that may have expired or been revoked since.
        server.session_storage = Arc::new(NoServerSessionStorage {});
    }
    Ok((server, judge))
}

fn verifier(
    files: &Files,
    authorities: &Content,
    provider: Arc<CryptoProvider>,
) -> Result<Arc<dyn ClientCertVerifier>, TlsError> {
    let mut roots = RootCertStore::empty();
    for certificate in authorities.certificates()? {
        roots
            .add(certificate)
            .map_err(|error| authorities.damaged(CERTIFICATE, error.into()))?;
    }
    let revoked = match &files.client_crl {
        Some(list) => list.revoked()?,
        None => Vec::new(),
    };
    let builder =
        WebPkiClientVerifier::builder_with_provider(Arc::new(roots), provider).with_crls(revoked);
    let builder = if files.require_client_cert {
        builder
    } else {
        builder.allow_unauthenticated()
    };
    builder.build().map_err(|error| TlsError::Authorities {
        path: authorities.path.clone(),
        cause: error.into(),
    })
}

fn refused(files: &Files, cause: rustls::Error) -> TlsError {
    let (cert, key) = (files.cert.path.clone(), files.key.path.clone());
    match cause {
        rustls::Error::InconsistentKeys(_) => TlsError::Mismatch { cert, key },
        cause => TlsError::Refused { cert, key, cause },
    }
}
