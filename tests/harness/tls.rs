//! An authority that issues what a test needs, and clients that believe it.

use std::{io, net::SocketAddr, sync::Arc};

use hyper_util::rt::TokioIo;
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, CertifiedIssuer, DnType,
    ExtendedKeyUsagePurpose, IsCa, KeyIdMethod, KeyPair, KeyUsagePurpose, RevokedCertParams,
    SerialNumber, date_time_ymd,
};
use rustls::{
    ClientConfig, RootCertStore,
    crypto::ring,
    pki_types::{CertificateDer, PrivateKeyDer, PrivatePkcs8KeyDer, ServerName},
};
use tempfile::TempDir;
use tokio::net::TcpStream;
use tokio_rustls::{TlsConnector, client::TlsStream};
use tonic::transport::{Channel, Endpoint, Uri};
use tower::service_fn;

/// Issues certificates, and writes those that a server reads into a folder of its own.
pub struct TestAuthority {
    issuer: CertifiedIssuer<'static, KeyPair>,
    folder: TempDir,
}

/// What a client shows.
pub struct ClientCert {
    chain: Vec<CertificateDer<'static>>,
    key: PrivateKeyDer<'static>,
    serial: u64,
}

/// How a client speaks TLS; cheap to clone.
#[derive(Clone)]
pub struct TestTls(Arc<ClientConfig>);

impl TestAuthority {
    /// One of this name.
    pub fn new(name: &str) -> Self {
        let mut params = CertificateParams::default();
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.distinguished_name.push(DnType::CommonName, name);
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
        let issuer = CertifiedIssuer::self_signed(params, KeyPair::generate().unwrap());
        Self {
            issuer: issuer.unwrap(),
            folder: tempfile::tempdir().unwrap(),
        }
    }

    /// The file of its own certificate.
    pub fn ca_file(&self) -> String {
        self.write("ca.pem", &self.issuer.pem())
    }

    /// The files of a server's certificate and key; written over those before.
    pub fn server_files(&self, names: &[&str]) -> (String, String) {
        let names: Vec<String> = names.iter().map(|it| (*it).to_owned()).collect();
        let key = KeyPair::generate().unwrap();
        let params = CertificateParams::new(names).unwrap();
        let certificate = params.signed_by(&key, &self.issuer).unwrap();
        (
            self.write("server.pem", &certificate.pem()),
            self.write("server.key", &key.serialize_pem()),
        )
    }

    /// The file of the list of these revoked certificates.
    pub fn revoked_file(&self, revoked: &[&ClientCert]) -> String {
        let entry = |it: &&ClientCert| RevokedCertParams {
            serial_number: SerialNumber::from(it.serial),
            revocation_time: date_time_ymd(2024, 1, 1),
            reason_code: None,
            invalidity_date: None,
        };
        let list = CertificateRevocationListParams {
            this_update: date_time_ymd(2024, 1, 1),
            next_update: date_time_ymd(2124, 1, 1),
            crl_number: SerialNumber::from(1_u64),
            issuing_distribution_point: None,
            revoked_certs: revoked.iter().map(entry).collect(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        let list = list.signed_by(&self.issuer).unwrap();
        self.write("revoked.pem", &list.pem().unwrap())
    }

    /// Writes what is no PEM over a file.
    pub fn damage(&self, name: &str) {
        self.write(name, "-----BEGIN NOTHING-----\n");
    }

    /// A client's certificate of this number, good until that year.
    pub fn client(&self, name: &str, serial: u64, until_year: i32) -> ClientCert {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
        params.serial_number = Some(SerialNumber::from(serial));
        params.not_before = date_time_ymd(2020, 1, 1);
        params.not_after = date_time_ymd(until_year, 1, 1);
        let key = KeyPair::generate().unwrap();
        let certificate = params.signed_by(&key, &self.issuer).unwrap();
        ClientCert {
            chain: vec![certificate.der().clone()],
            key: PrivateKeyDer::Pkcs8(PrivatePkcs8KeyDer::from(key.serialize_der())),
            serial,
        }
    }

    /// A client that believes this authority, and shows a certificate or none. Without protocols none is negotiated.
    pub fn believer(&self, shown: Option<&ClientCert>, protocols: &[&str]) -> TestTls {
        let mut roots = RootCertStore::empty();
        roots.add(self.issuer.der().clone()).unwrap();
        let builder = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions()
            .unwrap()
            .with_root_certificates(roots);
        let mut client = match shown {
            None => builder.with_no_client_auth(),
            Some(shown) => builder
                .with_client_auth_cert(shown.chain.clone(), shown.key.clone_key())
                .unwrap(),
        };
        client.alpn_protocols = protocols.iter().map(|it| it.as_bytes().to_vec()).collect();
        TestTls(Arc::new(client))
    }

    fn write(&self, name: &str, pem: &str) -> String {
        let path = self.folder.path().join(name);
        let beside = path.with_extension("new");
        std::fs::write(&beside, pem).unwrap();
        std::fs::rename(&beside, &path).unwrap();
        path.to_str().unwrap().to_owned()
    }
}

impl TestTls {
    /// The library's configuration.
    pub fn config(&self) -> Arc<ClientConfig> {
        self.0.clone()
    }

    /// A connection, after the handshake of the client's side.
    ///
    /// # Errors
    ///
    /// When the server cannot be believed, or refuses at once.
    pub async fn connect(&self, address: SocketAddr) -> io::Result<TlsStream<TcpStream>> {
        let stream = TcpStream::connect(address).await?;
        stream.set_nodelay(true)?;
        let name = ServerName::from(address.ip());
        TlsConnector::from(self.0.clone())
            .connect(name, stream)
            .await
    }

    /// A channel of gRPC. The endpoint is one of plain text, since the TLS is spoken here.
    pub(crate) async fn channel(
        &self,
        endpoint: &Endpoint,
        address: SocketAddr,
    ) -> Result<Channel, tonic::transport::Error> {
        let tls = self.clone();
        let connect = service_fn(move |_: Uri| {
            let tls = tls.clone();
            async move { tls.connect(address).await.map(TokioIo::new) }
        });
        endpoint.connect_with_connector(connect).await
    }
}
