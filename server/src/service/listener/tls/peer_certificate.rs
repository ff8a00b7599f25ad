//! The certificate that a client showed, which is judged again for as long as its connection is open (CONTRACTS S-2,
//! BAD_INPUT I4).

use std::{
    fmt,
    sync::{Arc, Mutex, PoisonError},
    time::Duration,
};

use rustls::{
    ServerConnection,
    pki_types::{CertificateDer, UnixTime},
};
use tokio::time::Instant;

use super::{Fingerprint, Tls};

/// How long a judgement holds while the files stay the same: what it rests on may expire.
const JUDGEMENT_LIFE: Duration = Duration::from_secs(5);

/// The certificate of a client, which this server's authorities vouched for in the handshake; an extension of each of
/// its requests. Cheap to clone.
#[derive(Clone)]
pub struct PeerCertificate(Arc<Shown>);

struct Shown {
    /// The client's own, then those between it and an authority; never empty.
    chain: Vec<CertificateDer<'static>>,
    tls: Tls,
    newest: Mutex<Judgement>,
}

/// What was found, by which files, and when.
#[derive(Clone, Copy)]
struct Judgement {
    fingerprint: Fingerprint,
    at: Instant,
    is_believed: bool,
}

impl PeerCertificate {
    /// As shown in the handshake that `connection` has behind it.
    pub(super) fn of(tls: &Tls, connection: &ServerConnection) -> Option<Self> {
        let chain = connection.peer_certificates()?;
        chain.first()?;
        // The files may be others than those of the handshake.
        let newest = Judgement {
            fingerprint: Fingerprint::NONE,
            at: Instant::now(),
            is_believed: false,
        };
        Some(Self(Arc::new(Shown {
            chain: chain.iter().map(|it| it.clone().into_owned()).collect(),
            tls: tls.clone(),
            newest: Mutex::new(newest),
        })))
    }

    /// The client's own certificate.
    pub fn der(&self) -> &[u8] {
        self.0.chain.first().map_or(&[], |it| it.as_ref())
    }

    /// Whether the files as they are now would let it in.
    pub fn is_believed(&self) -> bool {
        let current = self.0.tls.current();
        let mut newest = self.0.newest.lock().unwrap_or_else(PoisonError::into_inner);
        let is_fresh = newest.at.elapsed() < JUDGEMENT_LIFE;
        if newest.fingerprint != current.fingerprint || !is_fresh {
            let judged = current.judge.as_ref().zip(self.0.chain.split_first());
            let is_believed = judged.is_some_and(|(judge, (own, between))| {
                let verified = judge.verify_client_cert(own, between, UnixTime::now());
                verified.is_ok()
            });
            *newest = Judgement {
                fingerprint: current.fingerprint,
                at: Instant::now(),
                is_believed,
            };
        }
        newest.is_believed
    }
}

impl fmt::Debug for PeerCertificate {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("PeerCertificate(..)")
    }
}
