//! What protects a test server: a certificate of an authority made here, and tokens in a file.

use std::path::{Path, PathBuf};

use frontalis_access::{NewToken, Role, Scope, TokenFile};
use frontalis_server::config::Config;
use rcgen::{
    BasicConstraints, CertificateParams, CertifiedIssuer, DnType, IsCa, KeyPair, KeyUsagePurpose,
};
use tempfile::TempDir;

/// Files in a folder of their own; a server is told of them by [`Protection::apply`].
pub struct Protection {
    folder: TempDir,
}

impl Protection {
    /// Makes an authority, a certificate of `127.0.0.1`, and an empty token file.
    pub fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut authority = CertificateParams::default();
        authority.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        // Of another name than what it issues, or OpenSSL takes that for its own issuer.
        authority
            .distinguished_name
            .push(DnType::CommonName, "authority of a test");
        authority.key_usages = vec![KeyUsagePurpose::KeyCertSign];
        let authority = CertifiedIssuer::self_signed(authority, KeyPair::generate().unwrap());
        let authority = authority.unwrap();
        let key = KeyPair::generate().unwrap();
        let params = CertificateParams::new(["127.0.0.1".to_owned()]).unwrap();
        let certificate = params.signed_by(&key, &authority).unwrap();
        let protection = Self { folder };
        protection.write("ca.pem", &authority.pem());
        protection.write("server.pem", &certificate.pem());
        protection.write("server.key", &key.serialize_pem());
        protection.write("tokens.toml", &TokenFile::default().to_toml());
        protection
    }

    /// Has the server speak TLS and ask for tokens.
    pub fn apply(&self, config: &mut Config) {
        let path = |name: &str| self.path(name).to_str().unwrap().to_owned();
        config.tls.cert = path("server.pem");
        config.tls.key = path("server.key");
        config.token_file = path("tokens.toml");
    }

    /// The authority's certificate.
    pub fn ca_cert(&self) -> PathBuf {
        self.path("ca.pem")
    }

    /// The server's token file.
    pub fn token_file(&self) -> PathBuf {
        self.path("tokens.toml")
    }

    /// A file that holds a new token of this role, for these sessions. A server that runs already reads it a little later.
    pub fn token(&self, role: Role, scope: &str) -> PathBuf {
        let text = std::fs::read_to_string(self.token_file()).unwrap();
        let mut file = TokenFile::parse(&text).unwrap();
        let scope: Scope = scope.parse().unwrap();
        let now = crate::now();
        let token = file
            .create(NewToken::new(role.name(), role, scope), now)
            .unwrap();
        self.write("tokens.toml", &file.to_toml());
        let name = format!("{role}-{}.token", file.tokens().len());
        self.write(&name, token.reveal());
        self.path(&name)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
        only_its_owner_reads(&self.path(name));
    }
}

impl Default for Protection {
    fn default() -> Self {
        Self::new()
    }
}

fn only_its_owner_reads(path: &Path) {
    use std::os::unix::fs::PermissionsExt as _;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o600)).unwrap();
}
