//! The files of the port's certificates: read within a limit, complained about by name.

use std::{
    fs::File,
    io::{self, Read as _},
    path::{Path, PathBuf},
};

use rustls::pki_types::{
    CertificateDer, CertificateRevocationListDer, PrivateKeyDer, pem::PemObject,
};
use x509_parser::{extensions::GeneralName, prelude::FromDer as _};

use crate::config;

/// Largest file; a chain of certificates takes some KiB, a large list of revoked ones some hundred.
const MAX_FILE_BYTES: u64 = 4 << 20;

/// A certificate that ends sooner is warned of.
const SOON_SECS: i64 = 14 * 24 * 3_600;

/// Why certificates are refused.
#[derive(Debug, thiserror::Error)]
pub enum TlsError {
    /// A file cannot be read.
    #[error("the file {} cannot be read", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: io::Error,
    },
    /// A file is too large.
    #[error("the file {} is larger than {MAX_FILE_BYTES} bytes", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// A file has nothing of what it should have.
    #[error("the file {} holds no {wanted} as PEM", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
        /// What it should have.
        wanted: &'static str,
    },
    /// A file is damaged.
    #[error("the file {} is not a {wanted} as PEM", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What it should be.
        wanted: &'static str,
        /// What is wrong.
        #[source]
        cause: Cause,
    },
    /// Two files do not belong together.
    #[error("the key {} does not belong to the certificate {}", key.display(), cert.display())]
    Mismatch {
        /// The certificate.
        cert: PathBuf,
        /// The key.
        key: PathBuf,
    },
    /// The library does not take them.
    #[error("the certificate {} and the key {} are refused", cert.display(), key.display())]
    Refused {
        /// The certificate.
        cert: PathBuf,
        /// The key.
        key: PathBuf,
        /// Why.
        #[source]
        cause: rustls::Error,
    },
    /// The authorities cannot be used.
    #[error("the authorities of {} are refused", path.display())]
    Authorities {
        /// Their file.
        path: PathBuf,
        /// Why.
        #[source]
        cause: Cause,
    },
}

/// What a library says.
pub type Cause = Box<dyn std::error::Error + Send + Sync>;

/// A file and what it holds.
pub(super) struct Content {
    pub(super) path: PathBuf,
    pub(super) bytes: Vec<u8>,
}

/// All files of the configuration.
pub(super) struct Files {
    pub(super) cert: Content,
    pub(super) key: Content,
    pub(super) client_ca: Option<Content>,
    pub(super) client_crl: Option<Content>,
    pub(super) require_client_cert: bool,
}

impl Files {
    pub(super) fn read(paths: &config::Tls) -> Result<Self, TlsError> {
        let optional = |path: &str| (!path.is_empty()).then(|| Content::read(path)).transpose();
        Ok(Self {
            cert: Content::read(&paths.cert)?,
            key: Content::read(&paths.key)?,
            client_ca: optional(&paths.client_ca)?,
            client_crl: optional(&paths.client_crl)?,
            require_client_cert: paths.require_client_cert,
        })
    }

    /// Names of hosts that the certificate vouches for, in small letters.
    pub(super) fn names(&self) -> Result<Vec<String>, TlsError> {
        let chain = self.cert.certificates()?;
        let damaged = |cause: Cause| self.cert.damaged(CERTIFICATE, cause);
        let first = chain.first().ok_or_else(|| self.cert.empty(CERTIFICATE))?;
        let (_, certificate) = x509_parser::certificate::X509Certificate::from_der(first)
            .map_err(|error| damaged(error.to_string().into()))?;
        let names = certificate
            .subject_alternative_name()
            .map_err(|error| damaged(error.to_string().into()))?;
        let names = names.iter().flat_map(|it| &it.value.general_names);
        let of_hosts = names.filter_map(|it| match it {
            GeneralName::DNSName(name) => Some(name.to_ascii_lowercase()),
            _ => None,
        });
        Ok(of_hosts.collect())
    }

    /// Says what works and yet should not stay.
    pub(super) fn warn_of_what_is_odd(&self) {
        if is_readable_by_others(&self.key.path) {
            let path = self.key.path.display();
            tracing::warn!(%path, "others can read the private key; chmod 600 it");
        }
        let Some(left_secs) = self.secs_left() else {
            return;
        };
        let (path, days) = (self.cert.path.display(), left_secs / 86_400);
        if left_secs < 0 {
            tracing::warn!(%path, "the certificate has expired; clients will refuse it");
        } else if left_secs < SOON_SECS {
            tracing::warn!(%path, days, "the certificate expires soon");
        }
    }

    fn secs_left(&self) -> Option<i64> {
        let chain = self.cert.certificates().ok()?;
        let (_, first) =
            x509_parser::certificate::X509Certificate::from_der(chain.first()?).ok()?;
        let now = x509_parser::time::ASN1Time::now().timestamp();
        Some(first.validity().not_after.timestamp() - now)
    }
}

/// What a file should hold, in words.
pub(super) const CERTIFICATE: &str = "certificate";
const KEY: &str = "private key";
const REVOKED: &str = "list of revoked certificates";

impl Content {
    fn read(path: &str) -> Result<Self, TlsError> {
        let path = PathBuf::from(path);
        let failed = |cause| TlsError::File {
            path: path.clone(),
            cause,
        };
        let file = File::open(&path).map_err(failed)?;
        let mut bytes = Vec::new();
        file.take(MAX_FILE_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(failed)?;
        if bytes.len() as u64 > MAX_FILE_BYTES {
            return Err(TlsError::TooLarge { path });
        }
        Ok(Self { path, bytes })
    }

    pub(super) fn certificates(&self) -> Result<Vec<CertificateDer<'static>>, TlsError> {
        self.all(CERTIFICATE)
    }

    pub(super) fn revoked(&self) -> Result<Vec<CertificateRevocationListDer<'static>>, TlsError> {
        self.all(REVOKED)
    }

    pub(super) fn private_key(&self) -> Result<PrivateKeyDer<'static>, TlsError> {
        let mut keys = self.all(KEY)?;
        Ok(keys.swap_remove(0))
    }

    /// Every section of that kind; at least one.
    fn all<T: PemObject>(&self, wanted: &'static str) -> Result<Vec<T>, TlsError> {
        let found: Result<Vec<T>, _> = T::pem_slice_iter(&self.bytes).collect();
        let found = found.map_err(|error| self.damaged(wanted, error.to_string().into()))?;
        if found.is_empty() {
            return Err(self.empty(wanted));
        }
        Ok(found)
    }

    pub(super) fn damaged(&self, wanted: &'static str, cause: Cause) -> TlsError {
        TlsError::Damaged {
            path: self.path.clone(),
            wanted,
            cause,
        }
    }

    fn empty(&self, wanted: &'static str) -> TlsError {
        TlsError::Empty {
            path: self.path.clone(),
            wanted,
        }
    }
}

fn is_readable_by_others(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt as _;
    std::fs::metadata(path).is_ok_and(|it| it.permissions().mode() & 0o077 != 0)
}
